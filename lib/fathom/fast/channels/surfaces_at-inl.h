// q of the surfaces of a tile at several samples at once. Included once for every kind of vector
// instructions, by the files that foreach_target.h compiles for each.
#if defined(FATHOM_FAST_SURFACES_AT_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef FATHOM_FAST_SURFACES_AT_INL_H
#undef FATHOM_FAST_SURFACES_AT_INL_H
#else
#define FATHOM_FAST_SURFACES_AT_INL_H
#endif

#include <hwy/highway.h>

#include "fathom/fast/lanes/lanes-inl.h"
#include "fathom/fast/setup/setup.h"
#include "fathom/fast/tiles/tile.h"

HWY_BEFORE_NAMESPACE();
namespace fathom::fast::HWY_NAMESPACE {
namespace {

/// For as many samples as there are lanes of binary64.
using DT32 = hn::Rebind<LaneTag, D>;

struct Surfaces {
  V q;
  hn::Vec<DU> tag;
};

/// The surfaces of samples with these tags, at x and y.
HWY_INLINE Surfaces surfaces_at(const TileSurface* surfaces, hn::Vec<DT32> tags, V x, V y) {
  const DT32 dt;
  const LaneTag first = hn::GetLane(tags);
  if (hn::AllTrue(dt, hn::Eq(tags, hn::Set(dt, first)))) {
    const TileSurface& s = surfaces[Tile::place_of(first)];
    return {hn::MulAdd(constant(s.b), y, hn::MulAdd(constant(s.a), x, constant(s.c))),
            hn::Set(DU(), s.tag)};
  }
  HWY_ALIGN LaneTag tag_of[SetupBatch::most];
  hn::Store(tags, dt, tag_of);
  const Records r = load_records(
      [&](std::size_t lane) HWY_ATTR { return &surfaces[Tile::place_of(tag_of[lane])].c; });
  return {hn::MulAdd(r.third, y, hn::MulAdd(r.second, x, r.first)), hn::BitCast(DU(), r.fourth)};
}

}  // namespace
}  // namespace fathom::fast::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();
#endif
