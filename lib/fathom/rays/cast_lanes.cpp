// The walk along a ray: eight boxes and four triangles at a time, with the bounds of ray_bounds.h.
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "fathom/rays/cast_lanes.cpp"
#include <hwy/cache_control.h>
#include <hwy/foreach_target.h>  // must come before highway.h
#include <hwy/highway.h>

#include <array>
#include <bit>
#include <cmath>
#include <cstddef>
#include <cstdint>

#include "fathom/rays/ray_bounds.h"
#include "fathom/rays/ray_tree.h"
#include "fathom/rays/walk_ray.h"

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

// The boxes of a node that a ray may meet.

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

// The triangles of a block that a ray does not certainly miss.

struct V3 {
  V x, y, z;
};

/// Of one corner, from lane i on.
V3 load(const TriangleBlock<double>::Rows& rows, std::size_t i) {
  const D d;
  return {hn::LoadU(d, &rows[0][i]), hn::LoadU(d, &rows[1][i]), hn::LoadU(d, &rows[2][i])};
}
V3 load(const TriangleBlock<float>::Rows& rows, std::size_t i) {
  const D d;
  const hn::Rebind<float, D> f;
  return {hn::PromoteTo(d, hn::LoadU(f, &rows[0][i])), hn::PromoteTo(d, hn::LoadU(f, &rows[1][i])),
          hn::PromoteTo(d, hn::LoadU(f, &rows[2][i]))};
}
V3 constant(const Vector& v) {
  const D d;
  return {hn::Set(d, v[0]), hn::Set(d, v[1]), hn::Set(d, v[2])};
}
V3 minus(const V3& a, const V3& b) {
  return {hn::Sub(a.x, b.x), hn::Sub(a.y, b.y), hn::Sub(a.z, b.z)};
}
V product_difference(V a, V b, V c, V d) {
  return hn::Sub(hn::Mul(a, b), hn::Mul(c, d));
}
V3 cross(const V3& a, const V3& b) {
  return {product_difference(a.y, b.z, a.z, b.y), product_difference(a.z, b.x, a.x, b.z),
          product_difference(a.x, b.y, a.y, b.x)};
}
V dot(const V3& a, const V3& b) {
  return hn::Add(hn::Add(hn::Mul(a.x, b.x), hn::Mul(a.y, b.y)), hn::Mul(a.z, b.z));
}

/// The parts of the bounds that do not depend on the triangle.
struct Errors {
  double products, origin, corners, height, height_corners, height_origin, size_room;

  Errors(const WalkRay& ray, double corner_error) {
    const Vector& d = ray.direction;
    const double size = (std::abs(d[0]) + std::abs(d[1]) + std::abs(d[2])) * bounds::slack;
    const double near = corner_error + ray.origin_error;
    products =
        size * bounds::of_products + bounds::of_direction * ray.direction_error * bounds::slack;
    origin = size * bounds::of_origin * near;
    corners = size * bounds::of_corners * corner_error;
    size_room = bounds::size_room * corner_error;
    height = bounds::of_height * bounds::slack;
    height_corners = bounds::of_height_corners * corner_error * bounds::slack;
    height_origin = bounds::of_height_origin * near * bounds::slack;
  }
};

/// The results for the triangles of a block, side by side.
struct BlockTest {
  /// A bit for each triangle that is met, and for each that is not certainly missed.
  unsigned met = 0, open = 0;
  std::array<double, triangles_together> w, height, error, height_error;
};

V greatest_magnitude(const V3& v) {
  return hn::Max(hn::Abs(v.x), hn::Max(hn::Abs(v.y), hn::Abs(v.z)));
}

template <class Stored>
HWY_INLINE void test_block(const TriangleBlock<Stored>& block, const WalkRay& ray,
                           const Errors& errors, BlockTest& test) {
  const D tag;
  test.met = test.open = 0;
  for (std::size_t i = 0; i < triangles_together; i += hn::Lanes(tag)) {
    const V3 a = load(block.corners[0], i), p = minus(load(block.corners[1], i), a),
             r = minus(load(block.corners[2], i), a);
    const V3 t = minus(a, constant(ray.origin)), d = constant(ray.direction);
    const V3 n = cross(p, r);
    const V w_b = dot(d, cross(r, t)), w_c = dot(d, cross(t, p)), w = dot(n, d);
    const V w_a = hn::Sub(hn::Sub(w, w_b), w_c);

    const V H = hn::Add(hn::Max(greatest_magnitude(p), greatest_magnitude(r)),
                        hn::Set(tag, errors.size_room));
    const V T = greatest_magnitude(t);
    const V sum = hn::Add(T, H);
    const V of_edge =
        hn::Add(hn::Mul(sum, hn::Set(tag, errors.products)), hn::Set(tag, errors.origin));
    const V error =
        hn::Add(hn::Add(hn::Mul(H, of_edge), hn::Mul(sum, hn::Set(tag, errors.corners))),
                hn::Set(tag, bounds::floor));

    const V greatest = hn::Max(hn::Max(w_a, w_b), hn::Max(w_c, w));
    const V least = hn::Min(hn::Min(w_a, w_b), hn::Min(w_c, w));
    const V minus_error = hn::Neg(error);
    const auto missed = hn::And(hn::Gt(greatest, error), hn::Lt(least, minus_error));
    const auto met = hn::Or(hn::Gt(least, error), hn::Lt(greatest, minus_error));
    const unsigned all = (1U << hn::Lanes(tag)) - 1;
    const unsigned open = ~bits_of(tag, missed) & all;
    if (open == 0) continue;
    test.open |= open << i;
    test.met |= bits_of(tag, met) << i;
    hn::StoreU(w, tag, &test.w[i]);
    hn::StoreU(error, tag, &test.error[i]);
    hn::StoreU(dot(n, t), tag, &test.height[i]);
    const V of_squares =
        hn::Add(hn::Mul(T, hn::Set(tag, errors.height)), hn::Set(tag, errors.height_origin));
    const V of_distance = hn::Mul(T, hn::Set(tag, errors.height_corners));
    hn::StoreU(hn::Add(hn::Mul(H, hn::Add(hn::Mul(H, of_squares), of_distance)),
                       hn::Set(tag, bounds::floor)),
               tag, &test.height_error[i]);
  }
}

// The walk.

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
