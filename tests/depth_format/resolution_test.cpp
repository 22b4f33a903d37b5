#include "fathom/depth_format/resolution.h"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "fathom/failures/errors.h"
#include "tests/depth_format/exact_map.h"
#include "tests/special_values.h"

namespace fathom {
namespace {

using test::Rational;

Rational rational(const std::optional<Real>& x) {
  return Rational(*x->rational());
}

/// Whether x is the binary64 number nearest to q > 0.
bool is_nearest(double x, const Rational& q) {
  const Rational half = 0.5;
  const Rational below = (Rational(x) + Rational(std::nextafter(x, 0.0))) * half;
  const Rational above = (Rational(x) + Rational(std::nextafter(x, infinity))) * half;
  return compare(below, q) <= 0 && compare(q, above) <= 0;
}

const std::vector<double> depths{0.1, 0.125, 0.3, 1, 2.5, 10, 99.5, 512, 999, 1000};

TEST(Resolution, ClosedFormsOfUnorm) {
  for (const Storage storage : {Storage::unorm16, Storage::unorm24, Storage::unorm32}) {
    const Rational n = 0.1, f = 1000.0, N = std::ldexp(1.0, bits_of(storage)) - 1;
    for (const double depth : depths) {
      // Neighbouring depths D, D' of standard differ by D·D'·(far − near)/(near·far·N).
      const DepthFormat standard{Mapping::standard, storage, 0.1, 1000};
      const Resolution r = resolution(standard, Dyadic(depth));
      if (r.to_farther) {
        const Rational here = rational(decode(standard, r.stored));
        const Rational next = rational(decode(standard, {r.stored.bits + 1}));
        EXPECT_TRUE(is_nearest(*r.to_farther, here * next * (f - n) / (n * f * N)));
      }
      const Resolution linear = resolution({Mapping::linear, storage, 0.1, 1000}, Dyadic(depth));
      EXPECT_TRUE(!linear.to_farther || is_nearest(*linear.to_farther, (f - n) / N));
      EXPECT_TRUE(!linear.to_nearer || is_nearest(*linear.to_nearer, (f - n) / N));
      const Resolution w = resolution({Mapping::w, storage, 0.1, 1000}, Dyadic(depth));
      EXPECT_TRUE(is_nearest(*w.to_nearer, f / N));
    }
  }
}

/// A step of a logarithm is (D + 1/C)·(b^(1/N) − 1), or D·(b^(1/N) − 1). The factor lies between
/// x = log b/N and x + x², as e^x − 1 does for x < 1.
TEST(Resolution, StepsOfLogarithmsAreProportionalToTheDepth) {
  const double N = 65535;
  for (const double depth : {0.125, 1.0, 30.0, 900.0}) {
    const auto check = [&](const DepthFormat& format, double shift, double base) {
      const Resolution r = resolution(format, Dyadic(depth));
      const double x = std::log(base) / N;
      const double from = decode_to_binary64(format, r.stored) + shift;
      // The bounds are wider apart, by a factor of 1 + x > 1 + 1e-5, than binary64 rounds.
      EXPECT_GT(*r.to_farther, from * x * (1 - 1e-12));
      EXPECT_LT(*r.to_farther, from * (x + x * x));
    };
    check({Mapping::log_ulrich, Storage::unorm16, 0.1, 1000}, 0, 1e4);
    check({Mapping::log, Storage::unorm16, 0.1, 1000}, 1, 1001);
    check({Mapping::log, Storage::unorm16, 0.1, 1000, 0.25}, 4, 251);
  }
}

TEST(Resolution, ReversedHasTheStepsOfStandardInUnorm) {
  for (const double depth : depths) {
    const Resolution a =
        resolution({Mapping::standard, Storage::unorm24, 0.1, 1000}, Dyadic(depth));
    const Resolution b =
        resolution({Mapping::reversed, Storage::unorm24, 0.1, 1000}, Dyadic(depth));
    EXPECT_EQ(a.to_nearer, b.to_nearer);
    EXPECT_EQ(a.to_farther, b.to_farther);
    EXPECT_EQ(a.stored.bits + b.stored.bits, 0xFFFFFFU);
  }
}

/// A length that was rounded to binary64, by at most 2⁻⁵³ of itself or 2⁻¹⁰⁷⁵, and a bit.
Ratio lengthened(double x) {
  return Dyadic(x) * (Dyadic(1.0) + Dyadic(0x1p-52)) + Dyadic(0x1p-1074);
}
Ratio shortened(double x) {
  const Ratio less = Dyadic(x) * (Dyadic(1.0) - Dyadic(0x1p-52)) - Dyadic(0x1p-1074);
  return less.sign() == Sign::negative ? Ratio() : less;
}

/// Every format tells D apart from what lies farther behind than separation_behind, and from
/// nothing nearer; and no two depths of a bin are farther apart than its width.
TEST(Resolution, SeparationsAreWhereCodesChange) {
  for (const Mapping mapping : all_mappings) {
    for (const Storage storage : all_storages) {
      const DepthFormat format{mapping, storage, 0.1, 1000};
      for (const double depth : depths) {
        const StoredDepth stored = encode(format, Dyadic(depth));
        const std::optional<double> s = separation_behind(format, Dyadic(depth));
        const double width = bin_width(format, Dyadic(depth));
        if (!s) {
          EXPECT_EQ(encode(format, Dyadic(1000.0)), stored);
          continue;
        }
        EXPECT_EQ(encode(format, Dyadic(depth) + shortened(*s)), stored);
        EXPECT_LE(*s, width);
        for (const double length : {*s, width}) {
          const Ratio beyond = Dyadic(depth) + lengthened(length);
          EXPECT_TRUE(compare(beyond, Dyadic(1000.0)) > 0 || encode(format, beyond) != stored);
        }
      }
    }
  }
}

TEST(Resolution, CodesAreCounted) {
  const DepthFormat format{Mapping::standard, Storage::unorm16, 0.5, 1024};
  EXPECT_EQ(codes_between(format, Dyadic(0.5), Dyadic(1024.0)), 65536U);
  EXPECT_EQ(codes_between(format, Dyadic(3.0), Dyadic(3.0)), 1U);
  // f(10·near) = far·0.9/(far − near): 90 % of the codes and a little more.
  const double share = 1024 * 0.9 / 1023.5;
  EXPECT_EQ(codes_between(format, Dyadic(0.5), Dyadic(5.0)),
            static_cast<std::uint64_t>(std::round(share * 65535)) + 1);
  // reversed float32 over far = 2³⁰ near: 2²³ codes for each factor of two, and the ends.
  const DepthFormat reversed{Mapping::reversed_infinite, Storage::float32, 1, infinity};
  EXPECT_EQ(codes_between(reversed, Dyadic(1.0), Dyadic(1073741824.0)), (30U << 23) + 1);
}

TEST(Resolution, TheEndsHaveOneNeighbour) {
  const DepthFormat standard{Mapping::standard, Storage::unorm16, 1, 16};
  EXPECT_FALSE(resolution(standard, Dyadic(1.0)).to_nearer);
  EXPECT_FALSE(resolution(standard, Dyadic(16.0)).to_farther);
  EXPECT_FALSE(separation_behind(standard, Dyadic(16.0)));
  const DepthFormat infinite{Mapping::reversed_infinite, Storage::unorm16, 1, infinity};
  EXPECT_EQ(resolution(infinite, Dyadic(65535.0)).to_farther, infinity);
  EXPECT_EQ(bin_width(infinite, Dyadic(1e9)), infinity);
  EXPECT_FALSE(separation_behind(infinite, Dyadic(1e9)));
  EXPECT_THROW(resolution(standard, Dyadic(17.0)), InputError);
  EXPECT_THROW(codes_between(standard, Dyadic(0.5), Dyadic(2.0)), InputError);
}

}  // namespace
}  // namespace fathom
