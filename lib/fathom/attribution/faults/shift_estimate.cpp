#include "fathom/attribution/faults/shift_estimate.h"

#include <Eigen/Cholesky>
#include <Eigen/LU>
#include <cmath>
#include <cstddef>
#include <limits>

namespace fathom::attribution {
namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();

/// Pixels on which an estimate has to rest.
constexpr std::size_t least_pixels = 16;

/// What is linear in a shift within one triangle: inverse depths (perspective) or depths
/// (orthographic).
double affine_value(const Camera& camera, double depth) {
  return camera.projection == Projection::perspective ? 1 / depth : depth;
}

/// The normal equations of r = g·shift, g the gradient and r the difference at a pixel.
struct NormalEquations {
  Eigen::Matrix2d products = Eigen::Matrix2d::Zero();  ///< Σ g·gᵀ
  Eigen::Vector2d right = Eigen::Vector2d::Zero();     ///< Σ r·g
  double residuals = 0;                                ///< Σ |r − g·shift| of the shift before
  std::size_t pixels = 0;
};

/// Over the pixels whose neighbours to the right and below show the same triangle, without those
/// whose residual is beyond `limit`.
NormalEquations equations(const Truth& truth, const OtherMap& other, const Eigen::Vector2d& shift,
                          double limit) {
  const Camera& camera = truth.camera;
  NormalEquations sums;
  for (std::uint32_t y = 0; y + 1 < camera.height; ++y) {
    for (std::uint32_t x = 0; x + 1 < camera.width; ++x) {
      const std::size_t i = std::size_t{y} * camera.width + x;
      const std::size_t below = i + camera.width;
      const bool is_flat = truth.triangles[i] == truth.triangles[i + 1] &&
                           truth.triangles[i] == truth.triangles[below];
      if (!is_flat || !(truth.depths[i] < infinity) || !(other.depths[i] < infinity)) continue;
      const double here = affine_value(camera, truth.depths[i]);
      const Eigen::Vector2d g(affine_value(camera, truth.depths[i + 1]) - here,
                              affine_value(camera, truth.depths[below]) - here);
      const double r = affine_value(camera, other.depths[i]) - here;
      const double residual = std::abs(r - g.dot(shift));
      if (residual > limit) continue;
      sums.residuals += residual;
      ++sums.pixels;
      sums.products += g * g.transpose();
      sums.right += r * g;
    }
  }
  return sums;
}

}  // namespace

/// Three times, from the second time on without the worst.
std::optional<ImageShift> estimated_shift(const Truth& truth, const OtherMap& other) {
  Eigen::Vector2d shift = Eigen::Vector2d::Zero();
  double limit = infinity;
  for (int round = 0; round < 3; ++round) {
    const NormalEquations sums = equations(truth, other, shift, limit);
    const Eigen::Matrix2d& products = sums.products;
    const bool tell_both = products.determinant() > 1e-9 * products.diagonal().prod();
    if (sums.pixels < least_pixels || !tell_both) return std::nullopt;
    shift = products.ldlt().solve(sums.right);
    limit = 3 * sums.residuals / static_cast<double>(sums.pixels);
  }
  if (!(shift.norm() < 4)) return std::nullopt;
  return ImageShift{shift.x(), shift.y()};
}

}  // namespace fathom::attribution
