#pragma once

#include <filesystem>
#include <optional>

#include "fathom/camera/camera.h"
#include "fathom/image/convert.h"
#include "fathom/image/depth_map.h"

namespace fathom::app {

/// The camera that a map carries in `fathom.camera`; nullopt if it carries none. `file` is named in
/// messages. Fails with InputError where what it carries is no camera.
std::optional<Camera> camera_of(const DepthMap& map, const std::filesystem::path& file);

/// What conversions need to know of a camera.
MapView view_of(const Camera& camera);

}  // namespace fathom::app
