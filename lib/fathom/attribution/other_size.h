#pragma once

#include <vector>

#include "fathom/attribution/finding.h"
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
/// eight missing or additional at a border, the whole view drawn larger or smaller. None for a map
/// that is neither.
std::vector<SizedMap> readings_of_other_size(const Camera& camera, const OtherMap& other);

}  // namespace fathom::attribution
