#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string>

#include "fathom/attribution/faults/deviation_fit.h"

namespace fathom::attribution {
namespace {

using testing::ElementsAre;
using testing::IsEmpty;

const DeviationSet& set_of(const std::string& kind, int size) {
  for (const DeviationSet& set : deviation_sets()) {
    if (kind == set.kind && set.size() == size) return set;
  }
  throw kind;
}

/// Every parameter is `deviations` standard deviations off.
FittedDeviation fit_of(const std::string& kind, int size, double cost, double deviations = 100) {
  FittedDeviation fit{.set = &set_of(kind, size), .cost_before = 1, .cost = cost};
  for (const Parameter p : fit.set->parameters) {
    fit.deviation[static_cast<int>(p)] = -deviations;
    fit.shown[static_cast<int>(p)] = 1;
    fit.standard[static_cast<int>(p)] = 1;
  }
  return fit;
}

TEST(SimplestDeviation, IsTheBestOfTheSmallestSize) {
  const auto chosen = simplest_of(
      {fit_of("scale", 1, 0.2), fit_of("focal-length", 1, 0.3), fit_of("shift", 2, 0.15)}, 0.15);
  ASSERT_TRUE(chosen);
  EXPECT_STREQ(chosen->set->kind, "scale");
  EXPECT_THAT(chosen->alternatives, IsEmpty());
}

TEST(SimplestDeviation, IsLargerWhereNoSmallerOneIsAsGood) {
  const auto chosen = simplest_of({fit_of("scale", 1, 0.5), fit_of("shift", 2, 0.15)}, 0.15);
  ASSERT_TRUE(chosen);
  EXPECT_STREQ(chosen->set->kind, "shift");
}

TEST(SimplestDeviation, HasThoseThatCannotBeToldApartAsAlternatives) {
  // In the order of deviation_sets(), whichever leaves a little less; each kind once.
  const auto chosen = simplest_of({fit_of("distortion", 2, 0.2), fit_of("shift", 2, 0.205),
                                   fit_of("decoding", 2, 0.201), fit_of("distortion", 2, 0.2)},
                                  0.2);
  ASSERT_TRUE(chosen);
  EXPECT_STREQ(chosen->set->kind, "shift");
  EXPECT_THAT(chosen->alternatives, ElementsAre("distortion", "decoding"));
}

TEST(SimplestDeviation, IsSignificant) {
  EXPECT_FALSE(simplest_of({fit_of("scale", 1, 0.2, 5.9)}, 0.2));
  EXPECT_FALSE(simplest_of({fit_of("scale", 1, 0.995)}, 0.995));
  FittedDeviation one_is_not = fit_of("shift", 2, 0.2);
  one_is_not.deviation[static_cast<int>(Parameter::centre_y)] = 5.9;
  EXPECT_FALSE(simplest_of({one_is_not}, 0.2));
  EXPECT_TRUE(simplest_of({fit_of("scale", 1, 0.2, 6.1)}, 0.2));
}

// One that may be chance is neither named, though it comes first, nor an alternative.
TEST(SimplestDeviation, IsNotAnInsignificantOneThatIsAsGood) {
  const auto chosen = simplest_of({fit_of("aspect", 2, 0.2), fit_of("shift", 2, 0.2, 5.9)}, 0.2);
  ASSERT_TRUE(chosen);
  EXPECT_STREQ(chosen->set->kind, "aspect");
  EXPECT_THAT(chosen->alternatives, IsEmpty());
}

}  // namespace
}  // namespace fathom::attribution
