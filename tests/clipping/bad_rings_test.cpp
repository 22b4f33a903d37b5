// What cannot be clipped is refused with the ring and the reason.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <random>

#include "fathom/clipping/exact_kernel.h"
#include "fathom/clipping/rings.h"
#include "fathom/clipping/weiler_atherton.h"
#include "fathom/failures/errors.h"
#include "tests/effort.h"

namespace fathom::clipping::test {
namespace {

const Ring<double> square{{0, 0}, {6, 0}, {6, 6}, {0, 6}};

std::string refusal(const Rings<double>& subject, const Rings<double>& clip) {
  try {
    weiler_atherton(subject, clip, SetOperation::intersection);
    return "";
  } catch (const InputError& error) {
    return error.what();
  }
}

TEST(BadRings, NotFinite) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const double infinity = std::numeric_limits<double>::infinity();
  for (const double bad : {nan, infinity, -infinity})
    EXPECT_EQ(refusal({square, {{0, 0}, {1, 0}, {1, bad}}}, {square}),
              "subject ring 1 has a coordinate that is not finite, at corner 2");
  EXPECT_EQ(refusal({{{nan, 0}, {1, 0}, {1, 1}}}, {square}),
            "subject ring 0 has a coordinate that is not finite, at corner 0");
}

TEST(BadRings, FewerThanThreeDistinctCorners) {
  EXPECT_EQ(refusal({square}, {{}}), "clip ring 0 has 0 distinct corners; expected at least 3");
  EXPECT_EQ(refusal({square}, {{{1, 1}}}),
            "clip ring 0 has 1 distinct corner; expected at least 3");
  EXPECT_EQ(refusal({{{1, 1}, {2, 2}, {1, 1}, {2, 2}}}, {square}),
            "subject ring 0 has 2 distinct corners; expected at least 3");
  // Corners that repeat the one before, or the first at the end, are no fault.
  EXPECT_EQ(refusal({{{0, 0}, {0, 0}, {6, 0}, {6, 6}, {6, 6}, {0, 0}}}, {square}), "");
}

TEST(BadRings, WithoutArea) {
  EXPECT_EQ(refusal({{{0, 0}, {1, 2}, {3, 6}}}, {square}),
            "subject ring 0 has no area: its corners lie on one line");
  // Two corners at one place do not make a line.
  EXPECT_THAT(refusal({{{0, 0}, {1, 0}, {0, 0}, {0, 1}}}, {square}),
              ::testing::HasSubstr("subject ring 0 is not simple"));
}

TEST(BadRings, NotSimple) {
  EXPECT_EQ(refusal({{{0, 0}, {4, 4}, {4, 0}, {0, 4}}}, {square}),
            "subject ring 0 is not simple: its edges 0 and 2 meet at (2, 2)");
  EXPECT_EQ(refusal({{{0, 0}, {3, 1}, {3, 0}, {0, 1}}}, {square}),
            "subject ring 0 is not simple: its edges 0 and 2 meet at (3/2, 1/2)");
  // Touching itself in a corner, with a corner on an edge, along an edge, and a spike.
  EXPECT_THAT(refusal({{{0, 0}, {4, 0}, {2, 2}, {4, 4}, {0, 4}, {2, 2}}}, {square}),
              ::testing::HasSubstr("meet at (2, 2)"));
  EXPECT_THAT(refusal({{{0, 0}, {4, 0}, {4, 4}, {2, 0}, {0, 4}}}, {square}),
              ::testing::HasSubstr("meet at (2, 0)"));
  EXPECT_THAT(refusal({{{0, 0}, {4, 0}, {4, 4}, {3, 0}, {1, 0}, {0, 4}}}, {square}),
              ::testing::HasSubstr("is not simple"));
  EXPECT_THAT(refusal({{{0, 0}, {4, 0}, {4, 4}, {4, 2}, {0, 4}}}, {square}),
              ::testing::HasSubstr("is not simple"));
  EXPECT_THAT(refusal({square}, {{{0, 0}, {4, 0}, {6, 0}, {4, 0}, {4, 4}}}),
              ::testing::HasSubstr("clip ring 0 is not simple"));
}

TEST(BadRings, OfOneSideThatCross) {
  const Ring<double> other{{3, 3}, {9, 3}, {9, 9}, {3, 9}};
  EXPECT_EQ(refusal({square}, {square, other}),
            "clip rings 0 and 1 cross at (3, 6); expected rings that at most touch");
  // Crossing in corners only, and through a shared piece.
  EXPECT_THAT(refusal({{{0, 0}, {4, 0}, {4, 4}, {0, 4}}, {{-1, -1}, {1, -1}, {5, 5}}}, {square}),
              ::testing::HasSubstr("subject rings 0 and 1 cross"));
  EXPECT_THAT(refusal({square, {{3, 3}, {6, 2}, {6, 4}, {9, 9}, {3, 9}}}, {square}),
              ::testing::HasSubstr("cross"));
  // On different sides they may.
  EXPECT_EQ(refusal({square}, {other}), "");
}

// The rings are checked before their order or direction is known: neither changes the answer.
TEST(BadRings, OrderAndDirectionAreNoFault) {
  const Rings<double> holed{square, {{2, 2}, {4, 2}, {4, 4}, {2, 4}}};
  const Rings<double> clip{{{1, 3}, {5, 3}, {5, 9}, {1, 9}}};
  const auto expected = weiler_atherton(holed, clip, SetOperation::difference);
  for (int variant = 1; variant < 8; ++variant) {
    Rings<double> other = holed;
    if (variant & 1) std::reverse(other[0].begin(), other[0].end());
    if (variant & 2) std::rotate(other[1].begin(), other[1].begin() + 1, other[1].end());
    if (variant & 4) std::swap(other[0], other[1]);
    const auto answer = weiler_atherton(other, clip, SetOperation::difference);
    ASSERT_EQ(answer.size(), expected.size());
    for (std::size_t i = 0; i < answer.size(); ++i) {
      EXPECT_EQ(answer[i].outline, expected[i].outline);
      EXPECT_EQ(answer[i].holes, expected[i].holes);
    }
  }
}

// Of identical rings one is the outline and the other its hole: together they are nothing.
TEST(BadRings, IdenticalRingsCancel) {
  EXPECT_EQ(signed_area(checked_rings(Rings<double>{square, square}, "subject")), 0);
  EXPECT_EQ(signed_area(checked_rings(Rings<double>{square, square, square}, "subject")), 36);
}

// Crossings that binary64 cannot hold are refused by it, and nothing to the exact kernel.
TEST(BadRings, CrossingsBeyondBinary64) {
  const Rings<double> a{{{-1e300, -1e300}, {1e300, -1e300}, {0, 1e300}}};
  const Rings<double> b{{{-1e300, 0}, {1e300, 0}, {0, -1e305}}};
  EXPECT_EQ(refusal(a, b), "where edges meet is beyond binary64; the exact kernel does it");
  EXPECT_EQ(weiler_atherton(to_exact(a), to_exact(b), SetOperation::intersection).size(), 1U);
}

// Over binary64 the answer may be about right or refused; it comes to an end either way.
TEST(BadRings, RoundingEndsInAnAnswerOrARefusal) {
  std::mt19937_64 random(41);
  const auto below = [&](unsigned n) { return static_cast<double>(random() % n); };
  int answers = 0, refusals = 0;
  for (int i = 0; i < 3000 / checks::effort; ++i) {
    // Fans over nearly the same line y = x/3, every corner off it by a few ulps.
    const auto ring = [&] {
      Ring<double> corners;
      for (const double x : {0.0, 1 + below(3), 4 + below(3)}) corners.push_back({x, x / 3});
      corners.push_back({below(7), 4 + below(3)});
      for (Point2<double>& p : corners)
        for (auto steps = random() % 3; steps > 0; --steps) p.y = std::nextafter(p.y, 9);
      return corners;
    };
    const Rings<double> a{ring()}, b{ring()};
    try {
      weiler_atherton(a, b, SetOperation::intersection);
      weiler_atherton(a, b, SetOperation::difference);
      ++answers;
    } catch (const InputError& error) {
      EXPECT_THAT(error.what(), ::testing::HasSubstr("binary64"));
      ++refusals;
    }
    EXPECT_NO_THROW(weiler_atherton(to_exact(a), to_exact(b), SetOperation::intersection));
  }
  EXPECT_GT(answers, 500 / checks::effort);
  EXPECT_GT(refusals, 10 / checks::effort);
}

}  // namespace
}  // namespace fathom::clipping::test
