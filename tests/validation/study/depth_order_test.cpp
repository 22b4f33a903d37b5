// The experiment of the study `indistinguishable`, held to what is published and to the ideal
// model.

#include "apps/study/indistinguishable/depth_order.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <limits>
#include <stdexcept>
#include <string>

#include "apps/study/sweeps.h"
#include "fathom/depth_format/encode.h"

namespace fathom::studies {
namespace {

constexpr double near = 0.1, far = 10000;

DepthFormat format_of(Mapping mapping, Storage storage = Storage::float32) {
  return {mapping, storage, near,
          takes_infinite_far(mapping) ? std::numeric_limits<double>::infinity() : far};
}

const Sources& sources_named(const std::string& name) {
  for (const Sources& sources : all_sources()) {
    if (sources.name == name) return sources;
  }
  throw std::logic_error(name);
}

OrderCount measure(Mapping mapping, bool premultiplied, const std::string& sources, Storage storage,
                   const View& view) {
  const PipelineModel model{format_of(mapping), view.row, premultiplied,
                            sources_named(sources).rounding};
  const std::vector<double> depths = linear_samples(near, far, 10001);
  return count_order(model, storage, window_depths(model, view, sources_named(sources), depths));
}

const View view = default_view(near);

double percent(std::size_t part, const OrderCount& counts) {
  return 100.0 * static_cast<double>(part) / static_cast<double>(counts.pairs);
}

TEST(DepthOrder, TheVerticesThemselvesAreInOrder) {
  for (const auto& depths :
       {linear_samples(near, far, 10001), logarithmic_samples(near, far, 10001)}) {
    const OrderCount counts = count_vertex_order(view, depths);
    EXPECT_EQ(counts.pairs, 10000U);
    EXPECT_EQ(counts.equal, 0U);
    EXPECT_EQ(counts.swapped, 0U);
  }
}

/// Reed gives 45 % indistinguishable and 18 % swapped for the standard projection, premultiplied,
/// in float32. The figures depend on the camera: they lie between those of 20 random ones.
TEST(DepthOrder, ReedsStandardProjection) {
  double least[2]{100, 100}, greatest[2]{0, 0};
  for (std::uint64_t seed = 1; seed <= 20; ++seed) {
    const OrderCount c =
        measure(Mapping::standard, true, "vertices", Storage::float32, random_view(seed, near));
    const double shares[2]{percent(c.equal, c), percent(c.swapped, c)};
    for (int i = 0; i < 2; ++i) {
      least[i] = std::min(least[i], shares[i]);
      greatest[i] = std::max(greatest[i], shares[i]);
    }
  }
  EXPECT_LT(least[0], 45);
  EXPECT_GT(greatest[0], 45);
  EXPECT_LT(least[1], 18);
  EXPECT_GT(greatest[1], 18);
}

/// Every operation is that of IEEE 754, so the counts are the same everywhere.
TEST(DepthOrder, TheFiguresOfTheStudy) {
  const OrderCount c = measure(Mapping::standard, true, "vertices", Storage::float32, view);
  EXPECT_EQ(c.equal, 4691U);
  EXPECT_EQ(c.swapped, 1710U);
  const OrderCount separate = measure(Mapping::standard, false, "vertices", Storage::float32, view);
  EXPECT_EQ(separate.equal, 7721U);
  EXPECT_EQ(separate.swapped, 1U);
}

TEST(DepthOrder, ReversedFloatLosesNothing) {
  for (const Mapping mapping : {Mapping::reversed, Mapping::reversed_infinite}) {
    for (const bool premultiplied : {false, true}) {
      const OrderCount c = measure(mapping, premultiplied, "all", Storage::float32, view);
      EXPECT_EQ(c.equal + c.swapped, 0U);
    }
  }
}

/// Reed: 'reversed-Z with an integer depth buffer is as good as any of the other integer options'.
/// It loses what unorm24 loses by itself, whatever the matrices and wherever far is.
TEST(DepthOrder, ReversedIntegerLosesNoMoreThanTheStorage) {
  for (const Mapping mapping : {Mapping::reversed, Mapping::reversed_infinite}) {
    const OrderCount ideal = measure(mapping, false, "storage", Storage::unorm24, view);
    EXPECT_EQ(ideal.equal, mapping == Mapping::reversed ? 7577U : 7578U);
    for (const bool premultiplied : {false, true}) {
      const OrderCount c = measure(mapping, premultiplied, "vertices", Storage::unorm24, view);
      EXPECT_EQ(c.equal, ideal.equal);
      EXPECT_EQ(c.swapped, 0U);
    }
  }
}

TEST(DepthOrder, StorageAloneIsTheIdealModel) {
  const std::vector<double> depths = linear_samples(near, far, 1001);
  for (const Mapping mapping : {Mapping::standard, Mapping::reversed, Mapping::opengl}) {
    for (const Storage storage : {Storage::unorm16, Storage::unorm24, Storage::float32}) {
      const PipelineModel model{format_of(mapping, storage), view.row, false,
                                sources_named("storage").rounding};
      const OrderCount counts =
          count_order(model, storage, window_depths(model, view, sources_named("storage"), depths));
      std::size_t equal = 0;
      for (std::size_t i = 1; i < depths.size(); ++i) {
        const auto stored = [&](double depth) {
          return encode(model.format,
                        clamp_to_range(model.format, exact_depth(model, vertex_at(view, depth))));
        };
        equal += stored(depths[i]) == stored(depths[i - 1]) ? 1 : 0;
      }
      EXPECT_EQ(counts.equal, equal);
      EXPECT_EQ(counts.swapped, 0U);
    }
  }
}

}  // namespace
}  // namespace fathom::studies
