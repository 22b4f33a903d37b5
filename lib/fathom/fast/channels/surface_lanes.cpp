#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "fathom/fast/channels/surface_lanes.cpp"
#include "fathom/fast/channels/surface_lanes.h"

#include <hwy/foreach_target.h>  // must come before highway.h
#include <hwy/highway.h>

#include <limits>

#include "fathom/fast/channels/depth_interval-inl.h"
#include "fathom/fast/channels/round_lanes-inl.h"
#include "fathom/fast/lanes/lanes-inl.h"
#include "fathom/fast/pixels/shading_normals.h"

HWY_BEFORE_NAMESPACE();
namespace fathom::fast::HWY_NAMESPACE {
using namespace triangle;

namespace {

constexpr double ulp = epsilon<double>;

struct Vector3 {
  V x, y, z;
};

HWY_INLINE Vector3 load3(const std::array<TriangleLanes::Numbers, 3>& from, std::size_t first) {
  const D d;
  return {hn::Load(d, from[0].data() + first), hn::Load(d, from[1].data() + first),
          hn::Load(d, from[2].data() + first)};
}
HWY_INLINE Vector3 constants(const std::array<double, 3>& a) {
  return {constant(a[0]), constant(a[1]), constant(a[2])};
}
HWY_INLINE Vector3 entries_of(const std::array<WordPair, 3>& a) {
  return {constant(a[0].hi), constant(a[1].hi), constant(a[2].hi)};
}
HWY_INLINE Vector3 minus(const Vector3& a, const Vector3& b) {
  return {hn::Sub(a.x, b.x), hn::Sub(a.y, b.y), hn::Sub(a.z, b.z)};
}
HWY_INLINE Vector3 plus(const Vector3& a, const Vector3& b) {
  return {hn::Add(a.x, b.x), hn::Add(a.y, b.y), hn::Add(a.z, b.z)};
}
HWY_INLINE Vector3 magnitudes(const Vector3& a) {
  return {hn::Abs(a.x), hn::Abs(a.y), hn::Abs(a.z)};
}
HWY_INLINE V dot3(const Vector3& a, const Vector3& b) {
  return hn::MulAdd(a.z, b.z, hn::MulAdd(a.y, b.y, hn::Mul(a.x, b.x)));
}
HWY_INLINE Vector3 cross3(const Vector3& a, const Vector3& b) {
  return {hn::MulSub(a.y, b.z, hn::Mul(a.z, b.y)), hn::MulSub(a.z, b.x, hn::Mul(a.x, b.z)),
          hn::MulSub(a.x, b.y, hn::Mul(a.y, b.x))};
}
/// The magnitudes of the terms of a cross product, from the magnitudes of its factors.
HWY_INLINE Vector3 cross_sizes(const Vector3& a, const Vector3& b) {
  return {hn::MulAdd(a.y, b.z, hn::Mul(a.z, b.y)), hn::MulAdd(a.z, b.x, hn::Mul(a.x, b.z)),
          hn::MulAdd(a.x, b.y, hn::Mul(a.y, b.x))};
}

/// A vector, and the magnitudes of its terms.
struct SizedVector {
  Vector3 value, size;
};
HWY_INLINE SizedVector cross_of(const SizedVector& a, const SizedVector& b) {
  return {cross3(a.value, b.value), cross_sizes(a.size, b.size)};
}

/// p, r and n of triangles, as struct Edges has them, and whether the corners are safe.
struct EdgeVectors {
  Vector3 A;
  SizedVector p, r, n;
  M safe;
};

HWY_INLINE M are_safe(const Vector3& corner) {
  const auto is_safe = [](V x) HWY_ATTR {
    const V size = hn::Abs(x);
    return hn::And(hn::Le(size, constant(greatest_safe)),
                   hn::Or(hn::Ge(size, constant(least_safe)), hn::Eq(size, constant(0))));
  };
  return hn::And(is_safe(corner.x), hn::And(is_safe(corner.y), is_safe(corner.z)));
}

HWY_INLINE EdgeVectors edges_of(const TriangleLanes& t, std::size_t first) {
  const Vector3 A = load3(t.corners[0], first), B = load3(t.corners[1], first),
                C = load3(t.corners[2], first);
  const auto sized = [](const Vector3& x) HWY_ATTR { return SizedVector{x, magnitudes(x)}; };
  const SizedVector p = sized(minus(B, A)), r = sized(minus(C, A));
  return {A, p, r, cross_of(p, r), hn::And(are_safe(A), hn::And(are_safe(B), are_safe(C)))};
}

HWY_INLINE SizedVector placed_by(const SizedVector& n, const NormalMatrix& matrix) {
  const auto value = [&](std::size_t i)
                         HWY_ATTR { return dot3(entries_of(matrix.rows[i]), n.value); };
  const auto size = [&](std::size_t i)
                        HWY_ATTR { return dot3(constants(matrix.sizes[i]), n.size); };
  return {{value(0), value(1), value(2)}, {size(0), size(1), size(2)}};
}

/// n·d where the triangles are visible, with a bound: see along_ray().
HWY_INLINE CertifiedLanes along_rays(const SizedVector& n, const TriangleLanes& t,
                                     const ValueFrame& frame, std::size_t first) {
  const auto& columns = frame.rays.world().rays.columns;
  Vector3 d = entries_of(columns[2]);
  if (frame.image.perspective) {
    const V u = hn::Load(D(), t.u.data() + first), v = hn::Load(D(), t.v.data() + first);
    const auto coordinate = [&](std::size_t i) HWY_ATTR {
      return hn::MulAdd(constant(columns[0][i].hi), u,
                        hn::MulAdd(constant(columns[1][i].hi), v, constant(columns[2][i].hi)));
    };
    d = {coordinate(0), coordinate(1), coordinate(2)};
  }
  return {dot3(n.value, d), hn::Mul(constant(surface_bounds::turn * (ulp * slack)),
                                    dot3(n.size, constants(frame.world_sizes.direction)))};
}

/// A component of the unit normal: see quotient() and unit() in certified_surface.h.
HWY_INLINE RoundedLanes round_component(V n, V size, V error, const CertifiedLanes& length) {
  const V value = hn::Div(n, length.value), magnitude = hn::Abs(value);
  const V of_operands = hn::Div(
      hn::Add(hn::MulAdd(magnitude, length.error, error), constant(most_underflow)), length.value);
  const V bound =
      hn::Mul(hn::Add(hn::MulAdd(constant(ulp), magnitude, of_operands), constant(most_underflow)),
              constant(slack));
  const M is_zero = hn::Eq(size, constant(0));
  // Without a bound it is rounded to +0.
  RoundedLanes rounded =
      round_to_binary32({hn::IfThenZeroElse(is_zero, value), hn::IfThenZeroElse(is_zero, bound)});
  rounded.settled |= bits_of(is_zero);
  return rounded;
}

struct RoundedNormals {
  std::array<RoundedLanes, 3> n;
  unsigned settled;
};

/// `factor`: of the bounds on n. `towards`: its sign in each lane is the direction in which n is
/// turned.
HWY_INLINE RoundedNormals unit_normals(const SizedVector& n, double factor,
                                       const CertifiedLanes& towards) {
  const V greatest = greatest_of(n.size.x, n.size.y, n.size.z);
  const V e = constant(factor * (ulp * slack));
  const Vector3 error = {hn::Mul(e, n.size.x), hn::Mul(e, n.size.y), hn::Mul(e, n.size.z)};
  const V length = hn::Sqrt(dot3(n.value, n.value));
  const V length_error = hn::MulAdd(constant(surface_bounds::length * ulp * slack), length,
                                    hn::Add(error.x, hn::Add(error.y, error.z)));
  const M known = hn::And(
      hn::And(hn::Ge(greatest, constant(surface_bounds::least_normal)),
              hn::Le(greatest, constant(surface_bounds::greatest_normal))),
      hn::And(hn::Gt(hn::Abs(towards.value), towards.error),
              hn::And(hn::Gt(length, constant(0)),
                      hn::Le(length_error, hn::Mul(length, constant(quotient_condition))))));
  const M turned = hn::Gt(towards.value, constant(0));
  const auto component = [&](V x, V size, V x_error) HWY_ATTR {
    return round_component(hn::IfThenElse(turned, hn::Neg(x), x), size, x_error,
                           {length, length_error});
  };
  RoundedNormals rounded{
      {component(n.value.x, n.size.x, error.x), component(n.value.y, n.size.y, error.y),
       component(n.value.z, n.size.z, error.z)},
      bits_of(known)};
  for (const RoundedLanes& x : rounded.n) rounded.settled &= x.settled;
  return rounded;
}

unsigned normals_in_lanes(const TriangleLanes& t, const ObjectRays& object, const ValueFrame& frame,
                          bool in_camera_frame, NormalOfSurface* normals) {
  unsigned settled = 0;
  const auto lanes = hn::Lanes(D());
  for (std::size_t first = 0; first < TriangleLanes::most; first += lanes) {
    const EdgeVectors edges = edges_of(t, first);
    const bool as_is = object.placed_as_is;
    const SizedVector world = as_is ? edges.n : placed_by(edges.n, object.to_world);
    CertifiedLanes towards = along_rays(world, t, frame, first);
    if (in_camera_frame && frame.rays.handedness() == Sign::negative) {
      towards.value = hn::Neg(towards.value);
    }
    const SizedVector n = in_camera_frame ? placed_by(edges.n, object.to_camera) : world;
    const double factor =
        as_is && !in_camera_frame ? surface_bounds::normal : surface_bounds::placed_normal;
    const RoundedNormals rounded = unit_normals(n, factor, towards);
    HWY_ALIGN float numbers[3][TriangleLanes::most];
    for (std::size_t i = 0; i < 3; ++i) {
      hn::StoreU(rounded.n[i].value, D32(), numbers[i]);
    }
    for (std::size_t k = 0; k < lanes; ++k) {
      normals[first + k] = {numbers[0][k], numbers[1][k], numbers[2][k], 0};
    }
    settled |= (rounded.settled & bits_of(edges.safe)) << first;
  }
  return settled;
}

HWY_INLINE void store_form(V c, V b, V a, V error, M safe, LaneForm* form) {
  const V known = hn::IfThenElse(safe, error, constant(std::numeric_limits<double>::infinity()));
  hn::StoreInterleaved4(c, b, a, known, D(), &form->c);
}

/// The data of forms that do not depend on the triangle.
struct FormFrame {
  const Rays& rays;
  const ImageBounds& image;
  M safe;

  /// g·(u·m₀ + v·m₁ + m₂): see form_along().
  HWY_INLINE void along(const SizedVector& g, LaneForm* form) const {
    const auto dot_with = [&](std::size_t j)
                              HWY_ATTR { return dot3(g.value, entries_of(rays.columns[j])); };
    const auto size = [&](std::size_t j)
                          HWY_ATTR { return dot3(g.size, constants(rays.sizes[j])); };
    const V terms =
        hn::MulAdd(size(0), constant(image.u), hn::MulAdd(size(1), constant(image.v), size(2)));
    store_form(dot_with(2), dot_with(1), dot_with(0), bound(terms), safe, form);
  }
  /// y·(t − u·m₀ − v·m₁): see form_across().
  HWY_INLINE void across(const SizedVector& y, const SizedVector& t, LaneForm* form) const {
    const auto dot_with = [&](std::size_t j)
                              HWY_ATTR { return dot3(y.value, entries_of(rays.columns[j])); };
    const auto size = [&](std::size_t j)
                          HWY_ATTR { return dot3(y.size, constants(rays.sizes[j])); };
    const V terms = hn::MulAdd(size(0), constant(image.u),
                               hn::MulAdd(size(1), constant(image.v), dot3(y.size, t.size)));
    store_form(dot3(y.value, t.value), hn::Neg(dot_with(1)), hn::Neg(dot_with(0)), bound(terms),
               safe, form);
  }
  HWY_INLINE V bound(V terms) const {
    return hn::Mul(constant(surface_bounds::form * ulp * slack), terms);
  }
};

void weight_forms_in_lanes(const TriangleLanes& triangles, const ObjectRays& object,
                           const ImageBounds& image, const LaneForms& forms) {
  const Rays& rays = object.rays;
  for (std::size_t first = 0; first < TriangleLanes::most; first += hn::Lanes(D())) {
    const EdgeVectors edges = edges_of(triangles, first);
    const FormFrame frame{rays, image, edges.safe};
    const SizedVector t{minus(edges.A, entries_of(rays.columns[3])),
                        plus(magnitudes(edges.A), constants(rays.sizes[3]))};
    if (image.perspective) {
      frame.along(cross_of(edges.r, t), forms.B + first);
      frame.along(cross_of(t, edges.p), forms.C + first);
      frame.along(edges.n, forms.divisor + first);
    } else {
      const SizedVector d{entries_of(rays.columns[2]), constants(rays.sizes[2])};
      frame.across(cross_of(d, edges.r), t, forms.B + first);
      frame.across(cross_of(edges.p, d), t, forms.C + first);
      store_form(dot3(edges.n.value, d.value), constant(0), constant(0),
                 frame.bound(dot3(edges.n.size, d.size)), edges.safe, forms.divisor + first);
    }
  }
}

HWY_INLINE CertifiedLanes form_at(const LaneForm* forms, const LaneIndices& indices, V u,
                                  double v) {
  if (indices.are_same) {
    const LaneForm& f = forms[*indices.first];
    return {hn::MulAdd(constant(f.a), u, constant(f.c + f.b * v)), constant(f.error)};
  }
  const Records f =
      load_records([&](std::size_t lane) HWY_ATTR { return &forms[indices.first[lane]].c; });
  return {hn::MulAdd(f.third, u, hn::MulAdd(f.second, constant(v), f.first)), f.fourth};
}

/// 1/y, whose relative error is at most 4u, and the part of y that y errs by; NaN if nothing is
/// known.
struct Divisor {
  V inverse, error;
};

HWY_INLINE Divisor divisor_of(const CertifiedLanes& y) {
  const Reciprocal inverse = reciprocal(y.value);
  const M known = hn::And(inverse.known,
                          hn::Le(y.error, hn::Mul(hn::Abs(y.value), constant(quotient_condition))));
  return {inverse.value,
          hn::IfThenElse(known, y.error, constant(std::numeric_limits<double>::quiet_NaN()))};
}

/// Like quotient() in numeric/certified_value.h, with 5u more of the value for the inverse and the
/// product with it (validation/proofs/channels/weight_row.gappa.in).
HWY_INLINE CertifiedLanes quotient_by(const Divisor& y, const CertifiedLanes& w) {
  const V value = hn::Mul(w.value, y.inverse), magnitude = hn::Abs(value);
  const V of_operands =
      hn::Mul(hn::Add(hn::MulAdd(magnitude, y.error, w.error), constant(most_underflow)),
              hn::Abs(y.inverse));
  const V bound =
      hn::Add(hn::MulAdd(constant(resolve_bounds::weight_rounding), magnitude, of_operands),
              constant(most_underflow));
  return {value, hn::Mul(bound, constant(slack))};
}

void weights_in_lanes(const SurfaceRow& row, const SurfaceIndices& indices, const LaneForms& forms,
                      std::array<RoundedValues<float>, 2>& rounded) {
  for (RoundedValues<float>& r : rounded) r.settled = 0;
  for (std::size_t first = 0; first < TileShape::size; first += hn::Lanes(D())) {
    const LaneIndices at = indices_at(indices.data(), first);
    const V u = load_u(row, first);
    const Divisor divisor = divisor_of(form_at(forms.divisor, at, u, row.v));
    store_rounded(quotient_by(divisor, form_at(forms.B, at, u, row.v)), first, rounded[0]);
    store_rounded(quotient_by(divisor, form_at(forms.C, at, u, row.v)), first, rounded[1]);
  }
}

/// at_A, to_B, to_C.
using NormalLanes = std::array<CertifiedLanes, 3>;

HWY_INLINE NormalLanes shading_normal_at(const LaneShadingNormal* normals,
                                         const LaneIndices& indices, std::size_t component) {
  if (indices.are_same) {
    const auto& n = normals[*indices.first].components[component];
    return {{{constant(n.at_A), constant(n.error_A)},
             {constant(n.to_B), constant(n.error_B)},
             {constant(n.to_C), constant(n.error_C)}}};
  }
  const auto at = [&](std::size_t lane)
                      HWY_ATTR { return &normals[indices.first[lane]].components[component].at_A; };
  const Records first = load_records(at);
  const Records second = load_records([&](std::size_t lane) HWY_ATTR { return at(lane) + 4; });
  return {
      {{first.first, first.fourth}, {first.second, second.first}, {first.third, second.second}}};
}

HWY_INLINE M is_exact_zero(const CertifiedLanes& x) {
  return hn::And(hn::Eq(x.value, constant(0)), hn::Eq(x.error, constant(0)));
}

/// sum() and product() in numeric/certified_value.h; of the factors only y may be exactly 0.
HWY_INLINE CertifiedLanes certified_sum(const CertifiedLanes& x, const CertifiedLanes& y) {
  const V value = hn::Add(x.value, y.value);
  const V error = hn::MulAdd(constant(ulp), hn::Abs(value), hn::Add(x.error, y.error));
  return {value, hn::Mul(error, constant(slack))};
}
HWY_INLINE CertifiedLanes certified_product(const CertifiedLanes& x, const CertifiedLanes& y) {
  const V value = hn::Mul(x.value, y.value);
  const V of_factors =
      hn::MulAdd(hn::Abs(x.value), y.error, hn::Mul(hn::Add(hn::Abs(y.value), y.error), x.error));
  const V of_rounding = hn::MulAdd(constant(ulp), hn::Abs(value), constant(most_underflow));
  const V error = hn::Mul(hn::Add(of_factors, of_rounding), constant(slack));
  const M is_zero = is_exact_zero(y);
  return {hn::IfThenZeroElse(is_zero, value), hn::IfThenZeroElse(is_zero, error)};
}

/// A component of any length, from the weights of B and C.
HWY_INLINE CertifiedLanes interpolated_component(const LaneShadingNormal* normals,
                                                 const LaneIndices& at, std::size_t component,
                                                 const CertifiedLanes& B, const CertifiedLanes& C) {
  const NormalLanes n = shading_normal_at(normals, at, component);
  return certified_sum(n[0], certified_sum(certified_product(B, n[1]), certified_product(C, n[2])));
}

/// The inverse of the length; unknown if squares may leave their range.
HWY_INLINE Divisor length_of(const CertifiedLanes& x, const CertifiedLanes& y,
                             const CertifiedLanes& z) {
  const Vector3 n{x.value, y.value, z.value};
  const V greatest = greatest_magnitude(n.x, n.y, n.z);
  const V length = hn::Sqrt(dot3(n, n));
  const V error = hn::MulAdd(constant(surface_bounds::length * ulp * slack), length,
                             hn::Add(hn::Add(x.error, y.error), z.error));
  const M known = hn::And(hn::And(hn::Ge(greatest, constant(least_shading_normal)),
                                  hn::Le(greatest, constant(greatest_shading_normal))),
                          hn::Le(error, hn::Mul(length, constant(quotient_condition))));
  return {hn::Div(constant(1), length),
          hn::IfThenElse(known, error, constant(std::numeric_limits<double>::quiet_NaN()))};
}

/// A component that is exactly 0 remains 0 if the length is known.
HWY_INLINE unsigned store_component(const CertifiedLanes& c, const Divisor& length,
                                    std::size_t first, MapRow<float>& row) {
  const M is_zero = hn::And(is_exact_zero(c), hn::Eq(length.error, length.error));
  const CertifiedLanes quotient = quotient_by(length, c);
  // Without a bound it is rounded to +0.
  const RoundedLanes r = round_to_binary32(
      {hn::IfThenZeroElse(is_zero, quotient.value), hn::IfThenZeroElse(is_zero, quotient.error)});
  hn::StoreU(r.value, D32(), row.data() + first);
  return r.settled | bits_of(is_zero);
}

void shading_normals_in_lanes(const SurfaceRow& row, const SurfaceIndices& indices,
                              const LaneForms& forms, const LaneShadingNormal* normals,
                              std::array<RoundedValues<float>, 3>& rounded) {
  std::uint64_t settled = 0;
  for (std::size_t first = 0; first < TileShape::size; first += hn::Lanes(D())) {
    const LaneIndices at = indices_at(indices.data(), first);
    const V u = load_u(row, first);
    const Divisor divisor = divisor_of(form_at(forms.divisor, at, u, row.v));
    const CertifiedLanes B = quotient_by(divisor, form_at(forms.B, at, u, row.v));
    const CertifiedLanes C = quotient_by(divisor, form_at(forms.C, at, u, row.v));
    const CertifiedLanes x = interpolated_component(normals, at, 0, B, C);
    const CertifiedLanes y = interpolated_component(normals, at, 1, B, C);
    const CertifiedLanes z = interpolated_component(normals, at, 2, B, C);
    const Divisor length = length_of(x, y, z);
    settled |= std::uint64_t{store_component(x, length, first, rounded[0].values) &
                             store_component(y, length, first, rounded[1].values) &
                             store_component(z, length, first, rounded[2].values)}
               << first;
  }
  for (RoundedValues<float>& r : rounded) r.settled = settled;
}

}  // namespace
}  // namespace fathom::fast::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace fathom::fast {
using namespace triangle;

HWY_EXPORT(normals_in_lanes);
HWY_EXPORT(weight_forms_in_lanes);
HWY_EXPORT(weights_in_lanes);
HWY_EXPORT(shading_normals_in_lanes);

unsigned round_normals(const TriangleLanes& triangles, const ObjectRays& object,
                       const ValueFrame& frame, bool in_camera_frame, NormalOfSurface* normals) {
  return HWY_DYNAMIC_DISPATCH(normals_in_lanes)(triangles, object, frame, in_camera_frame, normals);
}

void make_weight_forms(const TriangleLanes& triangles, const ObjectRays& object,
                       const ImageBounds& image, const LaneForms& forms) {
  HWY_DYNAMIC_DISPATCH(weight_forms_in_lanes)(triangles, object, image, forms);
}

void round_weights(const SurfaceRow& row, const SurfaceIndices& indices, const LaneForms& forms,
                   std::array<RoundedValues<float>, 2>& rounded) {
  HWY_DYNAMIC_DISPATCH(weights_in_lanes)(row, indices, forms, rounded);
}

LaneShadingNormal lane_shading_normal(const SurfaceNormals* normals) {
  constexpr double unknown = std::numeric_limits<double>::infinity();
  LaneShadingNormal lanes;
  for (std::size_t i = 0; i < 3; ++i) {
    LaneShadingNormal::Component& c = lanes.components[i];
    if (!normals) {
      c.error_A = c.error_B = c.error_C = unknown;
      continue;
    }
    c.at_A = normals->at_A[i].value;
    c.to_B = normals->to_B[i].value;
    c.to_C = normals->to_C[i].value;
    c.error_A = normals->at_A[i].error;
    c.error_B = normals->to_B[i].error;
    c.error_C = normals->to_C[i].error;
  }
  return lanes;
}

void round_shading_normals(const SurfaceRow& row, const SurfaceIndices& indices,
                           const LaneForms& forms, const LaneShadingNormal* normals,
                           std::array<RoundedValues<float>, 3>& rounded) {
  HWY_DYNAMIC_DISPATCH(shading_normals_in_lanes)(row, indices, forms, normals, rounded);
}

void take_normals(const SurfaceIndices& indices, std::span<const NormalOfSurface> normals,
                  std::array<MapRow<float>, 3>& taken) {
  for (std::size_t k = 0; k < TileShape::size; ++k) {
    const NormalOfSurface& n = normals[indices[k]];
    for (std::size_t i = 0; i < 3; ++i) taken[i][k] = n[i];
  }
}

}  // namespace fathom::fast
#endif
