#include "apps/validate/validate_against.h"

#include <functional>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "apps/shell/about_option.h"
#include "apps/shell/progress.h"
#include "apps/shell/stopwatch.h"
#include "apps/validate/scenes_to_draw.h"
#include "apps/validate/validate_report.h"
#include "fathom/attribution/attribute_and_name.h"
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

void judge_all(std::vector<ValidationCase>& cases, const std::vector<SceneToMake>& scenes) {
  for (const SceneToMake& scene : scenes) {
    const ValidationScene made = scene.make();
    const auto truth = std::make_shared<Truth>(attribution::make_truth(made.scene, made.camera));
    for (ValidationCase& c : cases) {
      if (c.scene != scene.name || !c.is_done()) continue;
      Stopwatch watch;
      c.attribution = attribution::attribute_and_name(*truth, c.other, c.model);
      c.truth = truth;
      c.seconds = c.seconds.value_or(0) + watch.lap();
    }
  }
}

}  // namespace

int validate_against(const ValidateArguments& arguments, const Console& console) {
  const std::vector<SceneToMake> scenes = scenes_of(arguments, console);
  const std::vector<Peer> peers = peers_of(arguments);
  ValidationReport report(arguments);
  std::vector<ValidationCase> cases;
  {
    Progress progress(console, "drawing");
    cases = draw_all(scenes, peers, arguments.time_limit(), progress.reporter());
  }
  judge_all(cases, scenes);
  return report.finish(cases);
}

}  // namespace fathom::app
