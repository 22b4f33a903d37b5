// Numbers with bounds on their errors rounded to binary32, several at once. Included once for every
// kind of vector instructions, by the files that foreach_target.h compiles for each.
#if defined(FATHOM_FAST_ROUND_LANES_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef FATHOM_FAST_ROUND_LANES_INL_H
#undef FATHOM_FAST_ROUND_LANES_INL_H
#else
#define FATHOM_FAST_ROUND_LANES_INL_H
#endif

#include <hwy/highway.h>

#include "fathom/fast/channels/channel_rows.h"
#include "fathom/fast/lanes/lanes-inl.h"
#include "fathom/numeric/certified_rounding.h"

HWY_BEFORE_NAMESPACE();
namespace fathom::fast::HWY_NAMESPACE {
namespace {

struct CertifiedLanes {
  V value, error;
};

HWY_INLINE V load_u(const SurfaceRow& row, std::size_t first) {
  return hn::Add(counting_lanes(D(), static_cast<double>(first)), constant(row.first_u));
}

/// The surfaces of as many samples as there are lanes.
struct LaneIndices {
  const std::uint32_t* first;
  bool are_same;
};

HWY_INLINE LaneIndices indices_at(const std::uint32_t* indices, std::size_t first) {
  const hn::Rebind<std::uint32_t, D> d;
  const std::uint32_t* const at = indices + first;
  return {at, hn::AllTrue(d, hn::Eq(hn::LoadU(d, at), hn::Set(d, *at)))};
}

/// Rounded values, and a bit for each lane whose value is settled.
struct RoundedLanes {
  hn::Vec<D32> value;
  unsigned settled;
};

// Like to_binary32() of a binary64 number, which is not settled if it is 0. Two numbers that are
// rounded to the same one, which is not 0, have one sign.
HWY_INLINE RoundedLanes round_to_binary32(const CertifiedLanes& x) {
  const V margin = hn::MulAdd(hn::Abs(x.value), constant(interval_widening), x.error);
  const auto low = to_binary32(hn::Sub(x.value, margin));
  const auto high = to_binary32(hn::Add(x.value, margin));
  return {low, lane_bits(D32(), hn::And(hn::Eq(low, high), hn::Ne(low, hn::Zero(D32()))))};
}

HWY_INLINE void store_rounded(const CertifiedLanes& x, std::size_t first,
                              RoundedValues<float>& rounded) {
  const RoundedLanes lanes = round_to_binary32(x);
  hn::StoreU(lanes.value, D32(), rounded.values.data() + first);
  rounded.settled |= std::uint64_t{lanes.settled} << first;
}

}  // namespace
}  // namespace fathom::fast::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif  // per-target include guard
