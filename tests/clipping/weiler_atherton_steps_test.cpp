// The lists and the walk by themselves, on cases that can be followed on paper.
#include <gtest/gtest.h>

#include <sstream>

#include "fathom/clipping/exact_kernel.h"
#include "fathom/clipping/rings.h"
#include "fathom/clipping/weiler_atherton.h"
#include "fathom/clipping/weiler_atherton/contacts.h"
#include "fathom/clipping/weiler_atherton/edge_order.h"
#include "fathom/clipping/weiler_atherton/side_contacts.h"

namespace fathom::clipping {
namespace {

using P = Point2<Rational>;

Ring<Rational> rectangle(int x0, int y0, int x1, int y1) {
  return {{x0, y0}, {x1, y0}, {x1, y1}, {x0, y1}};
}

/// "(4,2)entering#0"
std::string to_text(const ListPlace<Rational>& place) {
  constexpr const char* kinds[] = {"entering", "leaving", "touching", "along"};
  std::ostringstream text;
  text << "(" << to_fraction(place.point.x) << "," << to_fraction(place.point.y) << ")";
  if (place.kind) text << kinds[static_cast<int>(*place.kind)];
  if (place.crossing) text << "#" << *place.crossing;
  return text.str();
}

/// The rings of a list, a line each.
std::string to_text(const ContactList<Rational>& list) {
  std::string text;
  for (const auto& ring : list) {
    for (const auto& place : ring) text += to_text(place) + " ";
    text += "\n";
  }
  return text;
}

std::string to_text(const std::vector<std::vector<WalkStep<Rational>>>& walks) {
  std::ostringstream text;
  for (const auto& walk : walks) {
    for (const auto& step : walk) {
      text << "(" << to_fraction(step.from.x) << "," << to_fraction(step.from.y) << ")"
           << (step.along == Border::subject ? "S" : "C");
      if (step.crossing) text << "#" << *step.crossing;
      text << " ";
    }
    text << "\n";
  }
  return text.str();
}

WeilerAthertonTrace<Rational> trace_of(const Rings<Rational>& subject, const Rings<Rational>& clip,
                                       SetOperation operation = SetOperation::intersection) {
  WeilerAthertonTrace<Rational> trace;
  weiler_atherton(subject, clip, operation, &trace);
  return trace;
}

//   6 . +-------+
//       |  clip |
//   4 +-|---+   |
//     | |   |   |
//   2 | +-------+
//     |     |
//   0 +-----+
//     0 2   4   6
TEST(WeilerAthertonLists, TwoSquares) {
  const Rings<Rational> subject{rectangle(0, 0, 4, 4)}, clip{rectangle(2, 2, 6, 6)};
  const auto both = trace_of(subject, clip);
  EXPECT_EQ(to_text(both.subject), "(0,0) (4,0) (4,2)entering#0 (4,4) (2,4)leaving#1 (0,4) \n");
  EXPECT_EQ(to_text(both.clip), "(2,2) (4,2)entering#0 (6,2) (6,6) (2,6) (2,4)leaving#1 \n");
  EXPECT_EQ(to_text(both.walks), "(4,2)S#0 (4,4)S (2,4)C#1 (2,2)C \n");
  // The clip list is followed backwards, from where the subject enters.
  const auto difference = trace_of(subject, clip, SetOperation::difference);
  EXPECT_EQ(to_text(difference.subject), to_text(both.subject));
  EXPECT_EQ(to_text(difference.walks), "(2,4)S#1 (0,4)S (0,0)S (4,0)S (4,2)C#0 (2,2)C \n");
}

// A comb of two teeth that hang into a square: two pieces, two walks, and each closes at its own
// start.
TEST(WeilerAthertonLists, TwoPiecesAreTwoWalks) {
  const Rings<Rational> comb{{{1, 9}, {1, 4}, {2, 4}, {2, 8}, {4, 8}, {4, 4}, {5, 4}, {5, 9}}};
  const auto trace = trace_of(comb, {rectangle(0, 0, 6, 6)});
  EXPECT_EQ(to_text(trace.clip),
            "(0,0) (6,0) (6,6) (5,6)leaving#3 (4,6)entering#2 (2,6)leaving#1 (1,6)entering#0 "
            "(0,6) \n");
  EXPECT_EQ(to_text(trace.walks),
            "(1,6)S#0 (1,4)S (2,4)S (2,6)C#1 \n"
            "(4,6)S#2 (4,4)S (5,4)S (5,6)C#3 \n");
}

// Rings that nothing crosses are in the result as a whole, or not.
TEST(WeilerAthertonLists, RingsWithoutCrossings) {
  const Rings<Rational> frame{rectangle(0, 0, 9, 9), rectangle(2, 2, 7, 7)};
  const Rings<Rational> inside_the_frame{{{0, 3}, {1, 4}, {1, 5}}};
  const auto difference = trace_of(frame, inside_the_frame, SetOperation::difference);
  EXPECT_EQ(to_text(difference.clip), "(0,3)touching (1,4) (1,5) \n");
  EXPECT_EQ(to_text(difference.walks),
            "(0,0)S (9,0)S (9,9)S (0,9)S (0,3)S \n"
            "(2,7)S (7,7)S (7,2)S (2,2)S \n"
            "(1,5)C (1,4)C (0,3)C \n");
  const auto both = trace_of(frame, inside_the_frame);
  EXPECT_EQ(to_text(both.walks), "(0,3)C (1,4)C (1,5)C \n");
}

// A subject that goes straight through the point in which two clip triangles meet leaves the one
// and enters the other there: two crossings in one point.
TEST(WeilerAthertonLists, TwoCrossingsInOnePoint) {
  const Rings<Rational> bow{{{0, 0}, {-3, 1}, {-3, -1}}, {{0, 0}, {3, -1}, {3, 1}}};
  const auto trace = trace_of({rectangle(-2, 0, 2, 2)}, bow);
  EXPECT_EQ(to_text(trace.subject),
            "(-2,0) (0,0)leaving#0 (0,0)entering#1 (2,0) (2,2/3)leaving#2 (2,2) (-2,2) "
            "(-2,2/3)entering#3 \n");
  EXPECT_EQ(to_text(trace.walks),
            "(0,0)S#1 (2,0)S (2,2/3)C#2 \n"
            "(-2,2/3)S#3 (-2,0)S (0,0)C#0 \n");
}

NumberedCorners<Rational> numbered_ring(const Ring<Rational>& ring) {
  return numbered(Rings<Rational>{ring});
}

const P middle{0, 0}, a{2, -1}, b{2, 1}, c{-2, 1}, d{-2, -1};

/// A list that passes through one point twice, from one wedge to the other, becomes two.
TEST(Wedges, PartsThatOnlyTouchAreBoundedApart) {
  const auto [points, rings] = numbered_ring({middle, a, b, middle, c, d});
  const PointOrder order(points);
  const NumberedRings crossed{
      {rings[0][0], rings[0][1], rings[0][2], rings[0][0], rings[0][4], rings[0][5]}};
  const NumberedRings lists = joined_by_wedges(edges_of(crossed), order);
  ASSERT_EQ(lists.size(), 2U);
  for (const NumberedRing& list : lists) {
    EXPECT_EQ(list.size(), 3U);
    EXPECT_EQ(signed_area(ring_of(list, points)), 2);
  }
}

/// A list through one point twice is taken apart there.
TEST(Wedges, RingsAreSimple) {
  const auto [points, rings] = numbered_ring({a, b, middle, c, d, middle});
  const NumberedRings simple = simple_rings(rings, PointOrder(points));
  ASSERT_EQ(simple.size(), 2U);
  EXPECT_EQ(simple[0].size() + simple[1].size(), 6U);
  for (const NumberedRing& ring : simple) EXPECT_EQ(signed_area(ring_of(ring, points)), 2);
}

TEST(Sides, RingsThatAreApartStayAsTheyAre) {
  const Rings<Rational> rings{rectangle(0, 0, 9, 9), rectangle(2, 2, 3, 3)};
  EXPECT_EQ(lists_of_side(rings, "subject"), checked_rings(rings, "subject"));
}

TEST(Sides, SharedEdgesAreDropped) {
  const Rings<Rational> lists =
      lists_of_side<Rational>({rectangle(0, 0, 2, 2), rectangle(2, 0, 4, 2)}, "subject");
  ASSERT_EQ(lists.size(), 1U);
  EXPECT_EQ(lists[0], (Ring<Rational>{{0, 0}, {2, 0}, {4, 0}, {4, 2}, {2, 2}, {0, 2}}));
  const Ring<Rational> square = rectangle(0, 0, 2, 2);
  EXPECT_TRUE(lists_of_side<Rational>({square, square}, "subject").empty());
  EXPECT_EQ(lists_of_side<Rational>({square, square, square}, "subject"), Rings<Rational>{square});
}

/// A hole that touches its outline is one list with it, which goes in and out through that point.
TEST(Sides, AHoleIsJoinedToTheOutlineThatItTouches) {
  const Rings<Rational> lists =
      lists_of_side<Rational>({rectangle(0, 0, 6, 6), {{0, 3}, {2, 2}, {2, 4}}}, "subject");
  EXPECT_EQ(lists,
            (Rings<Rational>{{{0, 0}, {6, 0}, {6, 6}, {0, 6}, {0, 3}, {2, 4}, {2, 2}, {0, 3}}}));
}

}  // namespace
}  // namespace fathom::clipping
