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
/// and weights: infinite where these do not determine them. Two variances add up.
/// - `shown`, what the residuals show: those of all triangles that share a corner count as one,
///   since they share its roundings. A triangle then counts with each of its corners, which is to
///   the safe side.
/// - What they cannot show, because a fit follows it: a mesh of few triangles has few corners, and
///   parameters fit their roundings. The model allows each corner to be half a width off, and every
///   pixel of its triangles by its barycentric part of that; such errors are taken to be
///   independent and as likely to be of one size as of another.
/// What all corners share, a matrix that was rounded or a grid that is offset, is not in it.
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
