#include <gtest/gtest.h>

#include <cmath>
#include <optional>
#include <ostream>
#include <stdexcept>
#include <vector>

#include "fathom/numeric/rounding.h"
#include "fathom/numeric/transcendental.h"
#include "tests/adversaries.h"
#include "tests/inputs/draw.h"
#include "tests/inputs/floating_point_modes.h"
#include "tests/numeric/random_numbers.h"
#include "tests/oracle/mpfr_number.h"
#include "tests/oracle/mpfr_rounding.h"

namespace fathom {
namespace {

Ratio ratio(double p, double q) {
  return {Dyadic(p), Dyadic(q)};
}

/// p/q as an MPFR number of 2000 bits.
void set(mpfr_ptr result, double p, double q) {
  mpfr_set_d(result, p, MPFR_RNDN);
  mpfr_div_d(result, result, q, MPFR_RNDN);
}

TEST(Logarithm, QuotientsOfPowersOfOneRationalAreRational) {
  EXPECT_EQ(*quotient_of_logarithms(Dyadic(8.0), Dyadic(4.0)).rational(), ratio(3, 2));
  EXPECT_EQ(*quotient_of_logarithms(ratio(9, 4), ratio(27, 8)).rational(), ratio(2, 3));
  EXPECT_EQ(*quotient_of_logarithms(Dyadic(1.0), Dyadic(7.0)).rational(), Ratio());
  EXPECT_EQ(*quotient_of_logarithms(Dyadic(6.0), Dyadic(36.0)).rational(), ratio(1, 2));
  // 2⁶⁴ and 2²⁰·3²⁰: exponents with a common divisor, but no powers of one rational.
  EXPECT_FALSE(quotient_of_logarithms(Dyadic(0x1p64), Dyadic(3486784401.0).scaled(20)).rational());
  EXPECT_FALSE(quotient_of_logarithms(Dyadic(2.0), Dyadic(3.0)).rational());
  EXPECT_FALSE(quotient_of_logarithms(Dyadic(8.0), Dyadic(12.0)).rational());
  EXPECT_FALSE(quotient_of_logarithms(ratio(9, 4), ratio(9, 2)).rational());
}

TEST(Logarithm, PowersAreRationalWhereTheBaseIsAPower) {
  EXPECT_EQ(*power_minus_one(ratio(9, 4), ratio(3, 2)).rational(), ratio(19, 8));
  EXPECT_EQ(*power_minus_one(Dyadic(5.0), Ratio()).rational(), Ratio());
  EXPECT_EQ(*power_minus_one(Dyadic(5.0), ratio(4, 2)).rational(), Ratio(Dyadic(24.0)));
  EXPECT_FALSE(power_minus_one(ratio(9, 5), ratio(1, 2)).rational());
  EXPECT_FALSE(power_minus_one(Dyadic(8.0), ratio(1, 2)).rational());
  EXPECT_FALSE(power_minus_one(Dyadic(8.0), Dyadic(0x1p-100)).rational());
}

TEST(Logarithm, RationalResultsRoundAsTies) {
  // 1/2·(2¹⁶ − 1) is a tie; the even neighbour is 2¹⁵.
  EXPECT_EQ(round_to_unorm(quotient_of_logarithms(Dyadic(3.0), Dyadic(9.0)), 16), 0x8000U);
  EXPECT_EQ(round_to_binary64(quotient_of_logarithms(Dyadic(3.0), Dyadic(9.0))), 0.5);
  EXPECT_EQ(compare(quotient_of_logarithms(Dyadic(3.0), Dyadic(9.0)), ratio(1, 2)), 0);
  EXPECT_GT(compare(quotient_of_logarithms(Dyadic(3.0), Dyadic(8.999)), ratio(1, 2)), 0);
}

TEST(Logarithm, RandomQuotientsAgreeWithMpfr) {
  std::mt19937_64 random(21);
  oracle::MpfrNumber x(2000), y(2000);
  for (int i = 0; i < 3000; ++i) {
    // 1 + tiny, moderate and huge.
    const double p = 1 + std::ldexp(1 + random() % 1000, static_cast<int>(random() % 100) - 52);
    const double q = 1 + std::ldexp(1 + random() % 1000, static_cast<int>(random() % 100) - 52);
    if (p == q) continue;
    set(x, p, 1);
    set(y, q, 1);
    mpfr_log(x, x, MPFR_RNDN);
    mpfr_log(y, y, MPFR_RNDN);
    mpfr_div(x, x, y, MPFR_RNDN);
    const Real ours = quotient_of_logarithms(Dyadic(p), Dyadic(q));
    const auto copy = [&](mpfr_ptr r) { return mpfr_set(r, x, MPFR_RNDN); };
    ASSERT_EQ(oracle::round_with(oracle::binary64, copy), round_to_binary64(ours)) << p << " " << q;
    ASSERT_EQ(oracle::round_with(oracle::binary32, copy), round_to_binary32(ours)) << p << " " << q;
  }
}

TEST(Logarithm, RandomPowersAgreeWithMpfr) {
  std::mt19937_64 random(22);
  oracle::MpfrNumber x(2000), y(2000);
  for (int i = 0; i < 3000; ++i) {
    const double b = 1 + std::ldexp(1 + random() % 1000, static_cast<int>(random() % 100) - 52);
    const double p = random() % 65536, q = 65535;
    set(x, b, 1);
    set(y, p, q);
    mpfr_pow(x, x, y, MPFR_RNDN);
    mpfr_sub_ui(x, x, 1, MPFR_RNDN);
    const Real ours = power_minus_one(Dyadic(b), ratio(p, q));
    const auto copy = [&](mpfr_ptr r) { return mpfr_set(r, x, MPFR_RNDN); };
    ASSERT_EQ(oracle::round_with(oracle::binary64, copy), round_to_binary64(ours)) << b << " " << p;
  }
}

using checks::Draw;
using checks::Rational;

/// A number of 3000 bits.
class Wide : public oracle::MpfrNumber {
 public:
  Wide() : MpfrNumber(3000) {}
};

/// log a.
void set_logarithm(mpfr_ptr result, const Ratio& a) {
  oracle::set_log1p(result, Rational(a - Dyadic(1.0)).q);
}

/// A number in all formats, and as codes where it is one.
struct Rounded {
  double binary64 = 0, binary32 = 0, binary16 = 0;
  std::vector<std::uint32_t> codes;
  friend bool operator==(const Rounded&, const Rounded&) = default;
};
std::ostream& operator<<(std::ostream& out, const Rounded& x) {
  out << std::hexfloat << x.binary64 << " " << x.binary32 << " " << x.binary16;
  for (const std::uint32_t code : x.codes) out << " " << code;
  return out;
}

constexpr int code_bits[] = {16, 24, 32};

Rounded rounded_by_us(const Real& x, const checks::FloatingPointMode* mode) {
  std::optional<checks::InMode> in_mode(std::in_place, mode);
  const double full = round_to_binary64(x);
  const float single = round_to_binary32(x);
  const std::uint16_t half = round_to_binary16(x).bits;
  Rounded result;
  for (const int bits : code_bits) {
    if (const auto code = round_to_unorm(x, bits)) result.codes.push_back(*code);
  }
  in_mode.reset();
  result.binary64 = full;
  result.binary32 = static_cast<double>(single);
  result.binary16 = static_cast<double>(widen_binary16(half));
  return result;
}

/// Where x comes within 2⁻¹⁵⁰⁰ of a number of which 2²⁰⁰ times are whole, it is that: a tie,
/// perhaps. No other number that is drawn comes so near.
void make_dyadic_exact(mpfr_ptr x) {
  Wide multiple, nearest;
  mpfr_mul_2si(multiple, x, 200, MPFR_RNDN);
  mpfr_rint(nearest, multiple, MPFR_RNDN);
  mpfr_sub(multiple, multiple, nearest, MPFR_RNDN);
  if (mpfr_zero_p(multiple) == 0 && mpfr_get_exp(multiple) > -1300) return;
  if (mpfr_zero_p(nearest) == 0) mpfr_mul_2si(x, nearest, -200, MPFR_RNDN);
}

Rounded rounded_by_mpfr(mpfr_ptr x) {
  make_dyadic_exact(x);
  const auto copy = [&](mpfr_ptr r) { return mpfr_set(r, x, MPFR_RNDN); };
  Rounded result{oracle::round_with(oracle::binary64, copy),
                 oracle::round_with(oracle::binary32, copy),
                 oracle::round_with(oracle::binary16, copy),
                 {}};
  if (mpfr_cmp_ui(x, 1) > 0) return result;
  for (const int bits : code_bits) {
    Wide scaled;
    mpfr_mul_ui(scaled, x, (1UL << bits) - 1, MPFR_RNDN);
    make_dyadic_exact(scaled);
    mpfr_rint(scaled, scaled, MPFR_RNDN);  // ties to even
    result.codes.push_back(static_cast<std::uint32_t>(mpfr_get_ui(scaled, MPFR_RNDN)));
  }
  return result;
}

Ratio power(const Ratio& x, int exponent) {
  Ratio result = Dyadic(1.0);
  for (int i = 0; i < exponent; ++i) result = result * x;
  return result;
}

/// A small rational number above 1.
Ratio small_root(Draw& draw) {
  const int q = draw.between(1, 9);
  return ratio(q + draw.between(1, 9), q);
}

/// A rational number above 1: next to 1, huge, a power, next to a power, a quotient.
Ratio above_one(Draw& draw) {
  switch (draw.below(6)) {
    case 0:
      return Dyadic(1.0) + Dyadic(std::abs(draw.of_exponent(draw.between(-1074, -1))));
    case 1:
      return Dyadic(std::abs(draw.of_exponent(draw.between(1, 1023))));
    case 2:
      return power(small_root(draw), draw.between(1, 12));
    case 3: {
      const Ratio x = power(small_root(draw), draw.between(1, 12));
      return x + x * Ratio(Dyadic(1.0).scaled(-draw.between(20, 300)));
    }
    case 4: {
      const double near = std::abs(draw.of_exponent(draw.between(-300, 300)));
      return ratio(near * (1 + std::ldexp(1 + draw.unit(), draw.between(-50, 300))), near);
    }
    default:
      return Dyadic(1 + std::max(0x1p-52, draw.unit()));
  }
}

void expect_quotient(const Ratio& a, const Ratio& b, const checks::FloatingPointMode* mode) {
  Wide x, y;
  set_logarithm(x, a);
  set_logarithm(y, b);
  mpfr_div(x, x, y, MPFR_RNDN);
  EXPECT_EQ(rounded_by_us(quotient_of_logarithms(a, b), mode), rounded_by_mpfr(x))
      << "log " << to_fraction(a) << " / log " << to_fraction(b);
}

TEST(LogarithmAdversaries, QuotientsAgreeWithMpfr) {
  checks::for_each_adversary(1000, [](std::uint64_t seed) {
    Draw draw(seed);
    const auto* mode = checks::any_mode(draw.generator());
    expect_quotient(above_one(draw), above_one(draw), mode);
    const Ratio root = small_root(draw);
    expect_quotient(power(root, draw.between(1, 12)), power(root, draw.between(1, 12)), mode);
    const Ratio a = above_one(draw);
    Wide x;
    set_logarithm(x, a);
    EXPECT_EQ(rounded_by_us(natural_logarithm(a), mode), rounded_by_mpfr(x))
        << "log " << to_fraction(a);
  });
}

/// Where a depth is decoded exponents are codes, over 2ⁿ − 1, or numbers of a float storage.
Ratio any_exponent(Draw& draw) {
  const std::uint64_t steps = (std::uint64_t{1} << draw.one_of(code_bits)) - 1;
  switch (draw.below(3)) {
    case 0:
      return ratio(static_cast<double>(draw.bits() % (steps + 1)), static_cast<double>(steps));
    case 1:
      return Dyadic(std::ldexp(draw.unit(), -draw.below(1074)));
    default:
      return Dyadic(std::ldexp(draw.below(64), -6));
  }
}

TEST(LogarithmAdversaries, PowersAgreeWithMpfr) {
  checks::for_each_adversary(1000, [](std::uint64_t seed) {
    Draw draw(seed);
    const auto* mode = checks::any_mode(draw.generator());
    const Ratio b = above_one(draw), e = any_exponent(draw);
    Wide x;
    set_logarithm(x, b);
    const Rational factor(e);
    mpfr_mul_q(x, x, factor.q, MPFR_RNDN);
    mpfr_expm1(x, x, MPFR_RNDN);
    EXPECT_EQ(rounded_by_us(power_minus_one(b, e), mode), rounded_by_mpfr(x))
        << to_fraction(b) << " to the power of " << to_fraction(e);
  });
}

/// r^j to the power of i/j is r^i; with as many bits as a tie of binary64 has, if r is 3/2.
TEST(LogarithmAdversaries, PowersThatAreRationalAreExact) {
  checks::for_each_adversary(1000, [](std::uint64_t seed) {
    Draw draw(seed);
    const auto* mode = checks::any_mode(draw.generator());
    const Ratio root = draw.one_in(2) ? ratio(3, 2) : small_root(draw);
    const int i = draw.between(1, 36), j = draw.between(1, 36);
    const Rational exact(power(root, i) - Dyadic(1.0));
    Wide x;
    mpfr_set_q(x, exact.q, MPFR_RNDN);
    EXPECT_EQ(rounded_by_us(power_minus_one(power(root, j), ratio(i, j)), mode), rounded_by_mpfr(x))
        << to_fraction(root) << " " << i << "/" << j;
  });
}

TEST(Logarithm, AffineKeepsEnclosuresInOrder) {
  const Real x = quotient_of_logarithms(Dyadic(2.0), Dyadic(3.0));
  const Real down = affine(x, Dyadic(-2.0), Dyadic(5.0));
  const Enclosure e = down.enclose(60);
  EXPECT_LT(e.low, e.high);
  // log 2 / log 3 = 0.630929753…
  EXPECT_GT(compare(down, Dyadic(3.7381404)), 0);
  EXPECT_LT(compare(down, Dyadic(3.7381406)), 0);
}

TEST(Logarithm, WhatIsNotDefinedIsRefused) {
  EXPECT_THROW(quotient_of_logarithms(Dyadic(0.5), Dyadic(2.0)), std::domain_error);
  EXPECT_THROW(quotient_of_logarithms(Dyadic(2.0), Dyadic(1.0)), std::domain_error);
  EXPECT_THROW(power_minus_one(Dyadic(1.0), Dyadic(1.0)), std::domain_error);
  EXPECT_THROW(power_minus_one(Dyadic(2.0), Dyadic(-1.0)), std::domain_error);
}

}  // namespace
}  // namespace fathom
