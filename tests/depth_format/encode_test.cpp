#include "fathom/depth_format/encode.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>
#include <random>
#include <string>
#include <vector>

#include "fathom/failures/errors.h"
#include "tests/depth_format/exact_map.h"
#include "tests/effort.h"
#include "tests/scratch_folder.h"
#include "tests/special_values.h"

namespace fathom {
namespace {

::testing::AssertionResult encodes_correctly(const DepthFormat& format, double depth) {
  const std::uint64_t bits = encode(format, Dyadic(depth)).bits;
  if (test::is_rounded_correctly(format, depth, bits)) return ::testing::AssertionSuccess();
  return ::testing::AssertionFailure()
         << test::text_of(format) << ": depth " << std::hexfloat << depth << " gives " << bits;
}

::testing::AssertionResult decodes_correctly(const DepthFormat& format, std::uint64_t bits) {
  const double depth = decode_to_binary64(format, {bits});
  if (test::is_decoded_correctly(format, bits, depth)) return ::testing::AssertionSuccess();
  return ::testing::AssertionFailure()
         << test::text_of(format) << ": " << bits << " gives depth " << std::hexfloat << depth;
}

bool is_inside(const DepthFormat& format, double depth) {
  return depth >= format.near && depth <= format.far;
}

/// Every code, or every third, the last among them; under sanitizers every 20th of these.
const std::uint64_t step = (checks::draws_all_cases() ? 1 : 3) * checks::effort;

/// Every boundary between codes, approached from both sides: where these are right, every depth in
/// between is, since encode is monotone (EncodeIsMonotone).
void check_every_boundary(const DepthFormat& format) {
  const std::uint64_t greatest = greatest_stored(format.storage).bits;
  for (std::uint64_t bits = 0; bits < greatest; bits += step) {
    const auto depth = depth_of(format, boundary_above(format.storage, {bits}));
    ASSERT_TRUE(depth);
    const double middle = round_to_binary64(*depth);
    for (const double d : {std::nextafter(middle, 0.0), std::nextafter(middle, infinity)}) {
      ASSERT_TRUE(!is_inside(format, d) || encodes_correctly(format, d));
    }
  }
}

void check_every_code(const DepthFormat& format) {
  const std::uint64_t greatest = greatest_stored(format.storage).bits;
  const bool falls = is_reversed(format.mapping);
  double previous = falls ? infinity : 0;
  for (std::uint64_t bits = 0; bits <= greatest; bits += step) {
    ASSERT_TRUE(decodes_correctly(format, bits));
    const double depth = decode_to_binary64(format, {bits});
    ASSERT_TRUE(falls ? depth <= previous : depth >= previous) << test::text_of(format);
    previous = depth;
    // A code between the ends stands for a depth that is stored as this code again.
    if (is_inside(format, depth)) {
      ASSERT_EQ(encode(format, Dyadic(depth)).bits, bits) << test::text_of(format);
    }
  }
}

class EveryMapping : public ::testing::TestWithParam<Mapping> {};

TEST_P(EveryMapping, AllCodesOfUnorm16) {
  const DepthFormat format{GetParam(), Storage::unorm16, 0.1, 1000};
  check_every_boundary(format);
  check_every_code(format);
}

TEST_P(EveryMapping, AllCodesOfFloat16) {
  const DepthFormat format{GetParam(), Storage::float16, 0.25, 300};
  check_every_boundary(format);
  check_every_code(format);
}

/// Depths spread evenly in the logarithm, with the ends and their neighbours.
std::vector<double> depths_of(const DepthFormat& format, int count, std::uint64_t seed) {
  const double far = std::isinf(format.far) ? 1e30 : format.far;
  std::vector<double> depths{format.near, std::nextafter(format.near, infinity), far,
                             std::nextafter(far, 0.0)};
  std::mt19937_64 random(seed);
  std::uniform_real_distribution<double> share(0, 1);
  while (depths.size() < static_cast<std::size_t>(count)) {
    const double depth =
        std::exp2(std::lerp(std::log2(format.near), std::log2(far), share(random)));
    if (is_inside(format, depth)) depths.push_back(depth);
  }
  return depths;
}

std::vector<DepthFormat> wide_formats(Mapping mapping) {
  std::vector<DepthFormat> formats;
  for (const Storage storage : all_storages) {
    formats.push_back({mapping, storage, 0.1, 10000});
    formats.push_back({mapping, storage, 1, 2});
    formats.push_back({mapping, storage, 1e-150, 1e150});
    formats.push_back({mapping, storage, 5e-324, 1.7976931348623157e308});
    formats.push_back({mapping, storage, 1, std::nextafter(1.0, 2.0)});
    if (takes_infinite_far(mapping)) formats.push_back({mapping, storage, 0.1, infinity});
    if (mapping == Mapping::log) formats.push_back({mapping, storage, 0.1, 1e7, 0.001});
  }
  return formats;
}

TEST_P(EveryMapping, RandomDepthsInEveryStorage) {
  for (const DepthFormat& format : wide_formats(GetParam())) {
    for (const double depth : depths_of(format, 20 + 280 / checks::effort, 7)) {
      ASSERT_TRUE(encodes_correctly(format, depth));
    }
  }
}

TEST_P(EveryMapping, DepthsAtRandomBoundariesInEveryStorage) {
  std::mt19937_64 random(8);
  for (const DepthFormat& format : wide_formats(GetParam())) {
    for (int i = 0; i < 200 / checks::effort; ++i) {
      const StoredDepth stored{random() % greatest_stored(format.storage).bits};
      const auto depth = depth_of(format, boundary_above(format.storage, stored));
      const double middle = round_to_binary64(*depth);
      for (const double d :
           {std::nextafter(middle, 0.0), middle, std::nextafter(middle, infinity)}) {
        ASSERT_TRUE(!is_inside(format, d) || encodes_correctly(format, d));
      }
      ASSERT_TRUE(decodes_correctly(format, stored.bits));
    }
  }
}

TEST_P(EveryMapping, EncodeIsMonotone) {
  for (const DepthFormat& format : wide_formats(GetParam())) {
    std::vector<double> depths = depths_of(format, 20 + 280 / checks::effort, 9);
    std::sort(depths.begin(), depths.end());
    StoredDepth previous = encode(format, Dyadic(depths[0]));
    for (const double depth : depths) {
      const StoredDepth stored = encode(format, Dyadic(depth));
      ASSERT_FALSE(is_nearer(format, stored, previous)) << test::text_of(format) << " at " << depth;
      previous = stored;
    }
  }
}

/// Without gaps: every boundary of some codes in a row, and every depth of some in a row.
TEST_P(EveryMapping, DenseDepthsInEveryStorage) {
  constexpr int run = 10 + 40 / checks::effort;
  std::mt19937_64 random(10);
  for (const DepthFormat& format : wide_formats(GetParam())) {
    const std::uint64_t first = random() % (greatest_stored(format.storage).bits - run);
    for (std::uint64_t bits = first; bits < first + run; ++bits) {
      const double middle =
          round_to_binary64(*depth_of(format, boundary_above(format.storage, {bits})));
      for (const double d : {std::nextafter(middle, 0.0), std::nextafter(middle, infinity)}) {
        ASSERT_TRUE(!is_inside(format, d) || encodes_correctly(format, d));
      }
      ASSERT_TRUE(decodes_correctly(format, bits));
    }
    double depth = depths_of(format, 5, random()).back();
    StoredDepth previous = encode(format, Dyadic(depth));
    for (int i = 0; i < run && is_inside(format, depth); ++i) {
      ASSERT_TRUE(encodes_correctly(format, depth));
      const StoredDepth stored = encode(format, Dyadic(depth));
      ASSERT_FALSE(is_nearer(format, stored, previous)) << test::text_of(format) << " at " << depth;
      previous = stored;
      depth = std::nextafter(depth, infinity);
    }
  }
}

TEST_P(EveryMapping, TheEndsOfTheRange) {
  for (const Storage storage : all_storages) {
    const DepthFormat format{GetParam(), storage, 0.1, 1000};
    const StoredDepth zero{}, one = greatest_stored(storage);
    const StoredDepth near = encode(format, Dyadic(0.1)), far = encode(format, Dyadic(1000.0));
    switch (GetParam()) {
      case Mapping::reversed:
        EXPECT_EQ(near, one);
        EXPECT_EQ(far, zero);
        break;
      case Mapping::reversed_infinite:
        EXPECT_EQ(near, one);
        break;
      case Mapping::infinite:
        EXPECT_EQ(near, zero);
        break;
      case Mapping::w:
      case Mapping::log:
        EXPECT_GT(near, zero);
        EXPECT_EQ(far, one);
        break;
      default:
        EXPECT_EQ(near, zero);
        EXPECT_EQ(far, one);
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Encode, EveryMapping, ::testing::ValuesIn(all_mappings),
                         [](const auto& mapping) {
                           std::string name(name_of(mapping.param));
                           for (char& c : name) c = c == '-' ? '_' : c;
                           return name;
                         });

TEST(Encode, QuotientsOfLogarithmsThatAreRational) {
  // log 2 / log 4 = 1/2, a tie in every unorm: 2ⁿ⁻¹ − 1/2 goes to the even 2ⁿ⁻¹.
  EXPECT_EQ(encode({Mapping::log, Storage::unorm16, 0.5, 3}, Dyadic(1.0)).bits, 0x8000U);
  EXPECT_EQ(encode({Mapping::log, Storage::unorm24, 0.5, 3}, Dyadic(1.0)).bits, 0x800000U);
  EXPECT_EQ(encode({Mapping::log, Storage::unorm32, 0.5, 3}, Dyadic(1.0)).bits, 0x80000000U);
  EXPECT_EQ(encode({Mapping::log, Storage::float64, 0.5, 3}, Dyadic(1.0)).bits,
            std::bit_cast<std::uint64_t>(0.5));
  // One step of the depth to either side leaves the tie.
  EXPECT_EQ(encode({Mapping::log, Storage::unorm16, 0.5, 3}, Dyadic(std::nextafter(1.0, 0))).bits,
            0x7FFFU);
  // 8 = 2³ and 4 = 2²: 2/3. 43690 = 65535·2/3.
  EXPECT_EQ(encode({Mapping::log_ulrich, Storage::unorm16, 1, 8}, Dyadic(4.0)).bits, 43690U);
  // (9/4) and (27/8), powers of 3/2, near = 1/4: log(D/near)/log(far/near) = 2/3 again.
  EXPECT_EQ(encode({Mapping::log_ulrich, Storage::unorm16, 0.25, 0.84375}, Dyadic(0.5625)).bits,
            43690U);
}

TEST(Encode, PowersThatAreRational) {
  // 4^(1/2) − 1 = 1 exactly, from a stored value of 1/2.
  const DepthFormat log{Mapping::log, Storage::float32, 0.5, 3};
  const auto depth = decode(log, {std::bit_cast<std::uint32_t>(0.5F)});
  ASSERT_TRUE(depth && depth->rational());
  EXPECT_EQ(*depth->rational(), Ratio(Dyadic(1.0)));
  // 3^(1/2) is not.
  const DepthFormat two{Mapping::log, Storage::float32, 0.5, 2};
  EXPECT_FALSE(decode(two, {std::bit_cast<std::uint32_t>(0.5F)})->rational());
}

TEST(Encode, InfinityIsDecoded) {
  EXPECT_EQ(decode_to_binary64({Mapping::infinite, Storage::unorm16, 0.1, infinity}, {65535}),
            infinity);
  EXPECT_EQ(decode_to_binary64({Mapping::reversed_infinite, Storage::float32, 0.1, infinity}, {0}),
            infinity);
}

TEST(Encode, DepthsThatAreNoBinary64NumbersAreTakenExactly) {
  // reversed-infinite with near = 1 stores 1/D: D = 3 and D = 3 + 2⁻²⁰⁰ differ only in the tie.
  const DepthFormat format{Mapping::reversed_infinite, Storage::unorm16, 1, infinity};
  const Ratio tie(Dyadic(65535.0), Dyadic(20000.5));  // 1/D·65535 = 20000.5
  EXPECT_EQ(encode(format, tie).bits, 20000U);
  EXPECT_EQ(encode(format, tie - Dyadic(1.0).scaled(-200)).bits, 20001U);
  EXPECT_EQ(encode(format, tie + Dyadic(1.0).scaled(-200)).bits, 20000U);
}

TEST(Encode, DepthsOutsideTheRangeAreRefusedOrClamped) {
  const DepthFormat format{Mapping::standard, Storage::unorm16, 1, 10};
  EXPECT_THROW(encode(format, Dyadic(0.5)), InputError);
  EXPECT_THROW(encode(format, Dyadic(10.5)), InputError);
  EXPECT_EQ(encode(format, clamp_to_range(format, Dyadic(0.5))).bits, 0U);
  EXPECT_EQ(encode(format, clamp_to_range(format, Dyadic(10.5))).bits, 65535U);
  EXPECT_EQ(clamp_to_range(format, Dyadic(2.0)), Ratio(Dyadic(2.0)));
}

TEST(DepthFormat, WhatMeansNothingIsRefused) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const auto refused = [](Mapping mapping, double near, double far, double c = 1) {
    EXPECT_THROW(require_meaningful({mapping, Storage::unorm16, near, far, c}), UsageError)
        << near << " " << far;
  };
  for (const Mapping mapping : all_mappings) {
    refused(mapping, 0, 10);
    refused(mapping, -1, 10);
    refused(mapping, nan, 10);
    refused(mapping, 1, nan);
    refused(mapping, 1, 1);
    refused(mapping, 2, 1);
    refused(mapping, infinity, infinity);
    refused(mapping, 1, 10, 0);
    refused(mapping, 1, 10, nan);
    if (mapping != Mapping::log) refused(mapping, 1, 10, 2);
    if (takes_infinite_far(mapping)) {
      EXPECT_NO_THROW(require_meaningful({mapping, Storage::unorm16, 1, infinity}));
    } else {
      refused(mapping, 1, infinity);
    }
  }
  const std::string without_far = message_of<UsageError>([] {
    require_meaningful({Mapping::linear, Storage::unorm16, 1, infinity});
  });
  EXPECT_NE(without_far.find("infinite and reversed-infinite"), std::string::npos);
  EXPECT_THROW(mapping_named("Standard"), UsageError);
  EXPECT_THROW(storage_named("unorm8"), UsageError);
  for (const char* name : {"d24", "D24S8", "GL_DEPTH_COMPONENT24", "DXGI_FORMAT_D24_UNORM_S8_UINT",
                           "VK_FORMAT_X8_D24_UNORM_PACK32", "depth24plus"})
    EXPECT_EQ(storage_named(name), Storage::unorm24) << name;
  for (const char* name : {"D32F", "VK_FORMAT_D32_SFLOAT", "depth32float", "GL_DEPTH_COMPONENT32F"})
    EXPECT_EQ(storage_named(name), Storage::float32) << name;
  EXPECT_NE(message_of<UsageError>([] {
              storage_named("D32");
            }).find("did you mean 'unorm32' or 'float32'?"),
            std::string::npos);
  for (const Mapping mapping : all_mappings) EXPECT_EQ(mapping_named(name_of(mapping)), mapping);
  for (const Storage storage : all_storages) EXPECT_EQ(storage_named(name_of(storage)), storage);
}

}  // namespace
}  // namespace fathom
