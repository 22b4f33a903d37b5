#include "fathom/scene/triangle_source.h"

#include <gtest/gtest.h>

#include "tests/inputs/both_readings.h"
#include "tests/places.h"
#include "tests/scratch_folder.h"

namespace fathom {
namespace {

using testing::Both;
using testing::ply_of;
using testing::stl_of;

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
    const TriangleOrigin truth = origin_of(both.scene, t);
    for (const TriangleSource* source : {&memory, &files}) {
      for (const TriangleOrigin& origin : {source->origin(t), source->triangle(t).origin}) {
        EXPECT_EQ(origin.object, truth.object);
        EXPECT_EQ(origin.triangle, truth.triangle);
        EXPECT_EQ(origin.face, truth.face);
      }
    }
    EXPECT_EQ(memory.triangle(t).corners, files.triangle(t).corners);
  }
}

}  // namespace
}  // namespace fathom
