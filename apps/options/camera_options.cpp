#include "apps/options/camera_options.h"

#include <fmt/format.h>

#include "apps/shell/known_files.h"
#include "apps/shell/numbers.h"
#include "fathom/camera/camera_files.h"
#include "fathom/numeric/errors.h"
#include "fathom/scene/framing.h"
#include "fathom/scene/read_scene.h"

namespace fathom::app {

void ViewOptions::add_to(CLI::App& command) {
  command.add_option("--view", view,
                     "AZIMUTH,ELEVATION of the eye in degrees (default 35,25); azimuth 90 is the "
                     "+x side, elevation 90 is above");
  command.add_option("--up", up, "The axis that points up: y (default) or z");
}

View ViewOptions::get() const {
  View result;
  if (!view.empty()) {
    const auto [azimuth, elevation] = parse_pair("--view", view);
    result.azimuth = azimuth;
    result.elevation = elevation;
  }
  if (up != "y" && up != "z") throw UsageError("--up: '" + up + "' is neither y nor z");
  result.up = up == "y" ? UpAxis::y : UpAxis::z;
  return result;
}

void CameraOptions::add_to(CLI::App& command) {
  CLI::Option* camera = command.add_option(
      "--camera", file_, "Camera file (JSON); without it, a camera that frames the scene");
  view_.add_to(command);
  command.add_option("--size", size_, "WIDTHxHEIGHT in pixels (default 1280x720)");
  command.add_option("--fov", fov_, "Vertical field of view in degrees (default 40)");
  command.add_option("--near", near_, "Nearest depth that counts (default 0)");
  command.add_option("--far", far_, "Farthest depth that counts (default: infinity)");
  for (const char* framing : {"--view", "--up", "--size", "--fov", "--near", "--far"}) {
    command.get_option(framing)->excludes(camera);
  }
}

Lens CameraOptions::lens() const {
  Lens lens;
  const auto [width, height] = parse_size("--size", size_);
  lens.width = width;
  lens.height = height;
  lens.vertical_fov = parse_number("--fov", fov_);
  if (!(lens.vertical_fov > 0 && lens.vertical_fov < 180)) {
    throw UsageError("--fov: '" + fov_ + "' is not an angle between 0 and 180 degrees");
  }
  if (!near_.empty()) lens.near = parse_number("--near", near_);
  if (!far_.empty()) lens.far = parse_number("--far", far_);
  return lens;
}

Camera CameraOptions::get_one(const Scene& scene, const char* command) const {
  std::vector<Camera> cameras = get(scene);
  if (cameras.size() != 1) {
    throw UsageError(fmt::format("--camera: a path of {} cameras; {} looks through one",
                                 cameras.size(), command));
  }
  return cameras.front();
}

std::vector<Camera> CameraOptions::get(const Scene& scene) const {
  if (from_file()) {
    note_input(file_);
    std::vector<Camera> cameras = read_cameras(file_);
    if (cameras.empty()) throw InputError(file_ + ": an empty list; expected at least one camera");
    for (std::size_t i = 0; i < cameras.size(); ++i) {
      if (const auto fault = find_fault(cameras[i])) {
        throw InputError(cameras.size() == 1 ? fmt::format("{}: {}", file_, *fault)
                                             : fmt::format("{}: camera {}: {}", file_, i, *fault));
      }
    }
    return cameras;
  }
  const std::string file = scene.sources.empty() ? "scene" : scene.sources.back().path;
  if (triangle_count(scene) == 0) {
    throw InputError(file + ": the scene has no triangle; expected one to frame, or --camera");
  }
  try {
    return {frame_scene(scene, view_.get(), lens())};
  } catch (const InputError& error) {
    throw InputError(file + ": " + error.what() + "; give --camera");
  }
}

}  // namespace fathom::app
