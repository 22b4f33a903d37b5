// Rounding of numbers that are known by enclosures only, after Ziv: how often they are enclosed,
// and that a rational number in disguise is found out.
#include "fathom/numeric/real.h"

#include <gtest/gtest.h>

#include <cmath>
#include <optional>
#include <vector>

#include "fathom/numeric/transcendental.h"
#include "tests/inputs/floating_point_modes.h"

namespace fathom {
namespace {

/// value ± 2^−bits: what is asked of it is written down.
struct Enclosed {
  Ratio value;
  bool is_rational;
  std::vector<long>* asked;
  int* decisions;

  [[nodiscard]] Real real() const {
    return {[*this](long bits) {
              asked->push_back(bits);
              const Ratio width(Dyadic(1.0).scaled(-bits));
              return Enclosure{value - width, value + width};
            },
            [*this]() -> std::optional<Ratio> {
              ++*decisions;
              if (!is_rational) return std::nullopt;
              return value;
            }};
  }
};

TEST(Real, OneEnclosureSettlesWhatLiesFarFromTheMiddle) {
  std::vector<long> asked;
  int decisions = 0;
  const Real third = Enclosed{Ratio(1.0, 3.0), true, &asked, &decisions}.real();
  EXPECT_EQ(round_to_binary32(third), 1.0F / 3);
  EXPECT_EQ(asked.size(), 1U);
  EXPECT_EQ(decisions, 0);
}

/// 1 + 2⁻²⁴ is a tie of binary32: no enclosure tells on which side it lies, for it lies on neither.
TEST(Real, ATieIsFoundToBeRational) {
  std::vector<long> asked;
  int decisions = 0;
  const Real tie = Enclosed{Ratio(Dyadic(1 + 0x1p-24)), true, &asked, &decisions}.real();
  EXPECT_EQ(round_to_binary32(tie), 1.0F);
  EXPECT_EQ(asked.size(), 1U);
  EXPECT_EQ(decisions, 1);
}

/// 2⁻⁵⁰⁰ above the tie, and said to be irrational: more bits are asked for until they tell.
TEST(Real, BitsAreDoubledUntilTheyTell) {
  std::vector<long> asked;
  int decisions = 0;
  const Ratio above(Dyadic(1 + 0x1p-24) + Dyadic(0x1p-500));
  const Real real = Enclosed{above, false, &asked, &decisions}.real();
  EXPECT_EQ(round_to_binary32(real), std::nextafter(1.0F, 2.0F));
  ASSERT_EQ(asked.size(), 4U);
  for (std::size_t i = 1; i < asked.size(); ++i) EXPECT_EQ(asked[i], 2 * asked[i - 1]);
  EXPECT_EQ(decisions, 1);
}

/// Found by DepthFormatAdversaries: log(1 + C·D) / log(1 + C·far) just above D/far = 2⁻¹⁵⁰, halfway
/// between 0 and the least subnormal number, which some modes take for equal.
TEST(Real, TiesOfSubnormalNumbersAreSettledInEveryMode) {
  const auto one_and = [](double x) { return Ratio(Dyadic(1.0) + Dyadic(x)); };
  const Ratio a = one_and(0x1p-520), b = one_and(0x1p-370);
  for (const checks::FloatingPointMode& mode : checks::other_modes) {
    std::optional<checks::InMode> in_mode(std::in_place, mode);
    const float single = round_to_binary32(quotient_of_logarithms(a, b));
    in_mode.reset();
    EXPECT_EQ(single, 0x1p-149F) << mode.name;
  }
}

TEST(Real, ComparisonsAndAffineMapsKeepTheNumber) {
  std::vector<long> asked;
  int decisions = 0;
  const Real third = Enclosed{Ratio(1.0, 3.0), true, &asked, &decisions}.real();
  EXPECT_EQ(compare(third, Ratio(1.0, 3.0)), 0);
  EXPECT_LT(compare(third, Ratio(Dyadic(0.5))), 0);
  EXPECT_GT(compare(third, Ratio(Dyadic(0.25))), 0);
  const Real mapped = affine(third, Ratio(Dyadic(-6.0)), Ratio(Dyadic(5.0)));
  EXPECT_EQ(round_to_binary64(mapped), 3.0);
  const std::optional<Ratio> exact = mapped.rational();
  ASSERT_TRUE(exact);
  EXPECT_EQ(*exact, Ratio(Dyadic(3.0)));
}

TEST(Real, ARatioIsRoundedAsItIs) {
  const Real real(Ratio(2.0, 3.0));
  EXPECT_EQ(round_to_binary64(real), 2.0 / 3);
  EXPECT_EQ(round_to_unorm(real, 16), 43690U);  // 65535·2⁄3 exactly
}

}  // namespace
}  // namespace fathom
