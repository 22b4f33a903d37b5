#pragma once

#include "tests/oracle/ray_caster.h"

namespace fathom::oracle {

/// The numbers of a lens as its publication has them: OpenCV's, with Brown's terms of higher order.
/// All of them 0: a pinhole.
struct LensNumbers {
  /// The models whose rays have square roots.
  enum class Root { none, orthographic, equisolid, unified, double_sphere, omnidirectional };

  /// Of r², r⁴, … above and below the fraction bar.
  std::array<double, 4> above{};
  std::array<double, 3> below{};
  /// Of r², r⁴, … in a stage before.
  std::array<double, 6> first{};
  double p1 = 0, p2 = 0, s1 = 0, s2 = 0, s3 = 0, s4 = 0;
  /// d = (x_d, y_d, 1 + k·r²) instead.
  std::optional<double> division;
  /// The point m that the lens takes to the sample lies at the angle |m| from the axis.
  bool is_angle = false;
  /// A formula with a square root instead, and its numbers; of the omnidirectional model, at the
  /// point that the lens takes to the sample.
  Root root = Root::none;
  double alpha = 0, beta = 1, xi = 0;
  /// The ω of FOV instead.
  std::optional<double> omega;
  /// The coefficients of FTHETA instead.
  std::optional<std::array<double, 6>> angle;
  /// A panorama instead: fx is the width of a turn, fy the height of half a turn (sphere) or of 1.
  enum class Panorama { none, sphere, cylinder } panorama = Panorama::none;

  /// Whether rays go to all sides, so that near and far bound the distance.
  [[nodiscard]] bool counts_distance() const {
    return division || is_angle || angle || root != Root::none || panorama != Panorama::none;
  }
};

/// RayCamera::bent of a lens in front of the camera's fx … skew. A sample sees the point m of the
/// plane z = 1 that the lens takes to it, |m|² ≤ greatest_q: found by Newton's method from many
/// starts, in floating point of more than lens_bits bits. None is found where there is none.
std::function<std::optional<Vector>(const Q& u, const Q& v)> lens_rays(const RayCamera& camera,
                                                                       const LensNumbers& lens,
                                                                       double greatest_q);

}  // namespace fathom::oracle
