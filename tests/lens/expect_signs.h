#pragma once

#include <gtest/gtest.h>

#include <array>
#include <random>

#include "fathom/lens/exact_direction.h"
#include "tests/lens/arb_ball.h"

/// Forms at exact directions against the oracle's directions.
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
