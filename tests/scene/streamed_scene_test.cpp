// Scenes that stay in their files count, number and span what they would in memory.
#include "fathom/scene/streamed_scene.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "fathom/scene/bounds.h"
#include "tests/inputs/both_readings.h"
#include "tests/scratch_folder.h"

namespace fathom {
namespace {

using checks::Both;
using checks::ply_of;
using checks::stl_of;
using ::testing::ElementsAre;
using ::testing::HasSubstr;

/// Two triangles about a point.
Mesh pair_at(double x) {
  Mesh mesh;
  mesh.vertices = {{x, 0, 0}, {x + 1, 0, 2}, {x, 1, 0}, {x + 1, 3, -1}};
  mesh.triangles = {{0, 1, 2}, {1, 3, 2}};
  mesh.face_count = 2;
  return mesh;
}

TEST(StreamedScene, TrianglesAndFacesHaveTheNumbersOfAScene) {
  const ScratchFolder folder;
  const Both both(
      {folder.write("a.stl", stl_of(pair_at(0))), folder.write("b.ply", ply_of(pair_at(5)))});
  ASSERT_EQ(triangle_count(both.streamed), 4U);
  ASSERT_EQ(triangle_count(both.scene), 4U);
  for (std::uint32_t t = 0; t < 4; ++t) {
    const TriangleOrigin ours = origin_of(both.streamed, t), truth = origin_of(both.scene, t);
    EXPECT_EQ(ours.object, truth.object);
    EXPECT_EQ(ours.triangle, truth.triangle);
    EXPECT_EQ(ours.face, truth.face);
  }
  // ply_of() begins with a face of two corners, which counts.
  EXPECT_EQ(origin_of(both.streamed, 2).face, 1U);
}

TEST(StreamedScene, TheOutlineSpansWhatTheSceneDoes) {
  const ScratchFolder folder;
  const Both both({folder.write("a.stl", stl_of(pair_at(-1))),
                   folder.write("none.stl", stl_of(Mesh())),
                   folder.write("b.ply", ply_of(pair_at(5)))});
  const Scene outline = outline_of(both.streamed);
  EXPECT_EQ(world_bounds(outline), world_bounds(both.scene));
  ASSERT_TRUE(world_bounds(outline));
  EXPECT_EQ(world_bounds(outline)->lower, (std::array<double, 3>{-1, 0, -1}));
  EXPECT_EQ(world_bounds(outline)->upper, (std::array<double, 3>{6, 3, 2}));
  ASSERT_EQ(outline.objects.size(), 3U);
  EXPECT_EQ(outline.objects[2].name, "b");
  EXPECT_TRUE(outline.meshes[1].triangles.empty());
  EXPECT_EQ(outline.sources.at(0).sha256, both.scene.sources.at(0).sha256);
  EXPECT_THAT(both.stream_warnings, ::testing::Contains(HasSubstr("none.stl: has no faces")));
}

}  // namespace
}  // namespace fathom
