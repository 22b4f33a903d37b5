#include "apps/maps/map_view.h"

#include <fmt/core.h>

#include <optional>

#include "apps/options/camera_options.h"
#include "fathom/failures/errors.h"

namespace fathom::app {
namespace {

/// The one camera of a file, of the size of the map.
Camera camera_in(const std::string& file, const DepthMap& map, const Console& console) {
  const std::vector<Camera> cameras = read_camera_file(file, console);
  if (cameras.size() != 1) {
    throw UsageError(fmt::format("--camera: a path of {} cameras; a map has one", cameras.size()));
  }
  if (cameras[0].width != map.width || cameras[0].height != map.height) {
    throw InputError(fmt::format("{}: a camera of {}x{} pixels, but the map has {}x{}", file,
                                 cameras[0].width, cameras[0].height, map.width, map.height));
  }
  return cameras[0];
}

}  // namespace

Camera camera_for(const DepthMap& map, const std::string& map_file, const std::string& camera_file,
                  const Console& console) {
  if (!camera_file.empty()) return camera_in(camera_file, map, console);
  const std::optional<Camera> camera = camera_in_map(map, map_file);
  if (!camera) throw InputError(map_file + ": carries no camera; expected --camera FILE");
  return *camera;
}

MapView view_for(const DepthMap& map, const std::string& map_file, const std::string& camera_file,
                 const Console& console) {
  return view_of(camera_for(map, map_file, camera_file, console));
}

}  // namespace fathom::app
