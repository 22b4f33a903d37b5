// Bounds as halves of binary64 numbers, several at once. Included once for every kind of vector
// instructions, by the files that foreach_target.h compiles for each.
#if defined(FATHOM_FAST_UPPER_HALF_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef FATHOM_FAST_UPPER_HALF_INL_H
#undef FATHOM_FAST_UPPER_HALF_INL_H
#else
#define FATHOM_FAST_UPPER_HALF_INL_H
#endif

#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace fathom::fast::HWY_NAMESPACE {
namespace {

/// upper_half() of binary64 numbers.
template <class V>
HWY_INLINE auto upper_halves(V bound) {
  namespace hn = hwy::HWY_NAMESPACE;
  const hn::RebindToUnsigned<hn::DFromV<V>> d;
  return hn::Add(hn::ShiftRight<32>(hn::BitCast(d, bound)), hn::Set(d, 1));
}

}  // namespace
}  // namespace fathom::fast::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif  // per-target include guard
