// Exact numbers in double-words against themselves.
#include "fathom/numeric/exact_words.h"

#include <gtest/gtest.h>

#include <cmath>

#include "tests/effort.h"
#include "tests/numeric/error_shares.h"
#include "tests/numeric/random_numbers.h"

namespace fathom {
namespace {

using checks::Numbers;
using checks::Share;

TEST(ExactWords, WordsOfANumberAreItsLeadingBits) {
  Numbers n(12);
  Share lost;
  int exact = 0;
  for (int i = 0; i < 20000 / checks::effort; ++i) {
    Dyadic x = Dyadic(n.unit()).scaled(n.below(1200) - 600);
    for (int terms = n.below(8); terms > 0; --terms) {
      x = x + x * Dyadic(n.unit()).scaled(-n.below(130));
    }
    const Certified<WordPair> words = words_of(x);
    EXPECT_LE(words.error, 0x1p-105 * std::abs(words.value.hi));
    EXPECT_EQ(words.value.hi, words.value.hi + words.value.lo);
    lost.add(checks::exactly(words.value), Ratio(x), words.error);
    if (x.top() - last_bit(x) > 106) continue;
    ++exact;
    EXPECT_EQ(words.error, 0);
  }
  EXPECT_GT(exact, 1000 / checks::effort);
  EXPECT_GT(lost.greatest(), 0.9);
  EXPECT_EQ(words_of(Dyadic()).error, 0);
  EXPECT_TRUE(std::isinf(words_of(Dyadic(1.0).scaled(1000)).error));
  EXPECT_TRUE(std::isinf(words_of(Dyadic(1.0).scaled(-802)).error));
}

TEST(ExactWords, SumsOfQuotientsAreWithinTheirBounds) {
  Numbers n(13);
  Share sums;
  for (int i = 0; i < 3000 / checks::effort; ++i) {
    std::vector<Ratio> terms;
    for (int k = n.below(9); k > 0; --k) {
      terms.emplace_back(Dyadic(n.unit()) * Dyadic(n.unit()) * Dyadic(n.unit()),
                         Dyadic(n.unit() + 2) * Dyadic(n.unit() + 2) * Dyadic(n.unit() + 2));
    }
    const Words sum = sum_in_words(terms);
    sums.add(checks::exactly(WordPair(sum.value)), sum_of(terms), sum.error);
    EXPECT_LE(sum.error, 0x1p-90);
    const Certified<double> leading = leading_word(sum);
    sums.add(Dyadic(leading.value), sum_of(terms), leading.error);
  }
  EXPECT_GT(sums.greatest(), 0.5);
}

}  // namespace
}  // namespace fathom
