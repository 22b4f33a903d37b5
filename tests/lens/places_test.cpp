// The fast engine's places of samples and their bounds, against enclosures of the exact directions.
#include "fathom/fast/lenses/places.h"

#include <gtest/gtest.h>

#include <cmath>
#include <memory>

#include "tests/inputs/lens_scenes.h"
#include "tests/lens/lens_oracle.h"

namespace fathom::fast {
namespace {

using checks::NamedLens;
using oracle::ArbBall;

constexpr std::uint32_t width = 110, height = 70;

/// A camera that sees up to 100° from the axis of a fisheye without a stage.
Camera wide_camera(const Lens& lens) {
  Camera camera;
  camera.width = width;
  camera.height = height;
  camera.projection.fx = camera.projection.fy = 50;
  camera.projection.cx = 73;
  camera.projection.cy = 41;
  camera.projection.lens = lens;
  return camera;
}

/// The component of an exact direction along an axis of a view.
ArbBall along(const ViewAxes::Axis& axis, const lens::ExactDirection& d) {
  const auto [low, high] = d.enclosure(120)[axis.of_camera];
  return ArbBall(axis.sign) * ArbBall::hull(low, high);
}

struct Checked {
  int samples = 0;
  double greatest_share = 0, greatest_error = 0;
};

/// Compares the samples of a tile that a view holds.
void check(const Places& places, const Places::View& view, std::uint32_t tile, Checked& checked) {
  const TileGrid grid(width, height);
  const auto room = std::make_unique<Places::Room>();
  const Places::OfTile of_tile = places.of_tile(view, tile, *room);
  if (of_tile.box.is_empty()) return;  // of another view
  for (std::uint32_t row = 0; row < TileShape::size; ++row) {
    for (std::uint32_t column = 0; column < TileShape::size; ++column) {
      const std::size_t i = TileShape::index(column, row);
      if (of_tile.x[i] != of_tile.x[i]) continue;
      const auto d = places.preimages().of_pixel(grid.area(tile).first_column + column,
                                                 grid.area(tile).first_row + row);
      ASSERT_TRUE(d.has_value());
      const ArbBall forward = along(view.axes.forward, *d);
      ASSERT_GT(forward.sign(), 0);
      const double off =
          std::max((along(view.axes.right, *d) / forward).distance_from(of_tile.x[i]),
                   (along(view.axes.down, *d) / forward).distance_from(of_tile.y[i]));
      ASSERT_LE(off, of_tile.error);
      if (of_tile.error > 0)
        checked.greatest_share = std::max(checked.greatest_share, off / of_tile.error);
      ++checked.samples;
    }
  }
  checked.greatest_error = std::max(checked.greatest_error, of_tile.error);
}

class PlacesOf : public ::testing::TestWithParam<NamedLens> {};

TEST_P(PlacesOf, LieWithinTheirBounds) {
  const Camera camera = wide_camera(GetParam().lens);
  const Places places(camera.projection, width, height);
  ASSERT_TRUE(places.are_usable());
  Checked checked;
  for (std::uint32_t tile = 0; tile < TileGrid(width, height).count(); ++tile)
    for (const Places::View& view : places.views()) check(places, view, tile, checked);
  int with_ray = 0;
  for (std::uint32_t row = 0; row < height; ++row)
    for (std::uint32_t column = 0; column < width; ++column)
      with_ray += places.preimages().of_pixel(column, row).has_value() ? 1 : 0;
  EXPECT_EQ(checked.samples, with_ray);
  // The bounds of one stage are within 200 times the errors, of two within 512.
  EXPECT_GT(checked.greatest_share, 0x1p-9);
  EXPECT_LT(checked.greatest_error, 0x1p-36);
}

INSTANTIATE_TEST_SUITE_P(
    Lenses, PlacesOf,
    ::testing::Values(NamedLens{"opencv", {LensModel::opencv, {-0.02, 0.001, 0.001, -0.002}}},
                      NamedLens{"fov", {LensModel::fov, {0.75}}},
                      NamedLens{"fov_that_ends", {LensModel::fov, {-2}, 1}},
                      NamedLens{"division", {LensModel::division, {-0.25}}},
                      NamedLens{"fisheye", {LensModel::fisheye}},
                      NamedLens{"equirectangular", {LensModel::equirectangular}},
                      NamedLens{"cylindrical", {LensModel::cylindrical, {}, 2}},
                      NamedLens{"fisheye_that_ends", {LensModel::simple_fisheye, {}, 1.25}},
                      NamedLens{"opencv_fisheye",
                                {LensModel::opencv_fisheye, {0.05, -0.01, 0.002, 0.001}}},
                      NamedLens{"thin_prisms",
                                {LensModel::thin_prism_fisheye,
                                 {0.02, -0.005, 0.001, -0.002, 0.001, 0.0005, 0.003, -0.002}}},
                      NamedLens{"two_stages",
                                {LensModel::rad_tan_thin_prism_fisheye,
                                 {0.02, -0.005, 0.001, -0.0005, 0.0001, -0.00002, 0.003, -0.002,
                                  0.002, -0.001, 0.003, 0.001}}},
                      NamedLens{"ftheta", {LensModel::ftheta, {0, 1, 0.1, -0.05, 0.01, -0.001}}},
                      NamedLens{"ftheta_on_both_sides", {LensModel::ftheta, {-0.5, 1.5}, 1.5}},
                      NamedLens{"orthographic", {LensModel::fisheye_orthographic}},
                      NamedLens{"equisolid", {LensModel::fisheye_equisolid}},
                      NamedLens{"unified", {LensModel::ucm, {0.625}}},
                      NamedLens{"extended", {LensModel::eucm, {0.4, 7}, 2.5}},
                      NamedLens{"double_sphere", {LensModel::double_sphere, {-0.25, 0.6}}},
                      NamedLens{"omnidirectional", {LensModel::omni, {0.875}}},
                      NamedLens{"mirror", {LensModel::omni, {1.5}}},
                      NamedLens{"bent_mirror", {LensModel::omni, {1.5, 0.05, 0.01, 0.01, 0.02}}},
                      NamedLens{"omnidirectional_and_bent",
                                {LensModel::omni, {0.75, -0.02, 0.004, 0.002, -0.003}, 2}}),
    [](const auto& lens) { return std::string(lens.param.name); });

}  // namespace
}  // namespace fathom::fast
