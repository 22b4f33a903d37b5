#include "fathom/depth_format/certified_format.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>
#include <string>
#include <vector>

#include "fathom/depth_format/encode.h"
#include "fathom/numeric/certified_logarithm.h"
#include "fathom/numeric/transcendental.h"
#include "tests/depth_format/exact_map.h"
#include "tests/effort.h"
#include "tests/special_values.h"

namespace fathom {
namespace {

constexpr int cases = 400 / checks::effort;

std::vector<DepthFormat> formats() {
  std::vector<DepthFormat> all;
  for (const Mapping mapping : all_mappings) {
    for (const Storage storage : all_storages) {
      all.push_back({mapping, storage, 0.1, 1000});
      all.push_back({mapping, storage, 1, 2});
      all.push_back({mapping, storage, 0x1p-90, 0x1p90});
      all.push_back({mapping, storage, 1e-160, 1e160});  // beyond what bounds were derived for
      if (takes_infinite_far(mapping)) all.push_back({mapping, storage, 0.1, infinity});
      if (mapping == Mapping::log) all.push_back({mapping, storage, 0.5, 3, 1});
      if (mapping == Mapping::log) all.push_back({mapping, storage, 0.1, 1e7, 0.001});
    }
  }
  return all;
}

double random_depth(const DepthFormat& format, std::mt19937_64& random) {
  const double far = std::isinf(format.far) ? 1e30 : format.far;
  std::uniform_real_distribution<double> share(0, 1);
  const double depth = std::exp2(std::lerp(std::log2(format.near), std::log2(far), share(random)));
  return std::clamp(depth, format.near, far);
}

/// A depth as double-words that differ from it by at most `error`, off by a random part of that.
Certified<WordPair> blurred(double depth, double error, std::mt19937_64& random) {
  std::uniform_real_distribution<double> part(-0.999, 0.999);
  return {two_sum(depth, error * part(random)), error};
}

struct Settled {
  int asked = 0, by_binary64 = 0, by_double_words = 0;
};

/// Asks every tier, with and without fused multiply-add, with an error and without one.
void check_encode(const DepthFormat& format, double depth, std::mt19937_64& random,
                  Settled& settled) {
  const StoredDepth exact = encode(format, Dyadic(depth));
  ++settled.asked;
  for (const double error : {0.0, depth * 0x1p-52}) {
    const auto stored = CertifiedFormat(format).encode(Certified<double>{depth, error});
    if (!stored) continue;
    settled.by_binary64 += error > 0 ? 1 : 0;
    ASSERT_EQ(*stored, exact) << test::text_of(format) << std::hexfloat << " depth " << depth;
  }
  bool all = true;
  for (const auto* arithmetic : {&CertifiedFormat::with_fma, &CertifiedFormat::without_fma}) {
    const CertifiedFormat certified(format, *arithmetic);
    for (const auto& D : {Certified<WordPair>{{depth}, 0}, blurred(depth, depth * 0x1p-90, random),
                          blurred(depth, depth * 0x1p-30, random)}) {
      const auto stored = certified.encode(D);
      all = all && (stored || D.error > depth * 0x1p-60);
      if (stored) {
        ASSERT_EQ(*stored, exact) << test::text_of(format) << std::hexfloat << " depth " << depth;
      }
    }
  }
  settled.by_double_words += all ? 1 : 0;
}

TEST(CertifiedFormat, EncodesAsExactArithmeticDoes) {
  std::mt19937_64 random(21);
  for (const DepthFormat& format : formats()) {
    Settled settled;
    for (int i = 0; i < cases; ++i) {
      ASSERT_NO_FATAL_FAILURE(check_encode(format, random_depth(format, random), random, settled));
    }
    // Which tier answers. Random depths are within 2⁻²⁰ of a step of a boundary once in 10⁵ cases.
    if (format.near < 0x1p-100) {
      EXPECT_EQ(settled.by_double_words + settled.by_binary64, 0) << test::text_of(format);
      continue;
    }
    if (format.near < 0x1p-10) continue;  // most values are 0 or 1 to the last bit, or next to it
    EXPECT_GE(settled.by_double_words, settled.asked * 99 / 100) << test::text_of(format);
    if (is_logarithmic(format.mapping) || format.storage == Storage::float64) continue;
    EXPECT_GE(settled.by_binary64, settled.asked * 97 / 100) << test::text_of(format);
  }
}

TEST(CertifiedFormat, AtBoundariesItIsRightOrSilent) {
  std::mt19937_64 random(22);
  Settled settled;
  for (const DepthFormat& format : formats()) {
    for (int i = 0; i < cases / 2; ++i) {
      const StoredDepth stored{random() % greatest_stored(format.storage).bits};
      const auto boundary = depth_of(format, boundary_above(format.storage, stored));
      const double middle = round_to_binary64(*boundary);
      for (const double d :
           {std::nextafter(middle, 0.0), middle, std::nextafter(middle, infinity)}) {
        if (!(d >= format.near && d <= format.far) || std::isinf(d)) continue;
        ASSERT_NO_FATAL_FAILURE(check_encode(format, d, random, settled));
      }
    }
    // Below a power of two the numbers of a float storage are twice as dense.
    for (unsigned i = 0; i < 6 && !is_unorm(format.storage); ++i) {
      const std::uint64_t power =
          greatest_stored(format.storage).bits - (std::uint64_t{1} << bits_of(format.storage)) * i;
      const auto boundary = depth_of(format, boundary_above(format.storage, {power - 1}));
      const double middle = round_to_binary64(*boundary);
      for (const double d : {middle * (1 - 0x1p-33), middle * (1 + 0x1p-33), middle}) {
        if (!(d >= format.near && d <= format.far) || std::isinf(d)) continue;
        for (int k = 0; k < 20; ++k) {
          ASSERT_NO_FATAL_FAILURE(check_encode(format, d, random, settled));
        }
      }
    }
    for (const double d : {format.near, std::nextafter(format.near, infinity)}) {
      ASSERT_NO_FATAL_FAILURE(check_encode(format, d, random, settled));
    }
    if (std::isinf(format.far)) continue;
    for (const double d : {format.far, std::nextafter(format.far, 0.0)}) {
      ASSERT_NO_FATAL_FAILURE(check_encode(format, d, random, settled));
    }
  }
}

/// Whether |value − x| ≤ error, and the error is not of another order than the arithmetic's.
template <class T>
void expect_encloses(const Certified<T>& computed, const Real& x, double worst,
                     const std::string& what) {
  const WordPair value = words_of(computed.value);
  const Ratio sum = Ratio(Dyadic(value.hi)) + Ratio(Dyadic(value.lo));
  const Enclosure around = x.enclose(300);
  const Ratio error = Dyadic(computed.error);
  ASSERT_FALSE(around.high < sum - error) << what;
  ASSERT_FALSE(sum + error < around.low) << what;
  ASSERT_LE(computed.error, worst) << what;
}

TEST(CertifiedFormat, DecodesWithinItsBounds) {
  std::mt19937_64 random(23);
  for (const DepthFormat& format : formats()) {
    const CertifiedFormat fused(format, CertifiedFormat::with_fma);
    const CertifiedFormat plain(format, CertifiedFormat::without_fma);
    for (int i = 0; i < cases / 4; ++i) {
      const StoredDepth stored = i < 3 ? StoredDepth{static_cast<std::uint64_t>(i)}
                                       : encode(format, Dyadic(random_depth(format, random)));
      const std::optional<Real> exact = decode(format, stored);
      const Certified<double> narrow = fused.decode(stored);
      if (!exact || format.near < 0x1p-100) {
        EXPECT_EQ(narrow.error, infinity);
        EXPECT_EQ(fused.wide_decode(stored).error, infinity);
        continue;
      }
      const std::string what = test::text_of(format) + " " + std::to_string(stored.bits);
      if (std::isfinite(narrow.error)) {
        expect_encloses(narrow, *exact, 0x1p-49 * narrow.value, what);
      }
      for (const CertifiedFormat* certified : {&fused, &plain}) {
        const Certified<WordPair> wide = certified->wide_decode(stored);
        if (!std::isfinite(wide.error)) {  // values of float64 next to 0
          EXPECT_LT(round_to_binary64(value_of(format.storage, stored)), 0x1p-390) << what;
          continue;
        }
        // exp(x) − 1 keeps the absolute precision of exp(x), over C.
        const double shift = format.mapping == Mapping::log ? 1 / format.c : 0;
        const double precision = is_logarithmic(format.mapping) ? 0x1p-72 : 0x1p-97;
        expect_encloses(wide, *exact, precision * (wide.value.hi + shift), what);
      }
    }
  }
}

TEST(CertifiedFormat, BoundsTheDepthsThatAreStoredAlike) {
  std::mt19937_64 random(24);
  for (const DepthFormat& format : formats()) {
    const CertifiedFormat certified(format);
    for (int i = 0; i < cases / 4; ++i) {
      const StoredDepth stored = encode(format, Dyadic(random_depth(format, random)));
      const double bound = certified.farthest_stored_as(stored);
      const bool falls = is_reversed(format.mapping);
      const bool is_last = falls ? stored.bits == 0 : stored == greatest_stored(format.storage);
      if (is_last || format.near < 0x1p-100) {
        EXPECT_EQ(bound, infinity);
        continue;
      }
      const Real end = *depth_of(
          format, boundary_above(format.storage, {falls ? stored.bits - 1 : stored.bits}));
      ASSERT_GE(bound, round_to_binary64(end)) << test::text_of(format) << " " << stored.bits;
      if (format.near > 0x1p-10) {
        EXPECT_LE(bound, round_to_binary64(end) * (1 + 0x1p-40)) << test::text_of(format);
      }
    }
  }
}

template <bool fused>
void check_logarithms() {
  std::mt19937_64 random(25);
  std::uniform_real_distribution<double> power(0, 90), near_one(-60, -1), exponent(-40, 9);
  for (int i = 0; i < 4 * cases; ++i) {
    const double y = i % 2 == 0 ? std::exp2(power(random)) : 1 + std::exp2(near_one(random));
    const auto log = logarithm<fused>({y, 0});
    expect_encloses(Certified<WordPair>{log.value, log.error}, natural_logarithm(Dyadic(y)),
                    0x1p-71 * log.value.hi, "log " + std::to_string(y));
    const double x = std::exp2(exponent(random));
    const auto exp = exponential<fused>({x, 0});
    // exp x with MPFR, from e^x = y ⇔ x = log y: x lies between the logarithms of the ends.
    const double error = exp.error * (1 + 0x1p-50);
    const Ratio value = Ratio(Dyadic(exp.value.hi)) + Ratio(Dyadic(exp.value.lo));
    ASSERT_LE(compare(natural_logarithm(value - Dyadic(error)), Dyadic(x)), 0) << x;
    ASSERT_GE(compare(natural_logarithm(value + Dyadic(error)), Dyadic(x)), 0) << x;
    ASSERT_LE(exp.error, exp.value.hi * 0x1p-75) << x;
  }
}

TEST(CertifiedLogarithm, EnclosesLogarithmsAndPowers) {
  check_logarithms<true>();
  check_logarithms<false>();
  EXPECT_EQ(logarithm<false>({0.0, 0}).error, infinity);
  EXPECT_EQ(logarithm<false>({1.0, 0.5}).error, infinity);
  EXPECT_EQ(exponential<false>({800.0, 0}).error, infinity);
  EXPECT_EQ(logarithm<false>({1.0, 0}).value.hi, 0);
}

}  // namespace
}  // namespace fathom
