// Vectors of the walk along a ray. Included once for every kind of vector instructions, by
// cast_lanes.cpp.
#if defined(FATHOM_RAYS_RAY_LANES_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef FATHOM_RAYS_RAY_LANES_INL_H
#undef FATHOM_RAYS_RAY_LANES_INL_H
#else
#define FATHOM_RAYS_RAY_LANES_INL_H
#endif

#include <hwy/highway.h>

#include <array>
#include <cstddef>
#include <cstdint>

#include "fathom/rays/ray_tree.h"

HWY_BEFORE_NAMESPACE();
namespace fathom::rays::HWY_NAMESPACE {
namespace {

namespace hn = hwy::HWY_NAMESPACE;
using D = hn::CappedTag<double, triangles_together>;
using V = hn::Vec<D>;
using F = hn::CappedTag<float, TreeNode::most_children>;

/// One bit for each lane.
template <class Tag>
unsigned bits_of(Tag d, hn::Mask<Tag> mask) {
  std::array<std::uint8_t, 8> bytes{};
  hn::StoreMaskBits(d, mask, bytes.data());
  return bytes[0] & ((1U << hn::Lanes(d)) - 1);
}

}  // namespace
}  // namespace fathom::rays::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
