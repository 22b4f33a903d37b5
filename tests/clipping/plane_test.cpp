#include "fathom/clipping/plane.h"

#include <gtest/gtest.h>

#include <limits>

#include "fathom/clipping/exact_kernel.h"
#include "fathom/failures/errors.h"

namespace fathom::clipping::test {
namespace {

const Plane<Rational> lecture{1, 1, 1, -1};  // x + y + z = 1

TEST(Plane, PointsOfTheLecture) {
  EXPECT_EQ(side_of(lecture, Point3<Rational>{1, 0, 0}), Side::on);
  EXPECT_EQ(side_of(lecture, Point3<Rational>{0, 0, 0}), Side::inside);
  EXPECT_EQ(side_of(lecture, Point3<Rational>{2, 3, 4}), Side::outside);
}

TEST(Plane, HomogeneousPointsAreOnTheSideOfWhatTheyStandFor) {
  for (const int w : {1, 2, 8, -1, -3}) {
    EXPECT_EQ(side_of(lecture, Point4<Rational>{2 * w, 3 * w, 4 * w, w}), Side::outside) << w;
    EXPECT_EQ(side_of(lecture, Point4<Rational>{0, 0, 0, w}), Side::inside) << w;
    EXPECT_EQ(side_of(lecture, Point4<Rational>{0, w, 0, w}), Side::on) << w;
    EXPECT_EQ(signed_distance(lecture, Point4<Rational>{2 * w, 3 * w, 4 * w, w}),
              signed_distance(lecture, Point4<Rational>{2, 3, 4, 1}));
  }
  EXPECT_EQ(side_of(lecture, Point4<Rational>{1, 1, -1, 0}), Side::outside);
  EXPECT_EQ(side_of(lecture, Point4<Rational>{-1, 0, 0, 0}), Side::inside);
  EXPECT_EQ(side_of(lecture, Point4<Rational>{1, -1, 0, 0}), Side::on);
  EXPECT_EQ(signed_distance(lecture, Point4<Rational>{1, 1, -1, 0}),
            std::numeric_limits<double>::infinity());
  EXPECT_EQ(signed_distance(lecture, Point4<Rational>{1, -1, 0, 0}), 0);
  EXPECT_THROW(side_of(lecture, Point4<Rational>{0, 0, 0, 0}), InputError);
}

TEST(Plane, DistanceIsRoundedOnceFromTheSquareRoot) {
  // 8/√3 = 4.618802153517006116…
  EXPECT_EQ(signed_distance(lecture, Point4<Rational>{2, 3, 4, 1}), 4.618802153517006116);
  EXPECT_EQ(signed_distance(lecture, Point4<Rational>{0, 0, 0, 1}), -0.57735026918962576451);
  // A normal that is no unit vector: (3, 4, 0), 5 long.
  EXPECT_EQ(signed_distance(lecture, Point4<Rational>{1, 0, 0, 1}), 0);
  EXPECT_EQ(signed_distance(Plane<Rational>{3, 4, 0, -10}, Point4<Rational>{0, 0, 7, 1}), -2);
  EXPECT_EQ(signed_distance(Plane<Rational>{Rational(3e150), Rational(4e150), 0, 0},
                            Point4<Rational>{Rational(1e-150), 0, 0, 1}),
            6e-151);
}

TEST(Plane, ThroughAPointWithANormal) {
  const auto plane = plane_through<Rational>({2, 3, 4}, {1, -2, 5});
  EXPECT_EQ(side_of(plane, Point3<Rational>{2, 3, 4}), Side::on);
  EXPECT_EQ(side_of(plane, Point3<Rational>{3, 1, 9}), Side::outside);  // Q + N
  EXPECT_EQ(plane.D, -(2 - 6 + 20));
}

/// (Q − P) × (R − P) of corners none of whose coordinates is 0: (3, −4, 2) × (1, 2, −7).
TEST(Plane, ANormalOfThreePoints) {
  const Point3<Rational> P{2, 3, 5}, Q{5, -1, 7}, R{3, 5, -2};
  const auto normal = normal_of(P, Q, R);
  EXPECT_EQ(normal.x, 24);
  EXPECT_EQ(normal.y, 23);
  EXPECT_EQ(normal.z, 10);
  const auto reversed = normal_of(P, R, Q);
  EXPECT_EQ(reversed.x, -24);
  EXPECT_EQ(reversed.y, -23);
  EXPECT_EQ(reversed.z, -10);
}

TEST(Plane, LineMeetsItAtTheFormulasParameter) {
  // t = (Q − R)·N / (S − R)·N with Q = (1, 0, 0), R = (0, 0, 0), S = (2, 3, 4).
  const auto meeting = plane_line_intersection<Rational>(lecture, {0, 0, 0}, {2, 3, 4});
  ASSERT_TRUE(meeting);
  EXPECT_EQ(meeting->t, Rational(1, 9));
  EXPECT_EQ(meeting->point.y, Rational(1, 3));
  EXPECT_EQ(side_of(lecture, meeting->point), Side::on);
  // Beyond the points that give the line, on either side.
  EXPECT_EQ(plane_line_intersection<Rational>(lecture, {2, 3, 4}, {4, 6, 8})->t, Rational(-8, 9));
  EXPECT_FALSE(plane_line_intersection<Rational>(lecture, {0, 0, 0}, {1, -1, 0}));
  EXPECT_FALSE(plane_line_intersection<Rational>(lecture, {1, 0, 0}, {0, 1, 0}));
}

TEST(Plane, WithoutANormalIsRefused) {
  EXPECT_THROW(plane_line_intersection<Rational>({0, 0, 0, 1}, {0, 0, 0}, {1, 0, 0}), InputError);
  EXPECT_THROW(signed_distance(Plane<double>{0, 0, 0, 1}, Point4<double>{0, 0, 0, 1}), InputError);
}

}  // namespace
}  // namespace fathom::clipping::test
