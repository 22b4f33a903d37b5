#pragma once

#include <cmath>
#include <cstdint>
#include <random>
#include <utility>
#include <vector>

#include "tests/inputs/scene_building.h"

/// Random small scenes with coordinates of few bits, so that samples on edges and vertices, equal
/// depths and edge-on triangles abound. Images are 6×5.
namespace fathom::checks {

/// few_bits    as they are;
/// neighbours  some coordinates moved to the next binary64 number;
/// huge, tiny  everything times about 1e±150.
enum class Kind { few_bits, neighbours, huge, tiny };

struct Case {
  Scene scene;
  Camera camera;
};

class CaseMaker {
 public:
  CaseMaker(std::uint64_t seed, Kind kind) : random_(seed), kind_(kind) {}

  Case make() {
    Case c;
    plain_ = below(3) != 0;
    do c.camera = plain_ ? plain_camera() : camera();
    while (find_fault(c.camera));
    c.scene = scene(c.camera);
    return c;
  }

 private:
  int below(int n) { return static_cast<int>(random_() % static_cast<unsigned>(n)); }
  double scale() const {
    return kind_ == Kind::huge ? 0x1p498 : kind_ == Kind::tiny ? 0x1p-498 : 1;  // about 1e±150
  }
  double coordinate() {
    double x = std::ldexp(below(17) - 8, -below(3)) * scale();
    if (kind_ == Kind::neighbours && below(3) == 0) x = std::nextafter(x, below(2) ? 1e9 : -1e9);
    return x;
  }

  /// A corner that the plain camera sees exactly at a pixel centre (or near it, or anywhere).
  MeshPoint corner(const Camera& c) {
    if (!plain_ || below(4) == 0) return {coordinate(), coordinate(), coordinate()};
    const double z = (1 + below(4)) * scale(), half = below(8) == 0 ? 0.25 : 0.5;
    const double u = below(10) - 2 + half, v = below(9) - 2 + half;
    MeshPoint p{(u - c.projection.cx) / c.projection.fx * z,
                (v - c.projection.cy) / c.projection.fy * z, z};
    if (kind_ == Kind::neighbours && below(3) == 0)
      p.x = std::nextafter(p.x, below(2) ? 1e9 : -1e9);
    return p;
  }

  Scene scene(const Camera& c) {
    const int corners = 3 + below(5);
    std::vector<MeshPoint> vertices;
    for (int i = 0; i < corners; ++i) vertices.push_back(corner(c));
    std::vector<CornerIndices> triangles(static_cast<std::size_t>(2 + below(6)));
    for (CornerIndices& t : triangles) {
      for (std::uint32_t& index : t) index = static_cast<std::uint32_t>(below(corners));
    }
    return scene_of(std::move(vertices), std::move(triangles));
  }

  /// No rotation, a focal length that is a power of two: sample rays have few bits.
  Camera plain_camera() {
    Camera c = camera_of(6, 5, std::ldexp(1, below(4)));
    if (below(3) == 0) c.projection.fy = -c.projection.fy;
    if (below(4) == 0) c.near = below(3) * scale();
    if (below(4) == 0) c.far = c.near + (1 + below(3)) * scale();
    return c;
  }

  Camera camera() {
    Camera c = camera_of(6, 5, std::ldexp(1 + below(4), below(3)));
    c.projection.model =
        below(4) == 0 ? ProjectionModel::orthographic : ProjectionModel::perspective;
    if (below(3) == 0) c.projection.fy = -c.projection.fy;
    if (below(3) == 0) c.projection.skew = below(5) - 2;
    if (below(3) == 0) c.projection.cx += 0.25 * below(9) - 1;
    if (below(2) == 0) c.projection.pixel_centre = 0;
    if (is_orthographic(c.projection)) {
      c.projection.fx /= scale();
      c.projection.fy /= scale();
      c.projection.skew /= scale();
    }
    if (below(2) == 0) {
      for (auto& row : c.world_to_camera) {
        for (int k = 0; k < 3; ++k) row[k] = below(5) - 2;
      }
    }
    for (auto& row : c.world_to_camera) row[3] = (below(9) - 4) * scale();
    if (below(2) == 0) c.world_to_camera[2][3] = 8 * scale();
    if (below(4) == 0) c.near = below(4) * scale();
    if (below(4) == 0) c.far = c.near + (1 + below(8)) * scale();
    return c;
  }

  std::mt19937_64 random_;
  Kind kind_;
  bool plain_ = false;
};

}  // namespace fathom::checks
