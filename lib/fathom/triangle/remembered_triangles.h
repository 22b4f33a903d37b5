#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <unordered_map>

#include "fathom/scene/triangle_source.h"
#include "fathom/triangle/projected_triangle.h"

namespace fathom::triangle {

/// The exact triangles that a referee was asked about last: about 5 kB each.
class RememberedTriangles {
 public:
  RememberedTriangles(const TriangleSource& triangles, const Camera& camera)
      : triangles_(triangles), camera_(camera) {}

  /// Forgets everything if there is no room for two more.
  void make_room() {
    if (remembered_.size() + 2 > most) remembered_.clear();
  }
  /// Valid until make_room().
  const ProjectedTriangle& get(std::uint32_t number) {
    auto& slot = remembered_[number];
    if (!slot) {
      TierCounts counted_before;  // facing is counted when triangles are binned
      slot = std::make_unique<ProjectedTriangle>(
          project(triangles_.world_corners(number), number, camera_, counted_before));
    }
    return *slot;
  }

 private:
  static constexpr std::size_t most = 2048;

  TriangleSource triangles_;
  const Camera& camera_;
  std::unordered_map<std::uint32_t, std::unique_ptr<ProjectedTriangle>> remembered_;
};

}  // namespace fathom::triangle
