#include "fathom/numeric/certified_logarithm.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "tests/adversaries.h"
#include "tests/inputs/draw.h"
#include "tests/oracle/mpfr_number.h"

namespace fathom {
namespace {

using checks::Draw;
using oracle::MpfrNumber;

/// Enough for any sum of binary64 numbers, exactly.
constexpr long wide = 2200;

void set_sum(mpfr_ptr result, const WordPair& x, double more) {
  mpfr_set_d(result, x.hi, MPFR_RNDN);
  mpfr_add_d(result, result, x.lo, MPFR_RNDN);
  mpfr_add_d(result, result, more, MPFR_RNDN);
}

using Function = int (*)(mpfr_ptr, mpfr_srcptr, mpfr_rnd_t);

/// Whether what was computed for y and its error encloses the function at both ends of what that
/// allows; it grows, so in between, too. The function itself is rounded to 400 bits.
template <class Wide>
void expect_encloses(Function function, const Certified<Wide>& computed, const WordPair& y,
                     double error) {
  for (const double end : {-error, error}) {
    MpfrNumber argument(wide), value(400), difference(wide);
    set_sum(argument, y, end);
    function(value, argument, MPFR_RNDN);
    set_sum(difference, computed.value, 0);
    mpfr_sub(difference, difference, value, MPFR_RNDN);
    mpfr_abs(difference, difference, MPFR_RNDN);
    EXPECT_LE(mpfr_cmp_d(difference, computed.error), 0)
        << std::hexfloat << y.hi << " " << y.lo << " " << error;
  }
}

/// A number at which something changes in the method, or nearly: near 1, near multiples of 1/64 and
/// of halves of that, near √½ times a power of two.
double argument_of_logarithm(Draw& draw) {
  const double size = std::ldexp(1, draw.one_in(2) ? 0 : draw.between(-998, 998));
  switch (draw.below(6)) {
    case 0:
      return 1 + draw.sign() * std::ldexp(1 + draw.unit(), -draw.between(2, 54));
    case 1:
      return draw.nudged(size * draw.between(45, 91) / 64, 3);
    case 2:
      return draw.nudged(size * draw.between(90, 182) / 128, 3);
    case 3:
      return draw.nudged(size * 0.70710678118654746, 3);
    case 4:
      return draw.nudged(size, 3);
    default:
      return size * (1 + draw.unit());
  }
}

/// A second word, of none to all of the bits that it may have.
WordPair with_low_word(Draw& draw, double hi) {
  if (draw.one_in(3)) return {hi, 0};
  const double lo = draw.one_in(3) ? 0x1p-53 * hi : draw.within(0x1p-53) * hi;
  return two_sum(hi, draw.sign() * std::ldexp(lo, -draw.below(60)));
}

double error_of(Draw& draw, double greatest) {
  return draw.one_in(2) ? 0 : greatest * std::ldexp(draw.unit(), -draw.below(80));
}

template <bool fused>
void check_logarithm(Draw& draw) {
  const WordPair y = with_low_word(draw, argument_of_logarithm(draw));
  const double error = error_of(draw, y.hi * 0x1p-20);
  const auto computed = logarithm<fused>({y, error});
  ASSERT_TRUE(std::isfinite(computed.error)) << std::hexfloat << y.hi;
  expect_encloses(mpfr_log, computed, y, error);
  if (error == 0) {
    EXPECT_LE(computed.error, 0x1p-70 * std::abs(computed.value.hi)) << std::hexfloat << y.hi;
  }
}

/// Near multiples of log 2/64, and of halves of that, where the method changes its step.
double argument_of_exponential(Draw& draw) {
  constexpr double step = 0.69314718055994531 / 128;
  switch (draw.below(4)) {
    case 0:
      return draw.nudged(draw.below(static_cast<int>(690 / step)) * step, 3);
    case 1:
      return std::abs(draw.of_exponent(draw.between(-1074, -1)));
    case 2:
      return draw.nudged(draw.below(690), 3);
    default:
      return draw.unit() * 690;
  }
}

template <bool fused>
void check_exponential(Draw& draw) {
  const double hi = std::clamp(argument_of_exponential(draw), 0.0, 689.999);
  const WordPair y = with_low_word(draw, hi);
  const double error = error_of(draw, 0x1p-20);
  const auto computed = exponential<fused>({y, error});
  ASSERT_TRUE(std::isfinite(computed.error)) << std::hexfloat << y.hi;
  expect_encloses(mpfr_exp, computed, y, error);
  if (error == 0) {
    EXPECT_LE(computed.error, 0x1p-75 * computed.value.hi) << std::hexfloat << y.hi;
  }
}

TEST(CertifiedLogarithmAdversaries, EncloseTheLogarithm) {
  checks::for_each_adversary(5000, [](std::uint64_t seed) {
    Draw draw(seed);
    check_logarithm<true>(draw);
    check_logarithm<false>(draw);
  });
}

TEST(CertifiedLogarithmAdversaries, EncloseTheExponential) {
  checks::for_each_adversary(5000, [](std::uint64_t seed) {
    Draw draw(seed);
    check_exponential<true>(draw);
    check_exponential<false>(draw);
  });
}

}  // namespace
}  // namespace fathom
