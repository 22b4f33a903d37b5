// How far away the surfaces of a tile are, and which triangles are hidden by them. Included once for
// every kind of vector instructions, by the files that foreach_target.h compiles for each.
#if defined(FATHOM_FAST_FARTHEST_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef FATHOM_FAST_FARTHEST_INL_H
#undef FATHOM_FAST_FARTHEST_INL_H
#else
#define FATHOM_FAST_FARTHEST_INL_H
#endif

#include <hwy/cache_control.h>
#include <hwy/highway.h>

#include <algorithm>
#include <limits>
#include <span>

#include "fathom/fast/lane_batch-inl.h"
#include "fathom/fast/setup-inl.h"
#include "fathom/fast/tile.h"

HWY_BEFORE_NAMESPACE();
namespace fathom::fast::HWY_NAMESPACE {
namespace {

constexpr std::uint32_t blocks_of_row = Tile::size / Tile::block;

// The least q, moved by twice its error: not greater than any exact q (moved_q.gappa.in). If a
// surface has no bound (NaN), nothing is known.
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
/// it, and the greatest of all blocks.
struct FarthestOfBlocks {
  alignas(64) std::array<float, Tile::blocks> two;
  alignas(64) std::array<float, Tile::blocks> four;
  float greatest;
};

/// The least of what square blocks of `step` begin with: at each place, those that are `step` to the
/// right and below.
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
  farthest.greatest = *std::max_element(tile.farthest().begin(), tile.farthest().end());
  if (farthest.greatest == -std::numeric_limits<float>::infinity()) return false;
  least_of_squares(tile.farthest(), 1, farthest.two);
  least_of_squares(farthest.two, 2, farthest.four);
  return true;
}

/// Triangles to draw, as many as there are lanes (the last one repeated if there are fewer).
struct Triangles {
  std::array<std::uint32_t, SetupBatch::most> number;
  std::array<CornerIndices, SetupBatch::most> corners;
};

/// Reads those from `first` on, and prefetches those that come next: triangles of a tile may be
/// anywhere in the mesh.
HWY_INLINE void fetch(const ImageObject& object, std::span<const std::uint32_t> numbers,
                      std::size_t first, Triangles& next) {
  const std::size_t lanes = hn::Lanes(D());
  const CornerIndices* triangles = object.mesh.triangles.data();
  for (std::size_t k = 0; k < lanes; ++k) {
    const std::size_t i = std::min(first + k, numbers.size() - 1);
    const std::size_t later = std::min(i + 2 * lanes, numbers.size() - 1);
    hwy::Prefetch(triangles + (numbers[later] - object.first_number));
    next.number[k] = numbers[i];
    next.corners[k] = triangles[numbers[i] - object.first_number];
    for (const std::uint32_t vertex : next.corners[k]) hwy::Prefetch(&object.vertices[vertex]);
  }
}

/// The lanes whose triangles are certainly hidden by what is drawn, or have no sample in the tile.
//
// A covered sample's q lies between those of the corners, and that of a corner, moved by twice its
// bound, beyond the exact one (moved_q.gappa.in: no bound of a usable corner's q is below u│q│).
// Triangles are looked at if they meet at most four by four blocks: larger ones are left out by
// blocks (draw_blocks() in tile_lanes.cpp).
HWY_INLINE unsigned hidden_lanes(const Corners& t, const Tile& tile,
                                 const FarthestOfBlocks& farthest) {
  const hn::Rebind<std::int32_t, D> di;
  const hn::Rebind<float, D> d32;
  const D d;
  const M usable = are_usable(t);
  const Boxes box = sample_boxes(t, tile.area());
  const M empty = hn::And(usable, are_empty(box));
  const V q =
      hn::MulAdd(constant(setup_bounds::q_moves), t.q_error, greatest_of(t.A.q, t.B.q, t.C.q));
  const V share = constant(1.0 / Tile::block);
  const auto block_of = [&](V place, std::uint32_t origin) HWY_ATTR {
    return hn::Floor(hn::Mul(hn::Sub(place, constant(origin)), share));
  };
  const V left = block_of(box.first_column, tile.area().first_column);
  const V right = block_of(box.last_column, tile.area().first_column);
  const V top = block_of(box.first_row, tile.area().first_row);
  const V bottom = block_of(box.last_row, tile.area().first_row);
  const V blocks = hn::Max(hn::Sub(right, left), hn::Sub(bottom, top));
  const M open =
      hn::AndNot(empty, hn::And(hn::And(usable, hn::Le(blocks, constant(3))),
                                hn::Lt(q, constant(static_cast<double>(farthest.greatest)))));
  if (hn::AllFalse(d, open)) return bits_of(empty);
  const V place = hn::MulAdd(top, constant(blocks_of_row), left);
  const auto index = hn::DemoteTo(di, hn::IfThenElseZero(open, place));
  const V two = hn::PromoteTo(d, hn::GatherIndex(d32, farthest.two.data(), index));
  const V four = hn::PromoteTo(d, hn::GatherIndex(d32, farthest.four.data(), index));
  const V least = hn::IfThenElse(hn::Le(blocks, constant(1)), two, four);
  return bits_of(hn::Or(empty, hn::And(open, hn::Lt(q, least))));
}

/// Copies the numbers of triangles that may be visible; returns how many there are.
HWY_INLINE std::size_t leave_out_hidden(const Tile& tile, const FarthestOfBlocks& farthest,
                                        const ImageObject& object,
                                        std::span<const std::uint32_t> numbers,
                                        std::uint32_t* visible) {
  const std::size_t lanes = hn::Lanes(D());
  std::size_t count = 0;
  Triangles next{};
  fetch(object, numbers, 0, next);
  for (std::size_t first = 0; first < numbers.size(); first += lanes) {
    const Triangles now = next;
    fetch(object, numbers, first + lanes, next);
    const std::size_t here = std::min(lanes, numbers.size() - first);
    const unsigned hidden =
        hidden_lanes(load_corners(object.vertices.get(), now.corners.data()), tile, farthest);
    for (std::size_t k = 0; k < here; ++k) {
      visible[count] = now.number[k];
      count += ~hidden >> k & 1;
    }
  }
  return count;
}

}  // namespace
}  // namespace fathom::fast::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif  // per-target include guard
