// The study of blending: its judge by hand, and its figures.
#include "apps/study/blending/blending.h"

#include <gtest/gtest.h>

#include "apps/study/pipeline_scenes.h"

namespace fathom::studies {
namespace {

/// A red wall at 5, green glass of a quarter at 4 and blue glass of a half at 3, in a mixed order.
TEST(Blending, JudgeBlendsByHand) {
  Scene scene;
  const auto add = [&](double z, const std::array<float, 4>& colour, std::optional<double> alpha) {
    Mesh mesh;
    mesh.vertices = {{-90, -90, z}, {90, -90, z}, {0, 90, z}};
    mesh.triangles = {{0, 1, 2}};
    mesh.colours.assign(3, colour);
    mesh.face_count = 1;
    scene.objects.push_back({.mesh = scene.meshes.size(), .name = "pane"});
    scene.meshes.push_back(std::move(mesh));
    scene.draw_states.emplace_back();
    scene.draw_states.back().alpha = alpha;
  };
  add(4, {0, 1, 0, 1}, 0.25);
  add(3, {0, 0, 1, 1}, 0.5);
  add(5, {1, 0, 0, 1}, std::nullopt);
  add(6, {1, 1, 1, 1}, std::nullopt);  // behind the wall
  const auto image = exactly_blended(scene, front_camera(3, 3, 1, 20), {0.25, 0.25, 0.25});
  for (const auto& colour : image.pixels) EXPECT_EQ(colour, (pipeline::Colour{0.375, 0.125, 0.5}));
}

std::size_t wrong(const GlassScene& scene, const std::string& method) {
  return blend(scene, method).wrong;
}

TEST(Blending, SortedPanesAreRightAndOthersAreNot) {
  for (const char* name : {"panes", "wall"}) {
    const GlassScene scene = glass_scene(name);
    EXPECT_EQ(wrong(scene, "back to front"), 0U) << name;
    EXPECT_EQ(wrong(scene, "back to front, read-only depth"), 0U) << name;
    for (const char* method : {"file order", "file order, depth test",
                               "file order, read-only depth", "random order", "front to back"})
      EXPECT_GT(wrong(scene, method), 300U) << name << ' ' << method;
  }
}

/// Where nothing is opaque, a depth buffer that is only read holds nothing.
TEST(Blending, ReadOnlyIsAsOffWithoutAWall) {
  const GlassScene panes = glass_scene("panes");
  EXPECT_EQ(blend(panes, "file order").picture.pixels,
            blend(panes, "file order, read-only depth").picture.pixels);
  const GlassScene wall = glass_scene("wall");
  EXPECT_NE(blend(wall, "file order").picture.pixels,
            blend(wall, "file order, read-only depth").picture.pixels);
}

TEST(Blending, OnlyCutsPutARingIntoOrder) {
  for (const char* name : {"ring", "penetration"}) {
    const GlassScene scene = glass_scene(name);
    EXPECT_GT(wrong(scene, "back to front"), 100U) << name;
    EXPECT_EQ(wrong(scene, "painter's algorithm"), 0U) << name;
  }
  // An opaque wall among the glass: an opacity for each object.
  EXPECT_EQ(wrong(glass_scene("wall"), "painter's algorithm"), 0U);
}

}  // namespace
}  // namespace fathom::studies
