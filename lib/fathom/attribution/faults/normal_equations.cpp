#include "fathom/attribution/faults/normal_equations.h"

namespace fathom::attribution {

Normal normal_of(const Eigen::MatrixXd& columns, const Eigen::VectorXd& r,
                 const Eigen::VectorXd& weights) {
  Normal n;
  const Eigen::MatrixXd weighted = weights.asDiagonal() * columns;
  Eigen::MatrixXd products = columns.transpose() * weighted;
  n.scale = products.diagonal().cwiseSqrt().cwiseInverse();
  if (!n.scale.allFinite()) return n;
  products = n.scale.asDiagonal() * products * n.scale.asDiagonal();
  n.products.compute(products);
  n.right = n.scale.cwiseProduct(weighted.transpose() * r);
  n.is_regular = n.products.info() == Eigen::Success && n.products.rcond() > 1e-11;
  return n;
}

}  // namespace fathom::attribution
