#include "fathom/numeric/certified_rounding.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <optional>

#include "fathom/numeric/rounding.h"
#include "tests/effort.h"
#include "tests/numeric/error_shares.h"
#include "tests/numeric/random_numbers.h"

namespace fathom {
namespace {

using checks::exactly;
using checks::Numbers;

/// Where a rounding comes out, both ends of the interval round to it exactly; and it comes out
/// where an interval twice as wide would still be settled.
template <class Rounded, class Round>
void expect_rounding(const std::optional<Rounded>& ours, const Dyadic& x, double error,
                     const Round& round, int& settled, int& open) {
  const auto ends_agree = [&](double factor) {
    const auto low = round(x - Dyadic(factor * error)), high = round(x + Dyadic(factor * error));
    return low == high;
  };
  if (ours) {
    ++settled;
    EXPECT_TRUE(ends_agree(1));
    EXPECT_EQ(static_cast<decltype(round(x))>(*ours), round(x));
  } else {
    ++open;
    EXPECT_FALSE(ends_agree(2)) << std::hexfloat << round_to_binary64(Ratio(x)) << " " << error;
  }
}

TEST(CertifiedRounding, ExactZeroHasNoSign) {
  for (const double zero : {0.0, -0.0}) {
    EXPECT_FALSE(std::signbit(to_binary32(zero, 0).value()));
    EXPECT_FALSE(std::signbit(to_binary32(WordPair{zero, zero}, 0).value()));
    EXPECT_FALSE(std::signbit(to_binary64(WordPair{zero, zero}, 0).value()));
  }
  // A negative number that underflows keeps its sign.
  EXPECT_TRUE(std::signbit(to_binary32(WordPair{-1e-60, 0}, 0).value()));
}

/// Double-words are not asked to settle a number whose leading word is itself in the middle: errors
/// here are so large that the leading words differ.
TEST(CertifiedRounding, IsRightAndHardlyEverDeclinesWithoutNeed) {
  Numbers n(33);
  const auto to_float = [](const Dyadic& x) { return round_to_binary32(Ratio(x)); };
  const auto to_double = [](const Dyadic& x) { return round_to_binary64(Ratio(x)); };
  const auto to_integer = [](const Dyadic& x) {
    return round_to_integer(Ratio(x), 1 << 20).value_or(0);
  };
  int settled[4]{}, open[4]{};
  for (int i = 0; i < 20000 / checks::effort; ++i) {
    const double sign = n.below(2) ? 1 : -1;
    // Near the middle between two binary32 numbers in (1, 2).
    const double base = static_cast<float>(1.5 + 0.4 * n.unit());
    const double error = std::ldexp(1, -26 - n.below(20));
    const double x = sign * (base + half_gap(static_cast<float>(base)) + error * 3 * n.unit());
    const WordPair pair{x, x * n.unit() * 0x1p-54};
    expect_rounding(to_binary32(x, error), x, error, to_float, settled[0], open[0]);
    expect_rounding(to_binary32(pair, error), exactly(pair), error, to_float, settled[1], open[1]);
    // Near the middle between two binary64 numbers.
    const double full = sign * (1.5 + 0.4 * n.unit());
    const double fine = std::ldexp(1, -56 - n.below(40));
    const WordPair y = two_sum(full, half_gap(full) * (n.below(2) ? 1 : -1) + fine * 3 * n.unit());
    expect_rounding(to_binary64(y, fine), exactly(y), fine, to_double, settled[2], open[2]);
    // Near the middle between two codes.
    const double middle = n.below(65534) + 1.5;
    const double coarse = std::ldexp(1, -2 - n.below(30));
    const WordPair z{middle + coarse * 3 * n.unit(), 0};
    if (z.hi < 0.5 || z.hi > 65535) continue;
    expect_rounding(to_code(z, coarse), exactly(z), coarse, to_integer, settled[3], open[3]);
    // As near as binary64 can say: it may decline, but must not be wrong.
    const double nearest_error = 0x1p-53 * (1 + n.unit());
    const double w = base + half_gap(static_cast<float>(base)) + 0x1p-52 * (n.below(7) - 3);
    if (const auto rounded = to_binary32(w, nearest_error)) {
      EXPECT_EQ(*rounded, to_float(Dyadic(w) - Dyadic(nearest_error)));
      EXPECT_EQ(*rounded, to_float(Dyadic(w) + Dyadic(nearest_error)));
    }
  }
  for (int k = 0; k < 4; ++k) {
    EXPECT_GT(settled[k], 1000 / checks::effort) << k;
    EXPECT_GT(open[k], 1000 / checks::effort) << k;
  }
}

/// Errors around the size of a number whose second word points at 0.
TEST(CertifiedRounding, ASignIsSettledOnlyOffZero) {
  const double infinity = std::numeric_limits<double>::infinity();
  for (const double sign : {1.0, -1.0}) {
    const WordPair x{sign, -sign * 0x1p-54};
    EXPECT_EQ(certain_sign(x, 0), sign);
    EXPECT_EQ(certain_sign(x, 1 - 0x1p-49), sign);
    for (const double error : {1 - 0x1p-53, 1.0, 1 + 0x1p-52, infinity, std::nan("")}) {
      EXPECT_EQ(certain_sign(x, error), std::nullopt);
    }
  }
  EXPECT_EQ(certain_sign({0, 0}, 0), std::nullopt);
  EXPECT_EQ(certain_sign({0, 0}, 0x1p-1074), std::nullopt);
}

/// The leading word is a tie between two codes, the second one decides.
TEST(CertifiedRounding, TheSecondWordCounts) {
  EXPECT_EQ(to_code(WordPair{32768.5, -0x1p-40}, 0x1p-60), 32768);
  EXPECT_EQ(to_code(WordPair{32769.5, 0x1p-40}, 0x1p-60), 32770);
  // Not the nearest to the leading word, which is what is looked at.
  EXPECT_EQ(to_code(WordPair{32768.5, 0x1p-40}, 0x1p-60), std::nullopt);
  EXPECT_EQ(to_code(WordPair{32769.5, -0x1p-40}, 0x1p-60), std::nullopt);
}

TEST(CertifiedRounding, ExactNumbersZeroesAndTies) {
  EXPECT_EQ(std::signbit(*to_binary32(0.0, 0.0)), false);
  EXPECT_EQ(to_binary32(0.0, 1e-300), std::nullopt);
  EXPECT_EQ(std::signbit(*to_binary32(-1e-300, 1e-310)), true);  // underflows to −0
  EXPECT_EQ(*to_binary32(1e300, 1e200), std::numeric_limits<float>::infinity());
  EXPECT_EQ(to_binary32(1.0, std::numeric_limits<double>::infinity()), std::nullopt);
  EXPECT_EQ(to_binary32(1.0, std::nan("")), std::nullopt);
  EXPECT_EQ(to_binary32(WordPair{1, 0}, std::nan("")), std::nullopt);
  EXPECT_EQ(to_binary64(WordPair{1, 0}, std::nan("")), std::nullopt);
  EXPECT_EQ(to_code(WordPair{1, 0}, std::nan("")), std::nullopt);
  EXPECT_EQ(to_binary32(WordPair{1 + 0x1p-24, 0}, 0x1p-1000), std::nullopt);  // a tie
  EXPECT_EQ(to_binary32(WordPair{1 + 0x1p-24, 0}, 0.0), 1.0F);                // known to be one
  EXPECT_EQ(to_binary64(WordPair{1, 0x1p-53}, 0.0), std::nullopt);
  EXPECT_EQ(to_binary32(WordPair{1 + 0x1p-23, -0x1p-77}, 0x1p-77), 1 + 0x1p-23F);
  EXPECT_EQ(to_code(WordPair{2.5, 0}, 0.0), 2);  // to even
  EXPECT_EQ(to_code(WordPair{3.5, 0}, 0.0), 4);
  EXPECT_EQ(to_code(WordPair{3.5, 0}, 1e-30), std::nullopt);
  EXPECT_EQ(to_code(WordPair{3.5 - 0x1p-47, 0x1p-60}, 0x1p-60), 3);
  EXPECT_EQ(to_code(WordPair{0.5, 0}, 0.0), std::nullopt);  // 0 is no surface
  EXPECT_EQ(to_code(WordPair{std::nextafter(65535.5, 0), 0}, 0x1p-40), 65535);
  EXPECT_EQ(to_code(WordPair{65535.5, 0}, 0.0), std::nullopt);
  // 2^j − ½ less a last bit: adding ½ would round up.
  EXPECT_EQ(to_code(WordPair{std::nextafter(1023.5, 0), 0}, 0.0), 1023);
}

}  // namespace
}  // namespace fathom
