#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "apps/options/scene_options.h"
#include "apps/shell/command.h"
#include "apps/shell/console.h"
#include "apps/shell/values.h"
#include "fathom/camera/camera.h"
#include "fathom/scene/scene.h"
#include "validation/scenes/validation_scenes.h"

namespace fathom::app {

/// Values of --model that select a model: the best fit, or, for a renderer that draws here, the
/// model of its variant.
inline constexpr const char* any_model = "auto";
inline constexpr const char* matching = "matching";

/// The arguments of `fathom validate`.
struct ValidateArguments {
  std::vector<std::string> scenes;
  std::string map, camera, model, channel, baseline, junit;
  std::string against, scene_names, variants, render, rays, lenses, output;
  bool colour = false, faults = false, for_ctest = false;
  /// Codes per scene unit of a map of integers that does not contain its scale.
  std::optional<double> png_scale;
  ReadLimits limits;
  Size size{320, 240};
  std::uint32_t seconds = 300;
  /// Of each kind and scene, with --rays.
  std::optional<std::uint32_t> ray_count;

  void add_to(Command& command);

  /// Seconds after which a renderer is ended: --time-limit, a day at most.
  [[nodiscard]] int time_limit() const;
};

// Input files of a comparison; no output may overwrite them.

/// The single camera of --camera, or the camera of a path that is called as `map`, the file of
/// --map; empty: there is no such file. Warnings go to the console.
/// Fails    UsageError if the file is not given or has no such camera; InputError.
Camera camera_of_comparison(const ValidateArguments& arguments, const std::string& map,
                            const Console& console);

/// The scene of SCENE…; warnings go to the console.
/// Fails    UsageError if SCENE is missing; InputError.
Scene read_files(const std::vector<std::string>& files, const ReadLimits& limits,
                 const Console& console);

/// A scene and the function that makes it. Every process that draws the scene makes it again.
struct SceneToMake {
  std::string name;
  std::function<validation::ValidationScene()> make;
};

/// The scene of SCENE…, else the scenes of --scene, else all built-in scenes. The result refers to
/// the arguments and the console.
/// Fails    UsageError if --scene names an unknown scene.
std::vector<SceneToMake> scenes_of(const ValidateArguments& arguments, const Console& console);

// The modes of `fathom validate`, by its options.

/// `validate --against`: has renderers draw scenes and compares every map with the truth. Returns
/// the exit status, as ValidationReport::finish().
int validate_against(const ValidateArguments& arguments, const Console& console);

/// `validate --map`: compares a map that another renderer made with the truth. Returns the exit
/// status, as ValidationReport::finish().
int validate_map(const ValidateArguments& arguments, const Console& console);

/// `validate --render`: only draws, and writes the renderer's picture as a map. Returns the exit
/// status.
int validate_render(const ValidateArguments& arguments, const Console& console);

/// `validate --colour`: has VTK draw lit scenes and compares VTK's and the pipeline's pictures with
/// the bounds of their formulas (validation/colour). Returns the exit status: answer_is_no if a
/// pixel is unexplained, unusable_input if VTK did not draw or a scene cannot be compared.
int validate_colours(const ValidateArguments& arguments, const Console& console);

/// `validate --faults --against …`: faults of the catalogue in maps of real renderers. Prints
/// faults that are not found or wrongly named, writes faults.json and faults.md, and returns the
/// exit status: answer_is_no if a right map has a finding, or a large fault is not found and
/// rightly named; unusable_input if a renderer did not draw.
int validate_faults(const ValidateArguments& arguments, const Console& console);

/// `validate --rays`: has engines trace rays and compares every answer with the truth. Prints a
/// line for each engine and kind of rays, writes rays.json, and returns the exit status:
/// answer_is_no if an answer is wrong.
int validate_rays(const ValidateArguments& arguments, const Console& console);

/// `validate --lenses`: has engines trace the rays of cameras with lenses and compares every pixel
/// with the truth. Prints a line for each engine, scene and lens, writes lenses.json, and returns
/// the exit status: answer_is_no if a pixel is unexplained.
int validate_lenses(const ValidateArguments& arguments, const Console& console);

}  // namespace fathom::app
