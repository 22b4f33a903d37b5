#include "fathom/lens/lens_field.h"

#include <stdexcept>

#include "fathom/numeric/standard_arithmetic.h"

namespace fathom {
namespace {

/// The k of d = (x_d, y_d, 1 + k·r²).
double division_term(const Lens& lens) {
  return lens.model == LensModel::fisheye_stereographic ? -0.25 : lens.distortion[0];
}

// With y = (a, b)/c: d·c² = (a·c, b·c, c² + k·(a² + b²)), and there is a ray where k·r² < 1.
std::optional<RationalDirection> divide(const DistortedPoint& y, const Dyadic& k) {
  const Dyadic c_squared = y.c * y.c, term = k * (y.a * y.a + y.b * y.b);
  if (!(term < c_squared)) return std::nullopt;
  return RationalDirection({y.a * y.c, y.b * y.c, c_squared + term}, c_squared);
}

}  // namespace

LensField::LensField(const Projection& projection, const Lens& lens)
    : plane_(projection), lens_(lens) {}

std::optional<ExactDirection> LensField::preimage(const Dyadic& u, const Dyadic& v) const {
  const StandardArithmetic standard;
  const DistortedPoint y = plane_.at(u, v);
  switch (lens_.model) {
    case LensModel::simple_division:
    case LensModel::division:
    case LensModel::fisheye_stereographic: {
      std::optional<RationalDirection> direction = divide(y, division_term(lens_));
      if (!direction) return std::nullopt;
      return ExactDirection(std::move(*direction));
    }
    default:
      if (!is_pinhole(lens_)) throw std::logic_error("not yet");
      return ExactDirection(RationalDirection({y.a, y.b, y.c}, y.c));
  }
}

}  // namespace fathom
