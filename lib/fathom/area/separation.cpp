#include "fathom/area/separation.h"

#include <bit>
#include <cstdint>
#include <limits>

namespace fathom::area {
using namespace triangle;

namespace {

/// The point where two lines cross, homogeneous, with a positive weight.
ExactVector3 crossing(const HalfPlane& a, const HalfPlane& b) {
  ExactVector3 point = cross(a.exact(), b.exact());
  if (point[2].sign() == Sign::negative) {
    for (Dyadic& component : point) component = -component;
  }
  return point;
}

/// Non-negative binary64 numbers, in their order, from integers.
double from_place(std::uint64_t place) {
  return std::bit_cast<double>(place);
}

}  // namespace

struct Separation::Ends {
  // n and w of the triangle in front (t) and of the one behind (s), at the first and last point.
  std::array<Dyadic, 2> n_t, w_t, n_s, w_s;
};

Separation::Separation(const ImageCell& cell, const SurfaceRegion& front,
                       const SurfaceRegion& behind)
    : front_numerator_{cell.localised(front.depth_numerator)},
      front_weight_{cell.localised(front.weight)},
      behind_numerator_{cell.localised(behind.depth_numerator)},
      behind_weight_{cell.localised(behind.weight)},
      is_zero_(is_constantly(0.0)) {}

Separation::Ends Separation::ends_of(const BoundarySegment& segment) const {
  Ends ends;
  const HalfPlane* lines[] = {segment.from, segment.to};
  for (std::size_t k = 0; k < 2; ++k) {
    const ExactVector3 point = crossing(*segment.line, *lines[k]);
    ends.n_t[k] = front_numerator_.at(point);
    ends.w_t[k] = front_weight_.at(point);
    ends.n_s[k] = behind_numerator_.at(point);
    ends.w_s[k] = behind_weight_.at(point);
  }
  return ends;
}

// D_s − D_t < δ ⇔ G = n_s·w_t − n_t·w_s − δ·w_s·w_t < 0, as the weights are positive. On the way
// from the first to the last point G is, up to a positive factor, the quadratic polynomial
// (1 − τ)²·G₀ + 2·τ·(1 − τ)·M + τ²·G₁ with the polar form M. If G₀ and G₁ are not negative, its
// least value over 0 < τ < 1 is negative exactly if M < 0 and M² > G₀·G₁; it is at most 0, with
// both ends positive, exactly if M < 0 and M² ≥ G₀·G₁.
bool Separation::reaches(const Ends& e, const Dyadic& limit, bool closed) {
  const auto polar = [&](std::size_t i, std::size_t k) {
    const Dyadic twice = e.n_s[i] * e.w_t[k] + e.n_s[k] * e.w_t[i] - e.n_t[i] * e.w_s[k] -
                         e.n_t[k] * e.w_s[i] - limit * (e.w_s[i] * e.w_t[k] + e.w_s[k] * e.w_t[i]);
    return twice.scaled(-1);
  };
  const Dyadic first = polar(0, 0), last = polar(1, 1);
  for (const Dyadic* end : {&first, &last}) {
    if (end->sign() == Sign::negative || (closed && end->is_zero())) return true;
  }
  const Dyadic middle = polar(0, 1);
  if (middle.sign() != Sign::negative) return false;
  const int order = compare(middle * middle, first * last);
  return closed ? order >= 0 : order > 0;
}

bool Separation::is_below(const Boundary& boundary, const Dyadic& limit) const {
  if (is_zero_) return !boundary.empty() && limit.sign() == Sign::positive;
  for (const BoundarySegment& segment : boundary) {
    if (reaches(ends_of(segment), limit, false)) return true;
  }
  return false;
}

bool Separation::is_at_most(const Boundary& boundary, const Dyadic& limit) const {
  if (is_zero_) return !boundary.empty() && limit.sign() != Sign::negative;
  for (const BoundarySegment& segment : boundary) {
    if (reaches(ends_of(segment), limit, true)) return true;
  }
  return false;
}

// The quadratic form G vanishes if all its six coefficients do.
bool Separation::is_constantly(const Dyadic& limit) const {
  const auto& n_t = front_numerator_.exact;
  const auto& w_t = front_weight_.exact;
  const auto& n_s = behind_numerator_.exact;
  const auto& w_s = behind_weight_.exact;
  for (std::size_t i = 0; i < 3; ++i) {
    for (std::size_t k = i; k < 3; ++k) {
      const Dyadic coefficient = n_s[i] * w_t[k] + n_s[k] * w_t[i] - n_t[i] * w_s[k] -
                                 n_t[k] * w_s[i] - limit * (w_s[i] * w_t[k] + w_s[k] * w_t[i]);
      if (!coefficient.is_zero()) return false;
    }
  }
  return true;
}

// The greatest binary64 number below which the separation never falls, by bisection over the order
// of the numbers; then the one above it, if the least value lies beyond the middle.
double Separation::least(const Boundary& boundary) const {
  if (is_zero_) return 0;
  std::uint64_t low = 0;  // not above the least value
  std::uint64_t high = std::bit_cast<std::uint64_t>(std::numeric_limits<double>::infinity());
  while (high - low > 1) {
    const std::uint64_t place = low + (high - low) / 2;
    (is_below(boundary, from_place(place)) ? high : low) = place;
  }
  const Dyadic floor(from_place(low));
  if (high == std::bit_cast<std::uint64_t>(std::numeric_limits<double>::infinity())) {
    return from_place(low);
  }
  const Dyadic middle = (floor + Dyadic(from_place(high))).scaled(-1);
  if (is_below(boundary, middle)) return from_place(low);
  const bool tie = is_at_most(boundary, middle);
  return from_place(tie && low % 2 == 0 ? low : high);
}

}  // namespace fathom::area
