#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "fathom/numeric/interval.h"
#include "validation/colour/lit_triangles.h"

/// Arithmetic of intervals, every result rounded outwards by one step of binary64: what IEEE 754
/// rounds to nearest lies within that. Infinite ends say that nothing is known on that side.
namespace fathom::validation {

inline Interval outwards(double lower, double upper) {
  constexpr double infinity = std::numeric_limits<double>::infinity();
  if (std::isnan(lower) || std::isnan(upper)) return {-infinity, infinity};
  return {std::nextafter(lower, -infinity), std::nextafter(upper, infinity)};
}

inline Interval exactly(double x) {
  return {x, x};
}
inline Interval around(double x, double error) {
  return outwards(x - error, x + error);
}
inline Interval widened(const Interval& a, double error) {
  return outwards(a.lower - error, a.upper + error);
}

inline double magnitude(const Interval& a) {
  return std::max(std::abs(a.lower), std::abs(a.upper));
}

inline Interval operator+(const Interval& a, const Interval& b) {
  return outwards(a.lower + b.lower, a.upper + b.upper);
}
inline Interval operator-(const Interval& a) {
  return {-a.upper, -a.lower};
}
inline Interval operator-(const Interval& a, const Interval& b) {
  return a + -b;
}
inline Interval operator*(const Interval& a, const Interval& b) {
  const std::array<double, 4> p{a.lower * b.lower, a.lower * b.upper, a.upper * b.lower,
                                a.upper * b.upper};
  for (const double x : p)
    if (std::isnan(x)) return outwards(x, x);
  return outwards(*std::min_element(p.begin(), p.end()), *std::max_element(p.begin(), p.end()));
}
/// Everything if the divisor may be 0.
inline Interval operator/(const Interval& a, const Interval& b) {
  constexpr double nothing = std::numeric_limits<double>::quiet_NaN();
  if (!(b.lower > 0 || b.upper < 0)) return outwards(nothing, nothing);
  return a * outwards(1 / b.upper, 1 / b.lower);
}
inline Interval square(const Interval& a) {
  const double greatest = magnitude(a) * magnitude(a);
  const double least = a.lower > 0 ? a.lower * a.lower : a.upper < 0 ? a.upper * a.upper : 0;
  const Interval result = outwards(least, greatest);
  return {std::max(0.0, result.lower), result.upper};
}
/// Of what is not negative.
inline Interval root(const Interval& a) {
  const Interval result = outwards(std::sqrt(std::max(0.0, a.lower)), std::sqrt(a.upper));
  return {std::max(0.0, result.lower), result.upper};
}
inline Interval clamped(const Interval& a, double least, double greatest) {
  return {std::clamp(a.lower, least, greatest), std::clamp(a.upper, least, greatest)};
}

using Range3 = std::array<Interval, 3>;

inline Interval dot(const Range3& a, const Range3& b) {
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}
inline Range3 cross(const Range3& a, const Range3& b) {
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}
inline Range3 operator-(const Range3& a) {
  return {-a[0], -a[1], -a[2]};
}
inline Range3 operator-(const Range3& a, const Range3& b) {
  return {a[0] - b[0], a[1] - b[1], a[2] - b[2]};
}
inline Interval length(const Range3& a) {
  return root(square(a[0]) + square(a[1]) + square(a[2]));
}
/// Components stay within [−1, 1], whatever is known of the length.
inline Range3 direction(const Range3& a) {
  const Interval l = length(a);
  return {clamped(a[0] / l, -1, 1), clamped(a[1] / l, -1, 1), clamped(a[2] / l, -1, 1)};
}

// The 8-bit colours that a renderer may draw, computed by the formulas of the textbooks in
// interval arithmetic. Only the precision of its steps is taken from the renderer.
//
// A renderer moves every corner in the window a little: to its subpixel grid, and by rounding the
// transform. The weights λ of a pixel's centre p in the moved triangle are the weights of a point
// p' in the true triangle. |p' − p| is at most the greatest move in either axis, because p' − p is
// the mean of the moves with the weights λ. Attributes over w are affine in the window, so they
// differ from the attributes at p by at most this distance times the sum of their slopes. If the
// renderer interpolates before it snaps, p' = p. The roundings of the interpolation are added; see
// `rounding`.

/// Where light is computed, and with which normal.
enum class LightModel {
  /// Each fragment, with the interpolated normal: our `phong`, VTK's Gouraud and Phong.
  interpolated_normal,
  /// Each fragment, with the normal that the derivatives of its position give: VTK's flat.
  derived_normal,
  /// The centre of the triangle, with the normal of its plane: our `flat`.
  face,
  /// The corners; fragments get the mean: our `gouraud`.
  corners,
};

/// The precision of a renderer's arithmetic.
struct Precision {
  /// Unit roundoff of every operation.
  double rounding = 0x1p-24;
  /// Powers and roots as exact as the shading language demands ([GLSL46] 4.7.1), else within 1 ulp.
  bool shader = true;
  /// The bits of the subpixel grid.
  int subpixel_bits = 8;
};

/// The pipeline in binary64 with its usual grid; OpenGL's shaders in binary32, and VTK's lines.
inline constexpr Precision binary64_pipeline{.rounding = 0x1p-53, .shader = false};
inline constexpr Precision vtk_on_llvmpipe{};

/// A triangle in the window, with all values of its fragments.
class ExpectedTriangle {
 public:
  ExpectedTriangle(const LitTriangle& triangle, const LitScene& scene, const Precision& precision);

  /// Pixels that it may touch: columns and rows from the first to before the second.
  [[nodiscard]] std::array<std::array<int, 2>, 2> box() const;

  enum class Coverage { none, possible, certain };
  [[nodiscard]] Coverage coverage(int x, int y) const;
  /// 1/depth, enlarged so that the renderer's depth buffer, of 24 bits or more, distinguishes
  /// depths whose intervals do not overlap.
  [[nodiscard]] Interval inverse_depth(int x, int y) const;
  /// The light on the fragment, from 0 to 1.
  [[nodiscard]] Interval light(int x, int y, LightModel model) const;

 private:
  /// An attribute over w: affine in the window.
  struct Affine {
    double value = 0, dx = 0, dy = 0;  ///< at the first corner; per pixel
    /// Errors of the renderer: of a value anywhere in the triangle; of the step of a pixel, of the
    /// common part of all values, and of each value by itself (in its own roundings).
    double error = 0, step_error = 0, offset_error = 0, own_error = 0;
    [[nodiscard]] double at(double x, double y) const { return value + dx * x + dy * y; }
  };
  [[nodiscard]] Affine affine(const std::array<double, 3>& at_corners,
                              const std::array<double, 3>& errors) const;
  [[nodiscard]] Interval range(const Affine& f, int x, int y) const;
  [[nodiscard]] double derived_error(int x, int y) const;
  [[nodiscard]] Interval lit(const Range3& normal, const Range3& to_point) const;

  const LitScene* scene_;
  Precision precision_;
  std::array<std::array<double, 3>, 3> eye_{};      ///< corners in the camera's frame
  std::array<std::array<double, 3>, 3> normals_{};  ///< there, of the side that is seen
  std::array<double, 3> plane_{};                   ///< unit normal of the plane, towards the eye
  std::array<double, 3> light_{};                   ///< towards it, there
  std::array<std::array<double, 2>, 3> window_{};
  double moved_ = 0;        ///< the greatest move of a corner, pixels
  double plane_error_ = 0;  ///< of the plane's unit normal, by the corners' errors
  std::array<Affine, 3> weights_{}, normal_{}, position_{};
  Affine inverse_depth_{}, window_z_{};
  bool seen_edge_on_ = false;
};

/// The codes to which a renderer may round a light, to nearest, after a product in binary32.
struct Codes {
  int least = 0, greatest = 255;
};
Codes codes_of(const Interval& light);

}  // namespace fathom::validation
