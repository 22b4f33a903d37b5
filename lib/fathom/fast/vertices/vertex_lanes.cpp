// Transforms vertices to the image, several at once. Compiled for every kind of vector
// instructions; the best kind of the machine is selected at run time.
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "fathom/fast/vertices/vertex_lanes.cpp"
#include <hwy/foreach_target.h>  // must come before highway.h
#include <hwy/highway.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "fathom/fast/lanes/lanes-inl.h"
#include "fathom/fast/vertices/vertex.h"

HWY_BEFORE_NAMESPACE();
namespace fathom::fast::HWY_NAMESPACE {
namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();

/// m₀x + m₁y + m₂z + m₃, in an order for which the bound of vertex.cpp holds.
HWY_INLINE V apply(const ImageRows::Row& m, V x, V y, V z) {
  return hn::MulAdd(constant(m[0]), x,
                    hn::MulAdd(constant(m[1]), y, hn::MulAdd(constant(m[2]), z, constant(m[3]))));
}

/// The content of an ImageVertex, and whether the vertex is usable and certainly behind.
struct Result {
  V u, v, q, position_error, q_error;
  M usable, behind;
};

// Û, Ŵ computed, E_U, E_W their bounds, r = Û/Ŵ the real quotient, U, W exact. Then
//   |r − U/W| = |(Û − U) + (U/W)(W − Ŵ)| / Ŵ ≤ (E_U + (|r| + |r − U/W|)·E_W) / Ŵ,
// so with E_W ≤ 2⁻²⁰·Ŵ: |r − U/W| ≤ (1 + 2⁻¹⁹)·(E_U + |r|·E_W) / Ŵ. And û = fl(Û·fl(1/Ŵ)) differs
// from r by at most 2.01u·|r|; 3u is used. 2⁻¹⁹ and the difference of r and û go into `slack`.
// Likewise |1/Ŵ − 1/W| ≤ E_W/(Ŵ·W) ≤ (1 + 2⁻¹⁹)·E_W/Ŵ², and the division rounds once more.
// An overflow anywhere makes a condition of `usable` false.
HWY_INLINE Result perspective_vertex(const ImageRows& rows, V x, V y, V z) {
  using namespace vertex_bounds;
  const V ax = hn::Abs(x), ay = hn::Abs(y), az = hn::Abs(z);
  const V U = apply(rows.U, x, y, z), Vv = apply(rows.V, x, y, z), W = apply(rows.W, x, y, z);
  const V uv_error = hn::Mul(constant(affine_error), apply(rows.size_UV, ax, ay, az));
  const V w_error = hn::Mul(constant(affine_error), apply(rows.size_W, ax, ay, az));
  Result r;
  r.q = hn::Div(constant(1), W);
  r.u = hn::Mul(U, r.q);
  r.v = hn::Mul(Vv, r.q);
  const V size = hn::Max(hn::Abs(r.u), hn::Abs(r.v));
  const V relative = hn::Mul(constant(quotient_error), size);
  r.position_error = hn::MulAdd(hn::MulAdd(hn::MulAdd(size, w_error, uv_error), r.q, relative),
                                constant(slack), constant(underflow_floor));
  r.q_error =
      hn::Mul(hn::MulAdd(w_error, r.q, constant(reciprocal_error)), hn::Mul(r.q, constant(slack)));
  r.usable = hn::And(hn::And(hn::And(hn::Ge(W, constant(least_W)), hn::Le(W, constant(greatest_W))),
                             hn::Le(w_error, hn::Mul(W, constant(greatest_relative_error_of_W)))),
                     hn::And(hn::Le(size, constant(greatest_coordinate)),
                             hn::Le(r.position_error, constant(greatest_position_error))));
  r.behind = hn::Lt(hn::MulAdd(hn::Add(w_error, constant(underflow_floor)), constant(slack), W),
                    constant(0));
  return r;
}

// W = 1: no division.
HWY_INLINE Result orthographic_vertex(const ImageRows& rows, V x, V y, V z) {
  using namespace vertex_bounds;
  const V ax = hn::Abs(x), ay = hn::Abs(y), az = hn::Abs(z);
  const V depth = apply(rows.D, x, y, z);
  Result r;
  r.u = apply(rows.U, x, y, z);
  r.v = apply(rows.V, x, y, z);
  r.q = hn::Neg(depth);
  const V scale = constant(affine_error * slack), floor = constant(underflow_floor);
  r.position_error = hn::MulAdd(apply(rows.size_UV, ax, ay, az), scale, floor);
  r.q_error = hn::MulAdd(apply(rows.size_D, ax, ay, az), scale, floor);
  r.usable =
      hn::And(hn::And(hn::Le(hn::Max(hn::Abs(r.u), hn::Abs(r.v)), constant(greatest_coordinate)),
                      hn::Le(r.position_error, constant(greatest_position_error))),
              hn::And(hn::Le(hn::Abs(depth), constant(greatest_W)),
                      hn::Le(r.q_error, constant(greatest_W))));
  r.behind = hn::Lt(r.q, r.q);  // never
  return r;
}

/// See ImageVertex::errors; a position error of +∞ stays +∞.
HWY_INLINE hn::Vec<DU> errors_of(const Result& r) {
  const DU du;
  const auto rounded = hn::ShiftLeft<32>(upper_halves(r.position_error));
  const auto unusable = hn::BitCast(du, constant(infinity));
  const auto upper = hn::IfThenElse(hn::RebindMask(du, r.usable), rounded, unusable);
  return hn::Or(upper, hn::IfThenElseZero(hn::RebindMask(du, r.usable), upper_halves(r.q_error)));
}

/// Whether u and v are within their bounds of multiples of snap_step.
HWY_INLINE M may_snap(const Result& r) {
  const V scale = constant(1 / snap_step), step = constant(snap_step);
  const V u = hn::Mul(hn::Round(hn::Mul(r.u, scale)), step);
  const V v = hn::Mul(hn::Round(hn::Mul(r.v, scale)), step);
  const V distance = hn::Max(hn::Abs(hn::Sub(r.u, u)), hn::Abs(hn::Sub(r.v, v)));
  const V size = hn::Max(hn::Abs(r.u), hn::Abs(r.v));
  return hn::And(r.usable,
                 hn::And(hn::Le(distance, r.position_error), hn::Le(size, constant(snap_limit))));
}

/// Moves the vertices that lie exactly on the grid to their places; few vertices do, in most scenes
/// none.
HWY_NOINLINE void snap(const VertexTransform& transform, const MeshPoint* points,
                       ImageVertex* image, std::size_t count) {
  for (std::size_t i = 0; i < count; ++i) {
    ImageVertex& vertex = image[i];
    if (!vertex.is_usable()) continue;
    const double u = std::nearbyint(vertex.u / snap_step) * snap_step;
    const double v = std::nearbyint(vertex.v / snap_step) * snap_step;
    if (std::abs(u) > snap_limit || std::abs(v) > snap_limit) continue;
    if (!transform.lies_exactly_at(points[i], u, v)) continue;
    vertex.u = u;
    vertex.v = v;
    vertex.errors &= 0xFFFFFFFF;
  }
}

/// As many vertices as there are lanes.
HWY_INLINE void transform_lanes(const VertexTransform& transform, const MeshPoint* points,
                                ImageVertex* image, std::size_t count) {
  const D d;
  const ImageRows& rows = transform.rows();
  V x, y, z;
  hn::LoadInterleaved3(d, &points->x, x, y, z);
  const Result r = transform.is_perspective() ? perspective_vertex(rows, x, y, z)
                                              : orthographic_vertex(rows, x, y, z);
  const V not_usable = hn::IfThenElse(r.behind, constant(-1), constant(0));
  const V u = hn::IfThenElseZero(r.usable, r.u), v = hn::IfThenElseZero(r.usable, r.v);
  const V q = hn::IfThenElse(r.usable, r.q, not_usable);
  hn::StoreInterleaved4(u, v, q, hn::BitCast(d, errors_of(r)), d, &image->u);
  if (HWY_UNLIKELY(!hn::AllFalse(d, may_snap(r)))) snap(transform, points, image, count);
}

void transform_vertices(const VertexTransform& transform, const MeshPoint* points,
                        std::size_t count, ImageVertex* image) {
  const std::size_t lanes = hn::Lanes(D());
  std::size_t i = 0;
  for (; i + lanes <= count; i += lanes) {
    transform_lanes(transform, points + i, image + i, lanes);
  }
  if (i == count) return;
  MeshPoint last_points[8] = {};
  ImageVertex last_image[8];
  std::copy(points + i, points + count, last_points);
  transform_lanes(transform, last_points, last_image, count - i);
  std::copy(last_image, last_image + (count - i), image + i);
}

}  // namespace
}  // namespace fathom::fast::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace fathom::fast {

HWY_EXPORT(transform_vertices);

void VertexTransform::operator()(std::span<const MeshPoint> points, ImageVertex* image) const {
  if (!usable_) {
    const std::uint64_t unknown =
        std::bit_cast<std::uint64_t>(std::numeric_limits<double>::infinity());
    std::fill_n(image, points.size(), ImageVertex{0, 0, 0, unknown});
    return;
  }
  HWY_DYNAMIC_DISPATCH(transform_vertices)(*this, points.data(), points.size(), image);
}

}  // namespace fathom::fast
#endif
