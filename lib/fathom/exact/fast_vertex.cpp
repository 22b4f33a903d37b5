#include "fathom/exact/fast_vertex.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "fathom/numeric/rounding.h"

// The bounds of this file, with u = 2⁻⁵³ (docs/error-analysis.md, "Vertices").
//
// Matrix. U, V, W, D are affine in the mesh's coordinates. The entries of that map are computed
// exactly and rounded once, so that a rounded entry is m(1 + δ), |δ| ≤ u. Entries are 0 or between
// 2⁻²⁰⁰ and 2²⁰⁰ in magnitude, else the object is not usable.
//
// Affine value. m₀x + m₁y + m₂z + m₃ from rounded entries: each term meets at most one rounding of
// its entry, one of the product and three of sums, so the error is at most γ₅·S, where
// S = |m₀x| + |m₁y| + |m₂z| + |m₃| and γ₅ = 5u/(1 − 5u). S is computed with a relative error of at
// most γ₅ as well. 6u·S, computed, is therefore a bound; what 6 is more than 5 covers the second
// order. A product that underflows adds at most 2⁻¹⁰⁷⁵ absolutely: each user says what covers it.
namespace fathom {
namespace {

constexpr double affine_error = 6 * unit_roundoff;
/// Relative slack of a bound: covers the roundings in its own evaluation (fewer than 2⁵ of them,
/// 2⁻⁴⁸), the terms of second order named below (2⁻¹⁸) and its conversion to binary32 (2⁻²⁴).
constexpr double slack = 1 + 0x1p-15;
/// Absolute floor of every bound, above all effects of underflow: these are errors of 2⁻¹⁰⁷⁵ in U,
/// V, W or D, grown by at most 2¹⁵⁰ by the divisions below. A normal binary32 number.
constexpr double underflow_floor = 0x1p-100;

constexpr double least_W = 0x1p-60, greatest_W = 0x1p60;
constexpr double greatest_coordinate = 0x1p30;
constexpr double greatest_position_error = 0x1p-12;

double apply(const std::array<double, 4>& m, double x, double y, double z) {
  return m[0] * x + m[1] * y + m[2] * z + m[3];
}

std::array<double, 4> magnitudes(const std::array<double, 4>& a, const std::array<double, 4>& b) {
  std::array<double, 4> greatest;
  for (std::size_t k = 0; k < 4; ++k) greatest[k] = std::max(std::abs(a[k]), std::abs(b[k]));
  return greatest;
}

/// U, V, W, D of a mesh point, exactly.
std::array<Dyadic, 4> exact_image(const Object& object, const Camera& camera, const MeshPoint& X) {
  const CameraPoint p = to_camera(camera, object.world_from_mesh(X));
  const HomogeneousImagePoint image = to_image(camera, p);
  return {image.U, image.V, image.W, p.z};
}

/// The rows of the affine map from the mesh to U, V, W, D: its values at the origin and how they
/// change along the axes; rounded.
std::array<std::array<double, 4>, 4> rounded_rows(const Object& object, const Camera& camera) {
  const MeshPoint axes[] = {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
  const auto origin = exact_image(object, camera, {0, 0, 0});
  std::array<std::array<double, 4>, 4> rows;
  for (std::size_t i = 0; i < 4; ++i) rows[i][3] = round_to_binary64(Ratio(origin[i]));
  for (std::size_t k = 0; k < 3; ++k) {
    const auto end = exact_image(object, camera, axes[k]);
    for (std::size_t i = 0; i < 4; ++i) {
      rows[i][k] = round_to_binary64(Ratio(end[i] - origin[i]));
    }
  }
  return rows;
}

bool is_safe(double entry) {
  const double size = std::abs(entry);
  return size == 0 || (size >= 0x1p-200 && size <= 0x1p200);
}

ImageVertex unusable(bool behind) {
  return {0, 0, behind ? -1.0 : 0.0, std::numeric_limits<float>::infinity(), 0};
}

}  // namespace

VertexTransform::VertexTransform(const Object& object, const Camera& camera)
    : perspective_(camera.projection == Projection::perspective),
      last_u_(camera.width - 0.5),
      last_v_(camera.height - 0.5) {
  const auto rows = rounded_rows(object, camera);
  for (const Row& row : rows) {
    usable_ = usable_ && std::all_of(row.begin(), row.end(), is_safe);
  }
  U_ = rows[0];
  V_ = rows[1];
  W_ = rows[2];
  D_ = rows[3];
  size_UV_ = magnitudes(U_, V_);
  size_W_ = magnitudes(W_, W_);
  size_D_ = magnitudes(D_, D_);
}

VertexTransform::Homogeneous VertexTransform::homogeneous(const MeshPoint& X) const {
  const auto [x, y, z] = X;
  const double ax = std::abs(x), ay = std::abs(y), az = std::abs(z);
  return {apply(U_, x, y, z), apply(V_, x, y, z), apply(W_, x, y, z),
          affine_error * apply(size_UV_, ax, ay, az), affine_error * apply(size_W_, ax, ay, az)};
}

ImageVertex VertexTransform::operator()(const MeshPoint& X) const {
  if (!usable_) return unusable(false);
  return perspective_ ? perspective_vertex(X) : orthographic_vertex(X);
}

// Û, Ŵ computed, E_U, E_W their bounds, r = Û/Ŵ the real quotient, U, W exact. Then
//   |r − U/W| = |(Û − U) + (U/W)(W − Ŵ)| / Ŵ ≤ (E_U + (|r| + |r − U/W|)·E_W) / Ŵ,
// so with E_W ≤ 2⁻²⁰·Ŵ: |r − U/W| ≤ (1 + 2⁻¹⁹)·(E_U + |r|·E_W) / Ŵ. And û = fl(Û·fl(1/Ŵ)) differs
// from r by at most 2.01u·|r|; 3u is written. 2⁻¹⁹ and the difference of r and û go into `slack`.
// Likewise |1/Ŵ − 1/W| ≤ E_W/(Ŵ·W) ≤ (1 + 2⁻¹⁹)·E_W/Ŵ², and the division rounds once more.
// Overflow anywhere makes a condition of the last `if` false.
ImageVertex VertexTransform::perspective_vertex(const MeshPoint& X) const {
  const Homogeneous p = homogeneous(X);
  const double q = 1 / p.W;
  const double u = p.U * q, v = p.V * q;
  const double size = std::max(std::abs(u), std::abs(v));
  const double position_error =
      ((p.error_UV + size * p.error_W) * q + 3 * unit_roundoff * size) * slack + underflow_floor;
  if (p.W >= least_W && p.W <= greatest_W && p.error_W <= p.W * 0x1p-20 &&
      std::abs(u) <= greatest_coordinate && std::abs(v) <= greatest_coordinate &&
      position_error <= greatest_position_error) {
    const double q_error = (p.error_W * q + unit_roundoff) * q * slack;
    return {u, v, q, static_cast<float>(position_error), static_cast<float>(q_error)};
  }
  return unusable(p.W + (p.error_W + underflow_floor) * slack < 0);
}

// W = 1: no division.
ImageVertex VertexTransform::orthographic_vertex(const MeshPoint& X) const {
  const Homogeneous p = homogeneous(X);
  const double D = apply(D_, X.x, X.y, X.z);
  const double D_error =
      affine_error * apply(size_D_, std::abs(X.x), std::abs(X.y), std::abs(X.z)) * slack +
      underflow_floor;
  const double position_error = p.error_UV * slack + underflow_floor;
  if (std::abs(p.U) <= greatest_coordinate && std::abs(p.V) <= greatest_coordinate &&
      position_error <= greatest_position_error && std::abs(D) <= greatest_W &&
      D_error <= greatest_W) {
    return {p.U, p.V, -D, static_cast<float>(position_error), static_cast<float>(D_error)};
  }
  return unusable(false);
}

// A covered sample s is a combination of the corners with weights that are not negative (divided by
// Δ, the edge functions), so that a linear form in (U, V, W) that is negative at every corner is
// negative at (s_u, s_v, 1). The forms: W itself; U − ½W, which is not negative at any sample;
// (w − ½)W − U; and the same two for V. With k = ½ or w − ½, the computed form errs by at most
// E_UV + k·E_W and by roundings of k·Ŵ and of the difference, at most u(|Û| + 2k|Ŵ|)(1 + u), which
// is less than (E_UV + 2k·E_W)/5, as |Û| ≤ E_UV/(6u)·(1 + 2⁻⁵⁰) and likewise for Ŵ. 1.5 is written.
bool VertexTransform::misses_image(const std::array<MeshPoint, 3>& corners) const {
  if (!usable_) return false;
  bool behind = true, left = true, right = true, above = true, below = true;
  for (const MeshPoint& X : corners) {
    const Homogeneous p = homogeneous(X);
    const auto is_negative = [&](double form, double k) {
      return form + 1.5 * (p.error_UV + k * p.error_W + underflow_floor) < 0;
    };
    behind = behind && p.W + 1.5 * (p.error_W + underflow_floor) < 0;
    left = left && is_negative(p.U - 0.5 * p.W, 0.5);
    right = right && is_negative(last_u_ * p.W - p.U, last_u_);
    above = above && is_negative(p.V - 0.5 * p.W, 0.5);
    below = below && is_negative(last_v_ * p.W - p.V, last_v_);
  }
  return behind || left || right || above || below;
}

}  // namespace fathom
