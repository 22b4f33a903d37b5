#pragma once

#include <Eigen/Cholesky>
#include <Eigen/Core>

namespace fathom::attribution {

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
