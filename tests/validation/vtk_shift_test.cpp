#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <string>
#include <vector>

#include "fathom/attribution/raster/clip_vertex.h"
#include "fathom/camera/camera_making.h"
#include "validation/vtk/vtk_renderer.h"

/// The rule by which VTK's mappers hold positions, against what VTK does.
namespace fathom::attribution {
namespace {

using Point = std::array<double, 3>;

struct Case {
  std::string name;
  std::vector<Point> points;
  bool is_shifted;
};

/// A triangle with these ends of its box along x and y.
std::vector<Point> triangle(double left, double right, double bottom, double top) {
  return {{left, bottom, 0}, {right, bottom, 0}, {left, top, 0}};
}

// Limits are a diagonal whose square is 1000 or 1/1000, and a distance of 1000 diagonals.
const Case cases[] = {
    {"ordinary", {{-1, -1, 0}, {1, -1, 0}, {0, 1, 3}}, false},
    {"large", {{-20, -20, 0}, {20, -20, 0}, {0, 20, 5}}, true},
    {"small", {{0, 0, 0}, {0.02, 0, 0}, {0, 0.02, 0}}, true},
    {"at the upper limit", triangle(0, 30, 0, 10), false},
    {"above the upper limit", triangle(0, 30, 0, 10 * (1 + 0x1p-40)), true},
    {"above the lower limit", triangle(0, 0.03, 0, 0.01 * (1 + 0x1p-40)), false},
    {"below the lower limit", triangle(0, 0.03, 0, 0.01 * (1 - 0x1p-40)), true},
    {"1000 diagonals away", triangle(4998.5, 5001.5, -2, 2), false},
    {"more than 1000 diagonals away", triangle(4998.625, 5001.625, -2, 2), true},
    {"a point that no triangle uses", {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {40, 0, 0}}, true},
};

TEST(VtkShift, IsTheOneThatVtkChooses) {
  for (const Case& c : cases) {
    const WorldMesh mesh{c.points, {{0, 1, 2}}};
    const Point& seen = c.points[0];
    const double across = std::hypot(c.points[1][0] - seen[0], c.points[1][1] - seen[1]);
    const Camera camera =
        look_at({seen[0], seen[1], seen[2] + 3 * across}, {seen[0], seen[1], seen[2]}, {0, 1, 0},
                {.width = 8, .height = 8, .vertical_fov = 45});
    validation::VtkRenderer vtk(mesh, camera, {.near = 0.1 * across, .far = 100 * across});
    vtk.draw();
    const RasterModel ours = with_known_shift({.shift_as_vtk = true}, mesh);
    EXPECT_EQ(ours.shift, vtk.drawing().shift) << c.name;
    EXPECT_EQ(ours.shift != (Point{0, 0, 0}), c.is_shifted) << c.name;
  }
}

TEST(VtkShift, OfAPointIsWhereItIsFarAway) {
  const RasterModel vtk{.shift_as_vtk = true};
  EXPECT_EQ(with_known_shift(vtk, {{{1000, 0, 0}}, {}}).shift, (Point{0, 0, 0}));
  EXPECT_EQ(with_known_shift(vtk, {{{1000.5, 0, 0}}, {}}).shift, (Point{1000.5, 0, 0}));
}

TEST(VtkShift, IsNoneOfOtherModels) {
  const WorldMesh far{{{1e6, 0, 0}, {1e6 + 1, 0, 0}, {1e6, 1, 0}}, {{0, 1, 2}}};
  EXPECT_EQ(with_known_shift({}, far).shift, (Point{0, 0, 0}));
  EXPECT_EQ(with_known_shift({.shift = {1, 2, 3}}, far).shift, (Point{1, 2, 3}));
  EXPECT_EQ(with_known_shift({.shift_as_vtk = true}, {}).shift, (Point{0, 0, 0}));
}

}  // namespace
}  // namespace fathom::attribution
