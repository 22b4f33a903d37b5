#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "fathom/scene/triangle_source.h"

namespace fathom::rays {

using Vector = std::array<double, 3>;

/// Powers of two to measure in: every corner of a triangle, and every point of a mesh without
/// triangles, has coordinates of less than 2 to this power, exactly.
long power_of_unit(const TriangleSource& triangles);

/// A point of an object's mesh in the world, in units of 2 to the power of `power`. A point of an
/// object that is placed without a transform loses only bits below 2⁻¹⁰⁷⁴; other points are rounded
/// once.
Vector in_unit(const Object& object, const MeshPoint& p, long power);

/// How far a coordinate of a placed corner may be from the exact one: it is below 1, and rounded
/// once.
inline constexpr double placing_error = 0x1p-54;

/// The triangles of a scene in the world, in binary64 and in a unit in which all coordinates are
/// below 1: bounds on errors are plain numbers then, and nothing overflows.
class PlacedTriangles {
 public:
  /// Each coordinate is within placing_error of the exact one (in_unit).
  using Corners = std::array<Vector, 3>;

  /// The unit is 2 to the power of `power`, at least power_of_unit().
  PlacedTriangles(const TriangleSource& triangles, long power);

  [[nodiscard]] std::uint32_t count() const { return static_cast<std::uint32_t>(corners_.size()); }
  [[nodiscard]] const Corners& operator[](std::uint32_t number) const { return corners_[number]; }
  [[nodiscard]] long power() const { return power_; }

 private:
  long power_;
  std::vector<Corners> corners_;
};

}  // namespace fathom::rays
