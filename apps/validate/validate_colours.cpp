#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <deque>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "apps/shell/console.h"
#include "apps/shell/failures.h"
#include "apps/shell/output_file.h"
#include "apps/shell/standard_streams.h"
#include "apps/validate/validate_arguments.h"
#include "apps/validate/validate_report.h"
#include "fathom/failures/errors.h"
#include "fathom/image/rgb_image.h"
#include "fathom/pipeline/render_pipeline.h"
#include "validation/colour/colour_comparison.h"
#include "validation/peers/drawing.h"
#include "validation/vtk/drawn_by_vtk.h"

namespace fathom::app {
namespace {

struct ColourPair {
  const char* name;
  const char* file;  ///< the end of the name of its picture
  /// With highlights or without.
  bool glossy;
  pipeline::Shading ours;
  validation::LightModel our_model;
  validation::VtkShading theirs;
  validation::LightModel their_model;
};

/// Pairs with equal formulas first.
constexpr std::array colour_pairs{
    // Without highlights, which ours has from the centre of the face and VTK's from each fragment.
    ColourPair{"flat, VTK flat, matte", "flat-matte", false, pipeline::Shading::flat,
               validation::LightModel::face, validation::VtkShading::flat,
               validation::LightModel::derived_normal},
    ColourPair{"phong, VTK Phong", "phong", true, pipeline::Shading::phong,
               validation::LightModel::interpolated_normal, validation::VtkShading::phong,
               validation::LightModel::interpolated_normal},
    ColourPair{"phong, VTK Gouraud", "phong-beside-gouraud", true, pipeline::Shading::phong,
               validation::LightModel::interpolated_normal, validation::VtkShading::gouraud,
               validation::LightModel::interpolated_normal},
    // Different formulas.
    ColourPair{"flat, VTK flat, glossy", "flat", true, pipeline::Shading::flat,
               validation::LightModel::face, validation::VtkShading::flat,
               validation::LightModel::derived_normal},
    ColourPair{"gouraud, VTK Gouraud", "gouraud", true, pipeline::Shading::gouraud,
               validation::LightModel::corners, validation::VtkShading::gouraud,
               validation::LightModel::interpolated_normal}};

/// A scene and a pair of pictures of it, or the reason why they are missing.
struct ColourCase {
  std::string scene;
  const ColourPair* pair = nullptr;
  std::string failure;
  std::optional<validation::GreyPicture> ours, theirs;
  validation::ColourComparison found;
};

using Json = nlohmann::ordered_json;
using validation::ColourComparison;
using validation::UnexplainedPixel;

constexpr std::size_t most_shown = 5;

std::string line_of(const ColourCase& c) {
  if (!c.theirs) return fmt::format("{}: {}: {}\n", c.scene, c.pair->name, c.failure);
  const ColourComparison& f = c.found;
  std::string text = fmt::format(
      "{}: {}: {} inside, {} of them equal, at most {} apart (bounds: {} of at most 1, mean "
      "{:.2f}, greatest {}); {} edge, {} background, {} unexplained\n",
      c.scene, c.pair->name, f.inside, f.equal, f.greatest_difference, f.within_one, f.mean_bound,
      f.greatest_bound, f.edge, f.background, f.unexplained.size());
  for (std::size_t i = 0; i < std::min(most_shown, f.unexplained.size()); ++i) {
    const UnexplainedPixel& p = f.unexplained[i];
    text += fmt::format("  pixel ({}, {}): ours {}, expected {} to {}; VTK {}, expected {} to {}\n",
                        p.x, p.y, p.ours, p.expected_of_ours.least, p.expected_of_ours.greatest,
                        p.theirs, p.expected_of_theirs.least, p.expected_of_theirs.greatest);
  }
  return text;
}

Json to_json(const ColourCase& c) {
  Json json{{"scene", c.scene}, {"pair", c.pair->name}};
  if (!c.theirs) {
    json["failure"] = c.failure;
    return json;
  }
  const ColourComparison& f = c.found;
  json["version"] = c.theirs->version;
  json["pixels"] = {{"inside", f.inside},
                    {"edge", f.edge},
                    {"background", f.background},
                    {"unexplained", f.unexplained.size()}};
  json["equal"] = f.equal;
  json["greatest_difference"] = f.greatest_difference;
  json["bounds"] = {
      {"at_most_one", f.within_one}, {"mean", f.mean_bound}, {"greatest", f.greatest_bound}};
  Json pixels = Json::array();
  for (std::size_t i = 0; i < std::min(most_shown, f.unexplained.size()); ++i) {
    const UnexplainedPixel& p = f.unexplained[i];
    pixels.push_back(
        {{"pixel", {p.x, p.y}},
         {"ours", p.ours},
         {"expected_of_ours", {p.expected_of_ours.least, p.expected_of_ours.greatest}},
         {"theirs", p.theirs},
         {"expected_of_theirs", {p.expected_of_theirs.least, p.expected_of_theirs.greatest}}});
  }
  json["unexplained"] = pixels;
  return json;
}

RgbImage side_by_side(const validation::GreyPicture& left, const validation::GreyPicture& right) {
  RgbImage image(2 * left.width, left.height);
  for (std::uint32_t y = 0; y < left.height; ++y) {
    for (std::uint32_t x = 0; x < left.width; ++x) {
      const std::uint8_t a = left.codes.at(std::size_t{y} * left.width + x);
      const std::uint8_t b = right.codes.at(std::size_t{y} * left.width + x);
      image.at(x, y) = {a, a, a};
      image.at(left.width + x, y) = {b, b, b};
    }
  }
  return image;
}

void write_files(const std::vector<ColourCase>& cases, const std::filesystem::path& folder) {
  std::deque<OutputFile> files;
  Json results = Json::array();
  for (const ColourCase& c : cases) {
    results.push_back(to_json(c));
    if (!c.theirs) continue;
    files.emplace_back(folder / (c.scene + "-" + c.pair->file + ".png"));
    files.back().write([&](const std::filesystem::path& path) {
      write_png(side_by_side(*c.ours, *c.theirs), path);
    });
  }
  files.emplace_back(folder / "colours.json");
  files.back().write(json_answer({{"results", results}}));
  std::vector<OutputFile*> all;
  all.reserve(files.size());
  for (OutputFile& file : files) all.push_back(&file);
  OutputFile::commit_together(all);
}

using pipeline::Material;
using pipeline::SpecularModel;
using validation::GreyPicture;

/// Of a pair's surfaces. Highlights are Phong's, as VTK's are.
Material material_of(const ColourPair& pair) {
  if (pair.glossy)
    return {.ambient = 0.15,
            .diffuse = 0.6,
            .specular = 0.25,
            .shininess = 40,
            .highlight = SpecularModel::phong};
  return {.ambient = 0.15,
          .diffuse = 0.75,
          .specular = 0,
          .shininess = 1,
          .highlight = SpecularModel::phong};
}

/// The pipeline's picture, in binary64 and with its usual grid.
GreyPicture drawn_by_pipeline(const validation::LitScene& scene, pipeline::Shading shading) {
  pipeline::PipelineOptions options;
  options.precision = pipeline::Precision::binary64;
  options.shading = shading;
  options.material = scene.material;
  options.light = {.towards = scene.towards_light, .in_world = true};
  const auto frame = render_frame(as_scene(scene), scene.camera, options, true);
  GreyPicture picture{scene.camera.width, scene.camera.height, {}, "pipeline"};
  for (const Rgb& c : to_rgb(frame.picture).pixels) picture.codes.push_back(c[0]);
  return picture;
}

/// Prints a line for each case and, where `out` is not empty, writes colours.json and a picture for
/// each case to that folder, which exists: ours on the left, VTK's on the right. Returns the exit
/// status.
int report_colours(const std::vector<ColourCase>& cases, const std::string& out) {
  std::string text;
  for (const ColourCase& c : cases) text += line_of(c);
  print(text);
  if (!out.empty()) write_files(cases, out);
  if (std::any_of(cases.begin(), cases.end(),
                  [](const ColourCase& c) { return !c.found.unexplained.empty(); }))
    return answer_is_no;
  const bool all_drawn =
      std::all_of(cases.begin(), cases.end(), [](const ColourCase& c) { return c.theirs; });
  return all_drawn ? done : unusable_input;
}

using validation::LitScene;

/// Refuses options that apply only to depth maps.
void require_colour_options(const ValidateArguments& a) {
  for (const auto& [option, value] : {std::pair{"--variants", &a.variants},
                                      {"--baseline", &a.baseline},
                                      {"--model", &a.model},
                                      {"--channel", &a.channel}}) {
    if (!value->empty()) throw UsageError(std::string(option) + ": has no meaning with --colour");
  }
}

LitScene lit(const SceneToMake& scene, const ColourPair& pair) {
  const validation::ValidationScene made = scene.make();
  return validation::lit_scene(made.scene, made.camera, material_of(pair));
}

/// All of VTK's pictures. Before any thread is started: see draw_colours_in_child.
std::vector<ColourCase> draw_all(const std::vector<SceneToMake>& scenes,
                                 const ValidateArguments& arguments, Progress& progress) {
  std::vector<ColourCase> cases;
  const auto count = static_cast<double>(scenes.size() * colour_pairs.size());
  const auto report = progress.reporter();
  for (const SceneToMake& scene : scenes) {
    for (const ColourPair& pair : colour_pairs) {
      ColourCase made{.scene = scene.name, .pair = &pair};
      try {
        made.theirs = validation::draw_colours_in_child([&] { return lit(scene, pair); },
                                                        pair.theirs, arguments.time_limit());
      } catch (const InputError& error) {
        if (!arguments.scenes.empty()) throw;  // there is no other scene
        made.failure = error.what();
      }
      cases.push_back(std::move(made));
      if (report) report(static_cast<double>(cases.size()) / count);
    }
  }
  return cases;
}

}  // namespace

int validate_colours(const ValidateArguments& given, const Console& console) {
  require_colour_options(given);
  ValidateArguments arguments = given;
  if (arguments.scenes.empty() && arguments.scene_names.empty())
    arguments.scene_names = "sphere,spot,teapot";
  const std::vector<SceneToMake> scenes = scenes_of(arguments, console);
  prepare_answer(arguments.output);
  std::vector<ColourCase> cases;
  {
    Progress progress(console, "drawing");
    cases = draw_all(scenes, arguments, progress);
  }
  for (std::size_t i = 0; i < cases.size(); ++i) {
    ColourCase& c = cases[i];
    if (!c.theirs) continue;
    const LitScene scene = lit(scenes[i / colour_pairs.size()], *c.pair);
    c.ours = drawn_by_pipeline(scene, c.pair->ours);
    c.found = validation::compare_colours(
        scene, {&*c.ours, c.pair->our_model, validation::binary64_pipeline},
        {&*c.theirs, c.pair->their_model, validation::vtk_on_llvmpipe});
  }
  return report_colours(cases, arguments.output);
}

}  // namespace fathom::app
