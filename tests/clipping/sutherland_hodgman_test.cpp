#include "fathom/clipping/sutherland_hodgman.h"

#include <gtest/gtest.h>

#include "fathom/clipping/exact_kernel.h"
#include "fathom/clipping/rings.h"
#include "fathom/clipping/weiler_atherton.h"
#include "fathom/failures/errors.h"
#include "tests/clipping/print.h"
#include "tests/clipping/random_polygons.h"
#include "tests/effort.h"

namespace fathom::clipping::test {
namespace {

Ring<Rational> clipped(const Ring<Rational>& subject, const Ring<Rational>& convex) {
  return ring_of(sutherland_hodgman(corners_of(subject), convex));
}

Ring<Rational> rectangle(int x0, int y0, int x1, int y1) {
  return {{x0, y0}, {x1, y0}, {x1, y1}, {x0, y1}};
}

TEST(SutherlandHodgman, RectangleStageByStage) {
  const Ring<Rational> triangle{{-2, 1}, {6, 1}, {2, 7}};
  ClipStages<Point2, Rational> stages;
  const auto result = sutherland_hodgman(corners_of(triangle), rectangle(0, 0, 4, 4), &stages);
  ASSERT_EQ(stages.size(), 4u);
  EXPECT_EQ(ring_of(stages[0]), triangle);  // the bottom edge cuts nothing
  EXPECT_EQ(ring_of(stages[1]), (Ring<Rational>{{-2, 1}, {4, 1}, {4, 4}, {2, 7}}));
  EXPECT_EQ(ring_of(stages[2]), (Ring<Rational>{{0, 4}, {-2, 1}, {4, 1}, {4, 4}}));
  EXPECT_EQ(ring_of(stages[3]), (Ring<Rational>{{0, 4}, {0, 1}, {4, 1}, {4, 4}}));
  EXPECT_EQ(ring_of(result), ring_of(stages[3]));
}

TEST(SutherlandHodgman, TouchingFromOutsideLeavesNothing) {
  const Ring<Rational> window = rectangle(0, 0, 4, 4);
  EXPECT_TRUE(clipped({{4, 2}, {6, 1}, {6, 3}}, window).empty());  // a point
  EXPECT_TRUE(clipped({{4, 1}, {6, 1}, {4, 3}}, window).empty());  // an edge
  EXPECT_TRUE(clipped({{4, 1}, {6, 0}, {6, 4}, {4, 3}, {4, 2}}, window).empty());
  EXPECT_EQ(clipped(window, window), window);
}

/// A convex ring from a random one: clipped squares of turned squares would be too regular.
Ring<Rational> random_convex(PolygonMaker& maker) {
  for (;;) {
    Ring<Rational> ring = checked_rings(
        to_exact(maker.polygon(6, 3 + maker.below(3), [](const auto&) { return true; })),
        "random")[0];
    try {
      check_convex(ring, "random");
      return ring;
    } catch (const InputError&) {
    }
  }
}

// Bridging edges run back and forth, so the signed area of its one ring is right even where the
// ring is not; and a convex subject gives the very polygon.
TEST(SutherlandHodgman, AgreesWithWeilerAthertonInArea) {
  PolygonMaker maker(21);
  int concave_in_pieces = 0;
  for (int i = 0; i < 2000 / checks::effort; ++i) {
    const bool convex_subject = i % 2 == 0;
    const Ring<Rational> clip = random_convex(maker);
    const Ring<Rational> subject =
        convex_subject
            ? random_convex(maker)
            : checked_rings(to_exact(maker.polygon(6, 9, [](const auto&) { return true; })),
                            "random")[0];
    const Ring<Rational> one = clipped(subject, clip);
    const auto pieces = weiler_atherton<Rational>({subject}, {clip}, SetOperation::intersection);
    ASSERT_EQ(signed_area(one), area_of(pieces));
    if (convex_subject) {
      ASSERT_EQ(one.empty(), pieces.empty());
      if (!one.empty()) {
        ASSERT_EQ(canonical(one), pieces.at(0).outline);
      }
    }
    concave_in_pieces += pieces.size() > 1 ? 1 : 0;
  }
  EXPECT_GT(concave_in_pieces, 20 / checks::effort);
}

TEST(SutherlandHodgman, ConcavePolygonComesOutAsOneRingWithBridges) {
  const Ring<Rational> notched{{0, 0}, {4, 0}, {4, 4}, {3, 1}, {1, 1}, {0, 4}};
  const Ring<Rational> strip = rectangle(-1, 2, 5, 3);
  const Ring<Rational> one = clipped(notched, strip);
  // From (4, 2) back to (0, 2) along the lower boundary, over the gap between the two pieces.
  EXPECT_EQ(one, (Ring<Rational>{{0, 3},
                                 {0, 2},
                                 {4, 2},
                                 {4, 3},
                                 {Rational(11, 3), 3},
                                 {Rational(10, 3), 2},
                                 {Rational(2, 3), 2},
                                 {Rational(1, 3), 3}}));
  EXPECT_THROW(checked_rings(Rings<Rational>{one}, "answer"), InputError);  // it is not simple
  const auto pieces = weiler_atherton<Rational>({notched}, {strip}, SetOperation::intersection);
  EXPECT_EQ(pieces.size(), 2u);
  EXPECT_EQ(area_of(pieces), signed_area(one));
}

TEST(SutherlandHodgman, PlanesInSpaceCarryAttributesAlong) {
  // A triangle through the cube [0, 4]³; the attributes are 1, x and x + 2 y + 3 z at the corners,
  // so they are that at every new corner too.
  const auto corner = [](int x, int y, int z) {
    return Corner3<Rational>{{x, y, z}, {1, x, x + 2 * y + 3 * z}};
  };
  const std::vector<Plane<Rational>> cube{{-1, 0, 0, 0}, {1, 0, 0, -4}, {0, -1, 0, 0},
                                          {0, 1, 0, -4}, {0, 0, -1, 0}, {0, 0, 1, -4}};
  ClipStages<Point3, Rational> stages;
  const std::vector<Corner3<Rational>> triangle{corner(-1, 1, 2), corner(9, 2, -3),
                                                corner(2, 8, 7)};
  const auto result = sutherland_hodgman(triangle, cube, &stages);
  EXPECT_EQ(stages.size(), 6u);
  ASSERT_GE(result.size(), 5u);
  for (const auto& [p, attributes] : result) {
    for (const Plane<Rational>& plane : cube) EXPECT_NE(side_of(plane, p), Side::outside);
    ASSERT_EQ(attributes.size(), 3u);
    EXPECT_EQ(attributes[0], 1);
    EXPECT_EQ(attributes[1], p.x);
    EXPECT_EQ(attributes[2], p.x + 2 * p.y + 3 * p.z);
  }
}

TEST(SutherlandHodgman, PolygonInAPlaneStays) {
  const std::vector<Corner3<Rational>> square{
      {{0, 0, 4}, {}}, {{1, 0, 4}, {}}, {{1, 1, 4}, {}}, {{0, 1, 4}, {}}};
  const Plane<Rational> top{0, 0, 1, -4};
  EXPECT_EQ(sutherland_hodgman(square, {top}).size(), 4u);
  EXPECT_EQ(sutherland_hodgman(square, {top, {1, 0, 0, 0}}).size(), 0u);  // only an edge is left
  EXPECT_THROW(sutherland_hodgman(square, {Plane<Rational>{0, 0, 0, 1}}), InputError);
}

// Neighbours that share an edge get the same corner on it, over binary64 too.
TEST(SutherlandHodgman, SharedEdgeIsCutInTheSamePointInBinary64) {
  const Corner3<double> a{{0.1, 0.2, 0.3}, {}}, b{{0.7, 0.9, 1.3}, {}};
  const Plane<double> plane{0.3, 0.7, 0.11, -0.5};
  const auto left = sutherland_hodgman<double>({a, b, {{0.1, 0.1, 0}, {}}}, {plane});
  const auto right = sutherland_hodgman<double>({b, a, {{0.2, 0.1, 0}, {}}}, {plane});
  int shared = 0;
  for (const auto& p : left)
    for (const auto& q : right)
      shared += p.position.x == q.position.x && p.position.y == q.position.y &&
                        p.position.z == q.position.z
                    ? 1
                    : 0;
  EXPECT_EQ(shared, 2);  // a and the cut
}

TEST(SutherlandHodgman, ConcaveClipPolygonIsRefused) {
  EXPECT_THROW(check_convex<double>({{0, 0}, {4, 0}, {1, 1}, {0, 4}}, "clip"), InputError);
  EXPECT_NO_THROW(check_convex<double>({{0, 0}, {2, 0}, {4, 0}, {0, 4}}, "clip"));
}

// As near to the boundary as one likes.
TEST(SutherlandHodgman, WhatHasNoCornerInsideLeavesNothing) {
  const auto beyond = [](const Point2<Rational>& p) -> Rational { return p.x - 4; };
  const Rational near(401, 100);
  EXPECT_TRUE(
      clip_at_boundary(corners_of<Rational>({{4, 1}, {near, 0}, {near, 4}, {4, 3}, {4, 2}}), beyond)
          .empty());
  EXPECT_TRUE(clip_at_boundary(corners_of<Rational>({{1, 1}, {3, 3}}), beyond).empty());
}

}  // namespace
}  // namespace fathom::clipping::test
