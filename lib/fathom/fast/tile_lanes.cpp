// Triangles drawn into a tile, a row of eight samples at once.
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "fathom/fast/tile_lanes.cpp"
#include <hwy/cache_control.h>
#include <hwy/foreach_target.h>  // must come before highway.h
#include <hwy/highway.h>

#include <algorithm>
#include <bit>
#include <limits>

#include "fathom/fast/counting_lanes-inl.h"
#include "fathom/fast/setup-inl.h"
#include "fathom/fast/tile.h"

HWY_BEFORE_NAMESPACE();
namespace fathom::fast::HWY_NAMESPACE {
namespace {

constexpr int block = static_cast<int>(Tile::block);

/// One triangle's functions, the same in every lane.
struct Functions {
  V a[3], b[3], c[3];
  V error;
  V q_a, q_b, q_c;
  V q_error;
};

HWY_INLINE Functions functions_of(const SetupBatch& batch, std::size_t k) {
  Functions f;
  for (std::size_t i = 0; i < 3; ++i) {
    f.a[i] = constant(batch.edge_a[i][k]);
    f.b[i] = constant(batch.edge_b[i][k]);
    f.c[i] = constant(batch.edge_c[i][k]);
  }
  f.error = constant(batch.edge_error[k]);
  f.q_a = constant(batch.q_a[k]);
  f.q_b = constant(batch.q_b[k]);
  f.q_c = constant(batch.q_c[k]);
  f.q_error = constant(batch.q_error[k]);
  return f;
}

/// The triangle that is drawn: a lane of a batch.
struct Drawn {
  const SetupBatch& batch;
  std::size_t lane;
  Functions f;
  hn::Vec<DU> tag;
  /// Its box within the tile, and the tile's first sample relative to the origin of the functions.
  int first_column, last_column, first_row, last_row;
  double x, y;
  bool test_range;
};

HWY_INLINE Drawn drawn(const SetupBatch& batch, std::size_t k, bool test_range,
                       const PixelBox& area) {
  // Columns and rows of the image may be beyond the range of int; those of a tile are below 64.
  const auto local = [](double position, std::uint32_t origin) {
    return static_cast<int>(position - origin);
  };
  const int first_column = local(batch.first_column[k], area.first_column);
  const int first_row = local(batch.first_row[k], area.first_row);
  return {batch,
          k,
          functions_of(batch, k),
          hn::Set(DU(), surface_tag(batch.number[k], batch.q_error[k])),
          first_column,
          local(batch.last_column[k], area.first_column),
          first_row,
          local(batch.last_row[k], area.first_row),
          static_cast<double>(-first_column),
          static_cast<double>(-first_row),
          test_range};
}

HWY_NOINLINE void settle_lanes(Tile& tile, const Drawn& t, unsigned lanes, int column, int row,
                               const Tile::Context& context) {
  const TriangleSetup setup = t.batch.get(t.lane);
  for (; lanes != 0; lanes &= lanes - 1) {
    tile.settle(setup, t.test_range,
                tile.area().first_column + static_cast<std::uint32_t>(column) +
                    static_cast<std::uint32_t>(std::countr_zero(lanes)),
                tile.area().first_row + static_cast<std::uint32_t>(row), context);
  }
}

/// Samples of the tile: rows first_row ≤ row ≤ last_row of eight columns, of which those from
/// first_lane to last_lane count.
struct Strip {
  int column, first_row, last_row;
  int first_lane, last_lane;
};

// At every sample the triangle is certainly the nearest surface so far ("wins"), or certainly not
// ("loses"), or neither is certain. The third case is settled exactly.
//
// d is the difference of two values of q with a relative error of u; the sum of their errors has
// one too, and both errors leave out q_left of themselves: d > sum implies that the exact q of this
// triangle is greater (validation/proofs/nearer_q.gappa.in). Where the triangle does not cover the
// sample the bound on q does not hold, but then "loses" is right anyway. Ends of the range are
// compared with q moved by twice its error: a bound on q is never below u·|q|, so the second half
// covers the rounding of the end (moved_q.gappa.in).
template <bool test_edges, bool test_range>
HWY_INLINE bool draw_strip(Tile& tile, const Drawn& t, const Strip& strip,
                           const Tile::Context& context) {
  const D d;
  const DU du;
  const int lanes = static_cast<int>(hn::Lanes(d));
  const Functions& f = t.f;
  const V minus_error = hn::Neg(f.error);
  std::size_t wins_in_all = 0;
  for (int part = 0; part < block; part += lanes) {
    const V lane = counting_lanes(d, static_cast<double>(part));
    const M counts =
        hn::And(hn::Ge(lane, constant(strip.first_lane)), hn::Le(lane, constant(strip.last_lane)));
    if (lanes < block && hn::AllFalse(d, counts)) continue;
    const V x = hn::Add(lane, constant(t.x + strip.column));
    const V e0 = hn::MulAdd(f.a[0], x, f.c[0]), e1 = hn::MulAdd(f.a[1], x, f.c[1]);
    const V e2 = hn::MulAdd(f.a[2], x, f.c[2]), q0 = hn::MulAdd(f.q_a, x, f.q_c);
    const std::size_t start = Tile::index(static_cast<std::uint32_t>(strip.column + part), 0);
    V y = constant(t.y + strip.first_row - 1);
    for (int row = strip.first_row; row <= strip.last_row; ++row) {
      y = hn::Add(y, constant(1));  // integers: exact
      double* const q_at = tile.q() + start + static_cast<std::size_t>(row) * Tile::size;
      std::uint64_t* const tag_at =
          tile.tags() + start + static_cast<std::size_t>(row) * Tile::size;
      const V q = hn::MulAdd(f.q_b, y, q0);
      const V difference = hn::Sub(q, hn::LoadU(d, q_at));
      const V sum = hn::Add(f.q_error, hn::BitCast(d, hn::LoadU(du, tag_at)));
      M open = hn::AndNot(hn::Lt(difference, hn::Neg(sum)), counts);
      M wins = hn::Gt(difference, sum);
      if constexpr (test_edges) {
        const V least = least_of(hn::MulAdd(f.b[0], y, e0), hn::MulAdd(f.b[1], y, e1),
                                 hn::MulAdd(f.b[2], y, e2));
        open = hn::And(open, hn::Ge(least, minus_error));
        wins = hn::And(wins, hn::Gt(least, f.error));
      }
      if (hn::AllFalse(d, open)) continue;
      if constexpr (test_range) {
        const V error = hn::Mul(constant(setup_bounds::q_moves), f.q_error);
        const DepthRange& range = context.range;
        wins = hn::And(wins, hn::And(hn::Ge(hn::Sub(q, error), constant(range.inside_least)),
                                     hn::Le(hn::Add(q, error), constant(range.inside_greatest))));
      }
      wins = hn::And(wins, open);
      hn::BlendedStore(q, wins, d, q_at);
      hn::BlendedStore(t.tag, hn::RebindMask(du, wins), du, tag_at);
      wins_in_all += hn::CountTrue(d, wins);
      const M doubtful = hn::AndNot(wins, open);
      if (HWY_UNLIKELY(!hn::AllFalse(d, doubtful))) {
        settle_lanes(tile, t, bits_of(doubtful), strip.column + part, row, context);
      }
    }
  }
  context.statistics.samples_covered += wins_in_all;
  context.statistics.samples_tested += static_cast<std::uint64_t>(
      (strip.last_lane - strip.first_lane + 1) * (strip.last_row - strip.first_row + 1));
  return wins_in_all != 0;
}

template <bool test_edges>
HWY_INLINE bool draw_strip(Tile& tile, const Drawn& t, const Strip& strip,
                           const Tile::Context& context) {
  return t.test_range ? draw_strip<test_edges, true>(tile, t, strip, context)
                      : draw_strip<test_edges, false>(tile, t, strip, context);
}

/// Strips over the whole box.
HWY_INLINE void draw_box(Tile& tile, const Drawn& t, const Tile::Context& context) {
  for (int column = t.first_column; column <= t.last_column; column += block) {
    draw_strip<true>(
        tile, t, {column, t.first_row, t.last_row, 0, std::min(block - 1, t.last_column - column)},
        context);
  }
}

/// What is certain about a row of blocks of a tile, a bit for each block.
struct BlockRow {
  unsigned drawn, inside;
};

// Products and sums are rounded monotonically, so no sample of a block has a computed value above
// that of the corner where the function is greatest, or below that of the opposite corner; only
// blocks that the box meets count, and the bounds hold up to 8 samples beyond it.
// Hidden: no surface of the block has a q below the block's farthest, and the triangle's greatest q
// moved by twice its error is below that (moved_q.gappa.in, of the sample where q is greatest; the
// computed value at the corner is not less, and rounding is monotone).
HWY_INLINE BlockRow look_at_blocks(Tile& tile, const Drawn& t, int block_row, bool reject) {
  const D d;
  const int lanes = static_cast<int>(hn::Lanes(d));
  const Functions& f = t.f;
  const V side = constant(block - 1);
  const V top = constant(t.y + block_row * block);
  BlockRow row{0, 0};
  for (int part = 0; part < static_cast<int>(Tile::size) / block; part += lanes) {
    const V number = counting_lanes(d, static_cast<double>(part));
    const V left = hn::MulAdd(number, constant(block), constant(t.x));
    M missed = hn::Lt(constant(1), constant(0)), inside = hn::Not(missed);
    for (int i = 0; i < 3; ++i) {
      const M right_is_greater = hn::Gt(f.a[i], constant(0));
      const M bottom_is_greater = hn::Gt(f.b[i], constant(0));
      const V greatest_x = hn::Add(left, hn::IfThenElseZero(right_is_greater, side));
      const V least_x = hn::Add(left, hn::IfThenZeroElse(right_is_greater, side));
      const V greatest_y = hn::Add(top, hn::IfThenElseZero(bottom_is_greater, side));
      const V least_y = hn::Add(top, hn::IfThenZeroElse(bottom_is_greater, side));
      const V greatest = hn::MulAdd(f.b[i], greatest_y, hn::MulAdd(f.a[i], greatest_x, f.c[i]));
      const V least = hn::MulAdd(f.b[i], least_y, hn::MulAdd(f.a[i], least_x, f.c[i]));
      missed = hn::Or(missed, hn::Lt(greatest, hn::Neg(f.error)));
      inside = hn::And(inside, hn::Gt(least, f.error));
    }
    if (reject) {
      const V x = hn::Add(left, hn::IfThenElseZero(hn::Gt(f.q_a, constant(0)), side));
      const V y = hn::Add(top, hn::IfThenElseZero(hn::Gt(f.q_b, constant(0)), side));
      const V greatest = hn::MulAdd(f.q_b, y, hn::MulAdd(f.q_a, x, f.q_c));
      const V farthest = hn::LoadU(
          d, tile.farthest() + static_cast<std::size_t>(
                                   block_row * (static_cast<int>(Tile::size) / block) + part));
      missed = hn::Or(
          missed,
          hn::Lt(hn::MulAdd(constant(setup_bounds::q_moves), f.q_error, greatest), farthest));
    }
    row.drawn |= (bits_of(missed) ^ ((1U << lanes) - 1)) << part;
    row.inside |= bits_of(inside) << part;
  }
  return row;
}

// The least q, moved by twice its error: not greater than any exact q (moved_q.gappa.in). If a
// surface has no bound (NaN), nothing is known.
HWY_INLINE void update_farthest(Tile& tile, std::size_t block_number) {
  const D d;
  const DU du;
  const std::size_t lanes = hn::Lanes(d);
  const std::size_t blocks_in_row = Tile::size / Tile::block;
  const std::size_t start =
      Tile::index(static_cast<std::uint32_t>(block_number % blocks_in_row * Tile::block),
                  static_cast<std::uint32_t>(block_number / blocks_in_row * Tile::block));
  V least = constant(std::numeric_limits<double>::infinity());
  M known = hn::Eq(least, least);
  for (std::size_t row = 0; row < Tile::block; ++row) {
    for (std::size_t part = 0; part < Tile::block; part += lanes) {
      const std::size_t i = start + row * Tile::size + part;
      const V error = hn::BitCast(d, hn::LoadU(du, tile.tags() + i));
      least = hn::Min(
          least, hn::NegMulAdd(constant(setup_bounds::q_moves), error, hn::LoadU(d, tile.q() + i)));
      known = hn::And(known, hn::Eq(error, error));
    }
  }
  tile.farthest()[block_number] = hn::AllTrue(d, known) ? hn::GetLane(hn::MinOfLanes(d, least))
                                                        : -std::numeric_limits<double>::infinity();
  tile.draws()[block_number] = 0;
}

/// Draws by rows of blocks: blocks without a covered sample and those behind everything that is
/// already drawn are left out; in those that lie inside the triangle, edges are not tested.
HWY_INLINE void draw_blocks(Tile& tile, const Drawn& t, const Tile::Context& context) {
  constexpr std::uint8_t draws_until_update = 4;
  const bool reject = context.switches.early_rejection;
  const int first_block = t.first_column / block, last_block = t.last_column / block;
  const unsigned met = ((2U << last_block) - 1) & ~((1U << first_block) - 1);
  for (int row = t.first_row / block; row <= t.last_row / block; ++row) {
    const BlockRow certain = look_at_blocks(tile, t, row, reject);
    for (unsigned bits = certain.drawn & met; bits != 0; bits &= bits - 1) {
      const int number = std::countr_zero(bits);
      const int column = number * block;
      const Strip strip{
          column, std::max(row * block, t.first_row), std::min(row * block + block - 1, t.last_row),
          std::max(t.first_column - column, 0), std::min(t.last_column - column, block - 1)};
      const bool inside = certain.inside >> number & 1;
      const bool drew = inside ? draw_strip<false>(tile, t, strip, context)
                               : draw_strip<true>(tile, t, strip, context);
      if (!reject || !drew) continue;
      const auto block_number = static_cast<std::size_t>(row) * (Tile::size / Tile::block) +
                                static_cast<std::size_t>(number);
      if (inside || ++tile.draws()[block_number] >= draws_until_update) {
        update_farthest(tile, block_number);
      }
    }
  }
}

HWY_INLINE void draw_triangle(Tile& tile, const SetupBatch& batch, std::size_t lane,
                              bool test_range, const Tile::Context& context) {
  const Drawn t = drawn(batch, lane, test_range, tile.area());
  if (std::max(t.last_column - t.first_column, t.last_row - t.first_row) < 2 * block ||
      !context.switches.hierarchy) {
    draw_box(tile, t, context);
  } else {
    draw_blocks(tile, t, context);
  }
}

/// The lanes of a batch whose boxes have at most two columns and two rows.
HWY_INLINE unsigned small_lanes(const SetupBatch& batch) {
  const D d;
  const V columns =
      hn::Sub(hn::Load(d, batch.last_column.data()), hn::Load(d, batch.first_column.data()));
  const V rows = hn::Sub(hn::Load(d, batch.last_row.data()), hn::Load(d, batch.first_row.data()));
  return bits_of(hn::Le(hn::Max(columns, rows), constant(1)));
}

/// One sample of each of the small triangles, by its column and row in their boxes: the decisions
/// of draw_strip(), those about edges for all triangles at once.
HWY_INLINE void draw_sample_of_each(Tile& tile, const SetupBatch& batch, unsigned drawn, int column,
                                    int row, const Tile::Context& context) {
  const D d;
  const V x = constant(column), y = constant(row);
  const V columns =
      hn::Sub(hn::Load(d, batch.last_column.data()), hn::Load(d, batch.first_column.data()));
  const V rows = hn::Sub(hn::Load(d, batch.last_row.data()), hn::Load(d, batch.first_row.data()));
  const unsigned within = drawn & bits_of(hn::And(hn::Ge(columns, x), hn::Ge(rows, y)));
  V e[3];
  for (std::size_t i = 0; i < 3; ++i) {
    e[i] = hn::MulAdd(
        hn::Load(d, batch.edge_b[i].data()), y,
        hn::MulAdd(hn::Load(d, batch.edge_a[i].data()), x, hn::Load(d, batch.edge_c[i].data())));
  }
  const V least = least_of(e[0], e[1], e[2]);
  const V error = hn::Load(d, batch.edge_error.data());
  const unsigned open = within & bits_of(hn::Ge(least, hn::Neg(error)));
  const unsigned covered = bits_of(hn::Gt(least, error)) & ~batch.test_range;
  alignas(64) double q_of[SetupBatch::most];
  hn::Store(hn::MulAdd(hn::Load(d, batch.q_b.data()), y,
                       hn::MulAdd(hn::Load(d, batch.q_a.data()), x, hn::Load(d, batch.q_c.data()))),
            d, q_of);
  std::uint64_t wins = 0;
  for (unsigned bits = open; bits != 0; bits &= bits - 1) {
    const auto k = static_cast<std::size_t>(std::countr_zero(bits));
    const auto image_column =
        static_cast<std::uint32_t>(batch.first_column[k]) + static_cast<std::uint32_t>(column);
    const auto image_row =
        static_cast<std::uint32_t>(batch.first_row[k]) + static_cast<std::uint32_t>(row);
    const std::size_t i =
        Tile::index(image_column - tile.area().first_column, image_row - tile.area().first_row);
    const std::uint64_t tag = surface_tag(batch.number[k], batch.q_error[k]);
    const double difference = q_of[k] - tile.q()[i];
    const double sum = std::bit_cast<double>(tag) + std::bit_cast<double>(tile.tags()[i]);
    if (difference < -sum) continue;
    if (difference > sum && (covered >> k & 1)) {
      tile.q()[i] = q_of[k];
      tile.tags()[i] = tag;
      ++wins;
    } else {
      tile.settle(batch.get(k), batch.test_range >> k & 1, image_column, image_row, context);
    }
  }
  context.statistics.samples_tested += static_cast<unsigned>(std::popcount(within));
  context.statistics.samples_covered += wins;
}

HWY_NOINLINE void draw_exactly(Tile& tile, std::uint32_t number, const PixelBox& box,
                               const Tile::Context& context) {
  SetupBatch exact;
  Tile::set_up_exactly(number, box, context, exact);
  draw_triangle(tile, exact, 0, true, context);
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

/// Edge functions without any error have no bound to widen.
HWY_NOINLINE void widen(SetupBatch& batch, double factor) {
  for (std::size_t k = 0; k < hn::Lanes(D()); ++k) {
    if (!(batch.snapped >> k & 1)) batch.edge_error[k] *= factor;
    batch.q_error[k] *= factor;
  }
}

void draw_triangles(Tile& tile, const ImageObject& object, std::span<const std::uint32_t> numbers,
                    const Tile::Context& context) {
  const std::size_t lanes = hn::Lanes(D());
  Triangles next{};
  SetupBatch batch;
  fetch(object, numbers, 0, next);
  for (std::size_t first = 0; first < numbers.size(); first += lanes) {
    const std::size_t count = std::min(lanes, numbers.size() - first);
    const Triangles now = next;
    fetch(object, numbers, first + lanes, next);
    batch.number = now.number;
    set_up_lanes(object.vertices.get(), now.corners.data(), tile.area(), context.range, batch);
    if (HWY_UNLIKELY(context.switches.widening != 1)) widen(batch, context.switches.widening);
    const unsigned drawn_lanes = ((1U << count) - 1) & ~batch.empty;
    context.statistics.grid_setups +=
        static_cast<unsigned>(std::popcount(drawn_lanes & batch.snapped & ~batch.refused));
    const unsigned small = drawn_lanes & ~batch.refused & small_lanes(batch);
    if (small != 0) {
      for (int sample = 0; sample < 4; ++sample) {
        draw_sample_of_each(tile, batch, small, sample % 2, sample / 2, context);
      }
    }
    for (unsigned bits = drawn_lanes & ~small; bits != 0; bits &= bits - 1) {
      const auto k = static_cast<std::size_t>(std::countr_zero(bits));
      if (HWY_UNLIKELY(batch.refused >> k & 1)) {
        draw_exactly(tile, batch.number[k], batch.box(k), context);
      } else {
        draw_triangle(tile, batch, k, batch.test_range >> k & 1, context);
      }
    }
  }
}

}  // namespace
}  // namespace fathom::fast::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace fathom::fast {
using namespace triangle;

HWY_EXPORT(draw_triangles);

void Tile::draw(const ImageObject& object, std::span<const std::uint32_t> numbers,
                const Context& context) {
  HWY_DYNAMIC_DISPATCH(draw_triangles)(*this, object, numbers, context);
}

}  // namespace fathom::fast
#endif
