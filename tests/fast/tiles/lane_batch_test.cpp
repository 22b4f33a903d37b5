// What tiles compute in binary32, for the vector instructions that every processor has: functions
// and their bounds from both sides, surfaces over a tile, and which triangles are left out as
// hidden.
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <set>

#include "fathom/fast/tiles/farthest-inl.h"
#include "fathom/fast/tiles/lane_batch-inl.h"
#include "tests/effort.h"
#include "tests/numeric/error_shares.h"
#include "tests/numeric/random_numbers.h"

namespace fathom {
namespace {

using namespace fast;
using namespace checks;
namespace lanes = fast::HWY_NAMESPACE;

constexpr PixelBox area{128, 191, 64, 127};

/// One function, the same in every lane and for all three edges and q, without an error of its own.
struct OneFunction {
  SetupBatch setups{};
  double a, b, c;
  std::uint32_t columns, rows;

  explicit OneFunction(Numbers& n) {
    const double size = std::ldexp(1, n.below(40) - 20);
    a = n.unit() * size * (n.below(8) == 0 ? 0 : 1);
    b = n.unit() * size * std::ldexp(1, -n.below(30));
    c = n.unit() * size * std::ldexp(1, n.below(8));
    columns = static_cast<std::uint32_t>(n.below(64));
    rows = static_cast<std::uint32_t>(n.below(64));
    fill();
  }
  OneFunction(double the_a, double the_b, double the_c, std::uint32_t side)
      : a(the_a), b(the_b), c(the_c), columns(side), rows(side) {
    fill();
  }
  void fill() {
    for (std::size_t i = 0; i < 3; ++i) {
      setups.edge_a[i].fill(a);
      setups.edge_b[i].fill(b);
      setups.edge_c[i].fill(c);
    }
    setups.q_a.fill(a);
    setups.q_b.fill(b);
    setups.q_c.fill(c);
    setups.first_column.fill(area.last_column - columns);
    setups.last_column.fill(area.last_column);
    setups.first_row.fill(area.last_row - rows);
    setups.last_row.fill(area.last_row);
    setups.number.fill(4711);
  }
  [[nodiscard]] lanes::LaneBatch in_lanes(std::uint32_t place) const {
    lanes::LaneBatch batch{};
    lanes::make_lane_places(setups, area, place, lanes::extent_of(setups), 1, batch);
    lanes::make_lane_functions(setups, lanes::extent_of(setups), 1, batch);
    return batch;
  }
  [[nodiscard]] Dyadic exact(int x, int y) const {
    return Dyadic(a) * Dyadic(x) + Dyadic(b) * Dyadic(y) + Dyadic(c);
  }
};

/// A column or row of a box, or up to 7 beyond it.
int place_from(Numbers& n, std::uint32_t side) {
  return n.below(static_cast<int>(side) + 15) - 7;
}

TEST(LaneShares, OfFunctionsInBinary32) {
  Numbers n(61);
  Share edges, q;
  for (int i = 0; i < 20000 / effort; ++i) {
    const OneFunction f(n);
    const lanes::LaneBatch batch = f.in_lanes(3);
    // Of the scale only a coefficient tells.
    const double scale = f.c == 0 ? 0 : std::exp2(std::round(std::log2(batch.edge_c[0][0] / f.c)));
    const int x = place_from(n, f.columns), y = place_from(n, f.rows);
    const auto fx = static_cast<float>(x), fy = static_cast<float>(y);
    const float edge = batch.edge_b[0][0] * fy + (batch.edge_a[0][0] * fx + batch.edge_c[0][0]);
    if (scale > 0)
      edges.add(edge, Ratio(f.exact(x, y).scaled(std::ilogb(scale))), batch.edge_error[0]);
    const float value = batch.q_b[0] * fy + (batch.q_a[0] * fx + batch.q_c[0]);
    q.add(value, Ratio(f.exact(x, y)), batch.q_error[0]);
    EXPECT_EQ(Tile::place_of(batch.tag[0]), 3U);
    const auto error = std::bit_cast<float>(batch.tag[0]);
    EXPECT_GE(error, batch.q_error[0]);
    EXPECT_LE(error, batch.q_error[0] * (1 + 0x1p-6F));
    EXPECT_EQ(batch.last_column[0], 63);
    EXPECT_EQ(batch.first_row[0], 63 - static_cast<int>(f.rows));
  }
  expect_share(edges.publish("lane_edges"), 0.2);
  expect_share(q.publish("lane_q"), 0.2);
}

TEST(LaneShares, OfSurfacesOverTheTile) {
  Numbers n(62);
  Share share;
  for (int i = 0; i < 20000 / effort; ++i) {
    const OneFunction f(n);
    alignas(64) std::array<TileSurface, SetupBatch::most> surfaces;
    lanes::make_surfaces(f.setups, area, surfaces.data());
    const int column = n.below(64), row = n.below(64);
    EXPECT_EQ(surfaces[0].number(), 4711U);
    share.add(surfaces[0].q(column, row),
              Ratio(f.exact(column - 63 + static_cast<int>(f.columns),
                            row - 63 + static_cast<int>(f.rows))),
              surfaces[0].error());
  }
  expect_share(share.publish("tile_q"), 0.1);
}

/// On the grid, while they are below 2⁷: multiples of 2⁻¹⁷, each of which binary32 holds.
TEST(LaneBatch, FunctionsOnTheGridOfSmallTrianglesAreExact) {
  Numbers n(63);
  int zeroes = 0;
  for (int i = 0; i < 4000 / effort; ++i) {
    const auto on_grid = [&] { return (n.below(1025) - 512) * 0x1p-8; };
    const double a = on_grid(), b = on_grid();
    const int u = n.below(4), v = n.below(4);
    // Through the sample (u, v), or beside it.
    const double c = -a * u - b * v + (n.below(3) - 1) * 0x1p-16 + 0x1p-17;
    OneFunction f(a, b, c, 3);
    f.setups.snapped = 0xFF;
    for (auto& error : f.setups.edge_error) error = 0x1p-18;
    const lanes::LaneBatch batch = f.in_lanes(1);
    const double size = (std::abs(a) + std::abs(b)) * 11 + std::abs(c);
    if (size >= 128) continue;
    for (int y = 0; y <= 3; ++y) {
      for (int x = 0; x <= 3; ++x) {
        const float edge = batch.edge_b[0][0] * static_cast<float>(y) +
                           (batch.edge_a[0][0] * static_cast<float>(x) + batch.edge_c[0][0]);
        EXPECT_EQ(edge > batch.edge_error[0], f.exact(x, y).sign() == Sign::positive);
        EXPECT_EQ(edge < -batch.edge_error[0], f.exact(x, y).sign() == Sign::negative);
        zeroes += x == u && y == v;
      }
    }
  }
  EXPECT_GT(zeroes, 1000 / effort);
}

TEST(LaneBatch, WhatMayOverflowHasNoBound) {
  for (const double size : {0x1p99, 0x1p101, 0x1p127, 0x1p130, 1e300}) {
    const OneFunction f(0, 0, size, 3);
    const auto error = std::bit_cast<float>(f.in_lanes(5).tag[0]);
    EXPECT_EQ(std::isnan(error), size > 0x1p100) << size;
  }
}

/// Triangles that are left out are those whose q is below that of every block that they meet.
TEST(Farthest, LeavesOutWhatIsHidden) {
  Numbers n(65);
  int hidden = 0, seen = 0;
  for (int i = 0; i < 200 / effort; ++i) {
    Tile tile;
    tile.start({0, 63, 0, 63});
    for (std::size_t s = 0; s < Tile::size * Tile::size; ++s) {
      tile.q()[s] = static_cast<float>(2 + n.unit());
      tile.tags()[s] = lane_tag(1, 0x1p-20F);
    }
    lanes::FarthestOfBlocks farthest;
    ASSERT_TRUE(lanes::find_farthest(tile, farthest));
    std::vector<TileEntry> entries;
    std::vector<std::uint32_t> expected, required;
    for (std::uint32_t number = 0; number < 37; ++number) {
      const auto q = static_cast<float>(1 + n.unit() / 4);
      std::array<std::uint32_t, 2> first{}, last{};
      for (std::size_t k = 0; k < 2; ++k) {
        first[k] = static_cast<std::uint32_t>(n.below(8));
        last[k] = std::min(7U, first[k] + static_cast<std::uint32_t>(n.below(4)));
      }
      entries.push_back({number, nearness_in(moved_up_in_24_bits(std::bit_cast<std::uint32_t>(q)),
                                             first[0], last[0], first[1], last[1])});
      float least = std::numeric_limits<float>::infinity();
      for (std::uint32_t row = first[1]; row <= last[1]; ++row) {
        for (std::uint32_t column = first[0]; column <= last[0]; ++column) {
          least = std::min(least, tile.farthest()[row * 8 + column]);
        }
      }
      if (!(q < least)) required.push_back(number);
    }
    std::array<std::uint32_t, 64> visible;
    const std::size_t count = lanes::leave_out_hidden(farthest, entries, visible.data());
    const std::set<std::uint32_t> kept(visible.begin(),
                                       visible.begin() + static_cast<std::ptrdiff_t>(count));
    EXPECT_EQ(kept.size(), count);
    for (const std::uint32_t number : required) EXPECT_EQ(kept.count(number), 1U);
    seen += static_cast<int>(required.size());
    hidden += static_cast<int>(entries.size() - count);
  }
  EXPECT_GT(hidden, 500 / effort);
  EXPECT_GT(seen, 500 / effort);
}

TEST(Farthest, IsThatOfEveryBlock) {
  Numbers n(66);
  Tile tile;
  tile.start({0, 63, 0, 63});
  lanes::FarthestOfBlocks farthest;
  EXPECT_FALSE(lanes::find_farthest(tile, farthest));
  std::array<float, Tile::blocks> least;
  least.fill(std::numeric_limits<float>::infinity());
  for (std::uint32_t row = 0; row < 64; ++row) {
    for (std::uint32_t column = 0; column < 64; ++column) {
      const std::size_t s = Tile::index(column, row);
      tile.q()[s] = static_cast<float>(2 + n.unit());
      tile.tags()[s] = lane_tag(1, 0x1p-20F);
      float& block = least[row / 8 * 8 + column / 8];
      block = std::min(block, tile.q()[s]);
    }
  }
  tile.tags()[Tile::index(9, 17)] = lane_tag(1, std::numeric_limits<float>::infinity());
  ASSERT_TRUE(lanes::find_farthest(tile, farthest));
  for (std::size_t k = 0; k < Tile::blocks; ++k) {
    const float found = tile.farthest()[k];
    if (k == 2 * 8 + 1) {
      EXPECT_EQ(found, -std::numeric_limits<float>::infinity());
      continue;
    }
    EXPECT_LT(found, least[k]);
    EXPECT_GT(found, least[k] - 0x1p-18F);
  }
}

}  // namespace
}  // namespace fathom
