#include "fathom/scene/triangle_source.h"

#include <gtest/gtest.h>

#include <stdexcept>
#include <tuple>

#include "fathom/failures/errors.h"
#include "tests/inputs/both_readings.h"
#include "tests/inputs/scene_building.h"
#include "tests/places.h"
#include "tests/scratch_folder.h"

namespace fathom {
namespace {

using checks::Both;
using checks::ply_of;
using checks::stl_of;

/// A triangle that is asked for by its number is that of the mesh in memory.
TEST(TriangleSource, TheSameInMemoryAndInFiles) {
  const ScratchFolder folder;
  Warnings warnings;
  const Scene cube = read_scene({test::source_dir() / "data/meshes/cube.obj"}, {}, warnings);
  Mesh none;
  const Both both({folder.write("none.stl", stl_of(none)),
                   folder.write("a.ply", ply_of(cube.meshes.at(0))),
                   folder.write("b.stl", stl_of(cube.meshes.at(0)))});
  const TriangleSource memory(both.scene), files(both.streamed);
  ASSERT_EQ(memory.count(), 24U);
  ASSERT_EQ(files.count(), 24U);
  for (std::uint32_t t = 0; t < 24; ++t) {
    for (const TriangleOrigin& origin :
         {memory.origin(t), memory.triangle(t).origin, origin_of(both.scene, t), files.origin(t),
          files.triangle(t).origin, origin_of(both.streamed, t)}) {
      EXPECT_EQ(origin.object, 1 + t / 12);  // none.stl is object 0
      const std::uint32_t local = t % 12;
      EXPECT_EQ(origin.triangle, local);
      // ply_of() puts a face that is no triangle before every seventh.
      EXPECT_EQ(origin.face, origin.object == 1 ? local + local / 7 + 1 : local);
    }
    EXPECT_EQ(memory.triangle(t).corners, files.triangle(t).corners);
  }
}

TEST(TriangleSource, RefusesANumberThatIsNotThere) {
  const ScratchFolder folder;
  Warnings warnings;
  const Scene cube = read_scene({test::source_dir() / "data/meshes/cube.obj"}, {}, warnings);
  const Both both({folder.write("cube.stl", stl_of(cube.meshes.at(0)))});
  for (const std::uint32_t number : {12U, 0xFFFFFFFFU}) {
    EXPECT_THROW(origin_of(both.scene, number), std::out_of_range);
    EXPECT_THROW(origin_of(both.streamed, number), std::out_of_range);
    EXPECT_THROW(std::ignore = TriangleSource(both.scene).world_corners(number), std::out_of_range);
  }
  EXPECT_THROW(origin_of(Scene{}, 0), std::out_of_range);
}

/// A mesh that is placed often: numbers of triangles would wrap.
TEST(TriangleSource, MoreTrianglesThanNumbersAreRefused) {
  Scene scene = checks::scene_of({{0, 0, 1}, {1, 0, 1}, {0, 1, 1}},
                                 std::vector<CornerIndices>(1 << 20, {0, 1, 2}));
  scene.objects.resize(4095, scene.objects[0]);
  EXPECT_EQ(TriangleSource(scene).count(), 4095ULL << 20);
  scene.objects.resize(4096, scene.objects[0]);
  EXPECT_THROW(TriangleSource{scene}, InputError);
}

}  // namespace
}  // namespace fathom
