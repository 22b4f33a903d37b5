// Depths of a tile of a lens, several at once.
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "fathom/fast/lenses/lens_depths.cpp"
#include <hwy/foreach_target.h>  // must come before highway.h
#include <hwy/highway.h>

#include <limits>

#include "fathom/fast/channels/depth_interval-inl.h"
#include "fathom/fast/lanes/lanes-inl.h"
#include "fathom/fast/lenses/lens_tile.h"

HWY_BEFORE_NAMESPACE();
namespace fathom::fast::HWY_NAMESPACE {
namespace {

// If both ends of an interval that contains D round to the same number, so does D: rounding is
// monotone. The bound of a surface holds anywhere in the tile's area (lens_tile_lanes.cpp).
void round_depths_of_tile(const LensTile& lens_tile, LensDepths& rounded) {
  const D d;
  const D32 d32;
  const DT32 dt;
  const Tile& tile = lens_tile.tile();
  const TileInWindow& where = lens_tile.where();
  const Places::OfTile& places = lens_tile.places();
  const auto background = hn::Set(d32, std::numeric_limits<float>::infinity());
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
    const auto least = to_binary32(depth.least), greatest = to_binary32(depth.greatest);
    hn::StoreU(hn::IfThenElse(hn::RebindMask(d32, surface), least, background), d32,
               rounded.depths.data() + i);
    const unsigned settled = bits_of(depth.known) & lane_bits(d32, hn::Eq(least, greatest));
    const unsigned shown = lane_bits(dt, surface);
    rounded.surface[i / 64] |= std::uint64_t{shown} << i % 64;
    rounded.open[i / 64] |= std::uint64_t{shown & ~settled} << i % 64;
  }
}

}  // namespace
}  // namespace fathom::fast::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace fathom::fast {

HWY_EXPORT(round_depths_of_tile);

void round_depths(const LensTile& tile, LensDepths& rounded) {
  HWY_DYNAMIC_DISPATCH(round_depths_of_tile)(tile, rounded);
}

}  // namespace fathom::fast
#endif
