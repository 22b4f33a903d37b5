#include "fathom/numeric/rounding.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <optional>
#include <string>

#include "tests/adversaries.h"
#include "tests/inputs/draw.h"
#include "tests/inputs/floating_point_modes.h"
#include "tests/numeric/random_numbers.h"
#include "tests/oracle/mpfr_rounding.h"

namespace fathom {
namespace {

using checks::any_double;
using checks::few_bits;
using checks::Rational;

double value_of(Binary16 x) {
  const int exponent = x.bits >> 10 & 31;
  const int fraction = x.bits & 1023;
  const double sign = x.bits >> 15 ? -1 : 1;
  if (exponent == 31) return sign * std::numeric_limits<double>::infinity();
  return sign * (exponent ? std::ldexp(1024 + fraction, exponent - 25) : std::ldexp(fraction, -24));
}

::testing::AssertionResult same_bits(double expected, double actual, const Ratio& x) {
  if (std::bit_cast<std::uint64_t>(expected) == std::bit_cast<std::uint64_t>(actual)) {
    return ::testing::AssertionSuccess();
  }
  return ::testing::AssertionFailure()
         << to_fraction(x) << ": MPFR " << std::hexfloat << expected << ", ours " << actual;
}

using Mode = const checks::FloatingPointMode*;

void check_quotient(const Ratio& x, Mode mode = nullptr) {
  const Rational q(x);
  std::optional<checks::InMode> in_mode(std::in_place, mode);
  const float single = round_to_binary32(x);
  const double full = round_to_binary64(x);
  const Binary16 half = round_to_binary16(x);
  in_mode.reset();
  // MPFR keeps the sign of a negative number that underflows; an exact zero is +0.
  ASSERT_TRUE(same_bits(oracle::quotient(oracle::binary32, q.q), single, x));
  ASSERT_TRUE(same_bits(oracle::quotient(oracle::binary64, q.q), full, x));
  ASSERT_TRUE(same_bits(oracle::quotient(oracle::binary16, q.q), value_of(half), x));
}

void check_root(const Ratio& x, Mode mode = nullptr) {
  const Rational q(x);
  std::optional<checks::InMode> in_mode(std::in_place, mode);
  const float single = round_sqrt_to_binary32(x);
  const double full = round_sqrt_to_binary64(x);
  in_mode.reset();
  ASSERT_TRUE(same_bits(oracle::root(oracle::binary32, q.q), single, x));
  ASSERT_TRUE(same_bits(oracle::root(oracle::binary64, q.q), full, x));
}

/// The number halfway between a value of a format and the next: `bits` of precision.
Dyadic midpoint(std::mt19937_64& random, int bits, int least_exponent, int greatest_exponent) {
  const auto significand = static_cast<double>(random() % (std::uint64_t{1} << bits));
  const int exponent =
      least_exponent +
      static_cast<int>(random() % static_cast<unsigned>(greatest_exponent - least_exponent));
  return (Dyadic(significand) * Dyadic(2.0) + Dyadic(1.0)).scaled(exponent - 1);
}

TEST(Rounding, ToNormalNumbersDeclinesWhereSomethingIsLost) {
  constexpr double least = std::numeric_limits<double>::min();
  const auto round = [](const Dyadic& x) { return round_to_normal(Ratio(x)); };
  EXPECT_EQ(round_to_normal(Ratio(Dyadic(0.0), Dyadic(-3.0))), 0.0);
  EXPECT_EQ(round(least), least);
  EXPECT_EQ(round(-least), -least);
  EXPECT_EQ(round(std::numeric_limits<double>::max()), std::numeric_limits<double>::max());
  EXPECT_EQ(round_to_normal(Ratio(1.0, 3.0)), 1.0 / 3);
  // Below the least normal number by less than half a step: rounded to it, with an error of u.
  EXPECT_EQ(round(Dyadic(least) - Dyadic(0x1p-1074).scaled(-2)), least);
  EXPECT_EQ(round(least / 2), std::nullopt);
  EXPECT_EQ(round(Dyadic(0x1p-1074).scaled(-1)), std::nullopt);
  EXPECT_EQ(round(Dyadic(-1.0).scaled(-5000)), std::nullopt);
  EXPECT_EQ(round(Dyadic(1.0).scaled(1024)), std::nullopt);
}

double denominator(std::mt19937_64& random, bool small) {
  for (;;) {
    const double d = small ? few_bits(random) : any_double(random);
    if (d != 0) return d;
  }
}

TEST(Rounding, RandomQuotientsAgreeWithMpfr) {
  std::mt19937_64 random(11);
  for (int i = 0; i < 30000; ++i) {
    const bool small = i % 3 != 0;
    const double n = small ? few_bits(random) : any_double(random);
    check_quotient({Dyadic(n), Dyadic(denominator(random, small))});
    if (HasFatalFailure()) return;
  }
}

struct Ties {
  int bits, least, greatest;
};
constexpr Ties formats[] = {{24, -149, 105}, {53, -1074, 972}, {11, -24, 6}};

TEST(Rounding, TiesAndTheirNeighboursAgreeWithMpfr) {
  std::mt19937_64 random(12);
  for (const auto& f : formats) {
    for (int i = 0; i < 3000; ++i) {
      const Dyadic tie = midpoint(random, f.bits, f.least, f.greatest);
      const Dyadic d = Dyadic(denominator(random, true));
      const Dyadic least = Dyadic(1.0).scaled(-1500);
      for (const Dyadic& x : {tie, tie + least, tie - least, -tie}) {
        check_quotient({x * d, d});
        if (HasFatalFailure()) return;
      }
    }
  }
}

/// Halfway between two numbers of a format, in the middle or at an end of its range.
Dyadic hard_tie(checks::Draw& draw) {
  const Ties& f = draw.one_of(formats);
  const Dyadic tie = midpoint(draw.generator(), f.bits, f.least, f.greatest);
  if (!draw.one_in(3)) return tie;
  const int end = draw.one_in(2) ? f.least : f.greatest - 1;
  return midpoint(draw.generator(), draw.one_in(2) ? f.bits : 1, end, end + 1);
}

/// As near to a tie m·2^e as quotients with a denominator d come to it: m ± 1/d; or anything.
Ratio hard_quotient(checks::Draw& draw) {
  const Dyadic d = Dyadic(denominator(draw.generator(), draw.one_in(2)));
  const Dyadic tie = draw.one_in(2) ? hard_tie(draw) : -hard_tie(draw);
  switch (draw.below(4)) {
    case 0:
      return {Dyadic(any_double(draw.generator())), d};
    case 1:  // a product of two: exponents beyond the range of all formats
      return {Dyadic(any_double(draw.generator())) * tie, d * d};
    case 2:
      return {tie * d, d};
    default:
      return {tie * d + Dyadic(draw.few_bits(1)).scaled(-draw.below(1200)) * tie, d};
  }
}

TEST(RoundingAdversaries, QuotientsAgreeWithMpfr) {
  checks::for_each_adversary(20000, [](std::uint64_t seed) {
    checks::Draw draw(seed);
    const Mode mode = checks::any_mode(draw.generator());
    check_quotient(hard_quotient(draw), mode);
  });
}

/// The same for numbers whose roots are such.
TEST(RoundingAdversaries, RootsAgreeWithMpfr) {
  checks::for_each_adversary(5000, [](std::uint64_t seed) {
    checks::Draw draw(seed);
    const Mode mode = checks::any_mode(draw.generator());
    const Dyadic tie = hard_tie(draw), d = Dyadic(denominator(draw.generator(), true));
    const Dyadic nearly = tie * tie + (tie * tie).scaled(-draw.between(50, 1000));
    const Ratio any = hard_quotient(draw);
    const Ratio anything = any.sign() == Sign::negative ? Ratio() - any : any;
    check_root(
        draw.one_in(3) ? anything : Ratio{(draw.one_in(2) ? tie * tie : nearly) * d * d, d * d},
        mode);
  });
}

TEST(RoundingAdversaries, EveryBinary16NumberIsWidenedAndComesBack) {
  for (std::uint32_t bits = 0; bits < 0x10000; ++bits) {
    const Binary16 x{static_cast<std::uint16_t>(bits)};
    if ((bits & 0x7FFF) > 0x7C00) continue;  // NaN
    const Mode mode = &checks::other_modes[bits % std::size(checks::other_modes)];
    std::optional<checks::InMode> in_mode(std::in_place, mode);
    const float wide = widen_binary16(x.bits);
    in_mode.reset();
    ASSERT_EQ(static_cast<double>(wide), value_of(x)) << bits;
    ASSERT_EQ(std::signbit(wide), bits >= 0x8000) << bits;
    if (std::isfinite(wide) && wide != 0) {
      ASSERT_EQ(round_to_binary16(Dyadic(wide)), x);
    }
  }
}

TEST(Rounding, EndsOfTheRange) {
  const auto check = [](const Dyadic& x) { check_quotient(Ratio(x)); };
  for (const int exponent : {-1075, -1074, -1022, -150, -149, -126, -25, -24, -14, 15, 16, 127, 128,
                             1023, 1024, 5000, -5000}) {
    const Dyadic power = Dyadic(1.0).scaled(exponent);
    const Dyadic sliver = Dyadic(1.0).scaled(exponent - 2000);
    for (const Dyadic& x :
         {power, power - sliver, power + sliver, -power, power - power.scaled(-25),
          power - power.scaled(-54), power - power.scaled(-12), power + power.scaled(-1)}) {
      check(x);
      if (HasFatalFailure()) return;
    }
  }
}

TEST(Rounding, ZeroIsPositiveAndNegativeUnderflowIsNegative) {
  EXPECT_FALSE(std::signbit(round_to_binary32(Ratio(Dyadic(-0.0)))));
  const float underflow = round_to_binary32(Ratio(Dyadic(-1.0).scaled(-200)));
  EXPECT_EQ(underflow, 0.0F);
  EXPECT_TRUE(std::signbit(underflow));
  EXPECT_EQ(round_to_binary32(Ratio(Dyadic(-1.0).scaled(200))),
            -std::numeric_limits<float>::infinity());
}

TEST(Rounding, RootsAgreeWithMpfr) {
  std::mt19937_64 random(13);
  for (int i = 0; i < 20000; ++i) {
    const bool small = i % 3 != 0;
    const double n = std::abs(small ? few_bits(random) : any_double(random));
    check_root({Dyadic(n), Dyadic(std::abs(denominator(random, small)))});
    if (HasFatalFailure()) return;
  }
}

TEST(Rounding, RootsThatTieOrNearlyDoAgreeWithMpfr) {
  std::mt19937_64 random(14);
  for (int i = 0; i < 5000; ++i) {
    const bool single = i % 2 == 0;
    const Dyadic tie = single ? midpoint(random, 24, -149, 100) : midpoint(random, 53, -1074, 900);
    const Dyadic d = Dyadic(denominator(random, true));
    const Dyadic square = tie * tie;
    const Dyadic sliver = square.scaled(-1000);
    for (const Dyadic& x : {square, square + sliver, square - sliver}) {
      check_root({x * d * d, d * d});
      if (HasFatalFailure()) return;
    }
  }
}

TEST(Rounding, RootOfANegativeNumberIsRefused) {
  EXPECT_THROW(round_sqrt_to_binary32(Ratio(Dyadic(-1.0))), std::domain_error);
}

TEST(Rounding, IntegersTieToEven) {
  EXPECT_EQ(round_to_integer({Dyadic(5.0), Dyadic(2.0)}, 9), 2U);
  EXPECT_EQ(round_to_integer({Dyadic(7.0), Dyadic(2.0)}, 9), 4U);
  EXPECT_EQ(round_to_integer({Dyadic(1.0), Dyadic(2.0)}, 9), 0U);
  EXPECT_EQ(round_to_integer({Dyadic(-1.0), Dyadic(2.0)}, 9), 0U);
  EXPECT_EQ(round_to_integer({Dyadic(-3.0), Dyadic(2.0)}, 9), std::nullopt);
  EXPECT_EQ(round_to_integer({Dyadic(19.0), Dyadic(2.0)}, 9), std::nullopt);
  EXPECT_EQ(round_to_integer({Dyadic(28.0), Dyadic(3.0)}, 9), 9U);
  EXPECT_EQ(round_sqrt_to_integer({Dyadic(25.0), Dyadic(4.0)}, 9), 2U);
  EXPECT_EQ(round_sqrt_to_integer({Dyadic(49.0), Dyadic(4.0)}, 9), 4U);
  EXPECT_EQ(round_sqrt_to_integer(Ratio(Dyadic(90.0)), 9), 9U);
  EXPECT_EQ(round_sqrt_to_integer(Ratio(Dyadic(91.0)), 9), std::nullopt);
}

TEST(Rounding, UnormCodes) {
  for (const int bits : {8, 16, 24, 32}) {
    const auto greatest = static_cast<std::uint32_t>((std::uint64_t{1} << bits) - 1);
    EXPECT_EQ(round_to_unorm(Ratio(Dyadic(0.0)), bits), 0U);
    EXPECT_EQ(round_to_unorm(Ratio(Dyadic(1.0)), bits), greatest);
    // ½·(2ⁿ − 1) is halfway between two integers; the even one is 2ⁿ⁻¹.
    EXPECT_EQ(round_to_unorm(Ratio(Dyadic(0.5)), bits), std::uint32_t{1} << (bits - 1));
    EXPECT_EQ(round_to_unorm({Dyadic(1.0), Dyadic(3.0)}, bits),
              (greatest + 1U) / 3U + (greatest == 0xFFFFFFFF ? 0x55555555U : 0U))
        << bits;
    EXPECT_EQ(round_to_unorm(Ratio(Dyadic(-0x1p-60)), bits), std::nullopt);
    EXPECT_EQ(round_to_unorm(Ratio(Dyadic(1.0) + Dyadic(0x1p-60)), bits), std::nullopt);
  }
}

TEST(Ratio, FractionsAndDecimals) {
  EXPECT_EQ(to_fraction({Dyadic(6.0), Dyadic(-4.0)}), "-3/2");
  EXPECT_EQ(to_fraction({Dyadic(0.0), Dyadic(3.0)}), "0");
  EXPECT_EQ(to_fraction(Ratio(Dyadic(12.0))), "12");
  EXPECT_EQ(to_decimal({Dyadic(1.0), Dyadic(3.0)}, 5), "3.3333e-1");
  EXPECT_EQ(to_decimal({Dyadic(2.0), Dyadic(3.0)}, 40),
            "6.666666666666666666666666666666666666667e-1");
  EXPECT_EQ(to_decimal(Ratio(Dyadic(999.5)), 3), "1.00e3");
  EXPECT_EQ(to_decimal(Ratio(Dyadic(-0.125)), 2), "-1.2e-1");  // half to even
  EXPECT_EQ(to_decimal(Ratio(Dyadic(1024.0)), 4), "1.024e3");
  EXPECT_THROW(Ratio(Dyadic(1.0), Dyadic(0.0)), std::domain_error);
}

TEST(Ratio, DecimalsAreThoseOfMpfr) {
  std::mt19937_64 random(15);
  for (int i = 0; i < 2000; ++i) {
    const double x = any_double(random);
    mpfr_t exact;
    mpfr_init2(exact, 53);
    mpfr_set_d(exact, x, MPFR_RNDN);
    char text[64];
    mpfr_snprintf(text, sizeof text, "%.39Re", exact);
    mpfr_clear(exact);
    const std::string ours = to_decimal(Ratio(Dyadic(x)), 40);
    EXPECT_EQ(ours.substr(0, ours.find('e')),
              std::string(text).substr(0, std::string(text).find('e')));
    EXPECT_EQ(std::stol(ours.substr(ours.find('e') + 1)),
              std::stol(std::string(text).substr(std::string(text).find('e') + 1)));
  }
}

}  // namespace
}  // namespace fathom
