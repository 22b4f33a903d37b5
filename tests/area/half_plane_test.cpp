// Signs of turns, determinants and crossings against rational numbers.
#include <gtest/gtest.h>

#include <cmath>

#include "fathom/area/convex_polygon.h"
#include "tests/area/lines.h"
#include "tests/oracle/against_oracle.h"

namespace fathom {
namespace {

using namespace area;
using checks::Line;
using oracle::Q;

Q turn_of(const Line& a, const Line& b) {
  return Q(a.a) * Q(b.b) - Q(a.b) * Q(b.a);
}

/// The point in which two lines cross.
oracle::Point crossing(const Line& a, const Line& b) {
  const Q d = turn_of(a, b);
  return {(Q(a.b) * Q(b.c) - Q(a.c) * Q(b.b)) / d, (Q(a.c) * Q(b.a) - Q(a.a) * Q(b.c)) / d};
}

Sign sign(const Q& q) {
  return sign_of(sgn(q));
}

TEST(HalfPlane, APowerOfTwoIsTakenOut) {
  for (const double scale : {1.0, 0x1p-1000, 0x1p900}) {
    const HalfPlane h({3 * scale, -5 * scale, scale / 4});
    EXPECT_EQ(h.approximate()[0], 3.0 / 8);
    EXPECT_EQ(h.approximate()[1], -5.0 / 8);
    EXPECT_EQ(h.exact()[2].scaled(h.exponent()), Dyadic(scale / 4));
  }
  // Beyond binary64, and with more bits than it has.
  const Dyadic huge = Dyadic(0x1p1000) * Dyadic(0x1p1000);
  const HalfPlane h({huge, huge + Dyadic(1.0), 0.0});
  EXPECT_EQ(h.exact()[1].scaled(h.exponent()), huge + Dyadic(1.0));
  EXPECT_LE(h.approximate()[1], 1);
}

TEST(HalfPlane, SignsAreThoseOfRationalNumbers) {
  std::mt19937_64 random(121);
  TierCounts counts;
  int zero_turns = 0, zero_determinants = 0;
  for (int i = 0; i < 20000; ++i) {
    const Line l = checks::random_line(random), m = checks::random_line(random),
               n = checks::random_line(random);
    const HalfPlane a({l.a, l.b, l.c}), b({m.a, m.b, m.c}), c({n.a, n.b, n.c});
    const Sign turned = sign_of_turn(a, b, counts);
    ASSERT_EQ(turned, sign(turn_of(l, m)));
    zero_turns += turned == Sign::zero;
    const Q determinant = Q(l.c) * turn_of(m, n) + Q(m.c) * turn_of(n, l) + Q(n.c) * turn_of(l, m);
    const Sign found = sign_of_determinant(a, b, c, counts);
    ASSERT_EQ(found, sign(determinant));
    zero_determinants += found == Sign::zero;
    if (turned == Sign::zero) {
      ASSERT_EQ(same_side(a, b), sgn(Q(l.a) * Q(m.a) + Q(l.b) * Q(m.b)) > 0);
      continue;
    }
    // n at the point where a and b cross.
    const oracle::Point p = crossing(l, m);
    ASSERT_EQ(side_of_crossing(c, a, b, counts), sign(Q(n.a) * p[0] + Q(n.b) * p[1] + Q(n.c)));
    if (sgn(turn_of(l, n)) == 0) continue;
    // Along a, whose inside is on the left: in the direction (b, −a).
    const oracle::Point q = crossing(l, n);
    const Q along = Q(l.b) * (p[0] - q[0]) - Q(l.a) * (p[1] - q[1]);
    ASSERT_EQ(compare_crossings(a, b, c, counts), sign(along));
  }
  EXPECT_GT(zero_turns, 1000);
  EXPECT_GT(zero_determinants, 1000);
  EXPECT_GT(counts.interval, 10000U);
  EXPECT_GT(counts.exact, 1000U);
}

TEST(HalfPlane, ApproximationsStayWithinTheirBounds) {
  std::mt19937_64 random(122);
  const auto number = [&] { return std::ldexp(static_cast<double>(random() >> 11), -52) - 1; };
  const auto expect_within = [](const Certified<double>& x, const Dyadic& exact) {
    const Dyadic error = Dyadic(x.value) - exact;
    ASSERT_LE(compare(error, Dyadic(x.error)), 0);
    ASSERT_GE(compare(error, Dyadic(-x.error)), 0);
  };
  for (int i = 0; i < 5000; ++i) {
    const HalfPlane a({number(), number(), number()}), b({number(), number(), number()});
    // Nearly a combination of the two, so that the determinant nearly vanishes.
    const Dyadic s = number(), t = number();
    const HalfPlane c({s * a.exact()[0] + t * b.exact()[0], s * a.exact()[1] + t * b.exact()[1],
                       s * a.exact()[2] + t * b.exact()[2] + Dyadic(number() * 0x1p-50)});
    expect_within(approximate_turn(a, b), turn(a, b));
    expect_within(approximate_determinant(a, b, c), determinant(a, b, c));
    for (std::size_t k = 0; k < 3; ++k) {
      expect_within(approximate_coefficient(c, k), c.exact()[k]);
    }
  }
}

}  // namespace
}  // namespace fathom
