// Directions in double-words, from the formulas of models and from the places of the fast engine,
// against enclosures of the exact directions.
#include "fathom/lens/word_formulas.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <memory>

#include "fathom/fast/lenses/places.h"
#include "fathom/fast/lenses/stage_starts.h"
#include "tests/inputs/lens_scenes.h"
#include "tests/inputs/tables_of_directions.h"
#include "tests/lens/arb_ball.h"

namespace fathom::lens {
namespace {

using checks::NamedLens;
using fast::Places;
using fast::TileShape;
using oracle::ArbBall;

constexpr std::uint32_t columns = 90, rows = 70;

Camera camera_with(const Lens& lens) {
  Camera camera;
  camera.width = columns;
  camera.height = rows;
  camera.projection = {.fx = 30, .fy = 31, .cx = 43.5, .cy = 31.25};
  if (has_one_focal_length(entry_of(lens.model))) camera.projection.fy = camera.projection.fx;
  camera.projection.lens = lens;
  if (lens.model == LensModel::table)
    return checks::with_table(camera, checks::DirectionMaker(3).numbers(columns * rows));
  return camera;
}

ArbBall ball_of(const Certified<WordPair>& x) {
  const Dyadic middle = Dyadic(x.value.hi) + Dyadic(x.value.lo), error(x.error);
  return ArbBall::hull(middle - error, middle + error);
}

/// Whether the boxes of words contain a positive multiple of the exact direction: all minors of the
/// two may be 0, and a component that is certain has the exact one's sign.
void expect_along(const DirectionWords& words, const ExactDirection& exact) {
  std::array<ArbBall, 3> w{ball_of(words[0]), ball_of(words[1]), ball_of(words[2])};
  const auto enclosure = exact.enclosure(220);
  std::array<ArbBall, 3> d;
  std::size_t greatest = 0;
  for (std::size_t k = 0; k < 3; ++k) {
    d[k] = ArbBall::hull(enclosure[k].low, enclosure[k].high);
    if (std::abs(words[k].value.hi) > std::abs(words[greatest].value.hi)) greatest = k;
  }
  for (std::size_t k = 0; k < 3; ++k) {
    const std::size_t next = (k + 1) % 3;
    EXPECT_TRUE((w[k] * d[next] - w[next] * d[k]).meets(ArbBall(0.0))) << k;
  }
  EXPECT_EQ(w[greatest].sign(), d[greatest].sign());
}

struct Counts {
  int found = 0, rays = 0;
  double greatest_error = 0;
};

void check_tile(const Places& places, const Places::View& view, std::uint32_t tile,
                const WordFormulas& formulas, Counts& counts) {
  const auto room = std::make_unique<Places::Room>();
  const Places::OfTile of_tile = places.of_tile(view, tile, *room);
  if (of_tile.box.is_empty()) return;
  fast::StageStarts starts(places.preimages());
  starts.start(of_tile, view.axes);
  const PixelBox area = fast::TileGrid(columns, rows).area(tile);
  for (std::size_t i = 0; i < TileShape::samples; ++i) {
    if (of_tile.x[i] != of_tile.x[i]) continue;
    const std::uint32_t column = area.first_column + TileShape::column_of(i);
    const std::uint32_t row = area.first_row + TileShape::row_of(i);
    ++counts.rays;
    const auto words = formulas.of_pixel(column, row, starts.at(i));
    if (!words) continue;
    ++counts.found;
    double size = 0, error = 0;
    for (const Certified<WordPair>& component : *words) {
      size = std::max(size, std::abs(component.value.hi));
      error = std::max(error, component.error);
    }
    counts.greatest_error = std::max(counts.greatest_error, error / size);
    if (i % 3 != 0) continue;
    const auto exact = places.preimages().of_pixel(column, row);
    ASSERT_TRUE(exact.has_value());
    expect_along(*words, *exact);
    if (::testing::Test::HasFailure()) {
      ADD_FAILURE() << "pixel " << column << ' ' << row;
      return;
    }
  }
}

class WordFormulasOf : public ::testing::TestWithParam<NamedLens> {};

TEST_P(WordFormulasOf, HoldTheExactDirections) {
  const Camera camera = camera_with(GetParam().lens);
  const Places places(camera.projection, columns, rows);
  ASSERT_TRUE(places.are_usable());
  const WordFormulas formulas(places.preimages());
  Counts counts;
  for (std::uint32_t tile = 0; tile < fast::TileGrid(columns, rows).count(); ++tile)
    for (const Places::View& view : places.views())
      check_tile(places, view, tile, formulas, counts);
  EXPECT_GT(counts.rays, 1000);
  // Of the table, a fifth of the directions are too long or too short.
  EXPECT_GE(counts.found, counts.rays * 7 / 10);
  EXPECT_LT(counts.greatest_error, 0x1p-80);
}

INSTANTIATE_TEST_SUITE_P(
    Lenses, WordFormulasOf,
    ::testing::Values(
        NamedLens{"radial", {LensModel::simple_radial, {-0.05}}},
        NamedLens{"opencv", {LensModel::opencv, {-0.02, 0.001, 0.001, -0.002}}},
        NamedLens{
            "rational",
            {LensModel::full_opencv, {-0.01, 0.002, 0.001, 0.002, 0.0003, 0.05, 0.01, 0.001}}},
        NamedLens{
            "tilted",
            {LensModel::opencv_14,
             {-0.01, 0.002, 0.001, 0.002, 0, 0, 0, 0, 0.001, -0.002, 0.004, 0.001, 0.05, -0.03}}},
        NamedLens{"pinhole_that_ends", {LensModel::pinhole, {}, 1.75}},
        NamedLens{"fov", {LensModel::fov, {1.25}}}, NamedLens{"pinhole_fov", {LensModel::fov, {0}}},
        NamedLens{"division", {LensModel::division, {-0.25}}},
        NamedLens{"stereographic", {LensModel::fisheye_stereographic}},
        NamedLens{"fisheye", {LensModel::fisheye}},
        NamedLens{"opencv_fisheye", {LensModel::opencv_fisheye, {0.05, -0.01, 0.002, 0.001}}},
        NamedLens{"thin_prisms",
                  {LensModel::thin_prism_fisheye,
                   {0.02, -0.005, 0.001, -0.002, 0.001, 0.0005, 0.003, -0.002}}},
        NamedLens{"orthographic", {LensModel::fisheye_orthographic}},
        NamedLens{"equisolid", {LensModel::fisheye_equisolid}},
        NamedLens{"unified", {LensModel::ucm, {0.625}}},
        NamedLens{"double_sphere", {LensModel::double_sphere, {-0.25, 0.6}}},
        NamedLens{"omnidirectional", {LensModel::omni, {0.875}}},
        NamedLens{"equirectangular", {LensModel::equirectangular}},
        NamedLens{"cylindrical", {LensModel::cylindrical}}, NamedLens{"table", {LensModel::table}}),
    [](const auto& lens) { return std::string(lens.param.name); });

}  // namespace
}  // namespace fathom::lens
