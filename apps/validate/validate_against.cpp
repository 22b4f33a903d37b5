#include <filesystem>
#include <functional>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "apps/shell/console.h"
#include "apps/shell/failures.h"
#include "apps/shell/output_file.h"
#include "apps/validate/faults/fault_study.h"
#include "apps/validate/report/validation_case.h"
#include "apps/validate/validate_arguments.h"
#include "apps/validate/validate_report.h"
#include "fathom/attribution/attribution.h"
#include "fathom/attribution/model/named_models.h"
#include "fathom/attribution/other_map.h"
#include "fathom/attribution/other_scene.h"
#include "fathom/camera/camera_files.h"
#include "fathom/failures/errors.h"
#include "fathom/image/depth_map.h"
#include "fathom/image/map_files.h"
#include "validation/peers/drawing.h"

namespace fathom::app {
namespace {

using attribution::Truth;
using validation::Peer;
using validation::ValidationCase;
using validation::ValidationScene;

std::vector<Peer> peers_of(const ValidateArguments& arguments) {
  std::vector<Peer> peers;
  for (const std::string& name : parse_list(arguments.against)) {
    const auto renderer =
        about_option("--against", [&] { return validation::renderer_named(name); });
    const std::vector<Peer> more = validation::peers_of(renderer, arguments.time_limit());
    peers.insert(peers.end(), more.begin(), more.end());
  }
  if (arguments.variants.empty()) return peers;
  const std::vector<std::string> variants = parse_list(arguments.variants);
  return about_option("--variants", [&] { return validation::with_variants(peers, variants); });
}

/// With --model matching, the variants that have a named model.
std::vector<Peer> with_models(std::vector<Peer> peers) {
  std::erase_if(peers, [](const Peer& peer) { return !validation::matching_model(peer); });
  if (peers.empty()) throw UsageError("--model matching: no model fits these variants");
  return peers;
}

/// Every scene drawn by every peer. Before any thread is started: see draw_in_child.
std::vector<ValidationCase> draw_all(const std::vector<SceneToMake>& scenes,
                                     const std::vector<Peer>& peers, int seconds,
                                     const std::function<void(double)>& progress) {
  std::vector<ValidationCase> cases;
  const auto count = static_cast<double>(scenes.size() * peers.size());
  for (const SceneToMake& scene : scenes) {
    for (const Peer& peer : peers) {
      ValidationCase made{.scene = scene.name,
                          .renderer = name_of(validation::renderer_of(peer)),
                          .variant = validation::variant_name(peer)};
      Stopwatch watch;
      validation::Drawing drawing = validation::draw_in_child(peer, scene.make, seconds);
      made.seconds = watch.lap();
      made.failure = drawing.failure;
      if (drawing.drawn) {
        made.other = std::move(drawing.drawn->map);
        made.model = std::move(drawing.drawn->model);
        made.version = std::move(drawing.drawn->version);
      }
      cases.push_back(std::move(made));
      if (progress) progress(static_cast<double>(cases.size()) / count);
    }
  }
  return cases;
}

/// As a map that someone brings.
void judge_by_model(const std::string& model, ValidationCase& c) {
  const Peer peer = validation::peer_named(validation::renderer_named(c.renderer), c.variant);
  const std::string name = model == matching ? validation::matching_model(peer).value() : model;
  c.variant += " as " + name;
  std::optional<attribution::RendererModel> named;
  if (name != any_model) named = attribution::model_for(name, c.truth->camera);
  const attribution::OtherMap brought = validation::as_brought(c.other);
  auto judged = attribution::judge(c.truth, brought, named);
  attribution::name_other_scene(c.truth->camera, brought, judged);
  set_judgement(c, std::move(judged));
}

/// By all that is known of how it was drawn, or by --model.
void judge(const std::string& model, ValidationCase& c) {
  if (!model.empty()) return judge_by_model(model, c);
  c.attribution = attribution::attribute_and_name(*c.truth, c.other, c.model);
}

void judge_all(std::vector<ValidationCase>& cases, const std::vector<SceneToMake>& scenes,
               const std::string& model, const Console& console) {
  Progress progress(console, "judging");
  const auto report = progress.reporter();
  std::size_t judged = 0;
  for (const SceneToMake& scene : scenes) {
    const ValidationScene made = scene.make();
    const auto truth = std::make_shared<Truth>(attribution::make_truth(made.scene, made.camera));
    for (ValidationCase& c : cases) {
      if (c.scene != scene.name || !c.is_done()) continue;
      Stopwatch watch;
      c.truth = truth;
      judge(model, c);
      c.predicted_fights = validation::predicted_fights(made.scene, *c.truth, c.model);
      c.seconds = c.seconds.value_or(0) + watch.lap();
      if (report) report(static_cast<double>(++judged) / static_cast<double>(cases.size()));
    }
  }
}

}  // namespace

int validate_against(const ValidateArguments& arguments, const Console& console) {
  const std::vector<SceneToMake> scenes = scenes_of(arguments, console);
  std::vector<Peer> peers = peers_of(arguments);
  if (arguments.model == matching) {
    peers = with_models(std::move(peers));
  } else if (!arguments.model.empty() && arguments.model != any_model) {
    about_option("--model", [&] { return attribution::model_named(arguments.model); });
  }
  ValidationReport report(arguments);
  std::vector<ValidationCase> cases;
  {
    Progress progress(console, "drawing");
    cases = draw_all(scenes, peers, arguments.time_limit(), progress.reporter());
  }
  judge_all(cases, scenes, arguments.model, console);
  return report.finish(cases, console);
}

namespace {

using validation::Peer;

/// The renderer of --render in the requested variant, else in its first variant.
Peer peer_to_render(const ValidateArguments& arguments) {
  const auto renderer =
      about_option("--render", [&] { return validation::renderer_named(arguments.render); });
  if (arguments.variants.empty()) {
    return validation::peers_of(renderer, arguments.time_limit()).front();
  }
  return about_option("--variants",
                      [&] { return validation::peer_named(renderer, arguments.variants); });
}

}  // namespace

int validate_render(const ValidateArguments& arguments, const Console& console) {
  if (arguments.output.empty()) throw UsageError("-o MAP is missing: where the map goes");
  const auto format = map_format_of(arguments.output);
  if (!format)
    throw UsageError("-o: '" + arguments.output + "' does not end in " + suffixes_of_float_maps());
  if (arguments.scenes.empty()) throw UsageError("SCENE is missing: the scene to render");
  const SceneToMake scene = scenes_of(arguments, console).front();
  const Peer peer = peer_to_render(arguments);
  OutputFile output(arguments.output);
  validation::Drawing drawing = validation::draw_in_child(peer, scene.make, arguments.time_limit());
  if (!drawing.drawn) throw InputError(drawing.failure);
  DepthMap map = attribution::as_depth_map(drawing.drawn->map);
  const Camera camera = scene.make().camera;
  map.texts[camera_text] = to_json(camera, Digits::seventeen);
  map.texts[engine_text] = drawing.drawn->version;
  output.write([&](const std::filesystem::path& path) {
    write_map(map, path, *format,
              {.channel = holds_all_channels(*format) ? "" : "Z", .camera = camera});
  });
  output.commit();
  return done;
}

}  // namespace fathom::app
