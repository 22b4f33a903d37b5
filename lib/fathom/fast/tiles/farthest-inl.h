// How far away the surfaces of a tile are, and which triangles are hidden by them. Included once
// for every kind of vector instructions, by the files that foreach_target.h compiles for each.
#if defined(FATHOM_FAST_FARTHEST_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef FATHOM_FAST_FARTHEST_INL_H
#undef FATHOM_FAST_FARTHEST_INL_H
#else
#define FATHOM_FAST_FARTHEST_INL_H
#endif

#include <hwy/highway.h>

#include <algorithm>
#include <limits>
#include <span>

#include "fathom/fast/bins/nearness.h"
#include "fathom/fast/setup/setup-inl.h"
#include "fathom/fast/tiles/lane_batch-inl.h"
#include "fathom/fast/tiles/tile.h"

HWY_BEFORE_NAMESPACE();
namespace fathom::fast::HWY_NAMESPACE {
namespace {

constexpr std::uint32_t blocks_of_row = Tile::blocks_of_row;

// The least q, moved by twice its error: not greater than any exact q (moved_q.gappa.in). If a
// surface has no bound (NaN), the result is unknown.
HWY_INLINE void update_farthest(Tile& tile, std::size_t block_number) {
  const DF d;
  const DT dt;
  const std::size_t lanes = hn::Lanes(d);
  const auto column = static_cast<std::uint32_t>(block_number % blocks_of_row * Tile::block);
  const auto row = static_cast<std::uint32_t>(block_number / blocks_of_row * Tile::block);
  // Cells that are next to each other in a row are so in memory.
  constexpr std::size_t samples = Tile::block * Tile::cell;
  VF least = hn::Set(d, std::numeric_limits<float>::infinity());
  MF known = hn::Eq(least, least);
  for (const std::size_t start :
       {Tile::index(column, row), Tile::index(column, row + Tile::cell)}) {
    for (std::size_t i = start; i < start + samples; i += lanes) {
      const VF error = hn::BitCast(d, hn::Load(dt, tile.tags() + i));
      least = hn::Min(least, hn::NegMulAdd(hn::Set(d, setup_bounds::q_moves), error,
                                           hn::Load(d, tile.q() + i)));
      known = hn::And(known, hn::Eq(error, error));
    }
  }
  tile.farthest()[block_number] = hn::AllTrue(d, known) ? hn::GetLane(hn::MinOfLanes(d, least))
                                                        : -std::numeric_limits<float>::infinity();
  tile.draws()[block_number] = 0;
}

/// For each block the farthest q of the two by two, and of the four by four blocks that begin with
/// it.
struct FarthestOfBlocks {
  alignas(64) std::array<float, Tile::blocks> two;
  alignas(64) std::array<float, Tile::blocks> four;
};

/// The least of what square blocks of `step` begin with: at each place, those that are `step` to
/// the right and below.
HWY_INLINE void least_of_squares(const std::array<float, Tile::blocks>& from, std::uint32_t step,
                                 std::array<float, Tile::blocks>& to) {
  for (std::uint32_t row = 0; row < blocks_of_row; ++row) {
    const std::uint32_t below = std::min(row + step, blocks_of_row - 1);
    for (std::uint32_t column = 0; column < blocks_of_row; ++column) {
      const std::uint32_t right = std::min(column + step, blocks_of_row - 1);
      const auto at = [&](std::uint32_t r, std::uint32_t c) { return from[r * blocks_of_row + c]; };
      to[row * blocks_of_row + column] = std::min(std::min(at(row, column), at(row, right)),
                                                  std::min(at(below, column), at(below, right)));
    }
  }
}

/// Computes the farthest q of all blocks. Returns whether one of them hides anything.
HWY_INLINE bool find_farthest(Tile& tile, FarthestOfBlocks& farthest) {
  for (std::size_t number = 0; number < Tile::blocks; ++number) update_farthest(tile, number);
  const float greatest = *std::max_element(tile.farthest().begin(), tile.farthest().end());
  if (greatest == -std::numeric_limits<float>::infinity()) return false;
  least_of_squares(tile.farthest(), 1, farthest.two);
  least_of_squares(farthest.two, 2, farthest.four);
  return true;
}

/// Copies the numbers of triangles that may be visible; returns how many there are.
HWY_INLINE std::size_t leave_out_hidden(const FarthestOfBlocks& farthest,
                                        std::span<const TileEntry> entries,
                                        std::uint32_t* visible) {
  const DF8 d;
  const hn::Rebind<std::uint32_t, DF8> du;
  const DI8 di;
  const std::size_t lanes = hn::Lanes(d);
  std::size_t count = 0;
  for (std::size_t first = 0; first < entries.size(); first += lanes) {
    const std::size_t here = std::min(lanes, entries.size() - first);
    TileEntry last[SetupBatch::most] = {};
    const TileEntry* from = entries.data() + first;
    if (here < lanes) from = std::copy_n(from, here, last) - here;
    hn::Vec<decltype(du)> number, nearness;
    hn::LoadInterleaved2(du, &from->number, number, nearness);
    const auto q = hn::BitCast(d, hn::And(nearness, hn::Set(du, nearness_of_q)));
    const auto place = hn::BitCast(di, hn::And(nearness, hn::Set(du, nearness_of_block)));
    const auto is_more = hn::Ne(hn::And(nearness, hn::Set(du, nearness_of_more)), hn::Zero(du));
    const auto least =
        hn::IfThenElse(hn::RebindMask(d, is_more), hn::GatherIndex(d, farthest.four.data(), place),
                       hn::GatherIndex(d, farthest.two.data(), place));
    const auto open = hn::AndNot(hn::RebindMask(du, hn::Lt(q, least)), hn::FirstN(du, here));
    count += hn::CompressStore(number, open, du, visible + count);
  }
  return count;
}

}  // namespace
}  // namespace fathom::fast::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif  // per-target include guard
