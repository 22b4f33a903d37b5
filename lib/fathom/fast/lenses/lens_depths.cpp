// Depths of a tile of a lens, several at once.
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "fathom/fast/lenses/lens_depths.cpp"
#include <hwy/foreach_target.h>  // must come before highway.h
#include <hwy/highway.h>

#include <cmath>
#include <limits>

#include "fathom/fast/channels/depth_interval-inl.h"
#include "fathom/fast/lanes/lanes-inl.h"
#include "fathom/fast/lenses/lens_tile.h"
#include "fathom/numeric/certified_rounding.h"
#include "fathom/numeric/standard_arithmetic.h"

HWY_BEFORE_NAMESPACE();
namespace fathom::fast::HWY_NAMESPACE {
namespace {

/// Values as they are stored, of as many samples as there are lanes of binary64.
struct StoredLanes {
  hn::Vec<D32> value;
  unsigned settled;
};

/// If both ends of an interval that contains D round to the same number, so does D: rounding is
/// monotone.
struct ToBinary32 {
  static constexpr float background = std::numeric_limits<float>::infinity();

  HWY_INLINE StoredLanes operator()(const DepthInterval& depth) const {
    const auto least = to_binary32(depth.least), greatest = to_binary32(depth.greatest);
    return {least, lane_bits(D32(), hn::Eq(least, greatest))};
  }
};

/// The same for codes, which binary32 holds exactly. The factor errs by up to u of itself, its
/// product is rounded, and so is the product with the widening, 4u.
struct ToCodes {
  static constexpr float background = 0;
  double factor;
  bool beyond_is_none;

  HWY_INLINE StoredLanes operator()(const DepthInterval& depth) const {
    const V low = hn::Mul(hn::Mul(depth.least, constant(factor)), constant(1 - interval_widening));
    const V high =
        hn::Mul(hn::Mul(depth.greatest, constant(factor)), constant(1 + interval_widening));
    const V code = hn::Round(low);
    const M is_code = hn::And(hn::Eq(code, hn::Round(high)),
                              hn::And(hn::Ge(code, constant(1)), hn::Le(code, constant(65535))));
    const M is_none = hn::And(hn::Gt(low, constant(65536)), hn::Ge(high, low));
    const unsigned settled = bits_of(is_code) | (beyond_is_none ? bits_of(is_none) : 0);
    return {to_binary32(hn::IfThenElseZero(is_code, code)), settled};
  }
};

// The bound of a surface holds anywhere in the tile's area (lens_tile_lanes.cpp).
template <class Store>
HWY_INLINE void store_depths(const LensTile& lens_tile, const Store& store, LensDepths& rounded) {
  const D d;
  const D32 d32;
  const DT32 dt;
  const Tile& tile = lens_tile.tile();
  const TileInWindow& where = lens_tile.where();
  const Places::OfTile& places = lens_tile.places();
  const auto background = hn::Set(d32, Store::background);
  const auto place = hn::Set(dt, Tile::place_of(~LaneTag{0}));
  rounded.surface.fill(0);
  rounded.open.fill(0);
  for (std::size_t i = 0; i < TileShape::samples; i += hn::Lanes(d)) {
    const auto tags = hn::LoadU(dt, tile.tags() + i);
    const auto surface = hn::Ne(hn::And(tags, place), hn::Zero(dt));
    if (hn::AllFalse(dt, surface)) {
      hn::StoreU(background, d32, rounded.depths.data() + i);
      continue;
    }
    const V x = hn::MulAdd(hn::LoadU(d, places.x.data() + i), constant(where.scale_x),
                           constant(where.shift_x));
    const V y = hn::MulAdd(hn::LoadU(d, places.y.data() + i), constant(where.scale_y),
                           constant(where.shift_y));
    const Surfaces s = surfaces_at(tile.surfaces(), tags, x, y);
    const DepthInterval depth = perspective_depth(s.q, hn::BitCast(d, s.tag));
    const StoredLanes stored = store(depth);
    hn::StoreU(hn::IfThenElse(hn::RebindMask(d32, surface), stored.value, background), d32,
               rounded.depths.data() + i);
    const unsigned settled = bits_of(depth.known) & stored.settled;
    const unsigned shown = lane_bits(dt, surface);
    rounded.surface[i / 64] |= std::uint64_t{shown} << i % 64;
    rounded.open[i / 64] |= std::uint64_t{shown & ~settled} << i % 64;
  }
}

void round_depths_of_tile(const LensTile& tile, LensDepths& rounded) {
  store_depths(tile, ToBinary32(), rounded);
}

// A factor of which no bound is known settles nothing, as NaN.
void round_codes_of_tile(const LensTile& tile, const triangle::CodeFactor& factor,
                         LensDepths& rounded) {
  const bool is_known = factor.error <= unit_roundoff<double>;
  const double known = is_known ? factor.value : std::numeric_limits<double>::quiet_NaN();
  store_depths(tile, ToCodes{known, factor.beyond_is_none}, rounded);
}

}  // namespace
}  // namespace fathom::fast::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace fathom::fast {

HWY_EXPORT(round_depths_of_tile);
HWY_EXPORT(round_codes_of_tile);

void round_depths(const LensTile& tile, LensDepths& rounded) {
  HWY_DYNAMIC_DISPATCH(round_depths_of_tile)(tile, rounded);
}

void round_to_codes(const LensTile& tile, const triangle::CodeFactor& factor, LensDepths& rounded) {
  HWY_DYNAMIC_DISPATCH(round_codes_of_tile)(tile, factor, rounded);
}

}  // namespace fathom::fast
#endif
