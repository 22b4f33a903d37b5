// The caller's floating-point mode changes nothing of what a depth buffer stores, or of what that
// means.
#include <gtest/gtest.h>

#include "fathom/depth_format/depth_bias.h"
#include "fathom/depth_format/encode.h"
#include "fathom/depth_format/pipeline_model.h"
#include "fathom/depth_format/resolution.h"
#include "fathom/numeric/rounding.h"
#include "tests/inputs/floating_point_modes.h"

namespace fathom {
namespace {

using Numbers = std::vector<double>;

/// near, far and depths: ordinary ones, and subnormal ones.
struct Range {
  double near, far, depth;
};
constexpr Range ranges[] = {{0.1, 1000, 0.7}, {0x1p-1060, 0x1.8p-1030, 0x1.7p-1040}, {3, 7, 5}};

TEST(FloatingPointMode, ChangesNoStoredDepth) {
  for (const Range& range : ranges) {
    for (const Mapping mapping : all_mappings) {
      for (const Storage storage : all_storages) {
        SCOPED_TRACE(std::string(name_of(mapping)) + " " + std::string(name_of(storage)));
        const DepthFormat format{mapping, storage, range.near, range.far, 1};
        const Dyadic depth = range.depth;
        checks::expect_same_in_all_modes([&] {
          const StoredDepth stored = encode(format, depth);
          return std::pair(stored.bits, decode_to_binary64(format, stored));
        });
      }
    }
  }
}

TEST(FloatingPointMode, ChangesNoResolution) {
  for (const Range& range : ranges) {
    const DepthFormat format{Mapping::standard, Storage::unorm16, range.near, range.far, 1};
    const Dyadic depth = range.depth;
    checks::expect_same_in_all_modes([&] {
      const Resolution steps = resolution(format, depth);
      return std::tuple(steps.stored.bits, steps.to_nearer, steps.to_farther,
                        codes_between(format, Dyadic(format.near), depth),
                        separation_behind(format, depth), bin_width(format, depth));
    });
  }
}

TEST(FloatingPointMode, ChangesNothingThatAPipelineStores) {
  for (const Range& range : {ranges[0], ranges[2]}) {
    PipelineModel model;
    model.format = {Mapping::standard, Storage::float32, range.near, range.far, 1};
    const auto z = static_cast<float>(range.depth);
    checks::expect_same_in_all_modes([&] {
      const Ratio a = window_depth(model, {0.1F, 0.2F, z});
      const Ratio between = interpolated_window_depth(model, {0.1F, 0.2F, z},
                                                      {0.3F, 0.1F, 1.1F * z}, Ratio(1.0, 3.0));
      return std::tuple(to_fraction(a), to_fraction(between),
                        to_fraction(stored_number(model, between)));
    });
  }
}

TEST(FloatingPointMode, ChangesNoBias) {
  const WindowSlopes slopes{Dyadic(0.1), Dyadic(0x1p-1070), Dyadic(0x1.1p-140)};
  for (const Storage storage : all_storages) {
    checks::expect_same_in_all_modes([&] {
      const Ratio offset = depth_offset(storage, {1.1, 4, 0}, slopes);
      return to_fraction(biased_depth(Dyadic(0.3), offset));
    });
  }
}

}  // namespace
}  // namespace fathom
