// The walk along a ray: eight boxes and four triangles at a time, with the bounds of ray_bounds.h.
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "fathom/rays/cast_lanes.cpp"
#include <hwy/cache_control.h>
#include <hwy/foreach_target.h>  // must come before highway.h
#include <hwy/highway.h>

#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>

#include "fathom/rays/test_boxes-inl.h"
#include "fathom/rays/test_triangles-inl.h"
#include "fathom/rays/walk_ray.h"

HWY_BEFORE_NAMESPACE();
namespace fathom::rays::HWY_NAMESPACE {
namespace {

/// Returns whether the answer is known.
template <class Stored>
bool test_leaf(const TriangleBlock<Stored>* blocks, std::size_t block, std::uint32_t triangles,
               const WalkRay& ray, const Errors& errors, TriangleVisitor& visitor) {
  BlockTest test;
  for (; triangles > 0; ++block) {
    const std::uint32_t here =
        triangles < triangles_together ? triangles : static_cast<std::uint32_t>(triangles_together);
    triangles -= here;
    test_block(blocks[block], ray, errors, test);
    for (unsigned open = test.open & ((1U << here) - 1); open != 0; open &= open - 1) {
      const auto i = static_cast<std::size_t>(std::countr_zero(open));
      if (visitor.offer({.number = blocks[block].numbers[i],
                         .place = block * triangles_together + i,
                         .is_met = ((test.met >> i) & 1) != 0,
                         .w = test.w[i],
                         .height = test.height[i],
                         .error = test.error[i],
                         .height_error = test.height_error[i]}))
        return true;
    }
  }
  return false;
}

/// Prefetches an object that is needed soon.
template <class T>
HWY_INLINE void prefetch(const T& object) {
  constexpr std::size_t cache_line = 64;
  const auto* const bytes = reinterpret_cast<const std::byte*>(&object);
  for (std::size_t i = 0; i < sizeof(T); i += cache_line) hwy::Prefetch(bytes + i);
}

/// A node or leaf that waits, and where the ray enters its box.
struct Waiting {
  float entry;
  std::uint32_t child, triangles;
};

template <class Stored>
void walk_among(const RayTree& tree, const WalkRay& ray, TriangleVisitor& visitor) {
  const TriangleBlock<Stored>* const blocks = tree.blocks<Stored>().data();
  std::array<Waiting, RayTree::most_levels*(TreeNode::most_children - 1) + 1> waiting;
  std::array<float, TreeNode::most_children> entries;
  const Errors errors(ray, tree.corner_error());
  std::size_t count = 0;
  waiting[count++] = {ray.first, 0, 0};
  while (count > 0) {
    const Waiting next = waiting[--count];
    if (next.entry > visitor.last()) continue;
    if (next.triangles > 0) {
      if (test_leaf(blocks, next.child, next.triangles, ray, errors, visitor)) return;
      continue;
    }
    const TreeNode& node = tree.nodes()[next.child];
    const std::size_t first = count;
    for (unsigned bits = boxes_met(node, ray, visitor.last(), entries); bits != 0;
         bits &= bits - 1) {
      const auto i = static_cast<std::size_t>(std::countr_zero(bits));
      // The nearest box is taken first, so it comes last.
      std::size_t place = count++;
      for (; place > first && waiting[place - 1].entry < entries[i]; --place)
        waiting[place] = waiting[place - 1];
      waiting[place] = {entries[i], node.child[i], node.triangles[i]};
      if (node.triangles[i] > 0) {
        prefetch(blocks[node.child[i]]);
      } else {
        prefetch(tree.nodes()[node.child[i]]);
      }
    }
  }
}

void walk(const RayTree& tree, const WalkRay& ray, TriangleVisitor& visitor) {
  if (tree.is_in_binary32()) {
    walk_among<float>(tree, ray, visitor);
  } else {
    walk_among<double>(tree, ray, visitor);
  }
}

}  // namespace
}  // namespace fathom::rays::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace fathom::rays {

HWY_EXPORT(walk);

void walk(const RayTree& tree, const WalkRay& ray, TriangleVisitor& visitor) {
  if (!tree.nodes().empty()) HWY_DYNAMIC_DISPATCH(walk)(tree, ray, visitor);
}

}  // namespace fathom::rays
#endif
