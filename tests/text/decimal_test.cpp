#include "fathom/text/decimal.h"

#include <gtest/gtest.h>
#include <mpfr.h>

#include <bit>
#include <cmath>
#include <cstdint>
#include <limits>
#include <random>
#include <string>

#include "tests/effort.h"

namespace fathom {
namespace {

using namespace text;

/// MPFR's correctly rounded answer in the precision and exponent range of the type.
template <class Real>
class MpfrReader {
 public:
  MpfrReader() {
    // MPFR's significands lie in [½, 1): the least subnormal is ½·2^emin.
    constexpr bool is_single = sizeof(Real) == 4;
    mpfr_set_emin(is_single ? -148 : -1073);
    mpfr_set_emax(is_single ? 128 : 1024);
    mpfr_init2(value_, std::numeric_limits<Real>::digits);
  }
  ~MpfrReader() {
    mpfr_clear(value_);
    mpfr_set_emin(mpfr_get_emin_min());
    mpfr_set_emax(mpfr_get_emax_max());
  }
  Real operator()(const std::string& text) {
    const int direction = mpfr_strtofr(value_, text.c_str(), nullptr, 10, MPFR_RNDN);
    mpfr_subnormalize(value_, direction, MPFR_RNDN);
    if constexpr (sizeof(Real) == 4) return mpfr_get_flt(value_, MPFR_RNDN);
    return mpfr_get_d(value_, MPFR_RNDN);
  }

 private:
  mpfr_t value_;
};

template <class Real>
std::uint64_t bits_of(Real x) {
  if constexpr (sizeof(Real) == 4) {
    return std::bit_cast<std::uint32_t>(x);
  } else {
    return std::bit_cast<std::uint64_t>(x);
  }
}

template <class Real>
void expect_like_mpfr(MpfrReader<Real>& mpfr, const std::string& text) {
  const Real truth = mpfr(text);
  const auto got = parse_decimal<Real>(text.data(), text.data() + text.size());
  ASSERT_EQ(got.end, text.data() + text.size()) << text;
  if (std::isinf(truth)) {
    ASSERT_EQ(got.fault, DecimalFault::overflow) << text;
    return;
  }
  ASSERT_EQ(got.fault, DecimalFault::none) << text;
  ASSERT_EQ(bits_of(got.value), bits_of(truth))
      << text << std::hexfloat << " read as " << got.value << ", MPFR says " << truth;
}

std::string formatted(const char* format, double x) {
  char buffer[1600];
  std::snprintf(buffer, sizeof buffer, format, x);
  return buffer;
}

/// Decimals of many shapes.
class DecimalSource {
 public:
  explicit DecimalSource(std::uint64_t seed) : random_(seed) {}

  std::string digits(int least, int most) {
    std::string text;
    for (int n = between(least, most); n > 0; --n) text += static_cast<char>('0' + between(0, 9));
    return text;
  }
  std::string sign() {
    static constexpr const char* signs[] = {"", "", "-", "+"};
    return signs[between(0, 3)];
  }
  /// [+-]digits[.digits][e[+-]digits] with digits on one side of the point at least.
  std::string any_shape() {
    std::string text = sign();
    switch (between(0, 3)) {
      case 0:
        text += digits(1, 20);
        break;
      case 1:
        text += digits(1, 12) + ".";
        break;
      case 2:
        text += "." + digits(1, 25);
        break;
      default:
        text += digits(1, 18) + "." + digits(1, 18);
    }
    if (between(0, 1) == 0) return text;
    text += between(0, 1) == 0 ? "e" : "E";
    static constexpr const char* exponent_signs[] = {"", "-", "+"};
    text += exponent_signs[between(0, 2)];
    if (between(0, 3) == 0) text += "0";
    static constexpr int reaches[] = {9, 60, 340, 400};
    return text + std::to_string(between(0, reaches[between(0, 3)]));
  }
  double any_double() {
    while (true) {
      const double x = std::bit_cast<double>(random_());
      if (std::isfinite(x)) return x;
    }
  }
  float any_float() {
    while (true) {
      const float x = std::bit_cast<float>(static_cast<std::uint32_t>(random_()));
      if (std::isfinite(x)) return x;
    }
  }
  int between(int least, int most) {
    return std::uniform_int_distribution<int>(least, most)(random_);
  }

 private:
  std::mt19937_64 random_;
};

/// The decimal halfway between x and its neighbour away from zero, all digits of it: exactly, and a
/// hair below and above it in its last digits.
template <class Real>
void check_halfway(MpfrReader<Real>& mpfr, Real x) {
  mpfr_exp_t emin = mpfr_get_emin(), emax = mpfr_get_emax();
  mpfr_set_emin(-5000);
  mpfr_set_emax(5000);
  mpfr_t middle;
  mpfr_init2(middle, 64);
  const Real next = std::nextafter(x, std::numeric_limits<Real>::infinity());
  mpfr_set_d(middle, static_cast<double>(x), MPFR_RNDN);
  if (std::isfinite(next)) {
    mpfr_add_d(middle, middle, static_cast<double>(next), MPFR_RNDN);
    mpfr_div_2ui(middle, middle, 1, MPFR_RNDN);
  }
  char* text = nullptr;
  mpfr_asprintf(&text, "%.1100Re", middle);
  std::string halfway = text;
  mpfr_free_str(text);
  mpfr_clear(middle);
  mpfr_set_emin(emin);
  mpfr_set_emax(emax);
  expect_like_mpfr(mpfr, halfway);
  const std::size_t last = halfway.find('e') - 1;
  std::string above = halfway;
  above[last] = '1';
  expect_like_mpfr(mpfr, above);
  // Below: the last digit that is not 0 goes down by one, and all behind it become 9.
  std::string below = halfway;
  std::size_t at = last;
  while (below[at] == '0' || below[at] == '.') {
    if (below[at] == '0') below[at] = '9';
    --at;
  }
  --below[at];
  expect_like_mpfr(mpfr, below);
}

template <class Real>
class DecimalTest : public ::testing::Test {};
using Reals = ::testing::Types<float, double>;
TYPED_TEST_SUITE(DecimalTest, Reals, );

TYPED_TEST(DecimalTest, AgreesWithMpfrOnRandomShapes) {
  MpfrReader<TypeParam> mpfr;
  DecimalSource source(20261121);
  for (int i = 0; i < checks::cases_to_draw(500'000, 4); ++i)
    ASSERT_NO_FATAL_FAILURE(expect_like_mpfr(mpfr, source.any_shape()));
}

TYPED_TEST(DecimalTest, AgreesWithMpfrOnWhatProgramsPrint) {
  MpfrReader<TypeParam> mpfr;
  DecimalSource source(7);
  for (int i = 0; i < checks::cases_to_draw(50'000, 4); ++i) {
    const double wide = source.any_double();
    const auto narrow = static_cast<double>(source.any_float());
    for (const char* format : {"%.17g", "%.9g", "%.6e", "%.16e"}) {
      ASSERT_NO_FATAL_FAILURE(expect_like_mpfr(mpfr, formatted(format, wide)));
      ASSERT_NO_FATAL_FAILURE(expect_like_mpfr(mpfr, formatted(format, narrow)));
    }
  }
  for (int i = 0; i < checks::cases_to_draw(50'000, 4); ++i)
    ASSERT_NO_FATAL_FAILURE(expect_like_mpfr(
        mpfr,
        formatted("%.6f", std::ldexp(source.any_double() > 0 ? 1 : -1, source.between(-30, 40)) *
                              (1 + source.between(0, 1 << 30) * 0x1p-30))));
}

TYPED_TEST(DecimalTest, RoundsHalfwayCasesToEven) {
  MpfrReader<TypeParam> mpfr;
  DecimalSource source(99);
  const auto any = [&] {
    if constexpr (sizeof(TypeParam) == 4) {
      return std::abs(source.any_float());
    } else {
      return std::abs(source.any_double());
    }
  };
  for (int i = 0; i < 3000; ++i) ASSERT_NO_FATAL_FAILURE(check_halfway<TypeParam>(mpfr, any()));
  using Limits = std::numeric_limits<TypeParam>;
  TypeParam x = 0;
  for (int i = 0; i < 300; ++i, x = std::nextafter(x, Limits::max()))
    ASSERT_NO_FATAL_FAILURE(check_halfway<TypeParam>(mpfr, x));
  x = Limits::min();
  for (int i = 0; i < 300; ++i, x = std::nextafter(x, TypeParam(0)))
    ASSERT_NO_FATAL_FAILURE(check_halfway<TypeParam>(mpfr, x));
}

TYPED_TEST(DecimalTest, TakesTheEdgesOfTheRange) {
  MpfrReader<TypeParam> mpfr;
  const std::string zeros(500, '0'), long_digits(3000, '7');
  for (const std::string& text :
       {std::string("0"), std::string("-0"), std::string("+0"), std::string("-0.0e5"),
        std::string("0e999999999999999999999"), std::string("1e400"), std::string("-1e400"),
        std::string("1e-400"), std::string("-1e-400"),
        // the exponent alone does not tell which way it leaves the range
        "0." + std::string(400, '0') + "1e10", "-0." + std::string(400, '0') + "1e800",
        std::string(400, '9') + "e-10", std::string(400, '9') + ".5e-800", std::string("1E+05"),
        std::string(".5"), std::string("5."), std::string("+.5e-0"), std::string("1e5"),
        std::string("1e-99999999999999999999"), std::string("1e99999999999999999999"),
        "0." + zeros + "1e501", "1" + zeros + "e-500", "1" + zeros + "e-900", "0." + zeros + "1",
        "1" + zeros, long_digits, "0." + long_digits, long_digits + "e-3000",
        "." + zeros + zeros + "5e+1001",
        // Half the least subnormal, a hair above it and below it, in binary64 and binary32.
        std::string("2.4703282292062327208e-324"), std::string("2.4703282292062328e-324"),
        std::string("2.4703282292062327e-324"), std::string("4.9406564584124654e-324"),
        std::string("7.0064923216240853e-46"), std::string("7.0064923216240854e-46"),
        std::string("7.0064923216240862e-46"), std::string("1.4012984643248171e-45"),
        // The largest finite numbers and the halfway points behind them.
        std::string("1.7976931348623157e308"), std::string("1.7976931348623158e308"),
        std::string("1.797693134862315807e308"), std::string("1.797693134862315808e308"),
        std::string("3.4028234663852886e38"), std::string("3.4028235677973362e38"),
        std::string("3.4028235677973367e38"), std::string("2.2250738585072011e-308"),
        std::string("1.1754943508222875e-38"), std::string("1.1754942807573643e-38")})
    ASSERT_NO_FATAL_FAILURE(expect_like_mpfr(mpfr, text)) << text;
}

TYPED_TEST(DecimalTest, RefusesWhatIsNoNumber) {
  for (const std::string text :
       {"", "+", "-", ".", "+-1", "-+1", "e5", ".e5", "x", "--1", "++1", " 1"}) {
    const auto got = parse_decimal<TypeParam>(text.data(), text.data() + text.size());
    EXPECT_EQ(got.fault, DecimalFault::malformed) << text;
  }
  for (const std::string text :
       {"nan", "inf", "-inf", "+inf", "NaN", "-nan", "infinity", "nan(7)"}) {
    const auto got = parse_decimal<TypeParam>(text.data(), text.data() + text.size());
    EXPECT_EQ(got.fault, DecimalFault::not_finite) << text;
  }
}

TYPED_TEST(DecimalTest, StopsBehindTheNumber) {
  for (const auto& [text, length] : {std::pair<std::string, int>{"1.5,2", 3},
                                     {"1e", 1},
                                     {"1e+", 1},
                                     {"0x10", 1},
                                     {"7f", 1},
                                     {"1.2.3", 3},
                                     {"+3 4", 2}}) {
    const auto got = parse_decimal<TypeParam>(text.data(), text.data() + text.size());
    EXPECT_EQ(got.fault, DecimalFault::none) << text;
    EXPECT_EQ(got.end - text.data(), length) << text;
  }
}

TEST(Decimal, RoundsOnceToBinary32) {
  // Halfway between 1 and its successor in binary32, and less than half an ulp of binary64 above
  // it: through binary64 it would become a tie and round to 1.
  const std::string text = "1.00000005960464477539062500000001";
  EXPECT_EQ(parse_decimal<float>(text.data(), text.data() + text.size()).value,
            std::nextafter(1.0F, 2.0F));
}

}  // namespace
}  // namespace fathom
