#include "fathom/clipping/contacts.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>

#include "tests/clipping/print.h"

namespace fathom::clipping {
namespace {

using ::testing::UnorderedElementsAre;
using P = Point2<Rational>;
using S = Segment2<Rational>;

/// As a set: an end that both have may be named twice.
std::vector<P> distinct_contacts(const S& a, const S& b) {
  std::vector<P> points = contacts(a, b);
  std::sort(points.begin(), points.end());
  points.erase(std::unique(points.begin(), points.end()), points.end());
  return points;
}

TEST(Contacts, OfTwoSegmentsOnPaper) {
  const S level{{0, 0}, {4, 0}};
  EXPECT_THAT(distinct_contacts(level, S{{1, -1}, {1, 1}}), UnorderedElementsAre(P{1, 0}));
  EXPECT_THAT(distinct_contacts(level, S{{0, -1}, {3, 2}}), UnorderedElementsAre(P{1, 0}));
  EXPECT_THAT(distinct_contacts(level, S{{2, 0}, {2, 5}}),
              UnorderedElementsAre(P{2, 0}));  // an end on it
  EXPECT_THAT(distinct_contacts(level, S{{4, 0}, {5, 1}}),
              UnorderedElementsAre(P{4, 0}));                                        // end to end
  EXPECT_THAT(distinct_contacts(level, S{{1, 1}, {3, 1}}), UnorderedElementsAre());  // parallel
  EXPECT_THAT(distinct_contacts(level, S{{5, 0}, {6, 0}}),
              UnorderedElementsAre());  // in one line, apart
  EXPECT_THAT(distinct_contacts(level, S{{1, 1}, {2, 3}}), UnorderedElementsAre());
  // An overlap gives its two ends, whichever way round.
  EXPECT_THAT(distinct_contacts(level, S{{3, 0}, {7, 0}}), UnorderedElementsAre(P{3, 0}, P{4, 0}));
  EXPECT_THAT(distinct_contacts(level, S{{3, 0}, {1, 0}}), UnorderedElementsAre(P{1, 0}, P{3, 0}));
  EXPECT_THAT(distinct_contacts(level, S{{4, 0}, {0, 0}}), UnorderedElementsAre(P{0, 0}, P{4, 0}));
  // Not a binary fraction.
  EXPECT_THAT(distinct_contacts(S{{0, 0}, {1, 1}}, S{{0, 1}, {2, 0}}),
              UnorderedElementsAre(P{Rational(2, 3), Rational(2, 3)}));
}

TEST(Contacts, AreCornersOfBothRings) {
  const auto [subject, clip] = enter_contacts(
      Sides<Rational>{{{{0, 0}, {4, 0}, {4, 4}, {0, 4}}}, {{{2, 2}, {6, 2}, {6, 6}, {2, 6}}}});
  for (const Ring<Rational>& ring : {subject.at(0), clip.at(0)}) {
    EXPECT_EQ(ring.size(), 6U);
    for (const P& p : {P{4, 2}, P{2, 4}}) {
      EXPECT_EQ(std::count(ring.begin(), ring.end(), p), 1);
    }
  }
}

TEST(SelfContact, OfRingsThatMeetThemselves) {
  EXPECT_FALSE(self_contact({{0, 0}, {4, 0}, {4, 4}, {0, 4}}));
  const auto bow_tie = self_contact({{0, 0}, {4, 4}, {4, 0}, {0, 4}});
  ASSERT_TRUE(bow_tie);
  EXPECT_EQ(bow_tie->point, (P{2, 2}));
  EXPECT_EQ(std::max(bow_tie->first_edge, bow_tie->second_edge), 2U);
  // A corner on another edge, and a corner that comes again.
  EXPECT_TRUE(self_contact({{0, 0}, {4, 0}, {4, 4}, {2, 0}, {0, 4}}));
  EXPECT_TRUE(self_contact({{0, 0}, {2, 2}, {4, 0}, {4, 4}, {2, 2}, {0, 4}}));
}

TEST(Contacts, PointsInMessages) {
  EXPECT_EQ(to_text(P{Rational(1, 3), 2}), "(1/3, 2)");
}

}  // namespace
}  // namespace fathom::clipping
