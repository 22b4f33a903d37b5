// Triangles drawn into a tile, as many samples at once as there are lanes of binary32.
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "fathom/fast/tiles/tile_lanes.cpp"
#include <hwy/foreach_target.h>  // must come before highway.h
#include <hwy/highway.h>

#include <algorithm>
#include <bit>
#include <limits>

#include "fathom/fast/bins/fetch-inl.h"
#include "fathom/fast/lanes/each_bit.h"
#include "fathom/fast/setup/setup-inl.h"
#include "fathom/fast/tiles/cell_drawing-inl.h"
#include "fathom/fast/tiles/cell_spans-inl.h"
#include "fathom/fast/tiles/farthest-inl.h"
#include "fathom/fast/tiles/lane_batch-inl.h"
#include "fathom/fast/tiles/tile.h"

// How to read this file: draw_triangles() draws the triangles that VisibleTriangles did not leave
// out as hidden. They are set up in binary64 (setup-inl.h) and turned into functions in binary32
// (lane_batch-inl.h). This file decides into which cells and blocks a triangle is drawn;
// cell_drawing-inl.h draws it.
HWY_BEFORE_NAMESPACE();
namespace fathom::fast::HWY_NAMESPACE {
namespace {

HWY_INLINE int cell_of(int place) {
  return place / cell * cell;
}

/// The cells of the whole box.
HWY_INLINE void draw_box(Tile& tile, const Drawn& t, const DrawContext& context) {
  const Cells cells{cell_of(t.first_column), cell_of(t.last_column), cell_of(t.first_row),
                    cell_of(t.last_row)};
  draw_cells<true>(tile, t, cells, context);
  context.statistics.samples_tested += static_cast<std::uint64_t>(
      (t.last_column - t.first_column + 1) * (t.last_row - t.first_row + 1));
}

/// The certain facts about a row of blocks of a tile, a bit for each block.
struct BlockRow {
  unsigned drawn, inside;
};

/// The functions of a triangle; the first is −∞ in columns that the box does not meet.
struct BlockFunctions {
  BlockFunction edges[3];
  BlockFunction q;
  float q_moves;
};

HWY_INLINE void leave_out_columns(const Drawn& t, BlockFunction& f) {
  const DF8 d;
  const int first = t.first_column / block, last = t.last_column / block;
  const auto first_met = hn::Set(d, static_cast<float>(first));
  const auto last_met = hn::Set(d, static_cast<float>(last));
  const auto none = hn::Set(d, -std::numeric_limits<float>::infinity());
  for (std::size_t part = 0; part < Tile::blocks_of_row; part += hn::Lanes(d)) {
    const auto number = counting_lanes(d, static_cast<float>(part));
    const auto is_met = hn::And(hn::Ge(number, first_met), hn::Le(number, last_met));
    float* const greatest = f.greatest.data() + part;
    float* const least = f.least.data() + part;
    hn::Store(hn::IfThenElse(is_met, hn::Load(d, greatest), none), d, greatest);
    hn::Store(hn::IfThenElse(is_met, hn::Load(d, least), none), d, least);
  }
}

HWY_INLINE void make_block_functions(const Drawn& t, BlockFunctions& f) {
  const LaneBatch& batch = t.batch;
  const std::size_t k = t.lane;
  const auto left = static_cast<float>(t.first_column);
  for (std::size_t i = 0; i < 3; ++i) {
    make_block_function(batch.edge_a[i][k], batch.edge_b[i][k], batch.edge_c[i][k], left,
                        f.edges[i]);
  }
  make_block_function(batch.q_a[k], batch.q_b[k], batch.q_c[k], left, f.q);
  f.q_moves = setup_bounds::q_moves * batch.q_error[k];
  leave_out_columns(t, f.edges[0]);
}

// Products and sums are rounded monotonically, so no sample of a block has a computed value above
// the value at the corner where the function is greatest, or below the value at the opposite
// corner; only blocks that the box meets count, and the bounds hold up to 8 samples beyond it.
// Hidden: no surface of the block has a q below the block's farthest q, and the triangle's greatest
// q, moved by twice its error, is below the farthest q (moved_q.gappa.in, at the sample where q is
// greatest; the computed value at the corner is not less, and rounding is monotone). A block that
// lies inside shows surfaces that are not farther than the triangle once it is drawn, at all its
// samples if it has no range to leave: its least q moved down by twice its error is not greater
// than any q there.
HWY_INLINE BlockRow look_at_blocks(Tile& tile, const Drawn& t, const BlockFunctions& f,
                                   int block_row, bool reject) {
  const DF8 d;
  const auto set = [](float x) HWY_ATTR { return hn::Set(DF8(), x); };
  const std::size_t lanes = hn::Lanes(d);
  const auto top = static_cast<float>(block_row * block - t.first_row);
  const auto error = set(t.batch.edge_error[t.lane]), minus_error = hn::Neg(error);
  BlockRow row{0, 0};
  for (std::size_t part = 0; part < Tile::blocks_of_row; part += lanes) {
    const auto greatest = [&](const BlockFunction& g) HWY_ATTR {
      return hn::MulAdd(set(g.b), set(top + g.greatest_y), hn::Load(d, g.greatest.data() + part));
    };
    const auto least = [&](const BlockFunction& g) HWY_ATTR {
      return hn::MulAdd(set(g.b), set(top + g.least_y), hn::Load(d, g.least.data() + part));
    };
    const auto least_of_edges = [&](const auto& of_edge) HWY_ATTR {
      return hn::Min(hn::Min(of_edge(f.edges[0]), of_edge(f.edges[1])), of_edge(f.edges[2]));
    };
    auto missed = hn::Lt(least_of_edges(greatest), minus_error);
    const auto inside = hn::Gt(least_of_edges(least), error);
    if (reject) {
      float* const farthest_at =
          tile.farthest().data() + static_cast<std::size_t>(block_row) * Tile::blocks_of_row + part;
      const auto farthest = hn::Load(d, farthest_at);
      missed = hn::Or(missed, hn::Lt(hn::Add(greatest(f.q), set(f.q_moves)), farthest));
      // NaN, of a triangle without a bound, is not greater.
      if (!t.test_range) {
        const auto here = hn::Sub(least(f.q), set(f.q_moves));
        const auto nearer = hn::And(inside, hn::Gt(here, farthest));
        hn::Store(hn::IfThenElse(nearer, here, farthest), d, farthest_at);
      }
    }
    row.drawn |= (lane_bits(d, missed) ^ ((1U << lanes) - 1)) << part;
    row.inside |= lane_bits(d, inside) << part;
  }
  return row;
}

/// Draws row by row of blocks. Leaves out blocks without a covered sample and blocks in which the
/// triangle lies behind everything drawn so far; does not test edges in blocks that lie inside the
/// triangle.
HWY_INLINE void draw_blocks(Tile& tile, const Drawn& t, const DrawContext& context) {
  constexpr std::uint8_t draws_until_update = 4;
  const bool reject = context.switches.early_rejection;
  BlockFunctions functions;
  make_block_functions(t, functions);
  for (int row = t.first_row / block; row <= t.last_row / block; ++row) {
    const BlockRow certain = look_at_blocks(tile, t, functions, row, reject);
    for (const std::size_t bit : EachBit(certain.drawn)) {
      const int number = static_cast<int>(bit);
      const int column = number * block;
      const int left = std::max(column, t.first_column);
      const int right = std::min(column + block - 1, t.last_column);
      const int top = std::max(row * block, t.first_row);
      const int bottom = std::min(row * block + block - 1, t.last_row);
      const Cells cells{cell_of(left), cell_of(right), cell_of(top), cell_of(bottom)};
      const bool inside = certain.inside >> number & 1;
      const bool drew = inside ? draw_cells<false>(tile, t, cells, context)
                               : draw_cells<true>(tile, t, cells, context);
      context.statistics.samples_tested +=
          static_cast<std::uint64_t>((right - left + 1) * (bottom - top + 1));
      if (!reject || !drew || (inside && !t.test_range)) continue;
      const auto block_number =
          static_cast<std::size_t>(row) * Tile::blocks_of_row + static_cast<std::size_t>(number);
      if (++tile.draws()[block_number] >= draws_until_update) {
        update_farthest(tile, block_number);
      }
    }
  }
}

/// The blocks in which a triangle is not hidden, as above, a bit for each, by rows of cells; blocks
/// that its box does not meet are irrelevant.
HWY_INLINE void find_open_blocks(Tile& tile, const LaneBatch& batch, std::size_t k,
                                 OfRows& open_blocks) {
  const DF8 d;
  BlockFunction q;
  make_block_function(batch.q_a[k], batch.q_b[k], batch.q_c[k],
                      static_cast<float>(batch.first_column[k]), q);
  const auto moves = hn::Set(d, setup_bounds::q_moves * batch.q_error[k]);
  for (int row = batch.first_row[k] / block; row <= batch.last_row[k] / block; ++row) {
    const auto y = static_cast<float>(row * block - batch.first_row[k]) + q.greatest_y;
    const auto number = static_cast<std::size_t>(row);
    unsigned open = 0;
    for (std::size_t part = 0; part < Tile::blocks_of_row; part += hn::Lanes(d)) {
      const auto greatest =
          hn::MulAdd(hn::Set(d, q.b), hn::Set(d, y), hn::Load(d, q.greatest.data() + part));
      const auto farthest =
          hn::Load(d, tile.farthest().data() + number * Tile::blocks_of_row + part);
      const auto hidden = hn::Lt(hn::Add(greatest, moves), farthest);
      open |= (lane_bits(d, hidden) ^ ((1U << hn::Lanes(d)) - 1)) << part;
    }
    open_blocks[2 * number] = open_blocks[2 * number + 1] = open;
  }
}

/// The cells that thin triangles of a batch may meet, for the lanes with few such cells.
struct ThinLanes {
  unsigned lanes = 0;
  std::array<CellList, SetupBatch::most> cells;
};

// Computed for all triangles before the first is drawn: each triangle ends with mispredicted jumps,
// after which the processor would have to wait for the cells of the next triangle.
HWY_NOINLINE void make_thin_lanes(Tile& tile, const LaneBatch& batch, unsigned lanes,
                                  const DrawContext& context, ThinLanes& thin) {
  SpanGuesses guesses;
  make_span_guesses(batch, guesses);
  CellSpans spans;
  alignas(64) OfRows open_blocks;
  open_blocks.fill(~0U);
  for (const std::size_t k : EachBit(lanes)) {
    make_cell_spans(batch, guesses, k, spans);
    if (spans.count > static_cast<int>(CellList::most)) continue;
    thin.lanes |= 1U << k;
    if (context.switches.early_rejection) find_open_blocks(tile, batch, k, open_blocks);
    list_cells(spans, open_blocks, thin.cells[k]);
  }
}

/// A function of its own, because inlining it would slow down the drawing of small triangles, which
/// are the majority.
HWY_NOINLINE void draw_large(Tile& tile, const Drawn& t, const ThinLanes& thin,
                             const DrawContext& context) {
  if (thin.lanes >> t.lane & 1) {
    draw_list(tile, t, thin.cells[t.lane], context);
  } else {
    draw_blocks(tile, t, context);
  }
}

/// The lanes of a batch whose boxes have at most two columns and two rows.
HWY_INLINE unsigned small_lanes(const SetupBatch& batch) {
  const auto [columns, rows] = box_sizes(batch);
  return bits_of(hn::Le(hn::Max(columns, rows), constant(1)));
}

/// The lanes of a batch whose boxes are drawn by blocks or spans.
HWY_INLINE unsigned large_lanes(const SetupBatch& batch) {
  const auto [columns, rows] = box_sizes(batch);
  return bits_of(hn::Ge(hn::Max(columns, rows), constant(3 * block)));
}

/// The lanes of a batch whose triangles are a few samples wide at most: their doubled areas, which
/// are the sums of the edge functions, over the longest sides. Nothing depends on it but time.
/// Needs    functions that are not scaled.
HWY_INLINE unsigned thin_lanes(const SetupBatch& batch) {
  constexpr double greatest_width = 4;
  V length = constant(0), area = constant(0);
  for (std::size_t i = 0; i < 3; ++i) {
    length = greatest_of(length, hn::Abs(load(batch.edge_a[i])), hn::Abs(load(batch.edge_b[i])));
    area = hn::Add(area, load(batch.edge_c[i]));
  }
  return bits_of(hn::Lt(area, hn::Mul(length, constant(greatest_width))));
}

/// One sample of each of the small triangles, by its column and row in their boxes: the decisions
/// of draw_cells(), those about edges in binary64 for all triangles at once.
HWY_INLINE void draw_sample_of_each(Tile& tile, const SetupBatch& setups, const LaneBatch& batch,
                                    unsigned drawn, int column, int row,
                                    const DrawContext& context) {
  const V x = constant(column), y = constant(row);
  const auto [columns, rows] = box_sizes(setups);
  const unsigned within = drawn & bits_of(hn::And(hn::Ge(columns, x), hn::Ge(rows, y)));
  if (within == 0) return;
  const auto value =
      [&](const SetupBatch::Numbers& a, const SetupBatch::Numbers& b, const SetupBatch::Numbers& c)
          HWY_ATTR { return hn::MulAdd(load(b), y, hn::MulAdd(load(a), x, load(c))); };
  const V least = least_of(value(setups.edge_a[0], setups.edge_b[0], setups.edge_c[0]),
                           value(setups.edge_a[1], setups.edge_b[1], setups.edge_c[1]),
                           value(setups.edge_a[2], setups.edge_b[2], setups.edge_c[2]));
  const V error = load(setups.edge_error);
  const unsigned open = within & bits_of(hn::Ge(least, hn::Neg(error)));
  const unsigned covered = bits_of(hn::Gt(least, error)) & ~setups.test_range;
  alignas(32) LaneBatch::Numbers q_of;
  hn::Store(to_binary32(value(setups.q_a, setups.q_b, setups.q_c)), D32(), q_of.data());
  std::uint64_t wins = 0;
  for (const std::size_t k : EachBit(open)) {
    const auto tile_column = static_cast<std::uint32_t>(batch.first_column[k] + column);
    const auto tile_row = static_cast<std::uint32_t>(batch.first_row[k] + row);
    const std::size_t i = Tile::index(tile_column, tile_row);
    const LaneTag tag = batch.tag[k];
    const float difference = q_of[k] - tile.q()[i];
    const float sum = std::bit_cast<float>(tag) + std::bit_cast<float>(tile.tags()[i]);
    if (difference < -sum) continue;
    if (difference > sum && (covered >> k & 1)) {
      tile.q()[i] = q_of[k];
      tile.tags()[i] = tag;
      ++wins;
    } else {
      tile.settle(setups.get(k), tag, setups.test_range >> k & 1,
                  tile.area().first_column + tile_column, tile.area().first_row + tile_row,
                  context);
    }
  }
  context.statistics.samples_tested += static_cast<unsigned>(std::popcount(within));
  context.statistics.samples_covered += wins;
}

/// Draws lanes of a batch that are not refused.
template <bool are_scaled>
HWY_INLINE void draw_batch(Tile& tile, const SetupBatch& setups, unsigned lanes, LaneBatch& batch,
                           const DrawContext& context) {
  const std::uint32_t place = tile.next_place();
  // Triangles of a batch may hide each other.
  make_surfaces(setups, tile.area(), tile.surfaces_at(place));
  const V extent = extent_of(setups);
  const double widening = context.switches.widening;
  make_lane_places(setups, tile.area(), place, extent, widening, batch);
  const std::uint64_t covered_before = context.statistics.samples_covered;
  const unsigned small = lanes & small_lanes(setups);
  if (small != 0) {
    for (int sample = 0; sample < 4; ++sample) {
      draw_sample_of_each(tile, setups, batch, small, sample % 2, sample / 2, context);
    }
  }
  if (lanes != small) make_lane_functions(setups, extent, widening, batch);
  const unsigned large =
      lanes != small && context.switches.hierarchy ? lanes & large_lanes(setups) : 0;
  // For scaled functions this is unknown.
  const unsigned maybe_thin = are_scaled || large == 0 ? large : large & thin_lanes(setups);
  ThinLanes thin;
  if (maybe_thin != 0) make_thin_lanes(tile, batch, maybe_thin, context, thin);
  for (const std::size_t k : EachBit(lanes & ~small)) {
    const Drawn t = drawn(setups, batch, k, setups.test_range >> k & 1, tile.is_partial());
    if (large >> k & 1) {
      draw_large(tile, t, thin, context);
    } else {
      draw_box(tile, t, context);
    }
  }
  if (context.statistics.samples_covered != covered_before) {
    tile.keep_surfaces(static_cast<std::uint32_t>(hn::Lanes(D())));
  }
}

/// Triangles that are drawn from exact numbers, or double-words, as many together as there are
/// lanes.
struct ExactBatch {
  SetupBatch setups{};
  std::size_t count = 0;
};

HWY_NOINLINE void draw_exactly(Tile& tile, ExactBatch& exact, const DrawContext& context) {
  LaneBatch lanes{};
  const unsigned drawn_lanes = (1U << exact.count) - 1;
  exact.setups.test_range = drawn_lanes;
  draw_batch<true>(tile, exact.setups, drawn_lanes, lanes, context);
  exact.count = 0;
}

/// Draws them once a batch is full.
HWY_NOINLINE void add_exactly(Tile& tile, std::uint32_t number, const PixelBox& box,
                              const DrawContext& context, ExactBatch& exact) {
  exact.setups.set(exact.count, context.set_up_exactly(number, box), box);
  if (++exact.count == hn::Lanes(D())) draw_exactly(tile, exact, context);
}

void draw_triangles(Tile& tile, const ImageObject& object, std::span<const std::uint32_t> numbers,
                    const DrawContext& context) {
  SetupBatch batch;
  LaneBatch lane_batch{};
  ExactBatch exact;
  for_each_triangles(
      object, numbers, [&](const Triangles& now, std::size_t, std::size_t count) HWY_ATTR {
        batch.number = now.number;
        set_up_lanes(object.vertices.get(), now.corners.data(), tile.area(), context.range, batch);
        if (HWY_UNLIKELY(context.switches.widening != 1)) widen(batch, context.switches.widening);
        const unsigned drawn_lanes = ((1U << count) - 1) & ~batch.empty;
        const unsigned certain = drawn_lanes & ~batch.refused;
        context.statistics.grid_setups +=
            static_cast<unsigned>(std::popcount(certain & batch.snapped));
        if (certain != 0) draw_batch<false>(tile, batch, certain, lane_batch, context);
        for (const std::size_t k : EachBit(drawn_lanes & batch.refused)) {
          add_exactly(tile, batch.number[k], batch.box(k), context, exact);
        }
      });
  if (exact.count != 0) draw_exactly(tile, exact, context);
}

}  // namespace
}  // namespace fathom::fast::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace fathom::fast {
using namespace triangle;

HWY_EXPORT(draw_triangles);

void Tile::draw(const ImageObject& object, std::span<const std::uint32_t> numbers,
                const DrawContext& context) {
  HWY_DYNAMIC_DISPATCH(draw_triangles)(*this, object, numbers, context);
}

}  // namespace fathom::fast
#endif
