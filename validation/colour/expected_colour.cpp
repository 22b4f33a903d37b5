#include "validation/colour/expected_colour.h"

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <numbers>

#include "fathom/attribution/model/renderer_input.h"
#include "fathom/attribution/model/window_depth.h"
#include "fathom/geometry/eigen_arrays.h"

namespace fathom::validation {
namespace {

using Vector = Eigen::Vector3d;

using geometry::as_array;
using geometry::as_vector;
double largest(const Vector& a) {
  return a.cwiseAbs().maxCoeff();
}

/// Bound of the rounding error of this file's own binary64 arithmetic in a sum of a few terms,
/// relative to their size.
constexpr double own_rounding = 0x1p-48;

/// The rounding error of an attribute is bounded by a number of unit roundoffs of the magnitudes
/// that are added up: a matrix's rounded entries, its products and sums of four terms
/// (row_roundings); products, differences and quotients of a slope, with its determinant
/// (slope_roundings).
constexpr double row_roundings = 6, slope_roundings = 8;
/// A sum of two products and a value.
constexpr double sum_roundings = 4;

/// Unit roundoffs in components of unit vectors: the product with w, squares and their sum (4), of
/// which a root halves the error, the root itself (2 ulp, [GLSL46] 4.7.1: 4), the product.
constexpr double unit_roundings = 10;
/// In a product of two vectors of unit length: three products, two sums, times Σ|a||b| ≤ √3.
constexpr double dot_roundings = 9;

/// (c)^s for c ≥ 0, rounded as the precision says.
Interval power(const Interval& c, double s, const Precision& precision) {
  const auto end = [&](double base, int side) {
    if (!(base > 0)) return s == 0 ? 1.0 : 0.0;
    const double exact = std::pow(base, s);
    double relative = 4 * 0x1p-53;
    if (precision.shader) {
      // exp2(s·log2(c)): log2, the product, exp2 (3 + 2|t| ulp).
      const double log2_c = std::log2(base), t = s * log2_c;
      const double t_error = s * attribution::log2_error(log2_c) + 2 * std::abs(t) * 0x1p-24;
      relative += std::expm1(std::numbers::ln2 * t_error) + (3 + 2 * std::abs(t)) * 0x1p-23;
    }
    return exact * (1 + side * relative);
  };
  return outwards(std::max(0.0, end(c.lower, -1)), end(c.upper, 1));
}

}  // namespace

ExpectedTriangle::ExpectedTriangle(const LitTriangle& t, const LitScene& scene,
                                   const Precision& precision)
    : scene_(&scene), precision_(precision) {
  const Camera& camera = scene.camera;
  const auto camera_from_world = geometry::as_matrix(camera.world_to_camera);
  const Eigen::Matrix3d rotation = camera_from_world.leftCols<3>();
  const Vector translation = camera_from_world.col(3);
  const auto clip = attribution::clip_from_eye(camera, {camera.near, camera.far});
  const double u = precision.rounding;
  const PrincipalPoint centre = principal_point(camera.projection);
  light_ = as_array(rotation * as_vector(scene.towards_light));
  std::array<double, 3> q{}, q_error{}, z{}, z_error{};
  std::array<Vector, 3> eye_error;
  for (std::size_t k = 0; k < 3; ++k) {
    const Vector p = as_vector(t.corners[k]);
    eye_[k] = as_array(rotation * p + translation);
    normals_[k] = as_array(rotation * as_vector(t.normals[k]));
    const Vector sizes = rotation.cwiseAbs() * p.cwiseAbs() + translation.cwiseAbs();
    eye_error[k] = (row_roundings * u + own_rounding) * sizes;
    const double eye_size = sizes.maxCoeff();
    const auto& [X, Y, Z] = eye_[k];
    window_[k] = {(camera.projection.fx * X + camera.projection.skew * Y) / Z + centre.x,
                  camera.projection.fy * Y / Z + centre.y};
    // Clip coordinates: sums of products of the matrix's entries with terms of at most eye_size.
    const auto clip_error = [&](std::size_t row) {
      double size = 0;
      for (std::size_t j = 0; j < 4; ++j)
        size += std::abs(clip[4 * row + j]) * (j < 3 ? eye_size : 1);
      return (row_roundings * u + own_rounding) * size;
    };
    const double w_relative = clip_error(3) / Z;
    const double half_width = camera.width / 2.0, half_height = camera.height / 2.0;
    // x/w, scaled and moved: four more roundings of numbers up to the size of the image.
    const double off = std::max(half_width * (clip_error(0) / Z + w_relative + 4 * u),
                                half_height * (clip_error(1) / Z + w_relative + 4 * u));
    moved_ = std::max(moved_, off + std::ldexp(0.5, -precision.subpixel_bits));
    q[k] = 1 / Z;
    q_error[k] = q[k] * (w_relative + 2 * u + own_rounding);
    z[k] = camera.far / (camera.far - camera.near) * (1 - camera.near / Z);
    z_error[k] = clip_error(2) / Z + w_relative + 4 * u;
  }
  const Vector eye_0 = as_vector(eye_[0]);
  const Vector face = (as_vector(eye_[1]) - eye_0).cross(as_vector(eye_[2]) - eye_0);
  const double face_length = face.norm();
  // The corners run counter-clockwise as seen, y down and z forward, if the plane's normal points
  // at the eye.
  const bool front = face.dot(eye_0) < 0;
  plane_ = as_array((front ? 1 : -1) * face / face_length);
  if (!front)
    for (auto& n : normals_) n = as_array(-as_vector(n));
  const auto& [a, b, c] = window_;
  const double area = (b[0] - a[0]) * (c[1] - a[1]) - (c[0] - a[0]) * (b[1] - a[1]);
  // Corners that are off by e turn the plane by at most 2e over its least height.
  double corner_error = 0, longest = 0;
  for (std::size_t k = 0; k < 3; ++k) {
    const Vector from = as_vector(eye_[k]), to = as_vector(eye_[(k + 1) % 3]);
    longest = std::max(longest, (to - from).norm());
    corner_error = std::max(corner_error,
                            std::numbers::sqrt3 * (largest(eye_error[k]) + 2 * u * largest(from)));
  }
  plane_error_ = 2 * corner_error * longest / face_length;
  // The visible side and the slopes of such a thin triangle are not certain.
  const double reach =
      std::abs(b[0] - a[0]) + std::abs(b[1] - a[1]) + std::abs(c[0] - a[0]) + std::abs(c[1] - a[1]);
  seen_edge_on_ = !(std::abs(area) > 4 * moved_ * (reach + 4 * moved_)) || !(face_length > 0);
  if (seen_edge_on_) return;

  for (std::size_t k = 0; k < 3; ++k) {
    std::array<double, 3> one{};
    one[k] = 1;
    weights_[k] = affine(one, {});
  }
  inverse_depth_ = affine(q, q_error);
  window_z_ = affine(z, z_error);
  for (std::size_t i = 0; i < 3; ++i) {
    const auto over_w = [&](const std::array<std::array<double, 3>, 3>& values, auto&& error_of) {
      std::array<double, 3> f{}, e{};
      for (std::size_t k = 0; k < 3; ++k) {
        f[k] = values[k][i] * q[k];
        e[k] = q[k] * error_of(k) + std::abs(values[k][i]) * q_error[k] + std::abs(f[k]) * 2 * u;
      }
      return affine(f, e);
    };
    normal_[i] = over_w(normals_, [&](std::size_t k) {
      return 2 * row_roundings * u * largest(as_vector(normals_[k]));
    });
    position_[i] = over_w(eye_, [&](std::size_t k) { return eye_error[k][i]; });
  }
}

/// With the corners' errors, and those of slopes and values computed from the window's origin on.
ExpectedTriangle::Affine ExpectedTriangle::affine(const std::array<double, 3>& f,
                                                  const std::array<double, 3>& errors) const {
  const auto& [a, b, c] = window_;
  const double x1 = b[0] - a[0], y1 = b[1] - a[1], x2 = c[0] - a[0], y2 = c[1] - a[1];
  const double area = x1 * y2 - x2 * y1;
  const double f1 = f[1] - f[0], f2 = f[2] - f[0];
  Affine result;
  result.dx = (f1 * y2 - f2 * y1) / area;
  result.dy = (f2 * x1 - f1 * x2) / area;
  result.value = f[0] - result.dx * a[0] - result.dy * a[1];
  const double u = precision_.rounding + own_rounding;
  const double condition = (std::abs(x1 * y2) + std::abs(x2 * y1)) / std::abs(area);
  const double steep_x = (std::abs(f1 * y2) + std::abs(f2 * y1)) / std::abs(area);
  const double steep_y = (std::abs(f2 * x1) + std::abs(f1 * x2)) / std::abs(area);
  const double wide = std::max(std::abs(x1), std::abs(x2)) + 1;
  const double high = std::max(std::abs(y1), std::abs(y2)) + 1;
  const double greatest = std::max({std::abs(f[0]), std::abs(f[1]), std::abs(f[2])});
  result.step_error = slope_roundings * u * (1 + condition) * std::max(steep_x, steep_y);
  // From the window's origin on: the value there, and what is added to it.
  const double from_origin = greatest + std::abs(result.dx) * scene_->camera.width +
                             std::abs(result.dy) * scene_->camera.height;
  result.offset_error = sum_roundings * u * from_origin;
  result.own_error = sum_roundings * u * from_origin;
  // The corners' own errors, with weights whose magnitudes add up to less than 2; a slope's as far
  // as the triangle reaches.
  result.error = 2 * std::max({errors[0], errors[1], errors[2]}) +
                 result.step_error * (wide + high) + result.offset_error + result.own_error;
  return result;
}

Interval ExpectedTriangle::range(const Affine& f, int x, int y) const {
  const double spread = (std::abs(f.dx) + std::abs(f.dy)) * moved_;
  return around(f.at(x + 0.5, y + 0.5), spread + f.error);
}

std::array<std::array<int, 2>, 2> ExpectedTriangle::box() const {
  std::array<std::array<int, 2>, 2> box{};
  const std::array<std::uint32_t, 2> size{scene_->camera.width, scene_->camera.height};
  for (std::size_t i = 0; i < 2; ++i) {
    const auto [least, greatest] = std::minmax({window_[0][i], window_[1][i], window_[2][i]});
    box[i] = {
        std::max(0, static_cast<int>(std::floor(least - moved_ - 0.5))),
        std::min(static_cast<int>(size[i]), static_cast<int>(std::ceil(greatest + moved_ + 0.5)))};
  }
  return box;
}

ExpectedTriangle::Coverage ExpectedTriangle::coverage(int x, int y) const {
  if (seen_edge_on_) return Coverage::possible;
  bool certain = true;
  for (const Affine& weight : weights_) {
    const Interval w = range(weight, x, y);
    if (w.upper < 0) return Coverage::none;
    certain = certain && w.lower > 0;
  }
  return certain ? Coverage::certain : Coverage::possible;
}

Interval ExpectedTriangle::inverse_depth(int x, int y) const {
  if (seen_edge_on_) {
    const auto [nearest, farthest] = std::minmax({eye_[0][2], eye_[1][2], eye_[2][2]});
    return outwards(0.5 / farthest, 2 / nearest);
  }
  const Camera& camera = scene_->camera;
  // The error of window depths and half a step of 24 bits, as an error of 1/depth.
  const double z = window_z_.error + 0x1p-24;
  return widened(range(inverse_depth_, x, y),
                 z * (camera.far - camera.near) / (camera.far * camera.near));
}

Interval ExpectedTriangle::lit(const Range3& normal, const Range3& to_point) const {
  const pipeline::Material& material = scene_->material;
  const double u = precision_.rounding + own_rounding;
  Range3 N = direction(normal), V = -direction(to_point), L{};
  for (std::size_t i = 0; i < 3; ++i) {
    N[i] = widened(N[i], unit_roundings * u);
    V[i] = widened(V[i], unit_roundings * u);
    L[i] = around(light_[i], 2 * u);
  }
  const Interval cosine = clamped(widened(dot(N, L), dot_roundings * u), -1, 1);
  Interval highlight = exactly(0);
  if (cosine.upper > 0) {
    Range3 mirrored{};  // 2(N·L)N − L: twice the cosine's roundings, a product, a difference
    for (std::size_t i = 0; i < 3; ++i)
      mirrored[i] = widened(exactly(2) * cosine * N[i] - L[i], (2 * dot_roundings + 6) * u);
    const Interval c = clamped(widened(dot(mirrored, V), dot_roundings * u), 0, 2);
    highlight = power(c, material.shininess, precision_);
    if (cosine.lower <= 0) highlight.lower = 0;
  }
  const Interval sum = exactly(material.ambient) +
                       exactly(material.diffuse) * clamped(cosine, 0, 1) +
                       exactly(material.specular) * highlight;
  return clamped(widened(sum, 6 * u * magnitude(sum)), 0, 1);
}

Interval ExpectedTriangle::light(int x, int y, LightModel model) const {
  if (seen_edge_on_) return {0, 1};
  Range3 to_point{};
  for (std::size_t i = 0; i < 3; ++i) to_point[i] = range(position_[i], x, y);
  switch (model) {
    case LightModel::interpolated_normal: {
      Range3 normal{};
      for (std::size_t i = 0; i < 3; ++i) normal[i] = range(normal_[i], x, y);
      return lit(normal, to_point);
    }
    case LightModel::derived_normal: {
      const double error = derived_error(x, y);
      Range3 n{};
      for (std::size_t i = 0; i < 3; ++i) n[i] = around(plane_[i], error);
      return lit(n, to_point);
    }
    case LightModel::face: {
      Range3 centre{}, n{};
      for (std::size_t i = 0; i < 3; ++i) {
        const double sum = eye_[0][i] + eye_[1][i] + eye_[2][i];
        centre[i] = around(sum / 3, own_rounding * (std::abs(sum) + 1));
        n[i] = around(plane_[i], own_rounding);
      }
      return lit(n, centre);
    }
    case LightModel::corners:
      break;
  }
  Interval sum = exactly(0), weight = exactly(0);
  for (std::size_t k = 0; k < 3; ++k) {
    Range3 n{}, p{};
    for (std::size_t i = 0; i < 3; ++i) {
      n[i] = around(normals_[k][i], own_rounding);
      p[i] = around(eye_[k][i], own_rounding * largest(as_vector(eye_[k])));
    }
    const Interval w = range(weights_[k], x, y) / exactly(eye_[k][2]);
    sum = sum + w * lit(n, p);
    weight = weight + w;
  }
  return clamped(sum / weight, 0, 1);
}

/// Bound of the difference between the plane's unit normal and the unit normal computed from
/// differences of neighbouring positions, in each component; 2 if nothing is known.
///
/// A position is P = f/q, a quotient of two values that are affine in the window. An error that is
/// equal in all pixels cancels in differences, except for the change of 1/q. The error that each
/// step adds, and each value's own rounding, remain.
double ExpectedTriangle::derived_error(int x, int y) const {
  const int rows = static_cast<int>(scene_->camera.height);
  // The four pixels that are shaded together start at even columns and rows from the bottom.
  const int x0 = x & ~1, row = (rows - 1 - y) & ~1, y0 = rows - 1 - row;
  constexpr double nothing_known = 2;
  const double u = precision_.rounding;
  std::array<Vector, 3> at;  // here, to the right, above
  std::array<double, 3> q{};
  for (std::size_t k = 0; k < 3; ++k) {
    const double px = x0 + (k == 1 ? 1 : 0) + 0.5, py = y0 - (k == 2 ? 1 : 0) + 0.5;
    q[k] = inverse_depth_.at(px, py);
    // Over a pixel the depth must not change by more than a sixteenth.
    if (!(q[k] > 0) || !(std::abs(q[k] - q[0]) <= q[0] / 16)) return nothing_known;
    at[k] =
        Vector(position_[0].at(px, py), position_[1].at(px, py), position_[2].at(px, py)) / q[k];
  }
  const double change = std::max(std::abs(q[1] - q[0]), std::abs(q[2] - q[0])) / q[0];
  double square = 0;
  for (std::size_t i = 0; i < 3; ++i) {
    const Affine &f = position_[i], &g = inverse_depth_;
    const double P = std::max({std::abs(at[0][i]), std::abs(at[1][i]), std::abs(at[2][i])});
    const auto over_q = [&](double f_error, double q_error) {
      return (f_error + P * q_error) / q[0];
    };
    const double e = over_q(f.step_error, g.step_error) +
                     over_q(f.offset_error, g.offset_error) * change +
                     2 * (over_q(f.own_error, g.own_error) + 4 * u * P);
    square += e * e;
  }
  // The other row and column of the four, and the products of errors: a quarter more.
  const double e = 1.25 * std::sqrt(square);
  const Vector across = at[1] - at[0], up = at[2] - at[0];
  const double a = across.norm(), b = up.norm(), area = across.cross(up).norm();
  const double error = 1.25 * ((a * e + b * e + e * e) / area + 3 * u * a * b / area) +
                       plane_error_ + unit_roundings * u;
  // It is turned towards the eye by the sign of its product with the direction there.
  const double distance = at[0].norm();
  if (!(std::abs(as_vector(plane_).dot(at[0])) / distance > 2 * error)) return nothing_known;
  return error;
}

Codes codes_of(const Interval& light) {
  constexpr double rounding = 255 * 0x1p-22;  // a product and a sum in binary32
  return {std::max(0, static_cast<int>(std::ceil(255 * light.lower - 0.5 - rounding))),
          std::min(255, static_cast<int>(std::floor(255 * light.upper + 0.5 + rounding)))};
}

}  // namespace fathom::validation
