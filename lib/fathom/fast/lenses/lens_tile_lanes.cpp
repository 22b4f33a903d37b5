// Drawing a tile of a lens, several samples at once.
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "fathom/fast/lenses/lens_tile_lanes.cpp"
#include <hwy/foreach_target.h>  // must come before highway.h
#include <hwy/highway.h>

#include <algorithm>
#include <bit>
#include <limits>

#include "fathom/fast/bins/fetch-inl.h"
#include "fathom/fast/lanes/each_bit.h"
#include "fathom/fast/lanes/lanes-inl.h"
#include "fathom/fast/lenses/lens_tile.h"
#include "fathom/fast/lenses/window.h"
#include "fathom/fast/setup/setup-inl.h"
#include "fathom/fast/tiles/cell_drawing-inl.h"
#include "fathom/fast/tiles/farthest-inl.h"
#include "fathom/fast/tiles/lane_batch-inl.h"
#include "fathom/fast/vertices/vertex.h"

HWY_BEFORE_NAMESPACE();
namespace fathom::fast::HWY_NAMESPACE {
namespace {

constexpr std::size_t of_cell = std::size_t{TileShape::cell} * TileShape::cell;
/// The cells of a block: two rows of two.
constexpr std::size_t of_block = 4;

/// The index of the first sample of a cell of a block.
HWY_INLINE std::size_t start_of_cell(std::size_t block_number, std::size_t number) {
  const auto column =
      static_cast<std::uint32_t>(block_number % TileShape::blocks_of_row) * TileShape::block +
      static_cast<std::uint32_t>(number % 2) * TileShape::cell;
  const auto row =
      static_cast<std::uint32_t>(block_number / TileShape::blocks_of_row) * TileShape::block +
      static_cast<std::uint32_t>(number / 2) * TileShape::cell;
  return TileShape::index(column, row);
}

/// Where samples lie along one axis: in binary32, with the least and the greatest of each cell.
HWY_INLINE void start_cell(const double* places, double scale, double shift, float* local,
                           float& least, float& greatest) {
  const D d;
  const D32 d32;
  const auto no_end = hn::Set(d32, std::numeric_limits<float>::infinity());
  auto low = no_end, high = hn::Neg(no_end);
  for (std::size_t i = 0; i < of_cell; i += hn::Lanes(d)) {
    const V place = hn::LoadU(d, places + i);
    const auto at = to_binary32(hn::MulAdd(place, constant(scale), constant(shift)));
    const auto has_ray = hn::Eq(at, at);
    low = hn::Min(low, hn::IfThenElse(has_ray, at, no_end));
    high = hn::Max(high, hn::IfThenElse(has_ray, at, hn::Neg(no_end)));
    hn::StoreU(hn::IfThenElseZero(has_ray, at), d32, local + i);
  }
  least = hn::GetLane(hn::MinOfLanes(d32, low));
  greatest = hn::GetLane(hn::MaxOfLanes(d32, high));
}

/// Samples without a ray have a q that nothing hides.
HWY_INLINE void close_samples_without_ray(const double* places, float* q) {
  const D d;
  const D32 d32;
  for (std::size_t i = 0; i < of_cell; i += hn::Lanes(d)) {
    const auto place = to_binary32(hn::LoadU(d, places + i));
    hn::StoreU(hn::IfThenElse(hn::Eq(place, place), hn::LoadU(d32, q + i),
                              hn::Set(d32, std::numeric_limits<float>::infinity())),
               d32, q + i);
  }
}

void start_tile(LensTile& tile, const Places::OfTile& places, const TileInWindow& where) {
  auto& cells = tile.cells();
  auto& blocks = tile.blocks();
  for (std::size_t number = 0; number < TileShape::blocks; ++number) {
    for (std::size_t k = 0; k < of_block; ++k) {
      const std::size_t at = start_of_cell(number, k), c = number * of_block + k;
      close_samples_without_ray(places.x.data() + at, tile.tile().q() + at);
      start_cell(places.x.data() + at, where.scale_x, where.shift_x, tile.x().data() + at,
                 cells.left[c], cells.right[c]);
      start_cell(places.y.data() + at, where.scale_y, where.shift_y, tile.y().data() + at,
                 cells.top[c], cells.bottom[c]);
    }
    const std::size_t first = number * of_block;
    blocks.left[number] = *std::min_element(&cells.left[first], &cells.left[first] + of_block);
    blocks.right[number] = *std::max_element(&cells.right[first], &cells.right[first] + of_block);
    blocks.top[number] = *std::min_element(&cells.top[first], &cells.top[first] + of_block);
    blocks.bottom[number] =
        *std::max_element(&cells.bottom[first], &cells.bottom[first] + of_block);
  }
  for (std::size_t row = 0; row < TileShape::blocks_of_row; ++row) {
    const std::size_t first = row * TileShape::blocks_of_row,
                      end = first + TileShape::blocks_of_row;
    tile.row_tops()[row] = *std::min_element(&blocks.top[first], &blocks.top[0] + end);
    tile.row_bottoms()[row] = *std::max_element(&blocks.bottom[first], &blocks.bottom[0] + end);
  }
}

/// Rectangles around the triangles of a batch, from the tile's origin.
struct LaneRectangles {
  alignas(32) LaneBatch::Numbers left;
  alignas(32) LaneBatch::Numbers right;
  alignas(32) LaneBatch::Numbers top;
  alignas(32) LaneBatch::Numbers bottom;

  void set_unknown(std::size_t k) {
    left[k] = top[k] = -std::numeric_limits<float>::infinity();
    right[k] = bottom[k] = std::numeric_limits<float>::infinity();
  }
};

// The rounding of a sample's place to binary32 is at most 2⁻¹⁰, as the window's width is at most
// 2¹⁴, and its error at most 2⁻¹²: together less than 2⁻⁹. The rounding of a corner is below 2⁻²⁴
// of it.
HWY_INLINE void make_rectangles(const Corners& t, const PixelBox& area, LaneRectangles& r) {
  const V e = t.position_error;
  const V u = constant(area.first_column + 0.5), v = constant(area.first_row + 0.5);
  const auto outwards = [](V x) HWY_ATTR {
    return hn::MulAdd(hn::Abs(x), constant(lens_bounds::rectangle_rounding),
                      constant(lens_bounds::rectangle_margin));
  };
  const auto low = [&](V x, V origin, LaneBatch::Numbers& to) HWY_ATTR {
    const V from_origin = hn::Sub(moved_down(x, e), origin);
    store32(hn::Sub(from_origin, outwards(from_origin)), to);
  };
  const auto high = [&](V x, V origin, LaneBatch::Numbers& to) HWY_ATTR {
    const V from_origin = hn::Sub(moved_up(x, e), origin);
    store32(hn::Add(from_origin, outwards(from_origin)), to);
  };
  low(least_of(t.A.u, t.B.u, t.C.u), u, r.left);
  high(greatest_of(t.A.u, t.B.u, t.C.u), u, r.right);
  low(least_of(t.A.v, t.B.v, t.C.v), v, r.top);
  high(greatest_of(t.A.v, t.B.v, t.C.v), v, r.bottom);
}

HWY_INLINE V extent_of(const PixelBox& area) {
  return constant(std::max(area.last_column - area.first_column, area.last_row - area.first_row) +
                  8.0);
}

// As set_up_lanes(), for samples that lie anywhere in the area and err by `error`. Moving a sample
// and moving all corners the other way is the same: edge functions have the bounds of corners that
// err by that much more. q moves by its gradients; the bound is of the computed function, so these
// are the computed gradients. Where the error is not far below 1, all are refused.
HWY_INLINE void set_up_lens_lanes(const ImageVertex* vertices, const CornerIndices* triangles,
                                  const TileInWindow& where, const DepthRange& range,
                                  SetupBatch& batch, LaneRectangles& rectangles) {
  Corners t = load_corners(vertices, triangles);
  const M usable = are_usable(t);
  make_rectangles(t, where.area, rectangles);
  const Boxes box{constant(where.area.first_column), constant(where.area.last_column),
                  constant(where.area.first_row), constant(where.area.last_row)};
  const V q_by_place = constant(where.error * lens_bounds::place_room);
  LocalTriangles l = localise(t, box);
  Depths q = certified_depths(t, l, certified_edges(l));
  l.delta = hn::Add(l.delta, q_by_place);
  const Edges e = certified_edges(l);
  const M safe =
      hn::And(usable, hn::Ge(l.T, hn::Mul(constant(setup_bounds::triangle_thinness), e.error)));
  q.error = hn::MulAdd(hn::Add(hn::Abs(q.a), hn::Abs(q.b)), q_by_place, q.error);
  store(e, q, box, batch);
  batch.empty = 0;
  batch.refused = bits_of(hn::Not(safe)) | (where.is_certain ? 0U : ~0U);
  batch.snapped = 0;
  batch.test_range = bits_of(hn::Or(hn::Not(usable), may_leave(range, t)));
}

/// A setup of exact numbers for samples that err by `error`.
HWY_INLINE TriangleSetup for_places(TriangleSetup s, double error) {
  const double by_place = error * lens_bounds::place_room;
  double greatest = 0;
  for (std::size_t i = 0; i < 3; ++i)
    greatest = std::max(greatest, std::abs(s.edge_a[i]) + std::abs(s.edge_b[i]));
  s.edge_error += greatest * by_place;
  s.q_error += (std::abs(s.q_a) + std::abs(s.q_b)) * by_place;
  s.edge_error *= setup_bounds::q_room;
  s.q_error *= setup_bounds::q_room;
  return s;
}

// The functions' origin is the tile's; their bounds cover what is computed anywhere in its area.
HWY_INLINE void make_lens_surfaces(const SetupBatch& setups, TileSurface* surfaces) {
  const D d;
  const DU du;
  const hn::Rebind<std::uint32_t, D> d32;
  const auto number = hn::PromoteTo(du, hn::LoadU(d32, setups.number.data()));
  const auto tag = hn::Or(hn::ShiftLeft<32>(upper_halves(load(setups.q_error))), number);
  hn::StoreInterleaved4(load(setups.q_c), load(setups.q_a), load(setups.q_b), hn::BitCast(d, tag),
                        d, &surfaces->c);
}

/// The rows of blocks that the rectangle may meet, a bit for each.
HWY_INLINE unsigned open_rows(LensTile& tile, const LaneRectangles& rectangles, std::size_t k) {
  const DF8 d;
  unsigned open = 0;
  for (std::size_t part = 0; part < TileShape::blocks_of_row; part += hn::Lanes(d)) {
    const auto met =
        hn::And(hn::Le(hn::Load(d, &tile.row_tops()[part]), hn::Set(d, rectangles.bottom[k])),
                hn::Ge(hn::Load(d, &tile.row_bottoms()[part]), hn::Set(d, rectangles.top[k])));
    open |= lane_bits(d, met) << part;
  }
  return open;
}

/// The parts of a row of eight blocks that a triangle may change, a bit for each.
HWY_INLINE unsigned open_blocks(LensTile& tile, const Drawn& t, const LaneRectangles& rectangles,
                                std::size_t row, const DrawContext& context) {
  const DF8 d;
  const auto set = [](float x) HWY_ATTR { return hn::Set(DF8(), x); };
  const std::size_t k = t.lane;
  const auto& blocks = tile.blocks();
  const auto left = set(rectangles.left[k]), right = set(rectangles.right[k]);
  const auto top = set(rectangles.top[k]), bottom = set(rectangles.bottom[k]);
  unsigned open = 0;
  for (std::size_t part = 0; part < TileShape::blocks_of_row; part += hn::Lanes(d)) {
    const std::size_t at = row * TileShape::blocks_of_row + part;
    const auto block_left = hn::Load(d, &blocks.left[at]);
    const auto block_right = hn::Load(d, &blocks.right[at]);
    const auto block_top = hn::Load(d, &blocks.top[at]);
    const auto block_bottom = hn::Load(d, &blocks.bottom[at]);
    auto met = hn::And(hn::And(hn::Le(block_left, right), hn::Ge(block_right, left)),
                       hn::And(hn::Le(block_top, bottom), hn::Ge(block_bottom, top)));
    if (hn::AllFalse(d, met)) continue;
    // Products and sums are rounded monotonically: at no sample of a block is the computed value
    // above that of the corner where the function is greatest.
    const auto greatest = [&](float a, float b, float c) HWY_ATTR {
      const auto at_row = hn::MulAdd(set(b), b > 0 ? block_bottom : block_top, set(c));
      return hn::MulAdd(set(a), a > 0 ? block_right : block_left, at_row);
    };
    // Of a block or two there is little to leave out.
    if (context.switches.hierarchy && hn::CountTrue(d, met) > 2) {
      const auto minus_error = set(-t.batch.edge_error[k]);
      for (std::size_t i = 0; i < 3; ++i) {
        const auto edge =
            greatest(t.batch.edge_a[i][k], t.batch.edge_b[i][k], t.batch.edge_c[i][k]);
        met = hn::And(met, hn::Ge(edge, minus_error));
      }
    }
    // Before the first back face, nothing is known of what is farthest.
    if (context.switches.early_rejection && tile.tile().draws_back_faces()) {
      const auto q = greatest(t.batch.q_a[k], t.batch.q_b[k], t.batch.q_c[k]);
      const auto moves = set(setup_bounds::q_moves * t.batch.q_error[k]);
      const auto farthest = hn::Load(d, tile.tile().farthest().data() + at);
      met = hn::AndNot(hn::Lt(hn::Add(q, moves), farthest), met);
    }
    open |= lane_bits(d, met) << part;
  }
  return open;
}

/// The cells of a block that the rectangle meets, a bit for each.
HWY_INLINE unsigned open_cells(LensTile& tile, const LaneRectangles& rectangles, std::size_t k,
                               std::size_t block_number) {
  const hn::CappedTag<float, of_block> d;
  const auto& cells = tile.cells();
  unsigned open = 0;
  for (std::size_t part = 0; part < of_block; part += hn::Lanes(d)) {
    const std::size_t at = block_number * of_block + part;
    const auto met =
        hn::And(hn::And(hn::Le(hn::Load(d, &cells.left[at]), hn::Set(d, rectangles.right[k])),
                        hn::Ge(hn::Load(d, &cells.right[at]), hn::Set(d, rectangles.left[k]))),
                hn::And(hn::Le(hn::Load(d, &cells.top[at]), hn::Set(d, rectangles.bottom[k])),
                        hn::Ge(hn::Load(d, &cells.bottom[at]), hn::Set(d, rectangles.top[k]))));
    open |= lane_bits(d, met) << part;
  }
  return open;
}

HWY_NOINLINE void settle_samples(LensTile& tile, const Drawn& t, unsigned samples, std::size_t at,
                                 const LensContext& context) {
  const TriangleSetup setup = t.setups.get(t.lane);
  for (const std::size_t number : EachBit(samples))
    tile.settle(setup, t.batch.tag[t.lane], t.test_range, at + number, context);
}

template <bool test_range>
HWY_INLINE void draw_triangle(LensTile& tile, const Drawn& t, const LaneRectangles& rectangles,
                              const LensContext& context) {
  const DF d;
  const DrawContext& window = context.window;
  const auto p = pen<true, test_range>(tile.tile(), t, window);
  std::size_t wins = 0, tested = 0;
  for (const std::size_t row : EachBit(open_rows(tile, rectangles, t.lane))) {
    for (const std::size_t bit : EachBit(open_blocks(tile, t, rectangles, row, window))) {
      const std::size_t number = row * TileShape::blocks_of_row + bit;
      for (const std::size_t k : EachBit(open_cells(tile, rectangles, t.lane, number))) {
        const std::size_t start = start_of_cell(number, k);
        tested += of_cell;
        for (std::size_t at = start; at < start + of_cell; at += hn::Lanes(d)) {
          const VF x = hn::Load(d, tile.x().data() + at), y = hn::Load(d, tile.y().data() + at);
          wins += p.draw(x, y, p.at_row(y), at, [&](unsigned samples) HWY_ATTR {
            settle_samples(tile, t, samples, at, context);
          });
        }
      }
    }
  }
  window.statistics.samples_tested += tested;
  window.statistics.samples_covered += wins;
}

/// Draws lanes of a batch.
HWY_INLINE void draw_lens_batch(LensTile& lens_tile, const SetupBatch& setups, unsigned lanes,
                                LaneBatch& batch, const LaneRectangles& rectangles,
                                const LensContext& context) {
  Tile& tile = lens_tile.tile();
  const DrawContext& window = context.window;
  const std::uint32_t place = tile.next_place();
  make_lens_surfaces(setups, tile.surfaces_at(place));
  // A sample's place is rounded to binary32, too: that adds one unit of roundoff of its terms to
  // the five that lane_error() counts (lens_value.gappa.in).
  const V extent = hn::Mul(extent_of(lens_tile.where().area), constant(lens_bounds::lane_extent));
  const double widening = window.switches.widening;
  make_lane_tags(setups, place, extent, widening, batch);
  make_lane_functions(setups, extent, widening, batch);
  const std::uint64_t covered_before = window.statistics.samples_covered;
  for (const std::size_t k : EachBit(lanes)) {
    const bool test_range = setups.test_range >> k & 1;
    const Drawn t = drawn(setups, batch, k, test_range, false);
    if (test_range) {
      draw_triangle<true>(lens_tile, t, rectangles, context);
    } else {
      draw_triangle<false>(lens_tile, t, rectangles, context);
    }
  }
  if (window.statistics.samples_covered != covered_before)
    tile.keep_surfaces(static_cast<std::uint32_t>(hn::Lanes(D())));
}

/// Triangles that are drawn from exact numbers, or double-words, as many together as there are
/// lanes.
struct ExactLanes {
  SetupBatch setups{};
  LaneRectangles rectangles{};
  std::size_t count = 0;
};

HWY_NOINLINE void draw_lens_exactly(LensTile& tile, ExactLanes& exact, const LensContext& context) {
  LaneBatch batch{};
  exact.setups.test_range = (1U << exact.count) - 1;
  draw_lens_batch(tile, exact.setups, exact.setups.test_range, batch, exact.rectangles, context);
  exact.count = 0;
}

HWY_NOINLINE void add_lens_exactly(LensTile& tile, std::uint32_t number, const LensContext& context,
                                   ExactLanes& exact) {
  const TileInWindow& where = tile.where();
  const TriangleSetup setup = context.window.set_up_exactly(number, where.area);
  exact.setups.set(exact.count, for_places(setup, where.error * context.window.switches.widening),
                   where.area);
  exact.rectangles.set_unknown(exact.count);
  if (++exact.count == hn::Lanes(D())) draw_lens_exactly(tile, exact, context);
}

void draw_lens_triangles(LensTile& tile, const ImageObject& object,
                         std::span<const std::uint32_t> numbers, const LensContext& context) {
  const DrawContext& window = context.window;
  SetupBatch batch;
  LaneBatch lane_batch{};
  LaneRectangles rectangles;
  ExactLanes exact;
  for_each_triangles(object, numbers,
                     [&](const Triangles& now, std::size_t, std::size_t count) HWY_ATTR {
                       batch.number = now.number;
                       set_up_lens_lanes(object.vertices.get(), now.corners.data(), tile.where(),
                                         window.range, batch, rectangles);
                       if (HWY_UNLIKELY(window.switches.widening != 1))
                         widen(batch, window.switches.widening);
                       const unsigned all = (1U << count) - 1;
                       const unsigned certain = all & ~batch.refused;
                       if (certain != 0)
                         draw_lens_batch(tile, batch, certain, lane_batch, rectangles, context);
                       for (const std::size_t k : EachBit(all & batch.refused))
                         add_lens_exactly(tile, batch.number[k], context, exact);
                     });
  if (exact.count != 0) draw_lens_exactly(tile, exact, context);
}

void find_farthest_of_blocks(Tile& tile) {
  for (std::size_t number = 0; number < Tile::blocks; ++number) update_farthest(tile, number);
}

}  // namespace
}  // namespace fathom::fast::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace fathom::fast {

HWY_EXPORT(start_tile);
HWY_EXPORT(draw_lens_triangles);
HWY_EXPORT(find_farthest_of_blocks);

void LensTile::start(Tile& tile, const Places::OfTile& places, const TileInWindow& where) {
  tile_ = &tile;
  places_ = places;
  where_ = where;
  HWY_DYNAMIC_DISPATCH(start_tile)(*this, places, where);
}

void LensTile::draw(const ImageObject& object, std::span<const std::uint32_t> numbers,
                    const LensContext& context) {
  HWY_DYNAMIC_DISPATCH(draw_lens_triangles)(*this, object, numbers, context);
}

void LensTile::begin_back_faces() {
  tile_->begin_back_faces();
  HWY_DYNAMIC_DISPATCH(find_farthest_of_blocks)(*tile_);
}

}  // namespace fathom::fast
#endif
