#pragma once

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <random>

#include "fathom/lens/exact_direction.h"
#include "tests/lens/arb_ball.h"

/// What a direction has to answer, given the oracle's components of it.
namespace fathom::oracle {

using Direction = std::array<ArbBall, 3>;

inline ArbBall value_of(const ExactVector3& l, const Direction& d) {
  return ArbBall(l[0]) * d[0] + ArbBall(l[1]) * d[1] + ArbBall(l[2]) * d[2];
}

inline ArbBall value_of(const QuadraticForm& form, const Direction& d) {
  const auto& [xx, yy, zz, xy, xz, yz] = form.coefficients;
  return ArbBall(xx) * d[0] * d[0] + ArbBall(yy) * d[1] * d[1] + ArbBall(zz) * d[2] * d[2] +
         ArbBall(xy) * d[0] * d[1] + ArbBall(xz) * d[0] * d[2] + ArbBall(yz) * d[1] * d[2];
}

inline void expect_encloses(const lens::ExactDirection& direction, const Direction& exact) {
  for (const long bits : {30L, 100L, 300L}) {
    const auto d = direction.enclosure(bits);
    for (std::size_t k = 0; k < 3; ++k) {
      EXPECT_TRUE(ArbBall::hull(d[k].low, d[k].high).meets(exact[k])) << bits;
      const ArbBall width = ArbBall(d[k].high) - ArbBall(d[k].low);
      EXPECT_LT(width.approximate(), 4 * std::ldexp(1.0, static_cast<int>(-bits)));
    }
  }
  for (std::size_t k = 0; k < 3; ++k) {
    const Interval& box = direction.box()[k];
    EXPECT_TRUE(ArbBall::hull(box.lower, box.upper).meets(exact[k]));
    EXPECT_LT(box.upper - box.lower, 0x1p-39);
  }
}

/// Planes and cones through about the direction, off by 2^−offset of their size.
inline void expect_signs_of_oracle(const lens::ExactDirection& d, const Direction& exact,
                                   int offset, std::mt19937_64& random) {
  const auto number = [](Sign sign) { return static_cast<int>(sign); };
  const auto small = [&random] { return Dyadic(static_cast<double>(random() % 2001) - 1000); };
  const Dyadic a = small(), b = small(), c = small(), e = small();
  const Dyadic shift = small().scaled(-offset);
  const Dyadic z = (value_of(ExactVector3{a, b, 0.0}, exact) / exact[2]).rounded(offset);
  const ExactVector3 plane{a, b, shift - z};
  EXPECT_EQ(number(d.sign_of(plane)), value_of(plane, exact).sign()) << offset;
  const ArbBall others = value_of(QuadraticForm{{a, b, 0.0, c, a, e}}, exact);
  const QuadraticForm cone{
      {a, b, shift - (others / (exact[2] * exact[2])).rounded(offset), c, a, e}};
  EXPECT_EQ(number(d.sign_of(cone)), value_of(cone, exact).sign()) << offset;
}

}  // namespace fathom::oracle
