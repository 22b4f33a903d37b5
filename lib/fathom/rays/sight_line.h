#pragma once

#include <array>
#include <cstdint>
#include <optional>

#include "fathom/numeric/certified_value.h"
#include "fathom/rays/sight.h"
#include "fathom/rays/walk_ray.h"
#include "fathom/scene/triangle_source.h"

namespace fathom::rays {

using CertifiedNumber = Certified<double>;
using CertifiedVector = std::array<CertifiedNumber, 3>;

CertifiedNumber minus(const CertifiedNumber& a, const CertifiedNumber& b);
/// x in units of 2 to the power of `power`; what lies below 2⁻¹⁰⁷⁴ is lost.
CertifiedNumber number_in_unit(double x, long power);
/// The corners of a triangle.
std::array<CertifiedVector, 3> corners_in_unit(const TriangleSource& source, std::uint32_t triangle,
                                               long power);

/// An end of a line of sight, in the unit of a tree.
class SightEnd {
 public:
  SightEnd(const SightPoint& point, const TriangleSource& source, long power);

  /// With bounds, which are infinite where binary64 has no such number.
  [[nodiscard]] const CertifiedVector& near() const { return near_; }
  /// In the world. Recomputed at each call.
  [[nodiscard]] WorldPoint exact(const TriangleSource& source) const;
  /// The triangle that it is a point of, or no_triangle. A line through the point that is not
  /// parallel to the triangle meets its plane there, so that the triangle hides nothing.
  [[nodiscard]] std::uint32_t triangle() const;

 private:
  SightPoint point_;
  CertifiedVector near_;
};

/// The ray that is at `from` for t = 0 and at `to` for t = 1, from t = 0 to t = 1. nullopt if the
/// bounds leave its direction open, or if `from` is not near the scene: then prepare() takes the
/// exact ray.
std::optional<WalkRay> prepare_between(const CertifiedVector& from, const CertifiedVector& to);

}  // namespace fathom::rays
