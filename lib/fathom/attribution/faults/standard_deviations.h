#pragma once

#include <Eigen/Cholesky>
#include <Eigen/Core>

#include "fathom/attribution/faults/residuals.h"
#include "fathom/attribution/truth.h"

namespace fathom::attribution {

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
