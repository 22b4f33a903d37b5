// One representative for all lists of numbers in the same proportions.
#include <gtest/gtest.h>

#include <vector>

#include "fathom/numeric/certified.h"
#include "tests/numeric/random_numbers.h"

namespace fathom {
namespace {

using checks::any_double;
using checks::few_bits;

ExactVector3 times(const ExactVector3& v, const Dyadic& factor) {
  return {v[0] * factor, v[1] * factor, v[2] * factor};
}

TEST(CommonFactor, OnPaper) {
  const ExactVector3 expected{-2.0, 0.0, 3.0};
  EXPECT_EQ(without_common_factor({-2.0, 0.0, 3.0}), expected);
  EXPECT_EQ(without_common_factor({-7.0, 0.0, 10.5}), expected);
  EXPECT_EQ(without_common_factor({-0x1p-1000, 0.0, 0x1.8p-1000}), expected);
  EXPECT_EQ(without_common_factor({0.0, 0.0, -0.375}), (ExactVector3{0.0, 0.0, -1.0}));
  EXPECT_EQ(without_common_factor({}), ExactVector3{});
}

TEST(CommonFactor, IsTakenOutOfListsOfAnyLength) {
  std::vector<Dyadic> numbers{0.0, 0x1.8p-1000, -0x1.2p-998, Dyadic(0x1.ep1000).scaled(100), 0.0};
  const std::vector<Dyadic> expected{0.0, 1.0, -3.0, Dyadic(5.0).scaled(2098), 0.0};
  divide_by_common_factor(numbers);
  EXPECT_EQ(numbers, expected);
  std::vector<Dyadic> none, zero(1);
  divide_by_common_factor(none);
  divide_by_common_factor(zero);
  EXPECT_EQ(zero, std::vector<Dyadic>(1));
}

TEST(CommonFactor, IsTakenOutWhateverItIs) {
  std::mt19937_64 random(3);
  for (int i = 0; i < 2000; ++i) {
    const ExactVector3 v =
        i % 2 == 0 ? ExactVector3{any_double(random), any_double(random), any_double(random)}
                   : ExactVector3{few_bits(random), few_bits(random), few_bits(random)};
    const ExactVector3 least = without_common_factor(v);
    const Dyadic factor = abs(Dyadic(any_double(random)) * Dyadic(any_double(random)));
    if (!factor.is_zero()) {
      EXPECT_EQ(without_common_factor(times(v, factor)), least);
    }
    // In the same proportions, and with the same signs.
    for (std::size_t k = 0; k < 3; ++k) {
      EXPECT_EQ(v[k].sign(), least[k].sign());
      EXPECT_EQ(v[k] * least[(k + 1) % 3], v[(k + 1) % 3] * least[k]);
    }
  }
}

TEST(Dyadic, HashesAreThoseOfTheNumber) {
  std::mt19937_64 random(4);
  for (int i = 0; i < 2000; ++i) {
    const double x = any_double(random), y = any_double(random);
    const Dyadic sum = Dyadic(x) + Dyadic(y), same = (sum + Dyadic(0x1p-1074)) - Dyadic(0x1p-1074);
    EXPECT_EQ(hash_of(sum), hash_of(same));
    EXPECT_NE(hash_of(sum), hash_of(-sum));
    EXPECT_NE(hash_of(sum), hash_of(sum.scaled(1)));
    EXPECT_NE(hash_of(sum), hash_of(sum + Dyadic(0x1p-1074)));
  }
  EXPECT_EQ(hash_of(Dyadic(-0.0)), hash_of(Dyadic()));
}

}  // namespace
}  // namespace fathom
