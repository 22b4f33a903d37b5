// Numbers that follow each other, in the lanes of a vector. Included once for every kind of vector
// instructions, by the files that foreach_target.h compiles for each.
#if defined(FATHOM_FAST_COUNTING_LANES_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef FATHOM_FAST_COUNTING_LANES_INL_H
#undef FATHOM_FAST_COUNTING_LANES_INL_H
#else
#define FATHOM_FAST_COUNTING_LANES_INL_H
#endif

#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace fathom::fast::HWY_NAMESPACE {
namespace {

namespace hn = hwy::HWY_NAMESPACE;

/// 0, 1, … in the lanes. hn::Iota of Highway 1.0 writes them to memory one by one and reads them
/// back at once, for which the processor waits, unless the compiler packs the writes; which it is
/// told not to do (cmake/FathomOptions.cmake).
template <class D>
HWY_INLINE hn::Vec<D> counting_lanes(D d) {
#if HWY_HAVE_SCALABLE
  return hn::Iota(d, 0);
#else
  using Number = hn::TFromD<D>;
  HWY_ALIGN static constexpr Number numbers[16] = {0, 1, 2,  3,  4,  5,  6,  7,
                                                   8, 9, 10, 11, 12, 13, 14, 15};
  static_assert(HWY_MAX_BYTES / sizeof(Number) <= 16);
  return hn::Load(d, numbers);
#endif
}

/// first, first + 1, …, each rounded once
template <class D>
HWY_INLINE hn::Vec<D> counting_lanes(D d, hn::TFromD<D> first) {
  return hn::Add(counting_lanes(d), hn::Set(d, first));
}

}  // namespace
}  // namespace fathom::fast::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
