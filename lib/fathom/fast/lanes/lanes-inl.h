// Vectors of binary64 numbers, and functions that all vector code needs. Included once for each
// kind of vector instructions, by files that foreach_target.h compiles.
#if defined(FATHOM_FAST_LANES_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef FATHOM_FAST_LANES_INL_H
#undef FATHOM_FAST_LANES_INL_H
#else
#define FATHOM_FAST_LANES_INL_H
#endif

#include <hwy/highway.h>

#include <cstddef>
#include <cstdint>

HWY_BEFORE_NAMESPACE();
namespace fathom::fast::HWY_NAMESPACE {
namespace {

namespace hn = hwy::HWY_NAMESPACE;
/// The greatest number of binary64 numbers in a vector.
constexpr std::size_t most_lanes = 8;
using D = hn::CappedTag<double, most_lanes>;
using DU = hn::Rebind<std::uint64_t, D>;
using DI = hn::Rebind<std::int64_t, D>;
using D32 = hn::Rebind<float, D>;
using V = hn::Vec<D>;
using M = hn::Mask<D>;

HWY_INLINE V constant(double x) {
  return hn::Set(D(), x);
}
HWY_INLINE V greatest_of(V a, V b, V c) {
  return hn::Max(a, hn::Max(b, c));
}
HWY_INLINE V least_of(V a, V b, V c) {
  return hn::Min(a, hn::Min(b, c));
}
HWY_INLINE V greatest_magnitude(V a, V b, V c) {
  return greatest_of(hn::Abs(a), hn::Abs(b), hn::Abs(c));
}

/// One bit per lane; there are at most 16 lanes.
template <class Tag, class Mask>
HWY_INLINE unsigned lane_bits(Tag d, Mask mask) {
  std::uint8_t bytes[8] = {};
  hn::StoreMaskBits(d, mask, bytes);
  // One read of both bytes would have to wait for two writes.
  if constexpr (hn::MaxLanes(Tag()) <= 8) return bytes[0];
  return bytes[0] | static_cast<unsigned>(bytes[1]) << 8;
}
HWY_INLINE unsigned bits_of(M mask) {
  return lane_bits(D(), mask);
}

/// Rounds to binary32; numbers beyond the greatest become ±∞. Emulated vectors would give the
/// greatest number instead.
HWY_INLINE hn::Vec<D32> to_binary32(V v) {
#if HWY_TARGET == HWY_EMU128 || HWY_TARGET == HWY_SCALAR
  alignas(16) double from[8];
  alignas(16) float to[8];
  hn::Store(v, D(), from);
  for (std::size_t k = 0; k < hn::Lanes(D()); ++k) to[k] = static_cast<float>(from[k]);
  return hn::Load(D32(), to);
#else
  return hn::DemoteTo(D32(), v);
#endif
}

/// 0, 1, … in the lanes. hn::Iota of Highway 1.0 writes them to memory one by one and reads them
/// back at once, which stalls the processor unless the compiler packs the writes; our compiler
/// flags forbid that (cmake/FathomOptions.cmake).
template <class Tag>
HWY_INLINE hn::Vec<Tag> counting_lanes(Tag d) {
#if HWY_HAVE_SCALABLE
  return hn::Iota(d, 0);
#else
  using Number = hn::TFromD<Tag>;
  HWY_ALIGN static constexpr Number numbers[16] = {0, 1, 2,  3,  4,  5,  6,  7,
                                                   8, 9, 10, 11, 12, 13, 14, 15};
  static_assert(HWY_MAX_BYTES / sizeof(Number) <= 16);
  return hn::Load(d, numbers);
#endif
}

/// first, first + 1, …, each rounded once
template <class Tag>
HWY_INLINE hn::Vec<Tag> counting_lanes(Tag d, hn::TFromD<Tag> first) {
  return hn::Add(counting_lanes(d), hn::Set(d, first));
}

/// upper_half() of binary64 numbers (vertex.h).
HWY_INLINE hn::Vec<DU> upper_halves(V bound) {
  const DU d;
  return hn::Add(hn::ShiftRight<32>(hn::BitCast(d, bound)), hn::Set(d, 1));
}

/// Four numbers of each lane's record.
struct Records {
  V first, second, third, fourth;
};

/// at(lane) points to the first of four consecutive numbers, at a multiple of 32 bytes; whole
/// records are loaded and transposed.
template <class At>
HWY_INLINE Records load_records(const At& at) {
  const D d;
#if HWY_TARGET == HWY_SCALAR || HWY_HAVE_SCALABLE
  HWY_ALIGN std::int64_t offsets[most_lanes];
  const double* const base = at(0);
  for (std::size_t k = 0; k < hn::Lanes(d); ++k) offsets[k] = at(k) - base;
  const auto offset = hn::Load(DI(), offsets);
  return {hn::GatherIndex(d, base, offset), hn::GatherIndex(d, base + 1, offset),
          hn::GatherIndex(d, base + 2, offset), hn::GatherIndex(d, base + 3, offset)};
#else
  if constexpr (hn::MaxLanes(D()) == 2) {
    const V a0 = hn::Load(d, at(0)), a1 = hn::Load(d, at(1));
    const V b0 = hn::Load(d, at(0) + 2), b1 = hn::Load(d, at(1) + 2);
    return {hn::InterleaveLower(d, a0, a1), hn::InterleaveUpper(d, a0, a1),
            hn::InterleaveLower(d, b0, b1), hn::InterleaveUpper(d, b0, b1)};
  } else {
    // Blocks of 128 bits: (1 2)(3 4) of one record, of a second in the upper half if that is wide.
    const hn::CappedTag<double, 4> d4;
    const auto load = [&](std::size_t lane) HWY_ATTR {
      if constexpr (hn::MaxLanes(D()) == 8) {
        return hn::Combine(d, hn::Load(d4, at(lane + 4)), hn::Load(d4, at(lane)));
      } else {
        return hn::Load(d4, at(lane));
      }
    };
    const V v0 = load(0), v1 = load(1), v2 = load(2), v3 = load(3);
    const V odd01 = hn::InterleaveLower(d, v0, v1), even01 = hn::InterleaveUpper(d, v0, v1);
    const V odd23 = hn::InterleaveLower(d, v2, v3), even23 = hn::InterleaveUpper(d, v2, v3);
    return {hn::OddEvenBlocks(hn::SwapAdjacentBlocks(odd23), odd01),
            hn::OddEvenBlocks(hn::SwapAdjacentBlocks(even23), even01),
            hn::OddEvenBlocks(odd23, hn::SwapAdjacentBlocks(odd01)),
            hn::OddEvenBlocks(even23, hn::SwapAdjacentBlocks(even01))};
  }
#endif
}

}  // namespace
}  // namespace fathom::fast::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif  // per-target include guard
