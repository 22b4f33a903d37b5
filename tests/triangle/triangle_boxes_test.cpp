#include "fathom/triangle/triangle_boxes.h"

#include <gtest/gtest.h>

#include "fathom/triangle/projected_triangle.h"
#include "tests/effort.h"
#include "tests/inputs/random_scenes.h"

namespace fathom {
namespace {

using namespace triangle;
using checks::CaseMaker;
using checks::effort;
using checks::Kind;

/// The boxes that triangles are found by never leave out what bounding_box() has, and mostly are
/// the same.
TEST(TriangleBoxes, ContainThoseOfTheReference) {
  int boxes = 0, equal = 0;
  for (const Kind kind : {Kind::few_bits, Kind::neighbours, Kind::huge, Kind::tiny}) {
    CaseMaker maker(5 + static_cast<std::uint64_t>(kind), kind);
    for (int i = 0; i < 500 / effort; ++i) {
      const checks::Case c = maker.make();
      const Object& object = c.scene.objects[0];
      const Mesh& mesh = c.scene.meshes[0];
      TriangleBoxes ours(object, mesh, c.camera);
      for (std::uint32_t t = 0; t < mesh.triangles.size(); ++t, ++boxes) {
        TierCounts counts;
        const PixelBox truth =
            bounding_box(project(world_corners(object, mesh, t), t, c.camera, counts), c.camera);
        const PixelBox box = ours.box(t);
        if (truth.is_empty()) {
          equal += box.is_empty() ? 1 : 0;
          continue;
        }
        ASSERT_FALSE(box.is_empty());
        equal += box.first_column == truth.first_column && box.last_column == truth.last_column &&
                         box.first_row == truth.first_row && box.last_row == truth.last_row
                     ? 1
                     : 0;
        EXPECT_LE(box.first_column, truth.first_column);
        EXPECT_GE(box.last_column, truth.last_column);
        EXPECT_LE(box.first_row, truth.first_row);
        EXPECT_GE(box.last_row, truth.last_row);
      }
    }
  }
  EXPECT_GE(boxes, 400);
  EXPECT_GT(equal, boxes * 3 / 4);
}

}  // namespace
}  // namespace fathom
