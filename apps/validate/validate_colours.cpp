#include <string>
#include <utility>
#include <vector>

#include "apps/shell/console.h"
#include "apps/validate/colour_report.h"
#include "apps/validate/validate_input.h"
#include "apps/validate/validate_modes.h"
#include "apps/validate/validate_report.h"
#include "fathom/failures/errors.h"
#include "validation/peers/drawing.h"

namespace fathom::app {
namespace {

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
