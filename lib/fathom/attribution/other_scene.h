#pragma once

#include <vector>

#include "fathom/attribution/attribution.h"
#include "fathom/attribution/judgement.h"
#include "fathom/attribution/other_map.h"
#include "fathom/camera/camera.h"

namespace fathom::attribution {

/// A possible origin of a map that differs from the camera's size: the camera of the map, the map
/// to compare with this camera, and the finding (kind `size` or `axes`).
struct SizedMap {
  Camera camera;
  OtherMap map;
  Finding finding;
};

/// The ways in which a map may have another size than the camera: rows and columns exchanged, up to
/// eight of them missing or additional at a border, the whole view drawn larger or smaller. Empty
/// if none of these applies.
std::vector<SizedMap> readings_of_other_size(const Camera& camera, const OtherMap& other);

/// The finding that the map does not show the scene, which replaces findings about missing
/// triangles: the map is empty, the scene has nothing in view, or at least nine tenths of the
/// pixels that show a surface in either are unexplained and no fault of the whole image explains
/// them, as in a map of another scene or camera. No finding if nine tenths of them show about the
/// right depth. The finding has the sizes of the given camera and map, if they differ.
void name_other_scene(const Camera& camera, const OtherMap& other, Judgement& judgement);

}  // namespace fathom::attribution
