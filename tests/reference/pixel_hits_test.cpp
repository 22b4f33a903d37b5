// hits_of_pixels() against probe(), pixel by pixel.
#include "fathom/reference/pixel_hits.h"

#include <gtest/gtest.h>

#include <array>

#include "fathom/failures/errors.h"
#include "fathom/numeric/rounding.h"
#include "fathom/reference/probe.h"
#include "tests/effort.h"
#include "tests/inputs/random_scenes.h"
#include "tests/inputs/scene_building.h"

namespace fathom {
namespace {

using checks::CaseMaker;
using checks::effort;
using checks::Kind;

void check(const Scene& scene, const Camera& camera, Cull cull, std::size_t& hits) {
  const PixelHits found = hits_of_pixels(scene, camera, cull);
  ASSERT_EQ(found.splits.size(), std::size_t{camera.width} * camera.height + 1);
  std::size_t pixel = 0;
  for (std::uint32_t row = 0; row < camera.height; ++row) {
    for (std::uint32_t column = 0; column < camera.width; ++column, ++pixel) {
      std::size_t i = found.splits[pixel];
      for (const CoveringTriangle& each : probe(scene, camera, column, row, cull)) {
        if (!each.counts) break;
        ASSERT_LT(i, found.splits[pixel + 1]);
        ASSERT_EQ(found.hits[i++],
                  (PixelHit{.triangle = each.number, .depth = round_to_binary64(each.depth)}));
      }
      ASSERT_EQ(i, found.splits[pixel + 1]);
    }
  }
  hits += found.hits.size();
}

TEST(PixelHits, AreThoseOfEachPixel) {
  std::size_t hits = 0;
  for (const Kind kind : {Kind::few_bits, Kind::neighbours, Kind::huge, Kind::tiny}) {
    CaseMaker maker(31 + static_cast<std::uint64_t>(kind), kind);
    for (int i = 0; i < 40 / effort; ++i) {
      const auto [scene, camera] = maker.make();
      for (const Cull cull : {Cull::none, Cull::back, Cull::front})
        check(scene, camera, cull, hits);
    }
  }
  EXPECT_GT(hits, 1000U / effort);
}

/// Triangles whose depths, 1 + z, are all 1 as binary64 numbers.
TEST(PixelHits, OfEqualRoundedDepthsAreOrderedExactly) {
  std::vector<MeshPoint> vertices;
  std::vector<CornerIndices> triangles;
  for (const double z : {0x1p-60, 0x1p-62, 0.0, 0x1p-61, 0.0}) {
    const auto first = static_cast<std::uint32_t>(vertices.size());
    vertices.insert(vertices.end(), {{-8, -8, z}, {8, -8, z}, {0, 8, z}});
    triangles.push_back({first, first + 1, first + 2});
  }
  Camera camera = checks::camera_of(2, 2, 2);
  camera.world_to_camera[2][3] = 1;
  const PixelHits found = hits_of_pixels(checks::scene_of(vertices, triangles), camera);
  ASSERT_EQ(found.splits, (std::vector<std::size_t>{0, 5, 10, 15, 20}));
  const std::array<std::uint32_t, 5> order{2, 4, 1, 3, 0};
  for (std::size_t i = 0; i < found.hits.size(); ++i)
    EXPECT_EQ(found.hits[i], (PixelHit{.triangle = order[i % 5], .depth = 1}));
}

TEST(PixelHits, RefuseALens) {
  Camera camera = checks::camera_of(4, 4, 4);
  camera.projection.lens.emplace(Lens{LensModel::simple_radial, {0.1}});
  EXPECT_THROW(hits_of_pixels({}, camera), UsageError);
}

}  // namespace
}  // namespace fathom
