// Sums of quotients against their exact sum.
#include <gtest/gtest.h>

#include "fathom/numeric/real.h"

namespace fathom {
namespace {

TEST(EnclosedSum, BinaryFractionsAddUpExactly) {
  EnclosedSum sum;
  for (const double x : {0.5, 0x1p-300, 3.0, 0.0}) sum.add(Dyadic(x));
  const Enclosure found = sum.get();
  EXPECT_EQ(found.low, Ratio(Dyadic(3.5) + Dyadic(0x1p-300)));
  EXPECT_EQ(found.high, found.low);
}

TEST(EnclosedSum, OtherQuotientsAreEnclosed) {
  EnclosedSum sum, part;
  Ratio exact;
  for (int k = 1; k <= 60; ++k) {
    const Ratio term(Dyadic(1.0).scaled(-k), Dyadic(2.0 * k + 1));
    exact = exact + term;
    (k % 3 == 0 ? part : sum).add(term);
  }
  sum.add(part);
  const Enclosure found = sum.get();
  EXPECT_LT(found.low, exact);
  EXPECT_LT(exact, found.high);
  EXPECT_EQ(found.high - found.low, Ratio(Dyadic(60.0).scaled(-320)));
}

TEST(EnclosedSum, TermsOfBothSigns) {
  EnclosedSum sum;
  Ratio exact;
  for (int k = 1; k <= 60; ++k) {
    const Ratio term(Dyadic(k % 2 == 0 ? 1.0 : -1.0), Dyadic(2.0 * k + 1));
    exact = exact + term;
    sum.add(term);
  }
  const Enclosure found = sum.get();
  EXPECT_EQ(exact.sign(), Sign::negative);
  EXPECT_LT(found.low, exact);
  EXPECT_LT(exact, found.high);
}

}  // namespace
}  // namespace fathom
