#include <gtest/gtest.h>

#include <cmath>
#include <string>
#include <vector>

#include "apps/bench/masked_occlusion_culling/masked_buffer.h"
#include "fathom/attribution/model/renderer_input.h"
#include "fathom/render.h"
#include "validation/scenes/made/made_meshes.h"
#include "validation/scenes/scenes.h"
#include "validation/scenes/shapes.h"

/// Masked Occlusion Culling draws what we draw, so that comparing times is fair. Built where a
/// clone of it is (FATHOM_MASKED_OCCLUSION_CULLING).
namespace fathom::bench {
namespace {

const std::vector<MaskedWay> ways{{true, true}, {true, false}, {false, true}, {false, false}};

struct Agreement {
  std::size_t covered = 0;       // by us
  std::size_t lost = 0;          // by us alone
  std::size_t invented = 0;      // by it alone
  std::size_t nearer = 0;        // than ours, by more than binary32 and the grid can do
  std::size_t much_farther = 0;  // than ours, by a twentieth
};

Agreement agreement(const Scene& scene, const Camera& camera, const MaskedWay& way) {
  const DepthMap map = render(scene, camera, {.engine = Engine::fast}).map;
  const Samples<float>& ours = *map.values<float>("Z");
  MaskedBuffer buffer(attribution::world_mesh(scene), camera, way);
  buffer.draw();
  const std::vector<float> theirs = buffer.depths();
  EXPECT_EQ(theirs.size(), ours.size());
  Agreement found;
  for (std::size_t i = 0; i < ours.size(); ++i) {
    const bool here = std::isfinite(ours[i]), there = std::isfinite(theirs[i]);
    found.covered += here ? 1 : 0;
    found.lost += here && !there ? 1 : 0;
    found.invented += there && !here ? 1 : 0;
    if (!here || !there) continue;
    found.nearer += theirs[i] < 0.99F * ours[i] ? 1 : 0;
    found.much_farther += theirs[i] > 1.05F * ours[i] ? 1 : 0;
  }
  return found;
}

class MaskedScenes : public testing::TestWithParam<std::string> {};

// Samples lie on the same points. What is covered differs where an outline passes within 1/256
// pixel of a pixel's centre: a few of a thousand pixels at most. Depths are bounds from behind, of
// blocks: nearer only by rounding, at grazing triangles; farther where blocks hold more than two
// surfaces.
TEST_P(MaskedScenes, CoverWhatWeCover) {
  const BenchScene bench = make_scene(GetParam(), 640, 360);
  for (const MaskedWay& way : ways) {
    const Agreement found = agreement(bench.scene, bench.camera, way);
    EXPECT_GT(found.covered, 1000U);
    EXPECT_LE(found.lost, found.covered / 1000) << way.widest << way.vertices_first;
    EXPECT_LE(found.invented, found.covered / 1000);
    EXPECT_LE(found.nearer, found.covered / 1000);
    EXPECT_LE(found.much_farther, found.covered / 5);
  }
}

INSTANTIATE_TEST_SUITE_P(All, MaskedScenes,
                         testing::Values("sphere-20k", "few-large", "room", "city", "cad"),
                         [](const auto& scene) {
                           std::string name = scene.param;
                           std::erase(name, '-');
                           return name;
                         });

TEST(MaskedBuffer, DrawsImagesOfAnySizeAndBothSidesOfTriangles) {
  BenchScene bench = make_scene("sphere-800", 131, 77);
  const Agreement front = agreement(bench.scene, bench.camera, ways[0]);
  EXPECT_LE(front.lost + front.invented, 4U);
  for (auto& [a, b, c] : bench.scene.meshes[0].triangles) std::swap(b, c);
  const Agreement back = agreement(bench.scene, bench.camera, ways[0]);
  EXPECT_EQ(back.covered, front.covered);
  EXPECT_LE(back.lost + back.invented, 4U);
}

TEST(MaskedBuffer, ShowsNothingOnceItIsCleared) {
  const BenchScene bench = make_scene("sphere-800", 64, 36);
  MaskedBuffer buffer(attribution::world_mesh(bench.scene), bench.camera, ways[0]);
  buffer.draw();
  buffer.clear();
  for (const float depth : buffer.depths()) ASSERT_TRUE(std::isinf(depth));
}

}  // namespace
}  // namespace fathom::bench
