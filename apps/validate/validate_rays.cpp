#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <nlohmann/json.hpp>
#include <string>
#include <utility>
#include <vector>

#include "apps/shell/console.h"
#include "apps/shell/failures.h"
#include "apps/shell/standard_streams.h"
#include "apps/validate/validate_arguments.h"
#include "apps/validate/validate_report.h"
#include "fathom/attribution/model/renderer_input.h"
#include "fathom/failures/errors.h"
#include "validation/rays/ray_cases.h"
#include "validation/rays/ray_engines.h"
#include "validation/rays/ray_judge.h"

namespace fathom::app {
namespace {

using Json = nlohmann::ordered_json;
using validation::EngineAnswers;
using validation::JudgedRays;
using validation::RayCase;
using validation::RayEngine;
using validation::RayVerdict;

constexpr std::uint32_t usual_count = 16384;
/// Scenes that closed meshes of different kinds make; others come with --scene.
constexpr const char* usual_scenes = "sphere,spot,teapot,room";
/// Wrong answers that are written out, of each engine and kind of rays.
constexpr std::size_t most_written = 20;

/// Refuses options that apply only to depth maps.
void require_options_of_rays(const ValidateArguments& a) {
  for (const auto& [option, value] : {std::pair{"--variants", &a.variants},
                                      {"--baseline", &a.baseline},
                                      {"--junit", &a.junit},
                                      {"--model", &a.model},
                                      {"--camera", &a.camera},
                                      {"--channel", &a.channel}}) {
    if (!value->empty()) throw UsageError(std::string(option) + ": has no meaning with --rays");
  }
}

std::vector<RayCase> cases_of(const ValidateArguments& given, const Console& console) {
  const std::size_t count = given.ray_count.value_or(usual_count);
  const bool are_named = !given.scenes.empty() || !given.scene_names.empty();
  ValidateArguments arguments = given;
  if (!are_named) arguments.scene_names = usual_scenes;
  std::vector<RayCase> cases;
  if (!are_named) cases = validation::made_ray_cases(count);
  for (const SceneToMake& scene : scenes_of(arguments, console)) {
    const auto mesh = attribution::world_mesh(scene.make().scene);
    for (RayCase& one : validation::ray_cases(scene.name, mesh, count))
      cases.push_back(std::move(one));
  }
  return cases;
}

/// An engine's answers to the rays of a case.
struct Tried {
  const RayCase* given;
  RayEngine engine;
  EngineAnswers answers;
  JudgedRays judged;
};

std::vector<Tried> try_all(const std::vector<RayCase>& cases, const ValidateArguments& arguments,
                           const Console& console) {
  const std::vector<std::string> engines = parse_list(arguments.rays);
  std::vector<Tried> tried;
  Progress progress(console, "tracing");
  const auto report = progress.reporter();
  const auto count = static_cast<double>(cases.size() * engines.size());
  for (const RayCase& one : cases) {
    const validation::RayJudge judge(one);
    for (const std::string& name : engines) {
      const RayEngine engine = validation::ray_engine_named(name);
      EngineAnswers answers = validation::trace(engine, one.mesh, one.rays);
      JudgedRays judged = judge.judge(answers);
      tried.push_back({&one, engine, std::move(answers), std::move(judged)});
      if (report) report(static_cast<double>(tried.size()) / count);
    }
  }
  return tried;
}

std::string row(const std::array<std::string, 12>& cells) {
  return fmt::format("{:<14} {:<8} {:<9} {:>8} {:>6} {:>9} {:>7} {:>7} {:>6} {:>9} {:>9} {:>10}\n",
                     cells[0], cells[1], cells[2], cells[3], cells[4], cells[5], cells[6], cells[7],
                     cells[8], cells[9], cells[10], cells[11]);
}

std::string table_of(const std::vector<Tried>& tried) {
  std::string text = row({"engine", "scene", "rays", "number", "lost", "invented", "behind",
                          "beside", "ties", "too few", "too many", "t off by"});
  for (const Tried& t : tried) {
    const auto count = [&](RayVerdict verdict) {
      return std::to_string(t.judged.counts.at(static_cast<std::size_t>(verdict)));
    };
    text += row({name_of(t.engine), t.given->scene, t.given->rays_name,
                 std::to_string(t.given->rays.size()), count(RayVerdict::lost),
                 count(RayVerdict::invented), count(RayVerdict::behind), count(RayVerdict::beside),
                 count(RayVerdict::tie), std::to_string(t.judged.counts_too_low),
                 std::to_string(t.judged.counts_too_high),
                 fmt::format("{:.3g}", t.judged.greatest_error_of_t)});
  }
  return text +
         "lost, invented, behind, beside: wrong nearest hits; too few, too many: wrong numbers of "
         "hits; t off by: steps of binary32\n";
}

Json hit_as_json(const RayHit& hit) {
  if (hit.triangle == no_triangle) return nullptr;
  return {{"triangle", hit.triangle}, {"t", hit.t}};
}

Json wrong_answers(const Tried& t) {
  Json wrong = Json::array();
  for (std::size_t i = 0; i < t.given->rays.size() && wrong.size() < most_written; ++i) {
    const RayVerdict verdict = t.judged.verdicts[i];
    if (!is_fault(verdict)) continue;
    wrong.push_back({{"ray", i},
                     {"origin", t.given->rays[i].origin},
                     {"direction", t.given->rays[i].direction},
                     {"verdict", name_of(verdict)},
                     {"truth", hit_as_json(t.judged.truth[i])},
                     {"answer", hit_as_json(t.answers.nearest[i])}});
  }
  return wrong;
}

Json as_json(const Tried& t) {
  Json verdicts;
  for (std::size_t k = 0; k < validation::verdict_count; ++k)
    verdicts[name_of(static_cast<RayVerdict>(k))] = t.judged.counts[k];
  return {{"engine", name_of(t.engine)},
          {"version", version_of(t.engine)},
          {"scene", t.given->scene},
          {"triangles", t.given->mesh.triangles.size()},
          {"rays", t.given->rays_name},
          {"number", t.given->rays.size()},
          {"verdicts", verdicts},
          {"counts",
           {{"judged", t.judged.counts_judged},
            {"too_low", t.judged.counts_too_low},
            {"too_high", t.judged.counts_too_high}}},
          {"greatest_error_of_t", t.judged.greatest_error_of_t},
          {"wrong", wrong_answers(t)}};
}

}  // namespace

int validate_rays(const ValidateArguments& arguments, const Console& console) {
  require_options_of_rays(arguments);
  ResultsFile file(arguments.output, "rays.json");
  const std::vector<RayCase> cases = cases_of(arguments, console);
  const std::vector<Tried> tried = try_all(cases, arguments, console);
  print(table_of(tried));
  Json results = Json::array();
  for (const Tried& t : tried) results.push_back(as_json(t));
  file.write(results);
  const bool is_wrong = std::ranges::any_of(tried, [](const Tried& t) {
    return t.judged.faults() + t.judged.counts_too_low + t.judged.counts_too_high > 0;
  });
  return is_wrong ? answer_is_no : done;
}

}  // namespace fathom::app
