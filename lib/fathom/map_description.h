#pragma once

#include <string>
#include <string_view>

#include "fathom/camera/camera.h"
#include "fathom/image/convert.h"
#include "fathom/image/depth_map.h"
#include "fathom/scene/scene.h"

namespace fathom {

/// What a map carries so that it can be computed again: the camera and the sources with their
/// SHA-256 as JSON, the names of the objects, the engine; and the camera in OpenEXR's words.
/// Exact    the camera to 17 digits; OpenEXR's matrices are rounded, for other programs' eyes only.
void describe_map(const Scene& scene, const Camera& camera, std::string_view engine, DepthMap& map);

/// Gives a map that was read from a file its world_from_image, by the camera in its texts, if it has one;
/// `name` is the map's for messages.
/// Fails    InputError where the text is no camera.
void add_world_from_image(DepthMap& map, const std::string& name);

/// What conversions of maps need to know of a camera.
MapView view_of(const Camera& camera);

}  // namespace fathom
