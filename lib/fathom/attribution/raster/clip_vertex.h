#pragma once

#include <array>
#include <vector>

#include "fathom/attribution/model/renderer_model.h"
#include "fathom/attribution/world_mesh.h"

namespace fathom::attribution {

/// A corner in clip coordinates (x, y, z, w), −w ≤ x, y ≤ w inside the image, and how far the
/// renderer's own may be from them. z is w times the window depth, 0 ≤ z ≤ w, whatever OpenGL's
/// own z is.
struct ClipVertex {
  std::array<double, 4> value{}, error{};
  /// Borders of the view volume that it was cut at, one bit each; 0 for a corner of the mesh.
  unsigned borders = 0;
};

/// All points of a mesh, in its order.
std::vector<ClipVertex> clip_vertices(const WorldMesh& mesh, const Camera& camera,
                                      const RasterModel& model);

}  // namespace fathom::attribution
