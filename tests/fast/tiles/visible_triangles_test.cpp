#include "fathom/fast/tiles/visible_triangles.h"

#include <gtest/gtest.h>

#include <bit>
#include <memory>

#include "fathom/fast/tiles/tile.h"

namespace fathom {
namespace {

using namespace fast;

/// A tile in which one surface with q = 1 is seen everywhere.
std::unique_ptr<Tile> tile_of_one_surface() {
  auto tile = std::make_unique<Tile>();
  tile->start({0, 63, 0, 63});
  const std::uint32_t place = tile->next_place();
  *tile->surfaces_at(place) = {1, 0, 0, surface_tag(7, 0x1p-40)};
  tile->keep_surfaces(1);
  for (std::size_t i = 0; i < Tile::samples; ++i) {
    tile->q()[i] = 1;
    tile->tags()[i] = lane_tag(place, 0x1p-20F);
  }
  return tile;
}

/// In the blocks from the second to the third column and row.
TileEntry entry_with(std::uint32_t number, float greatest_q) {
  return {number,
          nearness_in(moved_up_in_24_bits(std::bit_cast<std::uint32_t>(greatest_q)), 1, 2, 1, 2)};
}

std::vector<std::uint32_t> drawn(VisibleTriangles& triangles, Tile& tile, bool reject) {
  std::vector<std::uint32_t> numbers;
  triangles.for_each_part(tile, reject, [&](std::span<const std::uint32_t> part) {
    numbers.insert(numbers.end(), part.begin(), part.end());
  });
  return numbers;
}

TEST(VisibleTriangles, LeaveOutThoseBehindTheTile) {
  const auto tile = tile_of_one_surface();
  VisibleTriangles triangles;
  std::vector<std::uint32_t> all, near;
  for (std::uint32_t number = 0; number < 600; ++number) {
    const bool is_near = number % 3 == 0;
    triangles.entries().push_back(entry_with(number, is_near ? 2.0F : 0.5F));
    all.push_back(number);
    if (is_near) near.push_back(number);
  }
  EXPECT_EQ(drawn(triangles, *tile, true), near);
  EXPECT_EQ(drawn(triangles, *tile, false), all);
}

/// Where none was hidden in a part, the next ones are drawn unseen.
TEST(VisibleTriangles, AreNotLookedForWhereThatDoesNotPay) {
  const auto tile = tile_of_one_surface();
  VisibleTriangles triangles;
  for (std::uint32_t number = 0; number < 512; ++number) {
    triangles.entries().push_back(entry_with(number, number < 256 ? 2.0F : 0.5F));
  }
  EXPECT_EQ(drawn(triangles, *tile, true).size(), 512U);
}

TEST(VisibleTriangles, AreAllWhereTheTileIsEmpty) {
  const auto tile = std::make_unique<Tile>();
  tile->start({0, 63, 0, 63});
  VisibleTriangles triangles;
  for (std::uint32_t number = 0; number < 20; ++number) {
    triangles.entries().push_back(entry_with(number, 0.5F));
  }
  EXPECT_EQ(drawn(triangles, *tile, true).size(), 20U);
}

}  // namespace
}  // namespace fathom
