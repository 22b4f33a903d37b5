#include "fathom/geometry/approximate_row.h"

#include <cmath>
#include <limits>

#include "fathom/numeric/certified_value.h"

namespace fathom {

ApproximateRow::ApproximateRow(const std::array<Dyadic, 4>& row) {
  for (std::size_t k = 0; k < 4; ++k) {
    const auto [lower, upper] = enclose(row[k]);
    coefficients_[k] = lower;
    // Outside the normal numbers a coefficient's own rounding has no relative bound.
    usable_ = usable_ && (row[k].is_zero() || (std::isnormal(lower) && std::isnormal(upper)));
  }
}

// With u = 2⁻⁵³: the error of a term comes from its coefficient (truncated: 2u), its product and
// the up to three sums that it goes through, together at most (1 + 2u)(1 + u)⁴ − 1 < 2⁻⁵⁰ of the
// sum S of the magnitudes. The computed S is too small by at most as much, which leaves room within
// 2⁻⁴⁹·S. A product that underflows adds 2⁻¹⁰⁷⁵. Infinities and NaNs yield the whole line.
Interval ApproximateRow::at(const MeshPoint& p) const {
  constexpr double infinity = std::numeric_limits<double>::infinity();
  const auto& [a, b, c, d] = coefficients_;
  const double value = a * p.x + b * p.y + c * p.z + d;
  const double magnitude = std::abs(a * p.x) + std::abs(b * p.y) + std::abs(c * p.z) + std::abs(d);
  const double error = magnitude * 0x1p-49 + 0x1p-1070;
  if (!usable_ || !std::isfinite(magnitude)) return {-infinity, infinity};
  return enclose(Certified<double>{value, error});
}

}  // namespace fathom
