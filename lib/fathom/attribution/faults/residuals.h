#pragma once

#include <Eigen/Cholesky>
#include <Eigen/Core>
#include <cstdint>
#include <vector>

#include "fathom/attribution/attribution.h"
#include "fathom/attribution/faults/deviation.h"
#include "fathom/attribution/other_map.h"
#include "fathom/attribution/truth.h"

namespace fathom::attribution {

/// Difference of another map's depths from a camera's exact depths, pixel by pixel, in half widths
/// of the model's interval: |r| ≤ 1 is explained.
struct Residuals {
  Eigen::VectorXd r;
  /// Derivatives of the expected depth by each parameter, in the same unit.
  Eigen::Matrix<double, Eigen::Dynamic, parameter_count> slopes;
  std::vector<std::uint32_t> triangles;
  /// Barycentric coordinates of the point of its triangle that each pixel shows.
  Eigen::Matrix<double, Eigen::Dynamic, 3> corner_parts;

  /// Median of |r|.
  [[nodiscard]] double median() const;
  /// Mean of r² over the four fifths of the pixels with the least r².
  [[nodiscard]] double cost() const;
};

/// Makes residuals of a map for cameras that deviate from the truth's.
class ResidualSource {
 public:
  /// `found`: result of attribute() for the same arguments, with the widths. The arguments outlive
  /// it.
  ResidualSource(const Truth& truth, const OtherMap& other, const RendererModel& model,
                 const Attribution& found);

  /// Whether there are enough pixels for an estimate to rest on.
  [[nodiscard]] bool has_enough(const Residuals& residuals) const;
  /// `seen`: the truth of deviating(camera, deviation).
  [[nodiscard]] Residuals of(const Truth& seen, const Deviation& deviation) const;

 private:
  [[nodiscard]] double relative_width(std::size_t pixel) const;

  const OtherMap& other_;
  const RendererModel& model_;
  const Attribution& found_;
  Camera camera_;
  double typical_width_;  ///< half widths relative to the depth
  std::size_t stride_;
};

struct StandardDeviations {
  Eigen::VectorXd shown, all;
};

/// Standard deviations of parameters that were fitted to residuals by their columns of derivatives
/// and weights: infinite if the residuals do not determine a parameter. Two variances add up.
/// - `shown` is the variance of the residuals. Residuals of all triangles that share a corner count
///   as one, because they share its roundings. A triangle counts with each of its corners, which is
///   conservative.
/// - The second is invisible in residuals, because a fit follows it: a mesh of few triangles has
/// few
///   corners, and parameters fit their roundings. The model allows each corner an error of half a
///   width, and every pixel of its triangles the barycentric part of it. These errors are assumed
///   independent and uniformly distributed.
/// Errors that all corners share, such as a rounded matrix or an offset grid, are not included.
StandardDeviations standard_deviations(const Truth& truth, const Residuals& residuals,
                                       const Eigen::MatrixXd& columns,
                                       const Eigen::VectorXd& weights);

/// The weighted normal equations of columns that are scaled to length 1.
struct Normal {
  Eigen::VectorXd scale;
  Eigen::LLT<Eigen::MatrixXd> products;
  Eigen::VectorXd right;
  bool is_regular = false;

  [[nodiscard]] Eigen::VectorXd solution() const {
    return products.solve(right).cwiseProduct(scale);
  }
  /// (AᵀWA)⁻¹
  [[nodiscard]] Eigen::MatrixXd inverse() const {
    return scale.asDiagonal() * products.solve(Eigen::MatrixXd(scale.asDiagonal()));
  }
};

Normal normal_of(const Eigen::MatrixXd& columns, const Eigen::VectorXd& r,
                 const Eigen::VectorXd& weights);

}  // namespace fathom::attribution
