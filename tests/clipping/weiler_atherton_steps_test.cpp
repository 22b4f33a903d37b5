// The labels and the walk by themselves: two squares of which one covers a corner of the other.
#include <gtest/gtest.h>

#include "fathom/clipping/contacts.h"
#include "fathom/clipping/rings.h"
#include "fathom/clipping/weiler_atherton_labels.h"
#include "fathom/clipping/weiler_atherton_walk.h"

namespace fathom::clipping {
namespace {

using P = Point2<Rational>;

//   6 . +-------+
//       |  clip |
//   4 +-|---+   |
//     | |   |   |
//   2 | +-------+
//     |     |
//   0 +-----+
//     0 2   4   6
ContactLists<Rational> two_squares() {
  const Rings<Rational> entered = enter_contacts(
      Rings<Rational>{{{0, 0}, {4, 0}, {4, 4}, {0, 4}}, {{2, 2}, {6, 2}, {6, 6}, {2, 6}}});
  return {{entered[0]}, {entered[1]}};
}

TEST(WeilerAthertonLabels, EdgesKnowWhatLiesBesideThem) {
  int inside = 0, outside = 0;
  for (const LabelledEdge<Rational>& e : label_edges(two_squares())) {
    const Beside& other = e.border == Border::subject ? e.of_clip : e.of_subject;
    const Beside& own = e.border == Border::subject ? e.of_subject : e.of_clip;
    EXPECT_EQ(own, (Beside{true, false}));  // counter-clockwise
    EXPECT_EQ(other.left, other.right);     // no edge runs along the other's
    const P middle{(e.from.x + e.to.x) / Rational(2), (e.from.y + e.to.y) / Rational(2)};
    const auto within = [&](int low, int high) {
      return middle.x > low && middle.x < high && middle.y > low && middle.y < high;
    };
    EXPECT_EQ(other.left, e.border == Border::subject ? within(2, 6) : within(0, 4));
    ++(other.left ? inside : outside);
  }
  EXPECT_EQ(inside, 4);
  EXPECT_EQ(outside, 8);
}

TEST(WeilerAthertonLabels, TheSubjectEntersAndLeaves) {
  const auto contacts = label_contacts(two_squares());
  ASSERT_EQ(contacts.size(), 2U);
  for (const Contact<Rational>& c : contacts) {
    const bool entering = c.point == P{4, 2};
    EXPECT_TRUE(entering || c.point == (P{2, 4}));
    EXPECT_EQ(c.kind, entering ? ContactKind::entering : ContactKind::leaving);
    EXPECT_EQ(c.before, entering ? Relation::outside : Relation::inside);
    EXPECT_EQ(c.after, entering ? Relation::inside : Relation::outside);
  }
}

BorderEdge<Rational> edge(const P& from, const P& to) {
  return {from, to, Border::subject};
}

/// Two triangles that touch in a point are walked one by one.
TEST(WeilerAthertonWalk, PiecesThatOnlyTouchStaySeparate) {
  const P middle{0, 0}, a{2, -1}, b{2, 1}, c{-2, 1}, d{-2, -1};
  const auto walks = walk<Rational>(
      {edge(middle, a), edge(a, b), edge(b, middle), edge(middle, c), edge(c, d), edge(d, middle)});
  ASSERT_EQ(walks.size(), 2U);
  for (const auto& closed : walks) {
    EXPECT_EQ(closed.size(), 3U);
    const Rings<Rational> rings = simple_rings(closed);
    ASSERT_EQ(rings.size(), 1U);
    EXPECT_EQ(signed_area(rings[0]), 2);
  }
}

/// A walk through one point twice is taken apart there.
TEST(WeilerAthertonWalk, RingsAreSimple) {
  const P middle{0, 0}, a{2, -1}, b{2, 1}, c{-2, 1}, d{-2, -1};
  const Rings<Rational> rings = simple_rings<Rational>(
      {edge(a, b), edge(b, middle), edge(middle, c), edge(c, d), edge(d, middle), edge(middle, a)});
  ASSERT_EQ(rings.size(), 2U);
  EXPECT_EQ(rings[0].size() + rings[1].size(), 6U);
  EXPECT_EQ(signed_area(rings), 4);
}

}  // namespace
}  // namespace fathom::clipping
