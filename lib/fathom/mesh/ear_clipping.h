#pragma once

#include <array>
#include <vector>

#include "fathom/mesh/planar_ring.h"
#include "fathom/mesh/triangulate_face.h"

namespace fathom::mesh {

/// Cuts ears off a ring that is simple but for corners that repeat the one before them, and turns
/// `way` (specification, section 3); appends the triangles. Exact.
///
/// Cost     about n log n for outlines as they are drawn. A corner that is no ear is looked at
///          again only when its neighbour goes, or the one corner by which it is known to be none;
///          as that is drawn by lot, n log n questions are expected of any ring. Each goes to a
///          tree: log n steps for compact triangles, √n for long ones among corners that lie all
///          over the plane, and at worst, where a long side passes through all its boxes, n.
Triangulation clip_ears(const std::vector<Point2>& points, Sign way,
                        std::vector<std::array<Corner, 3>>& triangles);

}  // namespace fathom::mesh
