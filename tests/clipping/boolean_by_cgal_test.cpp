// CGAL's Boolean set operations in our form, and the first difference of two regions.

#include "fathom/clipping/boolean_by_cgal.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "fathom/failures/errors.h"
#include "tests/clipping/print.h"
#include "tests/scratch_folder.h"

namespace fathom::clipping {
namespace {

using P = Point2<Rational>;

Ring<Rational> rectangle(int x0, int y0, int x1, int y1) {
  return {{x0, y0}, {x1, y0}, {x1, y1}, {x0, y1}};
}

TEST(BooleanByCgal, AFrameIsCutInTwo) {
  const Rings<Rational> frame{rectangle(0, 0, 9, 9), rectangle(3, 3, 6, 6)};
  const auto pieces = boolean_by_cgal(frame, {rectangle(-1, 4, 10, 5)}, SetOperation::intersection);
  ASSERT_EQ(pieces.size(), 2U);
  EXPECT_EQ(pieces[0].outline, rectangle(0, 4, 3, 5));
  EXPECT_EQ(pieces[1].outline, rectangle(6, 4, 9, 5));
  const auto whole = boolean_by_cgal(frame, {}, SetOperation::difference);
  ASSERT_EQ(whole.size(), 1U);
  EXPECT_EQ(whole[0].holes.size(), 1U);
  EXPECT_TRUE(boolean_by_cgal(frame, {}, SetOperation::intersection).empty());
}

// CGAL's outer boundaries may touch themselves; our rings are simple.
TEST(BooleanByCgal, AHoleThatTouchesTheOutlineIsAHole) {
  const auto rest = boolean_by_cgal({rectangle(0, 0, 6, 6)}, {{{0, 3}, {2, 2}, {2, 4}}},
                                    SetOperation::difference);
  ASSERT_EQ(rest.size(), 1U);
  EXPECT_EQ(rest[0].outline, rectangle(0, 0, 6, 6));
  ASSERT_EQ(rest[0].holes.size(), 1U);
  EXPECT_EQ(rest[0].holes[0], (Ring<Rational>{{0, 3}, {2, 4}, {2, 2}}));
}

TEST(BooleanByCgal, BadRingsAreRefusedAsEverywhere) {
  EXPECT_EQ(message_of<InputError>([] {
              boolean_by_cgal({{{0, 0}, {4, 4}, {4, 0}, {0, 4}}}, {}, SetOperation::difference);
            }),
            "subject ring 0 is not simple: its edges 0 and 2 meet at (2, 2)");
}

TEST(FirstDifference, OfTheSameRegionThereIsNone) {
  const Rings<Rational> square{rectangle(0, 0, 4, 4)};
  EXPECT_FALSE(first_difference(square, square));
  EXPECT_FALSE(first_difference({}, {}));
  // In other pieces, and with an edge there and back.
  EXPECT_FALSE(first_difference(square, {rectangle(0, 0, 2, 4), rectangle(2, 0, 4, 4)}));
  EXPECT_FALSE(first_difference(square, {{{0, 0}, {4, 0}, {9, 0}, {4, 0}, {4, 4}, {0, 4}}}));
}

TEST(FirstDifference, IsThePieceWithTheLeastCorner) {
  const Rings<Rational> square{rectangle(0, 0, 4, 4)}, shifted{rectangle(1, 0, 5, 4)};
  const auto difference = first_difference(square, shifted);
  ASSERT_TRUE(difference);
  EXPECT_TRUE(difference->in_first);
  EXPECT_EQ(difference->piece.outline, rectangle(0, 0, 1, 4));
  EXPECT_EQ(difference->area, 4);
  EXPECT_EQ(difference->inside, (P{Rational(1, 2), 2}));
  const auto other_way = first_difference(shifted, square);
  ASSERT_TRUE(other_way);
  EXPECT_FALSE(other_way->in_first);
  EXPECT_EQ(other_way->piece.outline, rectangle(0, 0, 1, 4));
  const auto hole =
      first_difference({rectangle(0, 0, 9, 9), rectangle(2, 2, 4, 4)}, {rectangle(0, 0, 9, 9)});
  ASSERT_TRUE(hole);
  EXPECT_FALSE(hole->in_first);
  EXPECT_EQ(hole->area, 4);
}

// On no corner's level, half-way along the first stretch inside.
TEST(FirstDifference, HasAPointInside) {
  const auto whole = first_difference({{{0, 10}, {4, 10}, {0, 18}}}, {});
  ASSERT_TRUE(whole);
  EXPECT_EQ(whole->inside, (P{1, 14}));
}

TEST(FirstDifference, RingsWithoutAreaAreNoRegion) {
  EXPECT_FALSE(first_difference({{{0, 0}, {4, 4}}}, {}));
  EXPECT_FALSE(first_difference({{{0, 0}, {4, 4}, {8, 8}}}, {{{1, 1}}}));
}

}  // namespace
}  // namespace fathom::clipping
