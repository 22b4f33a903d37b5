#pragma once

#include <algorithm>
#include <array>
#include <cmath>

#include "fathom/numeric/certified_rounding.h"
#include "fathom/numeric/certified_value.h"
#include "fathom/numeric/double_word.h"
#include "fathom/triangle/rays.h"

// Constants of the channels' bounds, in units of ε times the magnitudes of the terms; their
// derivations are where they are used. validation/proofs/channels/surface_*.gappa.in proves each,
// in the arithmetic of binary64 and in that of double-words.
namespace fathom::triangle::surface_bounds {

/// n = p × r; placed by cofactors; n·t; forms c + b·v + a·u; n·d for the turn of a normal.
inline constexpr double normal = 4, placed_normal = 8, constant_form = 9, form = 12, turn = 15;
/// The root of n·n, in addition to the effect of the errors of the components.
inline constexpr double length = 3;
/// Origin + direction·D; √(x² + y² + 1), in units of X̄² + Ȳ² + 1 (one more, and of the value).
inline constexpr double position = 6, ray_length = 6;

/// Greatest sizes of a normal's components whose squares stay in range.
inline constexpr double least_normal = 0x1p-250, greatest_normal = 0x1p450;

}  // namespace fathom::triangle::surface_bounds

// Depth, barycentric weights and normal of a triangle at a sample, with bounds on their errors, in
// any arithmetic whose operations have a relative error of at most ε = epsilon<Real>: binary64 and
// double-words. One derivation serves both (docs/error-analysis.md, "Channels").
//
// Method ([MT97]). p = B − A, r = C − A, n = p × r, t = A − (origin of the ray), d the direction of
// the ray (rays.h), all in the frame of the mesh. The point of depth D on the ray lies in the plane
// of the triangle where D·(n·d) = n·t, and there its weights of B and C are d·(r × t)/(n·d) and
// d·(t × p)/(n·d). No corner needs to lie in front of the camera.
//
// How errors are counted. x̂ is the computed x; x̄ ≥ |x|, |x̂| is the value of the same expression
// with every term replaced by its magnitude. An error of k·ε·x̄ is written "k". A product has the
// sum of its factors' k and 1; a sum, the greatest k of its terms and 1. Inputs: coordinates 0,
// entries of tables 1. Terms of second order are below 2⁻⁴⁰ of those of first order and go into
// `slack`, as do the roundings of the bounds themselves.
//
//   p, r                     1    difference of two coordinates
//   n    p·r − p·r           4    1 + 1 + 1 of a product, 1 of the difference
//   t    A − O               2    1 of O, 1 of the difference; t̄ = |A| + |O|
//   n·t                      9    4 + 2 + 1 of a product, 2 of sums
//   n·m  (m a column)        8    4 + 1 + 1, 2
//   r × t, t × p             5    1 + 2 + 1, 1
//   (r × t)·m                9    5 + 1 + 1, 2
//   m × r, p × m             4    1 + 1 + 1, 1
//   (m × r)·t                9    4 + 2 + 1, 2
//   (m × r)·m                8    4 + 1 + 1, 2
//   c + b·v + a·u          k+3    exact u, v; one product, two sums; k ≤ 9: at most 12
//
// Nothing underflows: coordinates and leading parts of entries are 0 or between 2⁻¹⁰⁰ and 2¹⁰⁰, so
// coordinates are multiples of 2⁻¹⁵², entries, whose second words are not below 2⁻²¹⁰, of 2⁻²⁶²,
// and a multiple of a power of two remains one when it is rounded: every intermediate result above,
// and every error of one, is a multiple of 2⁻⁶⁷⁷
// (samples lie at halves). Nor does anything overflow: (2¹⁰¹)⁴·2⁴⁰ < 2⁵⁰⁰.
namespace fathom::triangle {

/// c + b·v + a·u; its computed and exact values differ by at most `error` at every sample.
template <class Real>
struct Form {
  Real a{}, b{}, c{};
  double error = 0;

  [[nodiscard]] Certified<Real> at(const ImagePoint& s) const {
    return {(c + b * s.v) + a * s.u, error};
  }
  /// At a point of the image that is known up to bounds. A product of two numbers of the arithmetic
  /// has an error of at most ε, as that with an exact coordinate has. Errors of a and b times those
  /// of the point are of second order.
  [[nodiscard]] Certified<Real> at(const Certified<Real>& u, const Certified<Real>& v) const {
    const double of_point = std::abs(nearest(a)) * u.error + std::abs(nearest(b)) * v.error;
    return {(c + b * v.value) + a * u.value, (error + of_point) * slack};
  }
};

/// Corners of a triangle in its mesh.
using MeshTriangle = std::array<MeshPoint, 3>;

/// Whether the bounds were derived for such corners.
inline bool is_safe(const MeshTriangle& corners) {
  for (const MeshPoint& X : corners) {
    for (const double x : {X.x, X.y, X.z}) {
      const double size = std::abs(x);
      if (!(size <= greatest_safe) || (size < least_safe && size != 0)) return false;
    }
  }
  return true;
}

template <class Real>
Real dot(const Vector<Real>& a, const Vector<Real>& b) {
  return (a[0] * b[0] + a[1] * b[1]) + a[2] * b[2];
}

template <class Real>
Vector<Real> cross(const Vector<Real>& a, const Vector<Real>& b) {
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}

/// The magnitudes of the terms of a cross product, from the magnitudes of its factors.
inline Vector<double> cross_size(const Vector<double>& a, const Vector<double>& b) {
  return {a[1] * b[2] + a[2] * b[1], a[2] * b[0] + a[0] * b[2], a[0] * b[1] + a[1] * b[0]};
}

template <class Real>
Vector<double> size_of(const Vector<Real>& a) {
  return {std::abs(nearest(a[0])), std::abs(nearest(a[1])), std::abs(nearest(a[2]))};
}

template <class Real>
Vector<Real> displacement(const MeshPoint& a, const MeshPoint& b) {
  return {difference<Real>(a.x, b.x), difference<Real>(a.y, b.y), difference<Real>(a.z, b.z)};
}

template <class Real>
Vector<Real> entries(const std::array<WordPair, 3>& column) {
  return {entry<Real>(column[0]), entry<Real>(column[1]), entry<Real>(column[2])};
}

/// p, r and n of a triangle.
template <class Real>
struct Edges {
  Vector<Real> p, r, n;
  Vector<double> p_size, r_size, n_size;

  explicit Edges(const MeshTriangle& corners)
      : p(displacement<Real>(corners[1], corners[0])),
        r(displacement<Real>(corners[2], corners[0])),
        n(cross(p, r)),
        p_size(size_of(p)),
        r_size(size_of(r)),
        n_size(cross_size(p_size, r_size)) {}
};

/// D at the samples of an image. Perspective: constant / varying(s); orthographic:
/// varying(s) / constant. The divisor is n·d, as in Method above.
template <class Real>
struct DepthForms {
  Form<Real> varying;
  Certified<Real> constant;

  [[nodiscard]] Certified<Real> at(const ImagePoint& s, bool perspective) const {
    const Certified<Real> value = varying.at(s);
    return perspective ? quotient(constant, value) : quotient(value, constant);
  }
};

/// The data for setting up forms that do not depend on the triangle.
struct ImageBounds {
  bool perspective;
  double u, v;  // no sample's coordinates are greater
};

/// t = A − O and its size.
template <class Real>
Vector<Real> from_origin(const MeshPoint& A, const Rays& rays, Vector<double>& size) {
  const Vector<Real> O = entries<Real>(rays.columns[3]);
  size = {std::abs(A.x) + rays.sizes[3][0], std::abs(A.y) + rays.sizes[3][1],
          std::abs(A.z) + rays.sizes[3][2]};
  return {Real(A.x) - O[0], Real(A.y) - O[1], Real(A.z) - O[2]};
}

/// Needs    safe corners, and usable rays of the object.
template <class Real>
DepthForms<Real> depth_forms(const MeshTriangle& corners, const Rays& rays,
                             const ImageBounds& image) {
  constexpr double e = epsilon<Real> * slack;
  const Edges<Real> edges(corners);
  Vector<double> t_size;
  const Vector<Real> t = from_origin<Real>(corners[0], rays, t_size);
  const Real nt = dot(edges.n, t);
  const double nt_size = dot(edges.n_size, t_size);
  Vector<Real> nm;
  Vector<double> nm_size;
  for (std::size_t j = 0; j < 3; ++j) {
    nm[j] = dot(edges.n, entries<Real>(rays.columns[j]));
    nm_size[j] = dot(edges.n_size, rays.sizes[j]);
  }
  const double part = nm_size[0] * image.u + nm_size[1] * image.v;
  if (image.perspective) {
    return {{nm[0], nm[1], nm[2], surface_bounds::form * e * (part + nm_size[2])},
            {nt, surface_bounds::constant_form * e * nt_size}};
  }
  return {{-nm[0], -nm[1], nt, surface_bounds::form * e * (part + nt_size)},
          {nm[2], surface_bounds::constant_form * e * nm_size[2]}};
}

/// The weights of B and C: weights[0](s)/divisor(s), weights[1](s)/divisor(s).
template <class Real>
struct WeightForms {
  std::array<Form<Real>, 2> weights;
  Form<Real> divisor;  // constant under an orthographic camera

  [[nodiscard]] Certified<Real> at(std::size_t k, const ImagePoint& s) const {
    return quotient(weights[k].at(s), divisor.at(s));
  }
};

/// The form g·(u·m₀ + v·m₁ + m₂).
template <class Real>
Form<Real> form_along(const Vector<Real>& g, const Vector<double>& g_size, const Rays& rays,
                      const ImageBounds& image) {
  const auto along = [&](std::size_t j) { return dot(g, entries<Real>(rays.columns[j])); };
  const auto size = [&](std::size_t j) { return dot(g_size, rays.sizes[j]); };
  return {along(0), along(1), along(2),
          surface_bounds::form * epsilon<Real> * slack *
              (size(0) * image.u + size(1) * image.v + size(2))};
}

/// The form y·(t − u·m₀ − v·m₁).
template <class Real>
Form<Real> form_across(const Vector<Real>& y, const Vector<double>& y_size, const Vector<Real>& t,
                       const Vector<double>& t_size, const Rays& rays, const ImageBounds& image) {
  const auto along = [&](std::size_t j) { return dot(y, entries<Real>(rays.columns[j])); };
  const auto size = [&](std::size_t j) { return dot(y_size, rays.sizes[j]); };
  return {-along(0), -along(1), dot(y, t),
          surface_bounds::form * epsilon<Real> * slack *
              (size(0) * image.u + size(1) * image.v + dot(y_size, t_size))};
}

/// Perspective: d·(r × t) with d varying. Orthographic: d = m₂ and t varies, and d·(r × t) =
/// (d × r)·t, d·(t × p) = (p × d)·t.
/// Needs    safe corners, and usable rays of the object.
template <class Real>
WeightForms<Real> weight_forms(const MeshTriangle& corners, const Rays& rays,
                               const ImageBounds& image) {
  const Edges<Real> edges(corners);
  Vector<double> t_size;
  const Vector<Real> t = from_origin<Real>(corners[0], rays, t_size);
  if (image.perspective) {
    const auto along = [&](const Vector<Real>& g, const Vector<double>& size) {
      return form_along(g, size, rays, image);
    };
    return {{along(cross(edges.r, t), cross_size(edges.r_size, t_size)),
             along(cross(t, edges.p), cross_size(t_size, edges.p_size))},
            along(edges.n, edges.n_size)};
  }
  const Vector<Real> d = entries<Real>(rays.columns[2]);
  const Vector<double>& d_size = rays.sizes[2];
  const auto across = [&](const Vector<Real>& y, const Vector<double>& size) {
    return form_across(y, size, t, t_size, rays, image);
  };
  return {{across(cross(d, edges.r), cross_size(d_size, edges.r_size)),
           across(cross(edges.p, d), cross_size(edges.p_size, d_size))},
          {Real{}, Real{}, dot(edges.n, d),
           surface_bounds::form * epsilon<Real> * slack * dot(edges.n_size, d_size)}};
}

/// Origin and direction of the ray of a sample. One of them varies over the image, as
/// a + b·v + c·u: entries, one product, two sums. Errors are at most 4ε times RaySizes.
template <class Real>
struct Ray {
  Vector<Real> origin, direction;
};
template <class Real>
Ray<Real> ray_at(const Rays& rays, bool perspective, const ImagePoint& s) {
  const auto &m0 = rays.columns[0], &m1 = rays.columns[1], &m2 = rays.columns[2],
             &O = rays.columns[3];
  const auto varying = [&](const std::array<WordPair, 3>& constant) {
    Vector<Real> sum;
    for (std::size_t i = 0; i < 3; ++i) {
      sum[i] = (entry<Real>(constant[i]) + entry<Real>(m1[i]) * s.v) + entry<Real>(m0[i]) * s.u;
    }
    return sum;
  };
  if (perspective) return {entries<Real>(O), varying(m2)};
  return {varying(O), entries<Real>(m2)};
}

/// Bounds, for all samples, on the sums of the magnitudes of the terms of origin and direction.
struct RaySizes {
  Vector<double> origin, direction;

  RaySizes(const Rays& rays, const ImageBounds& image)
      : origin(rays.sizes[3]), direction(rays.sizes[2]) {
    Vector<double>& varying = image.perspective ? direction : origin;
    for (std::size_t i = 0; i < 3; ++i) {
      varying[i] += rays.sizes[0][i] * image.u + rays.sizes[1][i] * image.v;
    }
  }
};

/// Which components of n = p × r are 0 for a reason that is plain to see: each of the two products
/// has a factor 0, or p and r are binary64 numbers and the two products are the same.
template <class Real>
std::array<bool, 3> zero_components(const Edges<Real>& edges) {
  std::array<bool, 3> zero{};
  for (std::size_t i = 0; i < 3; ++i) zero[i] = edges.n_size[i] == 0;
  if constexpr (!std::is_same_v<Real, double>) {
    const auto is_binary64 = [](const Vector<Real>& a) {
      return a[0].lo == 0 && a[1].lo == 0 && a[2].lo == 0;
    };
    if (!is_binary64(edges.p) || !is_binary64(edges.r)) return zero;
    for (std::size_t i = 0; i < 3; ++i) {
      const std::size_t j = (i + 1) % 3, k = (i + 2) % 3;
      const WordPair x = two_product<false>(edges.p[j].hi, edges.r[k].hi);
      const WordPair y = two_product<false>(edges.p[k].hi, edges.r[j].hi);
      zero[i] = zero[i] || (x.hi == y.hi && x.lo == y.lo);
    }
  }
  return zero;
}

/// The normal in the world or in the camera frame, of any length and turned either way: components
/// with errors.
template <class Real>
struct PlacedNormal {
  Vector<Real> n;
  /// Errors are at most 4ε (placed as is) or 8ε (a dot product of cofactors, exact entries rounded
  /// once, with the mesh's n) times this.
  Vector<double> size;
  double factor = surface_bounds::normal;
};

/// That of the mesh.
template <class Real>
PlacedNormal<Real> mesh_normal(const MeshTriangle& corners) {
  const Edges<Real> edges(corners);
  const std::array<bool, 3> zero = zero_components(edges);
  PlacedNormal<Real> mesh{edges.n, edges.n_size};
  for (std::size_t i = 0; i < 3; ++i) {
    if (zero[i]) {
      mesh.n[i] = 0.0;
      mesh.size[i] = 0;
    }
  }
  return mesh;
}

template <class Real>
PlacedNormal<Real> placed(const PlacedNormal<Real>& mesh, const NormalMatrix& matrix) {
  PlacedNormal<Real> result;
  for (std::size_t i = 0; i < 3; ++i) {
    result.n[i] = dot(entries<Real>(matrix.rows[i]), mesh.n);
    result.size[i] = dot(matrix.sizes[i], mesh.size);
  }
  result.factor = surface_bounds::placed_normal;
  return result;
}

template <class Real>
PlacedNormal<Real> world_normal(const MeshTriangle& corners, const ObjectRays& object) {
  const PlacedNormal<Real> mesh = mesh_normal<Real>(corners);
  return object.placed_as_is ? mesh : placed(mesh, object.to_world);
}

/// Bounds on the errors of its components.
template <class Real>
Vector<double> errors_of(const PlacedNormal<Real>& normal) {
  const double e = normal.factor * (epsilon<Real> * slack);
  return {e * normal.size[0], e * normal.size[1], e * normal.size[2]};
}

/// |n|. Squares err by 2k + 1, sums by 2, the root by half of that and 1. But since the length's
/// error comes from the errors of the components, it is counted as follows: |n̂| and |n| differ by
/// at most the sum of the components' errors, and |n̂| is computed with an error of (3/2 + 1)ε; 3
/// is used.
/// Needs    squares of the components that stay in range.
template <class Real>
Certified<Real> length_of(const Vector<Real>& n, const Vector<double>& error) {
  const Real length = square_root(dot(n, n));
  return {length, (error[0] + error[1] + error[2]) +
                      surface_bounds::length * epsilon<Real> * slack * std::abs(nearest(length))};
}

/// n·d at a sample: the products err by (8 + 4 + 1)ε and two sums.
template <class Real>
Certified<Real> along_ray(const PlacedNormal<Real>& normal, const Rays& world,
                          const ImageBounds& image, const ImagePoint& s) {
  const Vector<Real> d = ray_at<Real>(world, image.perspective, s).direction;
  const Vector<double> d_size = RaySizes(world, image).direction;
  return {dot(normal.n, d),
          surface_bounds::turn * (epsilon<Real> * slack) * dot(normal.size, d_size)};
}

/// Which way a normal is turned to point towards the camera: −1 against n, 1 along it, 0 where that
/// is not certain.
///
/// Σe = det(H)·(n·d) and Δ = D·Σe for n and d of one frame (H the linear part of the map to
/// (U, V, D), det H = fx·fy·det R in the world), and D > 0: so the specification's sign
/// −sign(Δ)·sign(fx·fy·det R) is −sign(n·d).
template <class Real>
int turn_of(const PlacedNormal<Real>& normal, const ObjectRays& world, const ImageBounds& image,
            const ImagePoint& s) {
  const Certified<Real> nd = along_ray(normal, world.rays, image, s);
  if (!(std::abs(nearest(nd.value)) > nd.error)) return 0;
  return nearest(nd.value) > 0 ? -1 : 1;
}

/// The unit normal in a frame, turned that way; every error is +∞ if it is unknown.
///
/// Underflow. Components of placed normals are multiples of 2⁻⁵⁶⁶ (2⁻²⁶² of an entry times 2⁻³⁰⁴ of
/// n), so their squares may lose words below 2⁻¹⁰⁷⁴. That is less than 2⁻³⁰⁰ of |n|²: quotient()
/// knows nothing unless |n| is 2²⁰ times its error, which is above 2⁻¹⁰¹ of the greatest size, and
/// that is at least 2⁻²⁵⁰. The slack covers it.
template <class Real>
Vector<Certified<Real>> unit(const PlacedNormal<Real>& normal, int turn) {
  Vector<Certified<Real>> result;
  const double greatest = std::max({normal.size[0], normal.size[1], normal.size[2]});
  using surface_bounds::least_normal, surface_bounds::greatest_normal;
  if (!(greatest >= least_normal && greatest <= greatest_normal)) return result;
  if (turn == 0) return result;
  const Vector<double> error = errors_of(normal);
  const Certified<Real> length = length_of(normal.n, error);
  for (std::size_t i = 0; i < 3; ++i) {
    const Real turned = turn < 0 ? -normal.n[i] : normal.n[i];
    result[i] = quotient<Real>({turned, error[i]}, length);
    if (normal.size[i] == 0) result[i] = {Real(0.0), 0};
  }
  return result;
}

/// The unit normal in the world, turned towards the camera, at a sample where the triangle is
/// visible; every error is +∞ if it is not certain which way to turn it.
/// Needs    safe corners, and usable rays of the object and of the world.
template <class Real>
Vector<Certified<Real>> unit_normal(const MeshTriangle& corners, const ObjectRays& object,
                                    const ObjectRays& world, const ImageBounds& image,
                                    const ImagePoint& s) {
  const PlacedNormal<Real> normal = world_normal<Real>(corners, object);
  return unit(normal, turn_of(normal, world, image, s));
}

/// The same in the camera frame. Cofactors of R transform n to det R times the vector whose product
/// with R·d is n·d. So if det R < 0, the normal is turned the other way.
/// Needs    also that camera normals are usable; `handedness`, the sign of det R.
template <class Real>
Vector<Certified<Real>> unit_camera_normal(const MeshTriangle& corners, const ObjectRays& object,
                                           const ObjectRays& world, const ImageBounds& image,
                                           const ImagePoint& s, Sign handedness) {
  const PlacedNormal<Real> mesh = mesh_normal<Real>(corners);
  const int turn =
      turn_of(object.placed_as_is ? mesh : placed(mesh, object.to_world), world, image, s);
  return unit(placed(mesh, object.to_camera), handedness == Sign::negative ? -turn : turn);
}

}  // namespace fathom::triangle
