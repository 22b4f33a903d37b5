// The functions of triangles in binary32, for the samples of a tile. Included once for every kind
// of vector instructions, by the files that foreach_target.h compiles for each.
#if defined(FATHOM_FAST_LANE_BATCH_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef FATHOM_FAST_LANE_BATCH_INL_H
#undef FATHOM_FAST_LANE_BATCH_INL_H
#else
#define FATHOM_FAST_LANE_BATCH_INL_H
#endif

#include <hwy/highway.h>

#include <cmath>
#include <limits>

#include "fathom/fast/bins/tile_shape.h"
#include "fathom/fast/lanes/lanes-inl.h"
#include "fathom/fast/setup/setup-inl.h"
#include "fathom/fast/tiles/tile.h"

HWY_BEFORE_NAMESPACE();
namespace fathom::fast::HWY_NAMESPACE {
namespace {

constexpr int block = static_cast<int>(TileShape::block), cell = static_cast<int>(TileShape::cell);

/// Samples of a cell, all or as many as a vector holds.
#if HWY_HAVE_SCALABLE
using DF = hn::CappedTag<float, 8>;
#else
using DF = hn::CappedTag<float, 16>;
#endif
using DT = hn::Rebind<LaneTag, DF>;
using VF = hn::Vec<DF>;
using MF = hn::Mask<DF>;
/// Triangles of a batch, or blocks of a row.
using DF8 = hn::CappedTag<float, 8>;
using DI8 = hn::Rebind<std::int32_t, DF8>;

HWY_INLINE VF constant32(float x) {
  return hn::Set(DF(), x);
}

/// Column and row of the samples in the lanes, from one of a cell on.
HWY_INLINE VF lane_columns(int first) {
  HWY_ALIGN static constexpr float columns[16] = {0, 1, 2, 3, 0, 1, 2, 3, 0, 1, 2, 3, 0, 1, 2, 3};
  return hn::LoadU(DF(), columns + first);
}
HWY_INLINE VF lane_rows(int first) {
  HWY_ALIGN static constexpr float rows[16] = {0, 0, 0, 0, 1, 1, 1, 1, 2, 2, 2, 2, 3, 3, 3, 3};
  return hn::LoadU(DF(), rows + first);
}

/// A SetupBatch in binary32, with boxes within the tile.
struct LaneBatch {
  using Numbers = std::array<float, SetupBatch::most>;
  using Places = std::array<std::int32_t, SetupBatch::most>;

  alignas(32) std::array<Numbers, 3> edge_a;
  alignas(32) std::array<Numbers, 3> edge_b;
  alignas(32) std::array<Numbers, 3> edge_c;
  alignas(32) Numbers edge_error;
  alignas(32) Numbers q_a;
  alignas(32) Numbers q_b;
  alignas(32) Numbers q_c;
  alignas(32) Numbers q_error;
  alignas(32) std::array<LaneTag, SetupBatch::most> tag;
  alignas(32) Places first_column;
  alignas(32) Places last_column;
  alignas(32) Places first_row;
  alignas(32) Places last_row;
};

HWY_INLINE V load(const SetupBatch::Numbers& numbers) {
  return hn::Load(D(), numbers.data());
}

HWY_INLINE void store32(V v, LaneBatch::Numbers& numbers) {
  hn::Store(to_binary32(v), D32(), numbers.data());
}

/// The sum of the magnitudes of a function's terms where the magnitudes of the samples' places are
/// at most `extent`.
HWY_INLINE V terms_of(V a, V b, V c, V extent) {
  return hn::MulAdd(hn::Add(hn::Abs(a), hn::Abs(b)), extent, hn::Abs(c));
}

/// A power of two whose product with x is in [1, 2).
/// Needs    2⁻¹⁰²² ≤ x < 2¹⁰²³.
HWY_INLINE V scale_of(V x) {
  const DU du;
  const auto exponent = hn::And(hn::BitCast(du, x), hn::Set(du, 0x7FF0000000000000));
  return hn::BitCast(D(), hn::Sub(hn::Set(du, 0x7FE0000000000000), exponent));
}

// A function with terms a·x, b·y, c of magnitudes that add up to S: in binary32 the coefficients
// err by 2⁻²⁴ of themselves, and products and sums as in exact_setup.cpp: by less than 5·2⁻²⁴·S in
// all, in addition to the bound of binary64 (lane_value.gappa.in). Values that underflow are below
// lane_floor.
HWY_INLINE V lane_error(V terms, V error) {
  const V in_lanes = hn::MulAdd(terms, constant(setup_bounds::lane_error), error);
  return hn::Mul(hn::Add(in_lanes, constant(setup_bounds::lane_floor)),
                 constant(setup_bounds::lane_room));
}

/// Bounds in binary32, widened if requested; bounds of 0 remain 0.
HWY_INLINE V widened(V error, double widening) {
  return widening == 1 ? error : hn::Mul(error, constant(widening));
}

/// The bounds of a batch. Edge functions without any error have no bound to widen.
[[maybe_unused]] HWY_NOINLINE void widen(SetupBatch& batch, double factor) {
  for (std::size_t k = 0; k < hn::Lanes(D()); ++k) {
    if (!(batch.snapped >> k & 1)) batch.edge_error[k] *= factor;
    batch.q_error[k] *= factor;
  }
}

// Edge functions are scaled by powers of two, each by its own, so that S < 2 and one bound does for
// all three. On the grid of snap_step all terms are multiples of 2⁻¹⁷: where S < 2⁷, 24 bits hold
// every sum exactly.
HWY_INLINE void make_lane_edges(const SetupBatch& setups, V extent, double widening,
                                LaneBatch& lanes) {
  const auto bits = static_cast<std::uint8_t>(setups.snapped);
  const std::uint8_t bytes[8] = {bits};
  const M snapped = hn::LoadMaskBits(D(), bytes);
  const V own_error = load(setups.edge_error);
  V error = constant(0);
  for (std::size_t i = 0; i < 3; ++i) {
    const V a = load(setups.edge_a[i]), b = load(setups.edge_b[i]), c = load(setups.edge_c[i]);
    const V terms = terms_of(a, b, c, extent);
    const V scale = scale_of(terms);
    store32(hn::Mul(a, scale), lanes.edge_a[i]);
    store32(hn::Mul(b, scale), lanes.edge_b[i]);
    store32(hn::Mul(c, scale), lanes.edge_c[i]);
    const M exact = hn::And(snapped, hn::Lt(terms, constant(setup_bounds::exact_lane_limit)));
    const V in_lanes = hn::IfThenZeroElse(exact, lane_error(terms, own_error));
    error = hn::Max(error, hn::Mul(in_lanes, scale));
  }
  store32(widened(error, widening), lanes.edge_error);
}

/// From the first to the last column or row of each box: one less than it has.
struct BoxSizes {
  V columns, rows;
};
HWY_INLINE BoxSizes box_sizes(const SetupBatch& setups) {
  return {hn::Sub(load(setups.last_column), load(setups.first_column)),
          hn::Sub(load(setups.last_row), load(setups.first_row))};
}

/// The greatest distance of a sample's column or row from the origin of the functions.
HWY_INLINE V extent_of(const SetupBatch& setups) {
  const auto [columns, rows] = box_sizes(setups);
  // The block of a sample may reach 7 beyond the box.
  return hn::Add(hn::Max(columns, rows), constant(8));
}

/// The functions, in the first lanes, as many as are set up at once.
HWY_INLINE void make_lane_functions(const SetupBatch& setups, V extent, double widening,
                                    LaneBatch& lanes) {
  make_lane_edges(setups, extent, widening, lanes);
  store32(load(setups.q_a), lanes.q_a);
  store32(load(setups.q_b), lanes.q_b);
  store32(load(setups.q_c), lanes.q_c);
}

/// Places beyond the range of int cannot be: the boxes lie in the tile.
HWY_INLINE void make_lane_boxes(const SetupBatch& setups, const PixelBox& area, LaneBatch& lanes) {
  const hn::Rebind<std::int32_t, D> d32;
  const V left = constant(area.first_column), top = constant(area.first_row);
  const auto store =
      [&](const SetupBatch::Numbers& from, V origin, LaneBatch::Places& to)
          HWY_ATTR { hn::Store(hn::DemoteTo(d32, hn::Sub(load(from), origin)), d32, to.data()); };
  store(setups.first_column, left, lanes.first_column);
  store(setups.last_column, left, lanes.last_column);
  store(setups.first_row, top, lanes.first_row);
  store(setups.last_row, top, lanes.last_row);
}

/// The tags of the surfaces, which will be kept from `place` on.
HWY_INLINE void make_lane_tags(const SetupBatch& setups, std::uint32_t place, V extent,
                               double widening, LaneBatch& lanes) {
  const V terms = terms_of(load(setups.q_a), load(setups.q_b), load(setups.q_c), extent);
  const V error = hn::IfThenElse(hn::Lt(terms, constant(setup_bounds::lane_limit)),
                                 lane_error(terms, load(setups.q_error)),
                                 constant(std::numeric_limits<double>::infinity()));
  store32(widened(error, widening), lanes.q_error);
  for (std::size_t k = 0; k < hn::Lanes(D()); ++k) {
    lanes.tag[k] = lane_tag(place + static_cast<std::uint32_t>(k), lanes.q_error[k]);
  }
}

/// The boxes and the tags.
HWY_INLINE void make_lane_places(const SetupBatch& setups, const PixelBox& area,
                                 std::uint32_t place, V extent, double widening, LaneBatch& lanes) {
  make_lane_tags(setups, place, extent, widening, lanes);
  make_lane_boxes(setups, area, lanes);
}

// q as a function over the tile: moved to its first sample, which errs by 4u of the sum of the
// magnitudes, S, and evaluated with the moved constant, which may be 2S: by 6u more, in addition to
// the bound for the triangle's box (tile_q.gappa.in).
HWY_INLINE void make_surfaces(const SetupBatch& setups, const PixelBox& area,
                              TileSurface* surfaces) {
  const D d;
  const DU du;
  const V a = load(setups.q_a), b = load(setups.q_b), c = load(setups.q_c);
  const V column = hn::Sub(load(setups.first_column), constant(area.first_column));
  const V row = hn::Sub(load(setups.first_row), constant(area.first_row));
  const V moved = hn::NegMulAdd(b, row, hn::NegMulAdd(a, column, c));
  const V terms = terms_of(a, b, c, constant(TileShape::size));
  const V error =
      hn::Mul(hn::MulAdd(terms, constant(setup_bounds::tile_q_error), load(setups.q_error)),
              constant(setup_bounds::q_room));
  const hn::Rebind<std::uint32_t, D> d32;
  const auto number = hn::PromoteTo(du, hn::LoadU(d32, setups.number.data()));
  const auto tag = hn::Or(hn::ShiftLeft<32>(upper_halves(error)), number);
  hn::StoreInterleaved4(moved, a, b, hn::BitCast(d, tag), d, &surfaces->c);
}

}  // namespace
}  // namespace fathom::fast::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif  // per-target include guard
