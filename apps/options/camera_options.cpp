#include "apps/options/camera_options.h"

#include <fmt/core.h>

#include <algorithm>

#include "apps/options/map_argument.h"
#include "apps/shell/known_files.h"
#include "fathom/camera/camera_files.h"
#include "fathom/camera/camera_import.h"
#include "fathom/failures/errors.h"
#include "fathom/files/input_file.h"
#include "fathom/image/recognise_map.h"
#include "fathom/scene/framing.h"

namespace fathom::app {
namespace {

/// The camera that frames the scene.
Camera framing_camera(const Scene& scene, const View& view, const Lens& lens) {
  const std::string file = scene.sources.empty() ? "scene" : scene.sources.back().path;
  const auto is_empty = [&](const Object& object) { return scene.meshes[object.mesh].is_empty(); };
  if (std::ranges::all_of(scene.objects, is_empty)) {
    throw InputError(file + ": the scene has no triangle; expected one to frame, or --camera");
  }
  try {
    return frame_scene(scene, view, lens);
  } catch (const InputError& error) {
    throw InputError(std::string(error.what()) + "; give --camera");
  }
}

std::vector<Camera> cameras_of_map(std::span<const std::byte> bytes, const std::string& file) {
  const std::optional<Camera> camera = camera_in_map(read_map_argument(bytes, file), file);
  if (!camera) throw InputError(file + ": the map carries no camera, expected a camera file");
  return {*camera};
}

}  // namespace

std::optional<Camera> camera_in_map(const DepthMap& map, const std::string& file) {
  const auto text = map.texts.find("fathom.camera");
  if (text == map.texts.end()) return std::nullopt;
  const std::vector<Camera> cameras = read_cameras(text->second, file + ": fathom.camera");
  if (cameras.size() != 1) throw InputError(file + ": fathom.camera does not hold one camera");
  return cameras[0];
}

void CameraOptions::add_to(Command& command) {
  const Option camera = command.option("--camera", "FILE", file_,
                                       "Camera file (JSON), or a map, which contains its camera "
                                       "(default: a camera that frames the scene)");
  for (Option& framing : add_view_options(command, view_)) framing.excludes(camera);
  for (Option& part : add_lens_options(command, lens_)) part.excludes(camera);
}

std::vector<Camera> CameraOptions::get(const Scene& scene, const Console& console) const {
  if (from_file()) return read_camera_file(file_, console);
  return {framing_camera(scene, view_, lens_)};
}

Camera CameraOptions::get_one(const Scene& scene, const char* command,
                              const Console& console) const {
  std::vector<Camera> cameras = get(scene, console);
  if (cameras.size() != 1) {
    throw UsageError(fmt::format("--camera: a path of {} cameras; {} takes a single one",
                                 cameras.size(), command));
  }
  return cameras.front();
}

std::vector<Camera> read_camera_file(const std::string& file, const Console& console) {
  note_input(file);
  if (is_colmap_model(file)) {
    throw InputError(fmt::format(
        "{0}: is a COLMAP model, expected a camera file; 'fathom camera import colmap {0} -o "
        "cameras.json' makes one",
        file));
  }
  const files::InputFile input(file);
  Warnings warnings;
  std::vector<Camera> cameras = is_map(input.bytes()) ? cameras_of_map(input.bytes(), file)
                                                      : read_cameras(input.text(), file, warnings);
  console.warn(warnings);
  if (cameras.empty()) throw InputError(file + ": an empty list; expected at least one camera");
  for (std::size_t i = 0; i < cameras.size(); ++i) {
    if (const auto fault = find_fault(cameras[i])) {
      throw InputError(cameras.size() == 1 ? fmt::format("{}: {}", file, *fault)
                                           : fmt::format("{}: camera {}: {}", file, i, *fault));
    }
  }
  return cameras;
}

}  // namespace fathom::app
