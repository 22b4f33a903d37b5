#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <map>
#include <memory>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "apps/shell/console.h"
#include "apps/shell/failures.h"
#include "apps/shell/standard_streams.h"
#include "apps/validate/validate_arguments.h"
#include "fathom/attribution/attribution.h"
#include "fathom/failures/errors.h"
#include "fathom/failures/unknown_name.h"
#include "validation/blender/blender_panorama.h"
#include "validation/lenses/lens_cases.h"
#include "validation/lenses/lens_judge.h"
#include "validation/peers/drawing.h"
#include "validation/rays/ray_engines.h"
#include "validation/variants/peer.h"

namespace fathom::app {
namespace {

using Json = nlohmann::ordered_json;
using attribution::PixelClass;
using validation::JudgedLens;
using validation::LensCase;
using validation::RayEngine;

/// A mesh seen from outside, a closed room from inside, small triangles, thin ones, and surfaces
/// that nearly meet.
constexpr const char* usual_lens_scenes = "spot,room,soup,slivers,sheets";
/// Unexplained pixels that are written out for each result.
constexpr std::size_t most_lens_pixels = 20;

/// Refuses options that apply only to maps of pinholes.
void require_options_of_lenses(const ValidateArguments& a) {
  for (const auto& [option, value] : {std::pair{"--baseline", &a.baseline},
                                      {"--junit", &a.junit},
                                      {"--model", &a.model},
                                      {"--camera", &a.camera},
                                      {"--channel", &a.channel}}) {
    if (!value->empty()) throw UsageError(std::string(option) + ": has no meaning with --lenses");
  }
}

bool is_cycles(const std::string& engine) {
  return engine == validation::cycles_engine;
}

/// The lenses of an engine.
std::vector<Camera> lenses_of(const std::string& engine, const Size& size) {
  const auto [width, height] = size;
  return is_cycles(engine) ? validation::blender_panoramas(width, height)
                           : validation::lens_cameras(width, height);
}

/// Those of --variants, otherwise all.
std::vector<Camera> chosen_lenses(const std::string& engine, const ValidateArguments& arguments) {
  std::vector<Camera> lenses = lenses_of(engine, arguments.size);
  if (arguments.variants.empty()) return lenses;
  const std::vector<std::string> names = parse_list(arguments.variants);
  std::erase_if(lenses, [&](const Camera& lens) {
    return std::ranges::find(names, lens.name) == names.end();
  });
  return lenses;
}

void require_known_lenses(const std::vector<std::string>& engines,
                          const ValidateArguments& arguments) {
  if (arguments.variants.empty()) return;
  std::vector<std::string> known;
  for (const std::string& engine : engines)
    for (const Camera& lens : lenses_of(engine, {2, 2}))
      if (std::ranges::find(known, lens.name) == known.end()) known.push_back(lens.name);
  for (const std::string& name : parse_list(arguments.variants)) {
    if (std::ranges::find(known, name) != known.end()) continue;
    throw UnknownName(fmt::format("--variants: there is no lens '{}'; there are {}", name,
                                  fmt::join(known, ", ")),
                      name, known);
  }
}

/// An engine's map of a scene through a lens.
struct TriedLens {
  std::shared_ptr<const LensCase> given;
  std::string engine, version;
  JudgedLens judged;
  /// Why there is no map, in one line.
  std::string failure = {};
};

/// Draws every scene in every panorama of Blender, in processes of their own.
class CyclesDrawings {
 public:
  /// Needs    a process that has started no threads.
  CyclesDrawings(const std::vector<SceneToMake>& scenes, const ValidateArguments& arguments,
                 const Console& console) {
    Progress progress(console, "drawing");
    const auto report = progress.reporter();
    const auto lenses = chosen_lenses(validation::cycles_engine, arguments);
    const auto count = static_cast<double>(scenes.size() * lenses.size());
    for (const SceneToMake& scene : scenes) {
      for (const Camera& lens : lenses) {
        drawings_[{scene.name, lens.name}] = validation::draw_in_child(
            validation::BlenderVariant{},
            [&] { return validation::scene_for_blender(scene.make(), lens); },
            arguments.time_limit());
        if (report) report(static_cast<double>(drawings_.size()) / count);
      }
    }
  }

  [[nodiscard]] const validation::Drawing& of(const std::string& scene,
                                              const std::string& lens) const {
    return drawings_.at({scene, lens});
  }

 private:
  std::map<std::pair<std::string, std::string>, validation::Drawing> drawings_;
};

TriedLens tried_by_cycles(std::shared_ptr<const LensCase> given, const CyclesDrawings& drawings) {
  const validation::Drawing& drawing = drawings.of(given->scene, given->camera.name);
  TriedLens tried{.given = given, .engine = validation::cycles_engine, .failure = drawing.failure};
  if (!drawing.drawn) return tried;
  tried.version = drawing.drawn->version;
  tried.judged = validation::judge_cycles(*given, drawing.drawn->map);
  return tried;
}

TriedLens tried_by(const std::string& name, std::shared_ptr<const LensCase> given,
                   const validation::LensJudge& judge) {
  const RayEngine engine = validation::ray_engine_named(name);
  const auto answers = validation::trace(engine, given->truth.mesh, judge.rays().rays);
  return {.given = std::move(given),
          .engine = name,
          .version = version_of(engine),
          .judged = judge.judge(answers)};
}

std::vector<TriedLens> try_all(const ValidateArguments& given, const Console& console) {
  ValidateArguments arguments = given;
  if (given.scenes.empty() && given.scene_names.empty()) arguments.scene_names = usual_lens_scenes;
  std::vector<std::string> engines = parse_list(arguments.lenses);
  require_known_lenses(engines, arguments);
  const std::vector<SceneToMake> scenes = scenes_of(arguments, console);
  const bool has_cycles = std::erase_if(engines, is_cycles) > 0;
  std::optional<CyclesDrawings> drawings;
  if (has_cycles) drawings.emplace(scenes, arguments, console);
  std::vector<TriedLens> tried;
  Progress progress(console, "judging");
  const auto report = progress.reporter();
  for (std::size_t i = 0; i < scenes.size(); ++i) {
    const validation::ValidationScene scene = scenes[i].make();
    const auto case_of = [&](const Camera& lens) {
      return std::make_shared<const LensCase>(validation::lens_case(scene, lens));
    };
    if (!engines.empty()) {
      for (const Camera& lens : chosen_lenses(engines.front(), arguments)) {
        const auto one = case_of(lens);
        const validation::LensJudge judge(*one);
        for (const std::string& name : engines) tried.push_back(tried_by(name, one, judge));
      }
    }
    if (has_cycles) {
      for (const Camera& lens : chosen_lenses(validation::cycles_engine, arguments))
        tried.push_back(tried_by_cycles(case_of(lens), *drawings));
    }
    if (report) report(static_cast<double>(i + 1) / static_cast<double>(scenes.size()));
  }
  return tried;
}

std::string lens_row(const std::array<std::string, 12>& cells) {
  return fmt::format(
      "{:<14} {:<8} {:<18} {:>7} {:>7} {:>7} {:>7} {:>11} {:>10} {:>7} {:>6} {:>11}\n", cells[0],
      cells[1], cells[2], cells[3], cells[4], cells[5], cells[6], cells[7], cells[8], cells[9],
      cells[10], cells[11]);
}

std::string table_of(const std::vector<TriedLens>& tried) {
  std::string text = lens_row({"engine", "scene", "lens", "rays", "equal", "next", "within",
                               "rounded ray", "arithmetic", "missed", "acosf", "unexplained"});
  for (const TriedLens& t : tried) {
    if (!t.failure.empty()) {
      text +=
          fmt::format("{} {} {}: {}\n", t.engine, t.given->scene, t.given->camera.name, t.failure);
      continue;
    }
    const attribution::Attribution& found = t.judged.attribution;
    const auto count = [&](PixelClass c) { return std::to_string(found.count(c)); };
    const std::size_t without_ray = found.classes.size() - t.judged.rays;
    const std::size_t of_another = found.count(PixelClass::edge) +
                                   found.count(PixelClass::z_fight) +
                                   found.count(PixelClass::missed);
    text += lens_row({t.engine, t.given->scene, t.given->camera.name, std::to_string(t.judged.rays),
                      std::to_string(found.count(PixelClass::equal) - without_ray),
                      count(PixelClass::quantization), count(PixelClass::arithmetic),
                      std::to_string(t.judged.by_rounded_rays),
                      std::to_string(of_another - t.judged.by_rounded_rays - t.judged.missed),
                      std::to_string(t.judged.missed), std::to_string(t.judged.by_acos),
                      count(PixelClass::unexplained)});
  }
  return text +
         "equal, next: the exact distance in binary32, or a neighbour of it; within: within the "
         "bound of the\nengine's arithmetic; rounded ray, arithmetic: another triangle, because of "
         "the rounding of the ray,\nor by the engine's arithmetic; missed: the ray slipped through "
         "an edge;\nacosf: explained by the steps of Cycles' azimuth\n";
}

Json unexplained_pixels(const TriedLens& t) {
  const attribution::Attribution& found = t.judged.attribution;
  Json pixels = Json::array();
  for (const std::size_t pixel :
       attribution::worst_pixels(t.given->truth, t.judged.map, found, most_lens_pixels)) {
    if (found.classes[pixel] == PixelClass::unexplained)
      pixels.push_back(attribution::pixel_text(t.given->truth, t.judged.map, found, pixel));
  }
  return pixels;
}

Json as_json(const TriedLens& t) {
  if (!t.failure.empty()) {
    return {{"engine", t.engine},
            {"scene", t.given->scene},
            {"lens", t.given->camera.name},
            {"failure", t.failure}};
  }
  const attribution::Attribution& found = t.judged.attribution;
  Json pixels;
  for (std::size_t k = 0; k < attribution::pixel_class_count; ++k)
    pixels[name_of(static_cast<PixelClass>(k))] = found.counts[k];
  return {{"engine", t.engine},
          {"version", t.version},
          {"scene", t.given->scene},
          {"lens", t.given->camera.name},
          {"width", t.given->camera.width},
          {"height", t.given->camera.height},
          {"rays", t.judged.rays},
          {"pixels", pixels},
          {"by_rounded_rays", t.judged.by_rounded_rays},
          {"by_acos", t.judged.by_acos},
          {"bounds",
           {{"median_relative_width", found.sharpness.median_relative_width},
            {"may_share", found.sharpness.may_share}}},
          {"greatest_relative_error", found.errors.greatest_relative},
          {"unexplained", unexplained_pixels(t)}};
}

}  // namespace

int validate_lenses(const ValidateArguments& arguments, const Console& console) {
  require_options_of_lenses(arguments);
  ResultsFile file(arguments.output, "lenses.json");
  const std::vector<TriedLens> tried = try_all(arguments, console);
  print(table_of(tried));
  Json results = Json::array();
  for (const TriedLens& t : tried) results.push_back(as_json(t));
  file.write(results);
  const bool is_wrong =
      std::ranges::any_of(tried, [](const TriedLens& t) { return t.judged.unexplained() > 0; });
  const bool is_missing =
      std::ranges::any_of(tried, [](const TriedLens& t) { return !t.failure.empty(); });
  return is_wrong ? answer_is_no : is_missing ? unusable_input : done;
}

}  // namespace fathom::app
