// The triangles of a block that a ray is not certain to miss, with the bounds of ray_bounds.h.
#if defined(FATHOM_RAYS_TEST_TRIANGLES_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef FATHOM_RAYS_TEST_TRIANGLES_INL_H
#undef FATHOM_RAYS_TEST_TRIANGLES_INL_H
#else
#define FATHOM_RAYS_TEST_TRIANGLES_INL_H
#endif

#include <hwy/highway.h>

#include <array>
#include <cmath>
#include <cstddef>

#include "fathom/rays/ray_bounds.h"
#include "fathom/rays/ray_lanes-inl.h"
#include "fathom/rays/walk_ray.h"

HWY_BEFORE_NAMESPACE();
namespace fathom::rays::HWY_NAMESPACE {
namespace {

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

}  // namespace
}  // namespace fathom::rays::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
