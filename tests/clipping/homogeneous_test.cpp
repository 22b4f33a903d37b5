#include "fathom/clipping/homogeneous.h"

#include <gtest/gtest.h>

#include <random>

#include "fathom/clipping/exact_kernel.h"
#include "fathom/failures/errors.h"
#include "tests/effort.h"

namespace fathom::clipping::test {
namespace {

using P4 = Point4<Rational>;

/// The lecture's projection with n = 1, f = 2, which looks along −z.
P4 projected(const P4& p) {
  const Rational n = 1, f = 2;
  return {p.x, p.y, -(f + n) / (f - n) * p.z - 2 * f * n / (f - n) * p.w, -p.z};
}

std::vector<Corner4<Rational>> corners(const std::vector<P4>& points) {
  std::vector<Corner4<Rational>> result;
  for (const P4& p : points) result.push_back({p, {}});
  return result;
}

bool same(const P4& a, const P4& b) {
  return a.x == b.x && a.y == b.y && a.z == b.z && a.w == b.w;
}

bool is_inside(const P4& p, Volume volume, int half = 1) {
  for (int k = 0; k < boundary_count; ++k)
    if (half * boundary_value(k, p, volume) < 0) return false;
  return true;
}

TEST(Homogeneous, PointBehindTheEyeOfTheLecture) {
  // M·(0, 0, n, 1) is (0, 0, −7, −1), which stands for (0, 0, 7): beyond every far plane. The
  // lecture has (0, 0, −3, −1); (f + n)/(f − n) = 3 is only the bound that z'/w' exceeds.
  const P4 Q = projected({0, 0, 1, 1});
  EXPECT_TRUE(same(Q, {0, 0, -7, -1}));
  EXPECT_FALSE(same(Q, {0, 0, -3, -1}));
  EXPECT_EQ(divided(Q).z, 7);
  EXPECT_FALSE(is_inside(Q, Volume::opengl));
  EXPECT_FALSE(is_inside(Q, Volume::opengl, -1));  // nor in the lower half
}

TEST(Homogeneous, PointOfTheLectureIsInside) {
  const P4 P{3, 1, 2, 8};
  EXPECT_TRUE(is_inside(P, Volume::opengl));
  const Point3<Rational> p = divided(P);
  EXPECT_TRUE(p.x == Rational(3, 8) && p.y == Rational(1, 8) && p.z == Rational(2, 8));
  // Its negative is the same point, in the lower half.
  EXPECT_FALSE(is_inside({-3, -1, -2, -8}, Volume::opengl));
  EXPECT_TRUE(is_inside({-3, -1, -2, -8}, Volume::opengl, -1));
}

TEST(Homogeneous, ClippingAfterTheDivisionKeepsTheWrongPart) {
  // From a visible point to one behind the eye: the part in front of the near plane goes. After the
  // division the far point lies at z = 7, and the line is cut at the far plane instead.
  const P4 P = projected({0, 0, Rational(-3, 2), 1}), Q = projected({0, 0, 1, 1});
  EXPECT_EQ(divided(P).z, Rational(1, 3));
  const auto part = clip_homogeneous(Segment4<Rational>{P, Q}, Volume::opengl);
  ASSERT_TRUE(part);
  EXPECT_EQ(divided(part->end).z, -1);

  const P4 A = projected({Rational(1, 4), 0, Rational(-3, 2), 1});
  const auto right = clip_homogeneous(corners({P, A, Q}), Volume::opengl);
  const auto wrong = clip_after_division(corners({P, A, Q}), Volume::opengl);
  Rational right_least = 2, wrong_greatest = -2;
  for (const auto& corner : right) right_least = std::min(right_least, divided(corner.position).z);
  for (const auto& corner : wrong) wrong_greatest = std::max(wrong_greatest, corner.position.z);
  EXPECT_EQ(right_least, -1);
  EXPECT_EQ(wrong_greatest, 1);
  // In front of the eye both orders agree.
  const auto before = clip_homogeneous(corners({P, A, projected({0, 3, -3, 1})}), Volume::opengl);
  const auto after = clip_after_division(corners({P, A, projected({0, 3, -3, 1})}), Volume::opengl);
  ASSERT_EQ(before.size(), after.size());
  for (std::size_t i = 0; i < before.size(); ++i) {
    const Point3<Rational> p = divided(before[i].position), q = after[i].position;
    EXPECT_TRUE(p.x == q.x && p.y == q.y && p.z == q.z);
  }
}

TEST(Homogeneous, ASegmentClippedAfterTheDivisionGoesToTheFarPlane) {
  const P4 P = projected({0, 0, Rational(-3, 2), 1}), Q = projected({0, 0, 1, 1});
  LiangBarskyTrace<Rational> trace;
  const auto wrong = clip_after_division(Segment4<Rational>{P, Q}, Volume::opengl, &trace);
  ASSERT_TRUE(wrong);
  EXPECT_TRUE(same(wrong->start, {0, 0, Rational(1, 3), 1}));
  EXPECT_TRUE(same(wrong->end, {0, 0, 1, 1}));
  EXPECT_EQ(trace.parameters.size(), 6U);
  EXPECT_EQ(trace.t_leaving, Rational(1, 10));
  EXPECT_THROW(clip_after_division(Segment4<Rational>{P, {1, 0, 0, 0}}, Volume::opengl),
               InputError);
}

// In front of the eye both orders keep the same part, whatever the two ends are.
TEST(Homogeneous, SegmentsInFrontOfTheEyeAreClippedAlikeInBothOrders) {
  std::mt19937 random(33);
  const auto number = [&] { return Rational(static_cast<int>(random() % 13) - 6, 2); };
  const auto in_front = [&]() -> P4 {
    return {number(), number(), number(), Rational(static_cast<int>(random() % 6) + 1, 2)};
  };
  int visible = 0;
  for (int i = 0; i < 2000 / checks::effort; ++i)
    for (const Volume volume : {Volume::opengl, Volume::zero_one}) {
      const Segment4<Rational> segment{in_front(), in_front()};
      const auto before = clip_homogeneous(segment, volume);
      const auto after = clip_after_division(segment, volume);
      ASSERT_EQ(before.has_value(), after.has_value());
      if (!before) continue;
      ++visible;
      const auto expect_same = [](const P4& p, const P4& q) {
        const Point3<Rational> d = divided(p);
        EXPECT_TRUE(same({d.x, d.y, d.z, 1}, q));
      };
      expect_same(before->start, after->start);
      expect_same(before->end, after->end);
    }
  EXPECT_GT(visible, 300 / checks::effort);
}

/// Random triangles in front of, behind and across the eye, clipped by the frustum's planes in
/// space, where there is no w, and projected then.
TEST(Homogeneous, IsClippingByTheFrustumInSpace) {
  const std::vector<Plane<Rational>> frustum{{-1, 0, 1, 0}, {1, 0, 1, 0}, {0, -1, 1, 0},
                                             {0, 1, 1, 0},  {0, 0, 1, 1}, {0, 0, -1, -2}};
  std::mt19937 random(31);
  const auto number = [&] { return Rational(static_cast<int>(random() % 13) - 6, 2); };
  int visible = 0, across = 0;
  for (int i = 0; i < 3000 / checks::effort; ++i) {
    std::vector<Corner3<Rational>> in_space;
    std::vector<Corner4<Rational>> in_clip_space;
    bool behind = false, in_front = false;
    for (int corner = 0; corner < 3; ++corner) {
      const Point3<Rational> p{number(), number(), number()};
      const Rational attribute = number();
      in_space.push_back({p, {attribute}});
      in_clip_space.push_back({projected({p.x, p.y, p.z, 1}), {attribute}});
      behind = behind || p.z >= 0;
      in_front = in_front || p.z < 0;
    }
    const auto expected = sutherland_hodgman(in_space, frustum);
    const auto clipped = clip_homogeneous(in_clip_space, Volume::opengl);
    ASSERT_EQ(clipped.size(), expected.size());
    for (std::size_t k = 0; k < clipped.size(); ++k) {
      const Point3<Rational>& p = expected[k].position;
      ASSERT_TRUE(same(clipped[k].position, projected({p.x, p.y, p.z, 1})));
      ASSERT_EQ(clipped[k].attributes, expected[k].attributes);
      ASSERT_GT(clipped[k].position.w, 0);
    }
    visible += clipped.empty() ? 0 : 1;
    across += !clipped.empty() && behind && in_front ? 1 : 0;
  }
  EXPECT_GT(visible, 300 / checks::effort);
  EXPECT_GT(across, 100 / checks::effort);
}

TEST(Homogeneous, LowerHalfIsTheUpperOneOfTheNegatives) {
  std::mt19937 random(32);
  const auto number = [&] { return Rational(static_cast<int>(random() % 9) - 4); };
  int lower = 0;
  for (int i = 0; i < 2000 / checks::effort; ++i)
    for (const Volume volume : {Volume::opengl, Volume::zero_one}) {
      std::vector<P4> points, negatives;
      while (points.size() < 3) {
        const P4 p{number(), number(), number(), number()};
        if (same(p, {0, 0, 0, 0})) continue;
        points.push_back(p);
        negatives.push_back({-p.x, -p.y, -p.z, -p.w});
      }
      const auto below = clip_homogeneous(corners(points), volume, Half::lower);
      const auto above = clip_homogeneous(corners(negatives), volume, Half::upper);
      ASSERT_EQ(below.size(), above.size());
      for (std::size_t k = 0; k < below.size(); ++k) {
        const P4& p = below[k].position;
        ASSERT_TRUE(same({-p.x, -p.y, -p.z, -p.w}, above[k].position));
        ASSERT_TRUE(is_inside(p, volume, -1));
        ASSERT_LT(p.w, 0);
      }
      lower += below.empty() ? 0 : 1;
    }
  EXPECT_GT(lower, 100 / checks::effort);
}

TEST(Homogeneous, SegmentThroughBothHalvesHasAPartInEach) {
  // From (0, 0, 0) in the upper half to (1/2, 0, 0), given by its negative, in the lower half.
  const Segment4<Rational> s{{0, 0, 0, 1}, {-1, 0, 0, -2}};
  const auto upper = clip_homogeneous(s, Volume::opengl, Half::upper);
  const auto lower = clip_homogeneous(s, Volume::opengl, Half::lower);
  ASSERT_TRUE(upper && lower);
  EXPECT_TRUE(same(upper->start, s.start));
  EXPECT_TRUE(same(lower->end, s.end));
  // The one runs out through x = −1 to infinity, the other comes in through x = 1.
  EXPECT_EQ(divided(upper->end).x, -1);
  EXPECT_EQ(divided(lower->start).x, 1);
  EXPECT_GT(upper->end.w, 0);
  EXPECT_LT(lower->start.w, 0);
}

TEST(Homogeneous, AtTheWaist) {
  // Through the origin: both ends stand for the same point.
  const auto part =
      clip_homogeneous(Segment4<Rational>{{1, 0, 0, 2}, {-2, 0, 0, -4}}, Volume::opengl);
  ASSERT_TRUE(part);
  EXPECT_TRUE(same(part->start, {1, 0, 0, 2}) && same(part->end, {1, 0, 0, 2}));
  // Outside on both sides, meeting the hourglass in its waist only.
  EXPECT_FALSE(clip_homogeneous(Segment4<Rational>{{3, 0, 0, 1}, {-3, 0, 0, -1}}, Volume::opengl));
  // An edge through the waist leaves no corner there.
  const auto polygon =
      clip_homogeneous(corners({{0, 0, 0, 1}, {1, 1, 0, 2}, {0, 0, 0, -1}}), Volume::opengl);
  for (const auto& corner : polygon) EXPECT_GT(corner.position.w, 0);
  EXPECT_THROW(
      clip_homogeneous(corners({{0, 0, 0, 0}, {1, 1, 0, 2}, {0, 1, 0, 1}}), Volume::opengl),
      InputError);
  EXPECT_THROW(divided<Rational>({1, 0, 0, 0}), InputError);
}

TEST(Homogeneous, PointsAtInfinityAreDirections) {
  // A triangle with a corner at infinity to the right: a strip, cut at x = w.
  const auto strip =
      clip_homogeneous(corners({{0, 0, 0, 1}, {1, 0, 0, 0}, {0, 1, 0, 2}}), Volume::opengl);
  ASSERT_EQ(strip.size(), 4u);
  for (const auto& corner : strip) EXPECT_TRUE(is_inside(corner.position, Volume::opengl));
}

TEST(Homogeneous, NearPlaneOfTheTwoVolumes) {
  const P4 between{0, 0, Rational(-1, 2), 1};
  EXPECT_TRUE(is_inside(between, Volume::opengl));
  EXPECT_FALSE(is_inside(between, Volume::zero_one));
  const auto part = clip_homogeneous(Segment4<Rational>{between, {0, 0, 1, 1}}, Volume::zero_one);
  ASSERT_TRUE(part);
  EXPECT_EQ(divided(part->start).z, 0);
}

// In front of the eye both orders give the same polygon.
TEST(Homogeneous, PolygonsInFrontOfTheEyeAreClippedAlikeInBothOrders) {
  std::mt19937 random(34);
  const auto number = [&] { return Rational(static_cast<int>(random() % 13) - 6, 2); };
  int visible = 0;
  for (int i = 0; i < 1000 / checks::effort; ++i)
    for (const Volume volume : {Volume::opengl, Volume::zero_one}) {
      std::vector<P4> points;
      for (int k = 0; k < 3; ++k)
        points.push_back(
            {number(), number(), number(), Rational(static_cast<int>(random() % 6) + 1, 2)});
      const auto before = clip_homogeneous(corners(points), volume);
      const auto after = clip_after_division(corners(points), volume);
      ASSERT_EQ(before.size(), after.size());
      for (std::size_t k = 0; k < before.size(); ++k) {
        const Point3<Rational> p = divided(before[k].position), q = after[k].position;
        ASSERT_TRUE(p.x == q.x && p.y == q.y && p.z == q.z);
      }
      visible += before.empty() ? 0 : 1;
    }
  EXPECT_GT(visible, 100 / checks::effort);
}

TEST(Homogeneous, TheTraceNamesTheBoundaries) {
  LiangBarskyTrace<Rational> trace;
  const Segment4<Rational> through{{-4, 0, 0, 1}, {4, 0, 0, 1}};
  clip_homogeneous(through, Volume::opengl, Half::upper, &trace);
  std::vector<int> boundaries;
  for (const auto& parameter : trace.parameters) boundaries.push_back(parameter.k);
  EXPECT_EQ(boundaries, (std::vector{1, 2, 3, 4, 5, 6}));
}

// The part is the start alone.
TEST(Homogeneous, ASegmentThatLeavesFromTheBoundaryIsAPoint) {
  const auto part =
      clip_homogeneous(Segment4<Rational>{{1, 0, 0, 1}, {2, 0, 0, 1}}, Volume::opengl);
  ASSERT_TRUE(part);
  EXPECT_TRUE(same(part->start, {1, 0, 0, 1}) && same(part->end, {1, 0, 0, 1}));
}

}  // namespace
}  // namespace fathom::clipping::test
