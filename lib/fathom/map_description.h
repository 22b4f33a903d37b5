#pragma once

#include <string_view>

#include "fathom/camera/camera.h"
#include "fathom/image/depth_map.h"
#include "fathom/scene/scene.h"

namespace fathom {

/// Data of a map that allow recomputing it: the camera, the sources with their SHA-256 as JSON, the
/// names of the objects and of the numbers in other channels, the engine.
void describe_map(const Scene& scene, const Camera& camera, std::string_view engine, DepthMap& map);

}  // namespace fathom
