#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "fathom/camera/camera.h"
#include "fathom/image/depth_map.h"
#include "fathom/scene/scene.h"
#include "fathom/triangle/options.h"

namespace fathom {

/// One triangle that covers a sample (specification, sections 4 and 5).
struct CoveringTriangle {
  std::uint32_t number = 0;
  TriangleOrigin origin;
  /// Signs of e_A, e_B, e_C times the sign of Δ: positive inside, zero on the edge.
  std::array<Sign, 3> edge_signs{};
  /// For an edge function that is zero: whether the edge is a left or a top edge.
  std::array<bool, 3> left_or_top{};
  bool front_facing = false;
  /// Exact planar depth at the sample, in scene units.
  Ratio depth;
  /// Whether D > 0, near ≤ D ≤ far, and culling keeps it. Only such a triangle can be visible.
  bool counts = false;
};

/// Every triangle that covers the sample at the centre of pixel (x, y), column and row from the top
/// left: nearest first, ties by number, and last those that do not count. Brute force.
///
/// Exact    everything, without an interval filter for the edges.
/// Fails    InputError where scene or camera has a fault (find_fault).
std::vector<CoveringTriangle> probe(const Scene& scene, const Camera& camera, std::uint32_t x,
                                    std::uint32_t y, Cull cull = Cull::none);

}  // namespace fathom
