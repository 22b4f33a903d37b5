// Rows of a tile's pixels as bits: samples, values, and pixels beside lines, against one by one.
#include "fathom/fast/coverage/tile_rows.h"

#include <gtest/gtest.h>

#include <random>

#include "fathom/fast/coverage/tile_functions.h"

namespace fathom {
namespace {

using namespace fast;

bool bit(const TileRows& rows, int column, int row) {
  return rows[static_cast<std::size_t>(row)] >> column & 1;
}

TEST(TileRows, ShowWhatSamplesShow) {
  std::mt19937_64 random(51);
  Tile tile;
  tile.start({0, 63, 0, 63});
  // Front faces have places 1 to 4, back faces 5 to 7.
  while (tile.next_place() < 5) tile.keep_surfaces(1);
  tile.begin_back_faces();
  while (tile.next_place() < 8) tile.keep_surfaces(1);
  std::uniform_int_distribution<std::uint32_t> place(0, 7);
  for (std::uint32_t i = 0; i < 64 * 64; ++i) {
    tile.tags()[i] = lane_tag(i % 3 == 0 ? 0 : place(random), 1e-3F);
  }
  TileRows shown, front;
  look_at_samples(tile, shown, front);
  for (std::uint32_t row = 0; row < 64; ++row) {
    for (std::uint32_t column = 0; column < 64; ++column) {
      const std::uint32_t its_place = Tile::place_of(tile.tags()[Tile::index(column, row)]);
      ASSERT_EQ(shown[row] >> column & 1, its_place != 0 ? 1U : 0U);
      ASSERT_EQ(front[row] >> column & 1, its_place != 0 && its_place < 5 ? 1U : 0U);
    }
  }
}

TEST(TileRows, BecomeValues) {
  std::mt19937_64 random(52);
  for (int i = 0; i < 20; ++i) {
    const std::uint64_t row = i == 0 ? 0 : i == 1 ? ~std::uint64_t{0} : random();
    MapRow<float> values;
    values.fill(7);
    to_coverage(row, values);
    for (std::size_t column = 0; column < 64; ++column) {
      ASSERT_EQ(values[column], row >> column & 1 ? 1.0F : 0.0F);
    }
  }
}

/// Triangles of all sizes and shapes, with level and upright sides, and errors.
std::array<UncertainHalfPlane, 3> triangle_from(std::mt19937_64& random) {
  std::uniform_real_distribution<double> place(-20, 84);
  std::uniform_int_distribution<int> choice(0, 3);
  std::array<SquarePoint, 3> p{};
  for (SquarePoint& corner : p) corner = {place(random), place(random)};
  if (choice(random) == 0) p[1].x = p[0].x;
  if (choice(random) == 0) p[2].y = p[0].y;
  if (choice(random) == 0) p[2] = {p[0].x + 0.5, p[0].y + 0.5};
  const double area = (p[1].x - p[0].x) * (p[2].y - p[0].y) - (p[1].y - p[0].y) * (p[2].x - p[0].x);
  if (area < 0) std::swap(p[1], p[2]);
  std::array<UncertainHalfPlane, 3> sides{};
  for (std::size_t k = 0; k < 3; ++k) {
    const SquarePoint &P = p[k], &Q = p[(k + 1) % 3];
    sides[k] = {P.y - Q.y, Q.x - P.x, P.x * Q.y - P.y * Q.x, choice(random) == 0 ? 1.0 : 1e-9};
  }
  return sides;
}

struct InPixel {
  bool inside = true, outside = false;
};
InPixel in_pixel(const std::array<UncertainHalfPlane, 3>& sides, int column, int row) {
  InPixel pixel;
  for (const UncertainHalfPlane& side : sides) {
    const auto [least, greatest] = values_in_pixel(side, column, row);
    pixel.inside = pixel.inside && least > side.error;
    pixel.outside = pixel.outside || greatest < -side.error;
  }
  return pixel;
}

TEST(TileRows, OfTrianglesHoldThePixelsInsideAndMet) {
  std::mt19937_64 random(53);
  int found = 0, inside = 0, listed = 0, met = 0;
  for (int i = 0; i < 400; ++i) {
    SCOPED_TRACE(i);
    const auto sides = triangle_from(random);
    const TileBox box = i % 2 ? TileBox{0, 63, 0, 63} : TileBox{5, 40, 7, 33};
    TileRows in{}, may_meet{};
    in[3] = 1;
    may_meet[60] = 6;
    add_pixels_inside(sides, box, in);
    find_pixels_met(sides, box, may_meet);
    ASSERT_TRUE(bit(in, 0, 3));  // what was there stays
    if (i % 2 == 0) {
      ASSERT_EQ(in[3], 1U);
      ASSERT_EQ(may_meet[60], 6U);
    }
    for (int row = box.top; row <= box.bottom; ++row) {
      for (int column = 0; column < 64; ++column) {
        const bool in_box = box.left <= column && column <= box.right;
        const InPixel pixel = in_pixel(sides, column, row);
        if (bit(in, column, row) && !(row == 3 && column == 0)) {
          ASSERT_TRUE(in_box && pixel.inside);
          ++found;
        }
        if (in_box && pixel.inside) ++inside;
        if (in_box && !pixel.outside) {
          ASSERT_TRUE(bit(may_meet, column, row)) << column << " " << row;
          ++met;
        }
        if (bit(may_meet, column, row)) {
          ASSERT_TRUE(in_box);
          ++listed;
        }
      }
    }
  }
  // Few at the ends of rows are not found, or listed in vain.
  EXPECT_GT(found, inside * 9 / 10);
  EXPECT_LT(listed, met * 3 / 2);
}

}  // namespace
}  // namespace fathom
