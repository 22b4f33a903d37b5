#include "fathom/clipping/weiler_atherton/contacts.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>

#include "fathom/failures/errors.h"
#include "tests/clipping/print.h"
#include "tests/scratch_folder.h"

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

/// A saw of `teeth` teeth, each with two edges that go from one side to the other.
Ring<double> saw(int teeth, bool level) {
  Ring<double> ring;
  for (int i = 0; i <= 2 * teeth; ++i) {
    const double along = 1 + i, across = i % 2 == 0 ? 0 : 2000;
    ring.push_back(level ? Point2<double>{across, along} : Point2<double>{along, across});
  }
  const double beyond = 2 * teeth + 2;
  ring.push_back(level ? Point2<double>{-1, beyond} : Point2<double>{beyond, -1});
  return ring;
}

// Each crossing is a corner in both rings.
TEST(Contacts, AsManyAsTheLimitAreEntered) {
  const auto entered = [](const Sides<double>& sides) {
    const auto [subject, clip] = enter_contacts(sides);
    return subject[0].size() - sides.subject[0].size() + clip[0].size() - sides.clip[0].size();
  };
  // 512 · 256 crossings of the teeth.
  const Sides<double> most{{saw(256, false)}, {saw(128, true)}};
  EXPECT_EQ(entered(most), most_contacts);
  Sides<double> more = most;
  more.clip.push_back({{0.5, 0.25}, {1.5, 0.25}, {0.5, 0.75}});
  EXPECT_EQ(message_of<InputError>([&] { enter_contacts(more); }),
            "the rings meet in more than 262144 points");
}

// From (1, 0) to the next number and down: half-way the crossing is rounded to x = 1, which comes
// before the start in the order of points.
TEST(Contacts, RoundedBeyondAnEndAreNoCorners) {
  const double next = 1 + 0x1p-52;
  const Ring<double> steep{{1, 0}, {next, -1}, {2, 0}};
  const auto [subject, clip] =
      enter_contacts(Sides<double>{{steep}, {{{0, -0.4}, {1.25, -0.4}, {0, -4}}}});
  const Point2<double> rounded{1, -0.4};
  EXPECT_EQ(std::count(clip[0].begin(), clip[0].end(), rounded), 1);
  EXPECT_EQ(std::count(subject[0].begin(), subject[0].end(), rounded), 0);
}

TEST(Contacts, ProductsBeyondBinary64AreRefused) {
  // The products of one segment alone are too great.
  const Segment2<double> far_away{{1e10, 1e10}, {1e10 + 1, 1e10 - 1}}, longer{{0, 0}, {1e300, 0}};
  const std::string refusal = "where edges meet is beyond binary64; the exact kernel does it";
  EXPECT_EQ(message_of<InputError>([&] { contacts(far_away, longer); }), refusal);
  EXPECT_EQ(message_of<InputError>([&] { contacts(longer, far_away); }), refusal);
}

TEST(SelfContact, OfAnEdgeThatTurnsBack) {
  const auto spike = self_contact({{-1, 0}, {-3, 0}, {-2, 0}, {-2, 5}});
  ASSERT_TRUE(spike);
  EXPECT_EQ(std::min(spike->first_edge, spike->second_edge), 0U);
  EXPECT_EQ(std::max(spike->first_edge, spike->second_edge), 1U);
  // Going on in the same direction is none.
  EXPECT_FALSE(self_contact({{-1, 0}, {-3, 0}, {-4, 0}, {-2, 5}}));
}

}  // namespace
}  // namespace fathom::clipping
