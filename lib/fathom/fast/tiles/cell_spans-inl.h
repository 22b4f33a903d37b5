// A function over the blocks of a tile, and the cells of a tile that thin triangles may meet.
// Included once for each kind of vector instructions, by files that foreach_target.h compiles.
#if defined(FATHOM_FAST_CELL_SPANS_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef FATHOM_FAST_CELL_SPANS_INL_H
#undef FATHOM_FAST_CELL_SPANS_INL_H
#else
#define FATHOM_FAST_CELL_SPANS_INL_H
#endif

#include <hwy/highway.h>

#include <algorithm>
#include <array>
#include <cstdint>

#include "fathom/fast/bins/tile_shape.h"
#include "fathom/fast/lanes/lanes-inl.h"
#include "fathom/fast/tiles/lane_batch-inl.h"

HWY_BEFORE_NAMESPACE();
namespace fathom::fast::HWY_NAMESPACE {
namespace {

/// A function at the samples of the blocks of a tile where it is greatest and least: for a column
/// of blocks its value without b·y, and y from the top of a row of blocks.
struct BlockFunction {
  using Numbers = std::array<float, TileShape::blocks_of_row>;
  alignas(32) Numbers greatest;
  alignas(32) Numbers least;
  float b;
  float greatest_y, least_y;
};

HWY_INLINE void make_block_function(float a, float b, float c, float first_column,
                                    BlockFunction& f) {
  const DF8 d;
  const auto at = [&](float x, std::size_t part) HWY_ATTR {
    const auto left = hn::MulAdd(counting_lanes(d, static_cast<float>(part)), hn::Set(d, block),
                                 hn::Set(d, x - first_column));
    return hn::MulAdd(hn::Set(d, a), left, hn::Set(d, c));
  };
  constexpr float side = block - 1;
  for (std::size_t part = 0; part < TileShape::blocks_of_row; part += hn::Lanes(d)) {
    hn::Store(at(a > 0 ? side : 0, part), d, f.greatest.data() + part);
    hn::Store(at(a > 0 ? 0 : side, part), d, f.least.data() + part);
  }
  f.b = b;
  f.greatest_y = b > 0 ? side : 0;
  f.least_y = side - f.greatest_y;
}

/// The number of a cell in its tile, as cells lie in memory: row by row.
struct CellPlace {
  static constexpr std::uint32_t in_row = TileShape::size / TileShape::cell;
  static std::uint32_t column(std::uint32_t number) { return number % in_row; }
  static std::uint32_t row(std::uint32_t number) { return number / in_row; }
};

/// Cells of a tile, by their numbers.
struct CellList {
  static constexpr std::size_t most = 48;
  std::size_t count = 0;
  /// With room for the overhang of the last vector that is written.
  alignas(64) std::array<std::uint32_t, most + 16> numbers;
};

/// For each row of cells of a tile.
using OfRows = std::array<std::uint32_t, CellPlace::in_row>;

/// Cells of a tile, row by row: the columns of the first and the last cell; no cell if the first is
/// greater.
struct CellSpans {
  alignas(64) OfRows first;
  alignas(64) OfRows last;
  /// The number of cells, in total and in the longest row.
  int count, longest;
};

/// Columns of cells that no edge function has excluded so far; each lane is a row of cells. The
/// first columns, and the negated last columns.
struct SpanLanes {
  VF first, minus_last;
};

/// For each edge function of the triangles of a batch: where rows of cells probably end, and the
/// numbers with which that is checked.
struct SpanGuesses {
  using PerEdge = std::array<LaneBatch::Numbers, 3>;
  /// The first cell that must be kept, as a function of the number of the row of cells, and the
  /// greatest number of such a cell.
  alignas(32) PerEdge at_first, by_row, end;
  /// The position in the box of the last sample that is left out, as a function of the cell's
  /// number.
  alignas(32) PerEdge by_cell, before;
  /// In the first row of cells, the position of the row in which the function is greatest.
  alignas(32) PerEdge lowest;
};

// Products and sums are rounded monotonically: where an edge function that grows to the right is
// certainly negative in the last column of a cell and in that row of the cell in which it is
// greatest, it is negative at all samples of the cell and of all cells to the left of it. A
// quotient guesses this cell; its roundings do not matter, because the sign of the function there
// is checked. If a function grows to the left, the same holds in mirrored columns, 3 − column,
// where cells have negated numbers. There are no branches, because signs of coefficients are hard
// to predict.
HWY_INLINE void make_span_guesses(const LaneBatch& batch, SpanGuesses& guesses) {
  // Scaled functions are below 2: nothing overflows, and a function of rows alone, with a slope of
  // 0, leaves out all cells of a row or no cell.
  constexpr float least_slope = 0x1p-60F;
  const D32 d;
  using V32 = hn::Vec<D32>;
  const auto set = [](float x) HWY_ATTR { return hn::Set(D32(), x); };
  const auto place = [](const LaneBatch::Places& places) HWY_ATTR {
    return hn::ConvertTo(D32(), hn::Load(hn::Rebind<std::int32_t, D32>(), places.data()));
  };
  const V32 zero = set(0), one = set(1), side = set(cell), part = set(1.0F / cell);
  const V32 origin = place(batch.first_column), top = place(batch.first_row);
  const V32 first = hn::Floor(hn::Mul(origin, part));
  const V32 last = hn::Floor(hn::Mul(place(batch.last_column), part));
  const V32 left = hn::Sub(side, origin), right = hn::Add(origin, one);
  const V32 minus_error = hn::Neg(hn::Load(d, batch.edge_error.data()));
  for (std::size_t i = 0; i < 3; ++i) {
    const V32 a = hn::Load(d, batch.edge_a[i].data()), b = hn::Load(d, batch.edge_b[i].data());
    const V32 c = hn::Load(d, batch.edge_c[i].data());
    const auto grows_right = hn::Gt(a, zero);
    const auto by_side = [&](V32 x, V32 y) HWY_ATTR { return hn::IfThenElse(grows_right, x, y); };
    const V32 lowest = hn::Sub(hn::IfThenElseZero(hn::Gt(b, zero), set(cell - 1)), top);
    const V32 inverse = hn::Div(one, hn::Max(hn::Abs(a), set(least_slope)));
    const V32 at_top = hn::Sub(minus_error, hn::MulAdd(b, lowest, c));
    const V32 at_first = hn::MulAdd(at_top, inverse, by_side(right, left));
    hn::Store(hn::Mul(at_first, part), d, guesses.at_first[i].data());
    hn::Store(hn::Neg(hn::Mul(b, inverse)), d, guesses.by_row[i].data());
    hn::Store(by_side(hn::Add(last, one), hn::Sub(one, first)), d, guesses.end[i].data());
    hn::Store(by_side(side, hn::Neg(side)), d, guesses.by_cell[i].data());
    hn::Store(by_side(hn::Neg(right), left), d, guesses.before[i].data());
    hn::Store(lowest, d, guesses.lowest[i].data());
  }
}

/// Rows of cells, `top` their first rows in the tile.
HWY_INLINE void leave_out(const LaneBatch& f, const SpanGuesses& guesses, std::size_t i,
                          std::size_t k, VF number, VF top, SpanLanes& spans) {
  const auto of_lane = [&](const SpanGuesses::PerEdge& numbers)
                           HWY_ATTR { return constant32(numbers[i][k]); };
  const VF a = of_lane(f.edge_a);
  const VF minus_error = constant32(-f.edge_error[k]);
  const VF guess = hn::MulAdd(of_lane(guesses.by_row), number, of_lane(guesses.at_first));
  const VF first = hn::Min(hn::Floor(guess), of_lane(guesses.end));
  const VF y = hn::Add(top, of_lane(guesses.lowest));
  const VF at_row = hn::MulAdd(of_lane(f.edge_b), y, of_lane(f.edge_c));
  const VF x = hn::MulAdd(of_lane(guesses.by_cell), first, of_lane(guesses.before));
  const MF is_missed = hn::Lt(hn::MulAdd(a, x, at_row), minus_error);
  const MF grows_right = hn::Gt(a, constant32(0));
  const MF right = hn::And(grows_right, is_missed), left = hn::AndNot(grows_right, is_missed);
  spans.first = hn::IfThenElse(right, hn::Max(spans.first, first), spans.first);
  spans.minus_last = hn::IfThenElse(left, hn::Max(spans.minus_last, first), spans.minus_last);
}

/// The cells of the box that may have a covered sample.
HWY_INLINE void make_cell_spans(const LaneBatch& f, const SpanGuesses& guesses, std::size_t k,
                                CellSpans& cells) {
  const DF d;
  const hn::Rebind<std::int32_t, DF> di;
  const hn::Rebind<std::uint32_t, DF> du;
  const VF zero = constant32(0), one = constant32(1), side = constant32(cell);
  const auto number_of = [&](const LaneBatch::Places& places) HWY_ATTR {
    const std::int32_t number = places[k] / cell;
    return constant32(static_cast<float>(number));
  };
  const VF first_row = number_of(f.first_row), last_row = number_of(f.last_row);
  const VF first_column = number_of(f.first_column);
  const VF minus_last_column = hn::Neg(number_of(f.last_column));
  VF count = zero, longest = zero;
  for (std::size_t part = 0; part < cells.first.size(); part += hn::Lanes(d)) {
    const VF number = counting_lanes(d, static_cast<float>(part));
    SpanLanes spans{first_column, minus_last_column};
    for (std::size_t i = 0; i < 3; ++i) {
      leave_out(f, guesses, i, k, number, hn::Mul(number, side), spans);
    }
    const MF is_met = hn::And(hn::Ge(number, first_row), hn::Le(number, last_row));
    const VF minus_last = hn::IfThenElse(is_met, spans.minus_last, one);
    const VF first = hn::IfThenElseZero(is_met, spans.first);
    const VF length = hn::Max(hn::Sub(one, hn::Add(minus_last, first)), zero);
    count = hn::Add(count, length);
    longest = hn::Max(longest, length);
    const auto store = [&](VF columns, OfRows& numbers) HWY_ATTR {
      hn::Store(hn::BitCast(du, hn::ConvertTo(di, columns)), du, numbers.data() + part);
    };
    store(first, cells.first);
    store(hn::Neg(minus_last), cells.last);
  }
  cells.count = static_cast<int>(hn::GetLane(hn::SumOfLanes(d, count)));
  cells.longest = static_cast<int>(hn::GetLane(hn::MaxOfLanes(d, longest)));
}

/// Lists the cells that lie in open blocks; each row has a bit for each block. The first cells of
/// all rows come first, then the second cells, and so on: a row hardly ever has more than three.
/// Needs    at most CellList::most of them.
HWY_INLINE void list_cells(const CellSpans& spans, const OfRows& open_blocks, CellList& list) {
  static_assert(TileShape::block == 2 * TileShape::cell);
  const hn::Rebind<std::uint32_t, DF> d;
  const hn::Rebind<std::int32_t, DF> di;
  const auto one = hn::Set(d, 1);
  list.count = 0;
  for (std::uint32_t part = 0; part < CellPlace::in_row; part += hn::Lanes(d)) {
    const auto start = hn::Mul(counting_lanes(d, part), hn::Set(d, CellPlace::in_row));
    const auto last = hn::BitCast(di, hn::Load(d, spans.last.data() + part));
    const auto open = hn::Load(d, open_blocks.data() + part);
    auto column = hn::Load(d, spans.first.data() + part);
    for (int i = 0; i < spans.longest; ++i, column = hn::Add(column, one)) {
      const auto is_out = hn::RebindMask(d, hn::Gt(hn::BitCast(di, column), last));
      const auto is_open = hn::TestBit(hn::Shr(open, hn::ShiftRight<1>(column)), one);
      const auto is_met = hn::AndNot(is_out, is_open);
      // CompressStore() would be one slow instruction where there is AVX-512.
      hn::StoreU(hn::Compress(hn::Add(start, column), is_met), d, list.numbers.data() + list.count);
      list.count += hn::CountTrue(d, is_met);
    }
  }
}

}  // namespace
}  // namespace fathom::fast::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();
#endif
