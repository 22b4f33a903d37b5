// A triangle drawn into cells of a tile, as many samples at once as there are lanes of binary32:
// its functions in binary32 decide about nearly every sample, Tile::settle() does about the rest.
// Included once for every kind of vector instructions, by the files that foreach_target.h compiles
// for each.
#if defined(FATHOM_FAST_CELL_DRAWING_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef FATHOM_FAST_CELL_DRAWING_INL_H
#undef FATHOM_FAST_CELL_DRAWING_INL_H
#else
#define FATHOM_FAST_CELL_DRAWING_INL_H
#endif

#include <hwy/highway.h>

#include "fathom/fast/lanes/each_bit.h"
#include "fathom/fast/setup/setup-inl.h"
#include "fathom/fast/tiles/cell_spans-inl.h"
#include "fathom/fast/tiles/lane_batch-inl.h"
#include "fathom/fast/tiles/tile.h"
#include "fathom/numeric/interval.h"

HWY_BEFORE_NAMESPACE();
namespace fathom::fast::HWY_NAMESPACE {
namespace {

/// One triangle's functions, the same in every lane.
struct Functions {
  VF a[3], b[3], c[3];
  VF error;
  VF q_a, q_b, q_c;
};

HWY_INLINE Functions functions_of(const LaneBatch& batch, std::size_t k) {
  Functions f;
  for (std::size_t i = 0; i < 3; ++i) {
    f.a[i] = constant32(batch.edge_a[i][k]);
    f.b[i] = constant32(batch.edge_b[i][k]);
    f.c[i] = constant32(batch.edge_c[i][k]);
  }
  f.error = constant32(batch.edge_error[k]);
  f.q_a = constant32(batch.q_a[k]);
  f.q_b = constant32(batch.q_b[k]);
  f.q_c = constant32(batch.q_c[k]);
  return f;
}

/// The triangle that is drawn: a lane of a batch.
struct Drawn {
  const SetupBatch& setups;
  const LaneBatch& batch;
  std::size_t lane;
  bool test_range;
  /// Whether the box may end where the image does.
  bool is_clipped;
  /// Its box within the tile.
  int first_column, last_column, first_row, last_row;
};

HWY_INLINE Drawn drawn(const SetupBatch& setups, const LaneBatch& batch, std::size_t k,
                       bool test_range, bool is_clipped) {
  return {setups,
          batch,
          k,
          test_range,
          is_clipped,
          batch.first_column[k],
          batch.last_column[k],
          batch.first_row[k],
          batch.last_row[k]};
}

/// A bit for each sample of the cell that begins at this column and row of the tile.
HWY_NOINLINE void settle_samples(Tile& tile, const Drawn& t, unsigned samples, int column, int row,
                                 const DrawContext& context) {
  const TriangleSetup setup = t.setups.get(t.lane);
  for (const std::size_t number : EachBit(samples)) {
    const int sample = static_cast<int>(number);
    const int x = column + sample % cell, y = row + sample / cell;
    // Cells reach beyond the box, where the triangle covers no sample.
    if (x < t.first_column || x > t.last_column || y < t.first_row || y > t.last_row) continue;
    tile.settle(setup, t.batch.tag[t.lane], t.test_range,
                tile.area().first_column + static_cast<std::uint32_t>(x),
                tile.area().first_row + static_cast<std::uint32_t>(y), context);
  }
}

/// Cells of the tile, by the columns and rows of their first samples.
struct Cells {
  int first_column, last_column, first_row, last_row;
};

/// The ends of the range of depths in binary32: q between the first two is within, beyond one of
/// the others not.
struct RangeEnds {
  VF least, greatest;
  VF outside_least, outside_greatest;
};
HWY_INLINE RangeEnds range_ends(const DepthRange& range) {
  return {constant32(round_up(range.inside_least)), constant32(round_down(range.inside_greatest)),
          constant32(round_down(range.outside_least)),
          constant32(round_up(range.outside_greatest))};
}

/// The data for drawing a triangle's cells, the same in every lane.
template <bool test_edges, bool test_range>
struct Pen {
  Tile& tile;
  const Drawn& t;
  const DrawContext& context;
  Functions f;
  VF last_x, last_y;
  VF minus_error;
  hn::Vec<DT> tag;
  RangeEnds ends;

  /// The functions at x = 0 of a row of samples.
  struct AtRow {
    VF edges[3];
    VF q;
  };
  HWY_INLINE AtRow at_row(VF y) const {
    return {{hn::MulAdd(f.b[0], y, f.c[0]), hn::MulAdd(f.b[1], y, f.c[1]),
             hn::MulAdd(f.b[2], y, f.c[2])},
            hn::MulAdd(f.q_b, y, f.q_c)};
  }
  template <class Settle>
  HWY_INLINE std::size_t draw(VF x, VF y, const AtRow& at_x_0, std::size_t at,
                              const Settle& settle) const;
};

template <bool test_edges, bool test_range>
HWY_INLINE Pen<test_edges, test_range> pen(Tile& tile, const Drawn& t, const DrawContext& context) {
  const Functions f = functions_of(t.batch, t.lane);
  RangeEnds ends{};
  if constexpr (test_range) ends = range_ends(context.range);
  return {tile,
          t,
          context,
          f,
          constant32(static_cast<float>(t.last_column - t.first_column)),
          constant32(static_cast<float>(t.last_row - t.first_row)),
          hn::Neg(f.error),
          hn::Set(DT(), t.batch.tag[t.lane]),
          ends};
}

// At every sample the triangle is certainly the nearest surface so far ("wins"), or certainly not
// ("loses"), or neither is certain. The third case is settled by binary64, or exactly.
//
// d is the difference of two values of q with a relative error of 2⁻²⁴; the sum of their errors has
// one too, and both errors leave out q_left of themselves: d > sum implies that the exact q of this
// triangle is greater (validation/proofs/q/nearer_q.gappa.in). Where the triangle does not cover
// the sample the bound on q does not hold, but then "loses" is right anyway. Ends of the range are
// compared with q moved by twice its error: a bound on q is never below 2⁻²⁴·|q|, so the second
// half covers the rounding of the end (moved_q.gappa.in).
// Samples of the cells beyond the box are not covered, unless the box ends where the area does: a
// sample beyond the area counts for nothing.
/// The samples of a vector, the first of them at the place `at` of the tile; settle(samples) is
/// called with a bit for each about which neither is certain. Returns how many of them are won.
template <bool test_edges, bool test_range>
template <class Settle>
HWY_INLINE std::size_t Pen<test_edges, test_range>::draw(VF x, VF y, const AtRow& at_x_0,
                                                         std::size_t at,
                                                         const Settle& settle) const {
  const DF d;
  const DT dt;
  float* const q_at = tile.q() + at;
  LaneTag* const tag_at = tile.tags() + at;
  const VF tag_error = hn::BitCast(d, tag);
  const VF q = hn::MulAdd(f.q_a, x, at_x_0.q);
  const VF q_there = hn::Load(d, q_at);
  const auto tag_there = hn::Load(dt, tag_at);
  const VF difference = hn::Sub(q, q_there);
  const VF sum = hn::Add(tag_error, hn::BitCast(d, tag_there));
  MF open = hn::Not(hn::Lt(difference, hn::Neg(sum)));
  MF wins = hn::Gt(difference, sum);
  if constexpr (test_edges) {
    const VF least = hn::Min(
        hn::Min(hn::MulAdd(f.a[0], x, at_x_0.edges[0]), hn::MulAdd(f.a[1], x, at_x_0.edges[1])),
        hn::MulAdd(f.a[2], x, at_x_0.edges[2]));
    open = hn::And(open, hn::Ge(least, minus_error));
    wins = hn::And(wins, hn::Gt(least, f.error));
  }
  if constexpr (test_range) {
    const VF error = hn::Mul(constant32(setup_bounds::q_moves), tag_error);
    const VF least = hn::Sub(q, error), greatest = hn::Add(q, error);
    wins = hn::And(wins, hn::And(hn::Ge(least, ends.least), hn::Le(greatest, ends.greatest)));
    open = hn::AndNot(
        hn::Or(hn::Lt(greatest, ends.outside_least), hn::Gt(least, ends.outside_greatest)), open);
  }
  if (HWY_UNLIKELY(t.is_clipped)) {
    open = hn::And(open, hn::And(hn::Le(x, last_x), hn::Le(y, last_y)));
  }
  // Without a branch: half of the cells have no sample that wins, but there is no telling which.
  wins = hn::And(wins, open);
  hn::Store(hn::IfThenElse(wins, q, q_there), d, q_at);
  hn::Store(hn::IfThenElse(hn::RebindMask(dt, wins), tag, tag_there), dt, tag_at);
  const MF doubtful = hn::AndNot(wins, open);
  if (HWY_UNLIKELY(!hn::AllFalse(d, doubtful))) {
    settle(lane_bits(d, doubtful));
  }
  return hn::CountTrue(d, wins);
}

/// Returns whether any sample is won.
template <bool test_edges, bool test_range>
HWY_INLINE bool draw_cells(Tile& tile, const Drawn& t, const Cells& cells,
                           const DrawContext& context) {
  const int lanes = static_cast<int>(hn::Lanes(DF()));
  const auto p = pen<test_edges, test_range>(tile, t, context);
  const VF left = constant32(static_cast<float>(cells.first_column - t.first_column));
  const VF step = constant32(cell);
  std::size_t wins = 0;
  for (int row = cells.first_row; row <= cells.last_row; row += cell) {
    const VF top = constant32(static_cast<float>(row - t.first_row));
    const std::size_t start = Tile::index(static_cast<std::uint32_t>(cells.first_column),
                                          static_cast<std::uint32_t>(row));
    for (int part = 0; part < cell * cell; part += lanes) {
      const VF y = hn::Add(lane_rows(part), top);
      const auto values = p.at_row(y);
      std::size_t at = start + static_cast<std::size_t>(part);
      VF x = hn::Add(lane_columns(part), left);
      for (int column = cells.first_column; column <= cells.last_column;
           column += cell, at += cell * cell, x = hn::Add(x, step)) {
        wins += p.draw(x, y, values, at, [&](unsigned samples) HWY_ATTR {
          settle_samples(tile, t, samples << part, column, row, context);
        });
      }
    }
  }
  context.statistics.samples_covered += wins;
  return wins != 0;
}

template <bool test_edges>
HWY_INLINE bool draw_cells(Tile& tile, const Drawn& t, const Cells& cells,
                           const DrawContext& context) {
  return t.test_range ? draw_cells<test_edges, true>(tile, t, cells, context)
                      : draw_cells<test_edges, false>(tile, t, cells, context);
}

// A single loop over all cells, because the processor could not predict the ends of rows.
template <bool test_range>
HWY_INLINE void draw_list(Tile& tile, const Drawn& t, const CellList& cells,
                          const DrawContext& context) {
  const int lanes = static_cast<int>(hn::Lanes(DF()));
  const auto p = pen<true, test_range>(tile, t, context);
  const VF first_x = constant32(static_cast<float>(t.first_column));
  const VF first_y = constant32(static_cast<float>(t.first_row));
  std::size_t wins = 0;
  for (int part = 0; part < cell * cell; part += lanes) {
    const VF x_in_cell = hn::Sub(lane_columns(part), first_x);
    const VF y_in_cell = hn::Sub(lane_rows(part), first_y);
    for (std::size_t i = 0; i < cells.count; ++i) {
      const std::uint32_t number = cells.numbers[i];
      const int column = static_cast<int>(CellPlace::column(number)) * cell;
      const int row = static_cast<int>(CellPlace::row(number)) * cell;
      const VF x = hn::Add(x_in_cell, constant32(static_cast<float>(column)));
      const VF y = hn::Add(y_in_cell, constant32(static_cast<float>(row)));
      const auto values = p.at_row(y);
      const std::size_t at = std::size_t{number} * (cell * cell) + static_cast<std::size_t>(part);
      wins += p.draw(x, y, values, at, [&](unsigned samples) HWY_ATTR {
        settle_samples(tile, t, samples << part, column, row, context);
      });
    }
  }
  context.statistics.samples_tested += cells.count * (cell * cell);
  context.statistics.samples_covered += wins;
}

HWY_INLINE void draw_list(Tile& tile, const Drawn& t, const CellList& cells,
                          const DrawContext& context) {
  if (t.test_range) {
    draw_list<true>(tile, t, cells, context);
  } else {
    draw_list<false>(tile, t, cells, context);
  }
}

}  // namespace
}  // namespace fathom::fast::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();
#endif
