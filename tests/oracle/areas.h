#pragma once

#include <map>

#include "tests/oracle/ray_caster.h"

/// The slow answer to how much of a pixel a scene covers, and how much of it each triangle. It
/// shares no code and no method with the engines: triangles are clipped in three dimensions, corner
/// by corner, divided, and the pixel is cut into slabs between which nothing crosses, in GMP's own
/// rational numbers.
namespace fathom::oracle {

using Point = std::array<Q, 2>;

/// What a triangle projects to within a pixel.
struct Piece {
  std::uint32_t triangle = 0;
  /// Convex, with an area.
  std::vector<Point> corners;
  /// key[0]·u + key[1]·v + key[2] orders the triangles at a point, the least is the nearest: −1/D
  /// under perspective, D under an orthographic projection.
  std::array<Q, 3> key;
};

class Areas {
 public:
  Areas(const RayCamera& camera, const std::vector<Triangle>& triangles);

  /// The area of the union of what the triangles cover of pixel (x, y).
  [[nodiscard]] Q coverage(int x, int y) const;
  /// The area within pixel (x, y) of the points at which each triangle is visible; none is 0.
  [[nodiscard]] std::map<std::uint32_t, Q> visible(int x, int y) const;
  /// The area of what one triangle covers of pixel (x, y).
  [[nodiscard]] Q unoccluded(std::uint32_t triangle, int x, int y) const;
  /// All triangles that cover a part of pixel (x, y), in the order of their numbers.
  [[nodiscard]] std::vector<Piece> pieces(int x, int y) const;

 private:
  [[nodiscard]] std::vector<Point> project(const Triangle& t, int x, int y) const;
  [[nodiscard]] bool key_of(const Triangle& t, std::array<Q, 3>& key) const;

  RayCamera camera_;
  std::vector<Triangle> in_camera_;
};

/// Twice the signed area.
Q twice_area(const std::vector<Point>& polygon);

}  // namespace fathom::oracle
