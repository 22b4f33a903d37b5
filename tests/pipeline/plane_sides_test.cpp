#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "fathom/numeric/certified.h"
#include "fathom/pipeline/geometry/painters_algorithm.h"

namespace fathom::pipeline {
namespace {

ExactVector3 exact_difference(const Point3d& p, const Point3d& q) {
  return {Dyadic(p[0]) - Dyadic(q[0]), Dyadic(p[1]) - Dyadic(q[1]), Dyadic(p[2]) - Dyadic(q[2])};
}

/// Points in a plane, next to it by an ulp, and anywhere, of sizes at which products underflow too.
TEST(PlaneSides, AreThoseOfTheExactDeterminant) {
  std::mt19937_64 random(251);
  int zero = 0, other = 0;
  for (int i = 0; i < 20000; ++i) {
    const double scale = i % 5 == 0 ? 0x1p-330 : 1;
    const auto number = [&] { return (static_cast<int>(random() % 17) - 8) * scale; };
    const auto point = [&](bool in_plane) {
      Point3d p{number(), number(), number()};
      if (in_plane) p[2] = p[0] + 2 * p[1];
      if (random() % 4 == 0) p[2] = std::nextafter(p[2], random() % 2 ? 1e9 : -1e9);
      return p;
    };
    const bool flat = i % 2 == 0;
    const Point3d a = point(flat), b = point(flat), c = point(flat), p = point(flat);
    const Sign expected =
        determinant(exact_difference(b, a), exact_difference(c, a), exact_difference(p, a)).sign();
    ASSERT_EQ(side_of_plane(a, b, c, p), expected);
    ++(expected == Sign::zero ? zero : other);
  }
  EXPECT_GT(zero, 2000);
  EXPECT_GT(other, 5000);
}

TEST(PlaneSides, ProjectionsOverlapByMoreThanTheirBoundaries) {
  const auto square = [](double x, double y, double side, bool turned = false) {
    std::vector<Point3d> p{{x, y, 1}, {x + side, y, 2}, {x + side, y + side, 3}, {x, y + side, 4}};
    return turned ? std::vector<Point3d>(p.rbegin(), p.rend()) : p;
  };
  for (const bool turned : {false, true}) {
    const auto a = square(0, 0, 2);
    EXPECT_TRUE(projections_overlap(a, square(1, 1, 2, turned)));
    EXPECT_TRUE(projections_overlap(a, square(0.5, 0.5, 1, turned)));  // inside
    EXPECT_TRUE(projections_overlap(a, a));
    EXPECT_FALSE(projections_overlap(a, square(2, 0, 2, turned)));  // a common side
    EXPECT_FALSE(projections_overlap(a, square(2, 2, 2, turned)));  // a common corner
    EXPECT_FALSE(projections_overlap(a, square(5, 5, 1, turned)));
    EXPECT_TRUE(projections_overlap(a, square(std::nextafter(2.0, 0), 0, 2, turned)));
  }
}

/// The area that two triangles of small integers have in common, by cutting one with the other's
/// sides.
double common_area(std::vector<Point3d> p, const std::vector<Point3d>& q) {
  const auto side = [](const Point3d& a, const Point3d& b, const Point3d& c) {
    return (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0]);
  };
  const double way = side(q[0], q[1], q[2]) > 0 ? 1 : -1;
  for (std::size_t k = 0; k < 3; ++k) {
    std::vector<Point3d> kept;
    for (std::size_t i = 0; i < p.size(); ++i) {
      const Point3d &a = p[i], &b = p[(i + 1) % p.size()];
      const double va = way * side(q[k], q[(k + 1) % 3], a),
                   vb = way * side(q[k], q[(k + 1) % 3], b);
      if (va >= 0) kept.push_back(a);
      if (va * vb < 0) {
        const double t = va / (va - vb);
        kept.push_back({a[0] + t * (b[0] - a[0]), a[1] + t * (b[1] - a[1]), 0});
      }
    }
    p = kept;
  }
  double area = 0;
  for (std::size_t i = 2; i < p.size(); ++i) area += side(p[0], p[i - 1], p[i]);
  return std::abs(area);
}

TEST(PlaneSides, TrianglesOverlapWhereTheyHaveAnAreaInCommon) {
  std::mt19937_64 random(71);
  int overlapping = 0, apart = 0;
  for (int i = 0; i < 4000; ++i) {
    const auto triangle = [&] {
      std::vector<Point3d> t;
      do {
        t.clear();
        for (int k = 0; k < 3; ++k) {
          t.push_back({static_cast<double>(random() % 9), static_cast<double>(random() % 9), 0});
        }
      } while (turn_in_window(t[0], t[1], t[2]) == Sign::zero);
      return t;
    };
    const auto p = triangle(), q = triangle();
    // Areas are multiples of far more than what is rounded here.
    const bool overlap = common_area(p, q) > 1e-6;
    ASSERT_EQ(projections_overlap(p, q), overlap) << i;
    ++(overlap ? overlapping : apart);
  }
  EXPECT_GT(overlapping, 500);
  EXPECT_GT(apart, 500);
}

TEST(PlaneSides, TurnsInTheWindow) {
  EXPECT_EQ(turn_in_window({0, 0, 7}, {1, 0, 3}, {0, 1, -2}), Sign::positive);
  EXPECT_EQ(turn_in_window({0, 0, 7}, {0, 1, 3}, {1, 0, -2}), Sign::negative);
  EXPECT_EQ(turn_in_window({0, 0, 7}, {1, 1, 3}, {2, 2, -2}), Sign::zero);
}

}  // namespace
}  // namespace fathom::pipeline
