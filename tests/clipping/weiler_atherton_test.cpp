// Weiler–Atherton against CGAL's Boolean set operations, as point sets and in exact areas.

#include "fathom/clipping/weiler_atherton.h"

#include <gtest/gtest.h>

#include <sstream>

#include "fathom/clipping/exact_kernel.h"
#include "fathom/clipping/rings.h"
#include "fathom/numeric/errors.h"
#include "tests/clipping/cgal_judge.h"
#include "tests/clipping/pieces.h"
#include "tests/clipping/random_polygons.h"

namespace fathom::clipping::test {
namespace {

std::string to_text(const Rings<double>& rings) {
  std::ostringstream text;
  for (const Ring<double>& ring : rings) {
    text << (&ring == rings.data() ? "[[" : ", [");
    for (std::size_t i = 0; i < ring.size(); ++i)
      text << (i == 0 ? "[" : ", [") << ring[i].x << ", " << ring[i].y << "]";
    text << "]";
  }
  return text.str() + "]";
}

std::string to_text(const Rings<double>& subject, const Rings<double>& clip) {
  return "{\"subject\": " + to_text(subject) + ", \"clip\": " + to_text(clip) + "}";
}

bool cross_each_other(const Rings<double>& rings) {
  try {
    checked_rings(rings, "random");
    return false;
  } catch (const InputError&) {
    return true;
  }
}

/// Both operations on one pair. The answers' areas add up to the subject's.
void expect_as_cgal(const Rings<double>& subject, const Rings<double>& clip) {
  const Judge judge(to_exact(subject), to_exact(clip));
  Rational sum(0);
  for (const SetOperation operation : {SetOperation::intersection, SetOperation::difference}) {
    SCOPED_TRACE(operation == SetOperation::intersection ? "intersection" : "difference");
    const auto answer = weiler_atherton(to_exact(subject), to_exact(clip), operation);
    ASSERT_EQ(area_of(answer), judge.area(operation)) << to_text(subject, clip);
    ASSERT_EQ(judge.fault(operation, answer), std::nullopt) << to_text(subject, clip);
    ASSERT_EQ(piece_fault(answer), std::nullopt) << to_text(subject, clip);
    sum += area_of(answer);
  }
  ASSERT_EQ(sum, signed_area(checked_rings(to_exact(subject), "subject")))
      << to_text(subject, clip);
}

/// `pairs` random pairs on a grid from 0 to `size`.
void expect_random_pairs(std::uint64_t seed, int pairs, int size, int corners) {
  PolygonMaker maker(seed);
  for (int i = 0; i < pairs && !::testing::Test::HasFatalFailure(); ++i) {
    const Rings<double> subject =
        maker.polygon(size, 3 + maker.below(corners - 2), cross_each_other);
    const Rings<double> clip = maker.polygon(size, 3 + maker.below(corners - 2), cross_each_other);
    expect_as_cgal(subject, clip);
  }
}

TEST(WeilerAtherton, RandomPairsOnAGridOf3) {
  expect_random_pairs(1, 1000, 3, 8);
}
TEST(WeilerAtherton, RandomPairsOnAGridOf4) {
  expect_random_pairs(2, 1000, 4, 10);
}
TEST(WeilerAtherton, RandomPairsOnAGridOf8) {
  expect_random_pairs(3, 500, 8, 16);
}

}  // namespace
}  // namespace fathom::clipping::test
