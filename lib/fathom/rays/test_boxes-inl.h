// The boxes of a node that a ray may meet, with the bounds of ray_bounds.h.
#if defined(FATHOM_RAYS_TEST_BOXES_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef FATHOM_RAYS_TEST_BOXES_INL_H
#undef FATHOM_RAYS_TEST_BOXES_INL_H
#else
#define FATHOM_RAYS_TEST_BOXES_INL_H
#endif

#include <hwy/highway.h>

#include <array>
#include <cstddef>

#include "fathom/rays/ray_bounds.h"
#include "fathom/rays/ray_lanes-inl.h"
#include "fathom/rays/walk_ray.h"

HWY_BEFORE_NAMESPACE();
namespace fathom::rays::HWY_NAMESPACE {
namespace {

/// Which boxes the ray may meet up to `last`, and where it enters them.
HWY_INLINE unsigned boxes_met(const TreeNode& node, const WalkRay& ray, float last,
                              std::array<float, TreeNode::most_children>& entries) {
  const F f;
  unsigned bits = 0;
  for (std::size_t i = 0; i < TreeNode::most_children; i += hn::Lanes(f)) {
    auto enter = hn::Set(f, ray.first), leave = hn::Set(f, last);
    auto beside = hn::Zero(f);  // above 0 for boxes that a parallel ray misses
    for (std::size_t k = 0; k < 3; ++k) {
      const auto lower = hn::LoadU(f, &node.lower[k][i]), upper = hn::LoadU(f, &node.upper[k][i]);
      const auto origin_near = hn::Set(f, ray.origin_near[k]);
      const auto origin_far = hn::Set(f, ray.origin_far[k]);
      if (ray.parallel[k]) {
        beside = hn::Max(beside, hn::Max(hn::Sub(lower, origin_near), hn::Sub(origin_far, upper)));
        continue;
      }
      const auto near_side = ray.backward[k] ? upper : lower;
      const auto far_side = ray.backward[k] ? lower : upper;
      enter = hn::Max(enter, hn::Mul(hn::Sub(near_side, origin_near), hn::Set(f, ray.inverse[k])));
      leave = hn::Min(
          leave, hn::Add(hn::Mul(hn::Sub(far_side, origin_far), hn::Set(f, ray.inverse_far[k])),
                         hn::Set(f, bounds::underflow_room)));
    }
    const auto met = hn::And(hn::Le(enter, leave), hn::Le(beside, hn::Zero(f)));
    hn::StoreU(enter, f, &entries[i]);
    bits |= bits_of(f, met) << i;
  }
  return bits;
}

}  // namespace
}  // namespace fathom::rays::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
