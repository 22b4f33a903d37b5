// From an interval of q to one of D, several at once. Included once for every kind of vector
// instructions, by the files that foreach_target.h compiles for each.
#if defined(FATHOM_FAST_DEPTH_INTERVAL_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef FATHOM_FAST_DEPTH_INTERVAL_INL_H
#undef FATHOM_FAST_DEPTH_INTERVAL_INL_H
#else
#define FATHOM_FAST_DEPTH_INTERVAL_INL_H
#endif

#include <hwy/highway.h>

#include "fathom/fast/resolve_bounds.h"
#include "fathom/fast/setup-inl.h"

HWY_BEFORE_NAMESPACE();
namespace fathom::fast::HWY_NAMESPACE {
namespace {

/// The least and the greatest D of an interval of q, where known.
struct DepthInterval {
  V least, greatest;
  M known;
};

// D = 1/q. With ε = e/q ≤ 2⁻²¹: 1/(q − e) = (1/q)/(1 − ε) ≤ (1/q)(1 + ε(1 + 2⁻²⁰)), and 1/(q + e)
// lies nearer to 1/q. z = fl(1/q) has a relative error of u. z·z·e has three roundings, the sum
// one, which 2⁻¹⁸ and 2⁻⁵⁰ = 8u cover.
HWY_INLINE DepthInterval perspective_depth(V q, V error) {
  const V z = hn::Div(constant(1), q);
  const V spread = hn::Mul(hn::Mul(z, z), hn::Mul(error, constant(resolve_bounds::spread_room)));
  return {hn::MulSub(z, constant(1 - resolve_bounds::end_room), spread),
          hn::MulAdd(z, constant(1 + resolve_bounds::end_room), spread),
          hn::Le(error, hn::Mul(q, constant(resolve_bounds::greatest_relative_error)))};
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
