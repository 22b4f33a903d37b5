#include "apps/validate/validate_colours.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "apps/shell/exit_status.h"
#include "apps/shell/standard_streams.h"
#include "apps/validate/scenes_to_draw.h"
#include "fathom/numeric/errors.h"
#include "fathom/pipeline/render_pipeline.h"
#include "validation/child/child_process.h"
#include "validation/colour/colour_comparison.h"
#include "validation/peers/colour_drawing.h"

namespace fathom::app {
namespace {

using pipeline::Material;
using pipeline::Shading;
using validation::ColourComparison;
using validation::Drawn;
using validation::GreyPicture;
using validation::LightModel;
using validation::LitScene;
using validation::VtkShading;

/// Highlights are Phong's, as VTK's are.
constexpr Material glossy{.ambient = 0.15,
                          .diffuse = 0.6,
                          .specular = 0.25,
                          .shininess = 40,
                          .highlight = pipeline::SpecularModel::phong};
constexpr Material matte{.ambient = 0.15,
                         .diffuse = 0.75,
                         .specular = 0,
                         .shininess = 1,
                         .highlight = pipeline::SpecularModel::phong};

/// Two pictures that show the same by their formulas, or whose formulas differ as they say.
struct Pair {
  const char* name;
  const Material* material;
  Shading ours;
  LightModel our_model;
  VtkShading theirs;
  LightModel their_model;
};
constexpr std::array pairs{
    // Without highlights, which ours has from the centre of the face and VTK's from each fragment.
    Pair{"flat, VTK flat, matte", &matte, Shading::flat, LightModel::face, VtkShading::flat,
         LightModel::derived_normal},
    Pair{"phong, VTK Phong", &glossy, Shading::phong, LightModel::interpolated_normal,
         VtkShading::phong, LightModel::interpolated_normal},
    Pair{"phong, VTK Gouraud", &glossy, Shading::phong, LightModel::interpolated_normal,
         VtkShading::gouraud, LightModel::interpolated_normal},
    // Each by a formula of its own.
    Pair{"flat, VTK flat, glossy", &glossy, Shading::flat, LightModel::face, VtkShading::flat,
         LightModel::derived_normal},
    Pair{"gouraud, VTK Gouraud", &glossy, Shading::gouraud, LightModel::corners,
         VtkShading::gouraud, LightModel::interpolated_normal}};

GreyPicture drawn_by_pipeline(const LitScene& lit, Shading shading) {
  pipeline::PipelineOptions options;
  options.precision = pipeline::Precision::binary64;
  options.shading = shading;
  options.material = lit.material;
  options.light = {.towards = lit.towards_light, .in_world = true};
  const auto frame = render_frame(as_scene(lit), lit.camera, options, true);
  GreyPicture picture{lit.camera.width, lit.camera.height, {}, "pipeline"};
  for (const Rgb& c : to_rgb(frame.picture).pixels) picture.codes.push_back(c[0]);
  return picture;
}

std::string line_of(const std::string& scene, const char* pair, const ColourComparison& c) {
  std::string text = fmt::format(
      "{}: {}: {} inside, {} of them equal, at most {} apart (bounds: {} of at most 1, mean "
      "{:.2f}, greatest {}); {} edge, "
      "{} background, {} unexplained\n",
      scene, pair, c.inside, c.equal, c.greatest_difference, c.within_one, c.mean_bound,
      c.greatest_bound, c.edge, c.background, c.unexplained.size());
  constexpr std::size_t most_shown = 5;
  for (std::size_t i = 0; i < std::min(most_shown, c.unexplained.size()); ++i) {
    const auto& p = c.unexplained[i];
    text += fmt::format("  pixel ({}, {}): ours {}, expected {} to {}; VTK {}, expected {} to {}\n",
                        p.x, p.y, p.ours, p.expected_of_ours.least, p.expected_of_ours.greatest,
                        p.theirs, p.expected_of_theirs.least, p.expected_of_theirs.greatest);
  }
  return text;
}

std::vector<SceneToMake> scenes_to_light(const ValidateArguments& arguments,
                                         const Console& console) {
  ValidateArguments chosen = arguments;
  if (chosen.scenes.empty() && chosen.scene_names.empty())
    chosen.scene_names = "sphere,spot,teapot";
  if (!arguments.scenes.empty()) return scenes_of(arguments, console);  // it refers to them
  return scenes_of(chosen, console);
}

}  // namespace

int validate_colours(const ValidateArguments& arguments, const Console& console) {
  struct Picture {
    std::string scene;
    const Pair* pair;
    const SceneToMake* maker;
    std::optional<GreyPicture> theirs;
    std::string failure;
  };
  const std::vector<SceneToMake> scenes = scenes_to_light(arguments, console);
  expect_standard_output();
  const auto make = [](const SceneToMake& scene, const Material& material) {
    const validation::ValidationScene made = scene.make();
    return validation::lit_scene(made.scene, made.camera, material);
  };
  // All of VTK's first, before any thread is started.
  std::vector<Picture> pictures;
  for (const SceneToMake& scene : scenes) {
    for (const Pair& pair : pairs) {
      Picture picture{scene.name, &pair, &scene, {}, {}};
      try {
        picture.theirs = validation::draw_colours_in_child(
            [&] { return make(scene, *pair.material); }, pair.theirs, arguments.time_limit());
      } catch (const InputError& error) {
        if (!arguments.scenes.empty()) throw;
        picture.failure = error.what();
      }
      pictures.push_back(std::move(picture));
    }
  }
  bool all_drawn = true, all_explained = true;
  for (const Picture& picture : pictures) {
    if (!picture.theirs) {
      print(fmt::format("{}: {}: {}\n", picture.scene, picture.pair->name, picture.failure));
      all_drawn = false;
      continue;
    }
    const LitScene lit = make(*picture.maker, *picture.pair->material);
    const GreyPicture ours = drawn_by_pipeline(lit, picture.pair->ours);
    const ColourComparison found = validation::compare_colours(
        lit, {&ours, picture.pair->our_model, validation::binary64_pipeline},
        {&*picture.theirs, picture.pair->their_model, validation::vtk_on_llvmpipe});
    print(line_of(picture.scene, picture.pair->name, found));
    all_explained = all_explained && found.unexplained.empty();
  }
  if (!all_explained) return answer_is_no;
  return all_drawn ? done : unusable_input;
}

}  // namespace fathom::app
