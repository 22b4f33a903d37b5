// q of the surfaces of a tile at several samples at once, and the intervals of D that follow from
// intervals of q. Included once for each kind of vector instructions, by files that
// foreach_target.h compiles.
#if defined(FATHOM_FAST_DEPTH_INTERVAL_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef FATHOM_FAST_DEPTH_INTERVAL_INL_H
#undef FATHOM_FAST_DEPTH_INTERVAL_INL_H
#else
#define FATHOM_FAST_DEPTH_INTERVAL_INL_H
#endif

#include <hwy/highway.h>

#include "fathom/fast/channels/resolve_bounds.h"
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

/// The least and the greatest D of an interval of q, where known.
struct DepthInterval {
  V least, greatest;
  M known;
};

/// 1/q, and whether it errs by less than 4u of itself.
struct Reciprocal {
  V value;
  M known;
};

// By a quotient in binary32, which takes a third of the time of one in binary64, and a step of
// third order: 1/q = z₀/(1 − r) with r = 1 − q·z₀, and z₀·(1 + r + r²) leaves out r³, which is
// below 2⁻⁶³. r is computed with an error of 2u at most, whether the product is fused or not.
// Nothing is assumed about z₀: its error is checked (depth_interval.gappa.in).
HWY_INLINE Reciprocal reciprocal(V q) {
  const D d;
  const V z = hn::PromoteTo(d, hn::Div(hn::Set(D32(), 1.0F), to_binary32(q)));
  const V r = hn::NegMulAdd(q, z, constant(1));
  return {hn::MulAdd(z, hn::MulAdd(r, r, r), z),
          hn::Le(hn::Abs(r), constant(resolve_bounds::greatest_residual))};
}

// D = 1/q. With ε = e/q ≤ 2⁻²¹: 1/(q − e) = (1/q)/(1 − ε) ≤ (1/q)(1 + ε(1 + 2⁻²⁰)), and 1/(q + e)
// lies nearer to 1/q. z has a relative error of 4u. z·z·e has three roundings, the sum one, which
// 2⁻¹⁸ and 2⁻⁵⁰ = 8u cover.
HWY_INLINE DepthInterval perspective_depth(V q, V error) {
  const Reciprocal inverse = reciprocal(q);
  const V z = inverse.value;
  const V spread = hn::Mul(hn::Mul(z, z), hn::Mul(error, constant(resolve_bounds::spread_room)));
  return {hn::MulSub(z, constant(1 - resolve_bounds::end_room), spread),
          hn::MulAdd(z, constant(1 + resolve_bounds::end_room), spread),
          hn::And(inverse.known,
                  hn::Le(error, hn::Mul(q, constant(resolve_bounds::greatest_relative_error))))};
}

// D = −q: one rounding of the sum and one of the product, which 8u covers for positive numbers.
HWY_INLINE DepthInterval orthographic_depth(V q, V error) {
  const V least = hn::Neg(hn::Add(q, error)), greatest = hn::Sub(error, q);
  return {hn::Mul(least, constant(1 - resolve_bounds::end_room)),
          hn::Mul(greatest, constant(1 + resolve_bounds::end_room)), hn::Gt(least, constant(0))};
}

}  // namespace
}  // namespace fathom::fast::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif  // per-target include guard
