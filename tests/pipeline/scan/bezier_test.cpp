#include "fathom/pipeline/scan/bezier.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <random>

#include "fathom/failures/errors.h"

namespace fathom::pipeline {
namespace {

CubicBezier random_curve(std::mt19937_64& random) {
  std::uniform_real_distribution<double> place(-10, 10);
  CubicBezier curve{};
  for (PlanePoint& p : curve.control) p = {place(random), place(random)};
  return curve;
}

/// By Bernstein's polynomials.
PlanePoint by_bernstein(const CubicBezier& curve, double t) {
  const double s = 1 - t;
  const double w[] = {s * s * s, 3 * s * s * t, 3 * s * t * t, t * t * t};
  PlanePoint sum{0, 0};
  for (std::size_t k = 0; k < 4; ++k)
    sum = {sum.x + w[k] * curve.control[k].x, sum.y + w[k] * curve.control[k].y};
  return sum;
}

double distance_to_segment(const PlanePoint& p, const PlanePoint& a, const PlanePoint& b) {
  const double dx = b.x - a.x, dy = b.y - a.y, length = dx * dx + dy * dy;
  const double t =
      length > 0 ? std::clamp(((p.x - a.x) * dx + (p.y - a.y) * dy) / length, 0.0, 1.0) : 0;
  return std::hypot(p.x - a.x - t * dx, p.y - a.y - t * dy);
}

TEST(CubicBezier, IsTheSumOfBernsteinsPolynomials) {
  std::mt19937_64 random(1);
  for (int i = 0; i < 100; ++i) {
    const CubicBezier curve = random_curve(random);
    for (const double t : {0.0, 0.1, 0.5, 0.77, 1.0}) {
      const PlanePoint p = curve.at(t), q = by_bernstein(curve, t);
      EXPECT_NEAR(p.x, q.x, 1e-14 * 20);
      EXPECT_NEAR(p.y, q.y, 1e-14 * 20);
      // The parts before and after 0.3 go through the same points.
      const auto parts = curve.divided_at(0.3);
      const PlanePoint before = by_bernstein(parts[0], t), there = by_bernstein(curve, 0.3 * t);
      EXPECT_NEAR(before.x, there.x, 1e-14 * 20);
      const PlanePoint after = by_bernstein(parts[1], t),
                       later = by_bernstein(curve, 0.3 + 0.7 * t);
      EXPECT_NEAR(after.y, later.y, 1e-14 * 20);
    }
  }
}

/// No point of the curve is farther from the chords than the tolerance, and no chord is missing one
/// that would be needed by far: half as many would not do.
TEST(CubicBezier, ChordsAreAsNearAsTheToleranceSaysAndNotMuchNearer) {
  std::mt19937_64 random(2);
  for (int i = 0; i < 50; ++i) {
    const CubicBezier curve = random_curve(random);
    for (const double tolerance : {1.0, 0.1, 1e-3}) {
      const std::vector<PlanePoint> points = flattened(curve, tolerance);
      ASSERT_EQ(points.front(), curve.control[0]);
      ASSERT_EQ(points.back(), curve.control[3]);
      double farthest = 0;
      for (int k = 0; k <= 500; ++k) {
        const PlanePoint p = by_bernstein(curve, k / 500.0);
        double nearest = std::numeric_limits<double>::infinity();
        for (std::size_t j = 1; j < points.size(); ++j)
          nearest = std::min(nearest, distance_to_segment(p, points[j - 1], points[j]));
        farthest = std::max(farthest, nearest);
      }
      EXPECT_LE(farthest, tolerance) << i;
      if (tolerance < 0.5) {
        EXPECT_GT(farthest, tolerance / 40) << i;
      }
    }
  }
}

/// A parabola in disguise, (t, t²): the second difference is the same everywhere, so n chords are
/// 1/(4n²) away, and the bound is exact: 4ᵏ chords for 4²ᵏ times the precision.
TEST(CubicBezier, APartialParabolaTakesThePowersOfTwoThatItsBoundSays) {
  const CubicBezier parabola{{{{0, 0}, {1.0 / 3, 0}, {2.0 / 3, 1.0 / 3}, {1, 1}}}};
  EXPECT_NEAR(chord_error(parabola), 0.25, 1e-15);
  for (const int n : {1, 2, 4, 16, 64}) {
    const double needed = 0.25 / (static_cast<double>(n) * n);
    EXPECT_EQ(flattened(parabola, needed * 1.001).size(), static_cast<std::size_t>(n) + 1);
    EXPECT_EQ(flattened(parabola, needed * 0.999).size(), static_cast<std::size_t>(2 * n) + 1);
  }
}

/// Against sums over chords, which come nearer with the square of their number.
TEST(CubicBezier, TheAreaBesideItIsThatOfItsChordsInTheEnd) {
  std::mt19937_64 random(3);
  for (int i = 0; i < 50; ++i) {
    const CubicBezier curve = random_curve(random);
    const std::vector<PlanePoint> points = flattened(curve, 1e-6);
    double sum = 0;
    for (std::size_t j = 1; j < points.size(); ++j)
      sum += (points[j - 1].x * points[j].y - points[j - 1].y * points[j].x) / 2;
    EXPECT_NEAR(area_beside(curve), sum, 1e-4) << i;
  }
}

TEST(CubicBezier, RefusesWhatHasNoEnd) {
  const CubicBezier curve{{{{0, 0}, {1, 0}, {1, 1}, {0, 1}}}};
  for (const double tolerance : {0.0, -1.0, std::nan(""), 1e-14})
    EXPECT_THROW(flattened(curve, tolerance), UsageError) << tolerance;
  for (std::size_t k = 0; k < 4; ++k) {
    for (const double wrong : {std::numeric_limits<double>::infinity(), std::nan("")}) {
      CubicBezier in_x = curve, in_y = curve;
      in_x.control[k].x = wrong;
      in_y.control[k].y = wrong;
      EXPECT_THROW(flattened(in_x, 0.1), UsageError);
      EXPECT_THROW(flattened(in_y, 0.1), UsageError);
    }
  }
  // What is too fine depends on the size of the curve, not on where it lies.
  CubicBezier far_away = curve;
  for (PlanePoint& p : far_away.control) p = {p.x + 0x1p20, p.y + 0x1p20};
  EXPECT_GT(flattened(far_away, 0x1p-30).size(), 1000U);
}

}  // namespace
}  // namespace fathom::pipeline
