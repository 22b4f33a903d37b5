// Formats and depths from families that are each hard for a reason of their own: what is stored and
// what it means, exactly and in floating point, against the formulas in rational numbers and MPFR.
#include <gtest/gtest.h>

#include <cmath>
#include <optional>

#include "fathom/depth_format/certified_format.h"
#include "fathom/depth_format/encode.h"
#include "fathom/reference/probe.h"
#include "tests/adversaries.h"
#include "tests/depth_format/exact_map.h"
#include "tests/inputs/adversarial_scenes.h"
#include "tests/inputs/draw.h"
#include "tests/inputs/floating_point_modes.h"
#include "tests/special_values.h"

namespace fathom {
namespace {

using checks::Draw;
using checks::FloatingPointMode;
using test::compare_map;
using test::Rational;

/// near < far, of any magnitudes, next to each other, of few bits, or at the ends of what the
/// bounds of floating point were derived for.
void draw_range(Draw& draw, DepthFormat& format) {
  double& near = format.near;
  double& far = format.far;
  switch (draw.below(6)) {
    case 0:
      near = std::abs(draw.of_exponent(draw.between(-1074, 1022)));
      far = std::abs(draw.of_exponent(draw.between(-1074, 1022)));
      break;
    case 1:
      near = std::abs(draw.of_exponent(draw.between(-100, 99)));
      far = std::abs(draw.of_exponent(draw.between(-100, 99)));
      break;
    case 2:
      near = std::abs(draw.of_exponent(draw.between(-20, 20)));
      far = near + near * std::ldexp(1, -draw.between(20, 52));
      break;
    case 3:  // powers of one number, and halves of a range, abound
      near = std::ldexp(draw.between(1, 8), -draw.below(4));
      far = std::ldexp(draw.between(1, 8), draw.below(6));
      break;
    case 4:
      near = draw.nudged(draw.one_in(2) ? 0x1p-100 : 0.1, 2);
      far = draw.nudged(draw.one_in(2) ? 0x1p100 : 1000, 2);
      break;
    default:
      near = 0.01 + draw.unit();
      far = near * (1 + std::ldexp(1 + draw.unit(), draw.between(-3, 20)));
  }
  if (near > far) std::swap(near, far);
  if (takes_infinite_far(format.mapping) && draw.one_in(2)) far = infinity;
}

double any_c(Draw& draw) {
  switch (draw.below(4)) {
    case 0:
      return std::abs(draw.of_exponent(draw.between(-99, 99)));
    case 1:
      return std::abs(draw.of_exponent(draw.between(-1074, 1000)));
    case 2:
      return std::ldexp(draw.between(1, 8), -draw.below(6));
    default:
      return 1;
  }
}

bool is_meaningful(const DepthFormat& format) {
  return format.near > 0 && format.near < format.far &&
         (std::isfinite(format.far) || takes_infinite_far(format.mapping));
}

DepthFormat any_format(Draw& draw) {
  for (;;) {
    DepthFormat format{draw.one_of(all_mappings), draw.one_of(all_storages)};
    draw_range(draw, format);
    if (format.mapping == Mapping::log) format.c = any_c(draw);
    if (is_meaningful(format)) return format;
  }
}

bool is_inside(const DepthFormat& format, const Ratio& depth) {
  return !(depth < Ratio(Dyadic(format.near))) &&
         (std::isinf(format.far) || compare(depth, Dyadic(format.far)) <= 0);
}

/// Any value but the greatest; those next to 0, to 1 and to a power of two more often.
StoredDepth any_stored(Draw& draw, Storage storage) {
  const std::uint64_t greatest = greatest_stored(storage).bits;
  const std::uint64_t some = draw.bits() % 4;
  switch (draw.below(5)) {
    case 0:
      return {some};
    case 1:
      return {greatest - 1 - some};
    case 2: {
      const int shift = is_unorm(storage) ? 1 : bits_of(storage);
      return {std::min(greatest - 1, ((draw.bits() % greatest >> shift) << shift) + some - 1)};
    }
    default:
      return {draw.bits() % greatest};
  }
}

std::optional<Ratio> if_finite(double depth) {
  if (!std::isfinite(depth)) return std::nullopt;
  return Dyadic(depth);
}

/// A depth of the format's range or next to it: at an end, anywhere, where what is stored steps, or
/// next to that.
std::optional<Ratio> any_depth(Draw& draw, const DepthFormat& format) {
  const double far = std::isinf(format.far) ? 0x1p1000 : format.far;
  switch (draw.below(6)) {
    case 0:
      return if_finite(draw.nudged(draw.one_in(2) ? format.near : far, 2));
    case 1: {
      const double power = std::lerp(std::log2(format.near), std::log2(far), draw.unit());
      return Dyadic(std::min(std::exp2(power) * (1 + 0x1p-40 * draw.unit()), far));
    }
    case 2:
      return Ratio(Dyadic(format.near)) + Ratio(Dyadic(far) - Dyadic(format.near)) *
                                              Ratio(Dyadic(std::ldexp(1, -draw.below(80))));
    default: {
      const Ratio boundary = boundary_above(format.storage, any_stored(draw, format.storage));
      const std::optional<Real> depth = depth_of(format, boundary);
      if (!depth) return std::nullopt;
      const std::optional<Ratio> exact = depth->rational();
      if (!exact || draw.one_in(2)) {
        return if_finite(draw.nudged(round_to_binary64(*depth), 2));
      }
      if (draw.one_in(3)) return *exact;
      const int bits = draw.between(20, is_logarithmic(format.mapping) ? 150 : 900);
      return *exact + *exact * Ratio(Dyadic(draw.sign()).scaled(-bits));
    }
  }
}

/// The depth as two words, with a bound on what they leave out, and on more than that if drawn.
Certified<WordPair> in_words(Draw& draw, const Ratio& depth) {
  const double hi = round_to_binary64(depth);
  const Ratio rest = depth - Dyadic(hi);
  const double lo = round_to_binary64(rest);
  double error = std::abs(round_to_binary64(rest - Dyadic(lo))) * (1 + 0x1p-40);
  if (error == 0 && !(rest == Ratio(Dyadic(lo)))) error = 0x1p-1000;
  if (draw.one_in(2)) error += hi * std::ldexp(1, -draw.between(30, 110));
  return {{hi, lo}, error};
}

struct SettledTiers {
  int asked = 0, by_binary64 = 0, by_double_words = 0;
};

void expect_encoded(const DepthFormat& format, const Ratio& depth, Draw& draw,
                    SettledTiers& settled) {
  const FloatingPointMode* mode = checks::any_mode(draw.generator());
  std::optional<checks::InMode> in_mode(std::in_place, mode);
  const StoredDepth stored = encode(format, depth);
  in_mode.reset();
  EXPECT_TRUE(test::is_rounded_correctly(format, Rational(depth), stored.bits))
      << stored.bits << (mode ? mode->name : "standard");

  settled.asked += 1;
  if (std::isinf(round_to_binary64(depth))) return;
  const Certified<WordPair> words = in_words(draw, depth);
  const double dropped = std::abs(words.value.lo) + words.error;
  const auto narrow =
      CertifiedFormat(format).encode(Certified<double>{words.value.hi, dropped * (1 + 0x1p-50)});
  EXPECT_EQ(narrow.value_or(stored), stored);
  for (const auto* arithmetic : {&CertifiedFormat::with_fma, &CertifiedFormat::without_fma}) {
    const auto wide = CertifiedFormat(format, *arithmetic).encode(words);
    EXPECT_EQ(wide.value_or(stored), stored);
    settled.by_double_words += wide.has_value();
  }
  settled.by_binary64 += narrow.has_value();
}

/// Where a computed depth is known up to its error, f at the ends of that has the value in between.
void expect_encloses(const DepthFormat& format, const WordPair& depth, double error,
                     const Rational& value) {
  if (!std::isfinite(error)) return;
  const int rising = is_reversed(format.mapping) ? -1 : 1;
  const Rational D = Rational(depth.hi) + Rational(depth.lo);
  const Rational least = D - Rational(error);
  EXPECT_GE(rising * compare_map(format, D + Rational(error), value), 0);
  if (compare(least, 0.0) > 0) {
    EXPECT_LE(rising * compare_map(format, least, value), 0);
  }
}

void expect_decoded(const DepthFormat& format, StoredDepth stored, Draw& draw) {
  const FloatingPointMode* mode = checks::any_mode(draw.generator());
  std::optional<checks::InMode> in_mode(std::in_place, mode);
  const double depth = decode_to_binary64(format, stored);
  in_mode.reset();
  EXPECT_TRUE(test::is_decoded_correctly(format, stored.bits, depth)) << std::hexfloat << depth;

  const Rational value = test::number(format.storage, stored.bits);
  const CertifiedFormat certified(format);
  const Certified<double> narrow = certified.decode(stored);
  expect_encloses(format, {narrow.value}, narrow.error, value);
  for (const auto* arithmetic : {&CertifiedFormat::with_fma, &CertifiedFormat::without_fma}) {
    const Certified<WordPair> wide = CertifiedFormat(format, *arithmetic).wide_decode(stored);
    expect_encloses(format, wide.value, wide.error, value);
  }
  const double farthest = certified.farthest_stored_as(stored);
  if (std::isinf(farthest)) return;
  const bool falls = is_reversed(format.mapping);
  const std::uint64_t next = falls ? stored.bits - 1 : stored.bits + 1;
  const Rational end = (value + test::number(format.storage, next)) * Rational(0.5);
  EXPECT_GE((falls ? -1 : 1) * compare_map(format, farthest, end), 0) << std::hexfloat << farthest;
}

TEST(DepthFormatAdversaries, AreStoredAsRationalNumbersAre) {
  SettledTiers settled;
  checks::for_each_adversary(20000, [&](std::uint64_t seed) {
    Draw draw(seed);
    const DepthFormat format = any_format(draw);
    const std::optional<Ratio> depth = any_depth(draw, format);
    if (!depth || !is_inside(format, *depth)) return;
    SCOPED_TRACE(test::text_of(format) + " depth " + to_fraction(*depth));
    expect_encoded(format, *depth, draw, settled);
  });
  if (checks::number_of_adversaries(20000) < 1000) return;
  EXPECT_GT(settled.asked, 500);
  EXPECT_GT(settled.by_binary64, settled.asked / 10);
  EXPECT_GT(settled.by_double_words, settled.asked / 5);
}

TEST(DepthFormatAdversaries, AreDecodedAsRationalNumbersAre) {
  checks::for_each_adversary(10000, [](std::uint64_t seed) {
    Draw draw(seed);
    const DepthFormat format = any_format(draw);
    StoredDepth stored = any_stored(draw, format.storage);
    if (draw.one_in(8)) stored = greatest_stored(format.storage);
    SCOPED_TRACE(test::text_of(format) + " stored " + std::to_string(stored.bits));
    expect_decoded(format, stored, draw);
  });
}

/// Depths that are no binary64 numbers, with a range that begins and ends next to some of them.
TEST(DepthFormatAdversaries, OfScenesAreStoredAsRationalNumbersAre) {
  SettledTiers settled;
  checks::for_each_adversary(600, [&](std::uint64_t seed) {
    Draw draw(seed);
    const checks::Case c =
        checks::adversarial_case(checks::all_families[seed % checks::all_families.size()], seed);
    std::vector<Ratio> depths;
    for (std::uint32_t y = 0; y < c.camera.height; y += 2) {
      for (std::uint32_t x = 0; x < c.camera.width; x += 3) {
        for (const CoveringTriangle& t : probe(c.scene, c.camera, x, y)) {
          if (t.counts) depths.push_back(t.depth);
        }
      }
    }
    for (const Ratio& depth : depths) {
      DepthFormat format = any_format(draw);
      if (draw.one_in(2)) format.near = draw.nudged(round_to_binary64(depths.front()), 1);
      if (draw.one_in(2)) format.far = draw.nudged(round_to_binary64(depths.back()), 1);
      if (!is_meaningful(format) || !is_inside(format, depth)) continue;
      SCOPED_TRACE(test::text_of(format) + " depth " + to_fraction(depth));
      expect_encoded(format, depth, draw, settled);
    }
  });
  if (checks::number_of_adversaries(600) < 100) return;
  EXPECT_GT(settled.asked, 50);
}

}  // namespace
}  // namespace fathom
