#include "fathom/attribution/faults/standard_deviations.h"

#include <limits>
#include <unordered_map>

namespace fathom::attribution {
namespace {

using Eigen::MatrixXd;
using Eigen::VectorXd;

/// Standard deviation of a number that is uniform in [−1, 1].
constexpr double uniform_variance = 1.0 / 3;

/// What one corner does to the parameters.
struct CornerEffect {
  VectorXd shown;    ///< by the residuals about it
  VectorXd allowed;  ///< where it is off by all that the model allows
};

}  // namespace

StandardDeviations standard_deviations(const Truth& truth, const Residuals& residuals,
                                       const MatrixXd& columns, const VectorXd& weights) {
  const Normal normal = normal_of(columns, residuals.r, weights);
  if (!normal.is_regular) {
    const VectorXd unknown =
        VectorXd::Constant(columns.cols(), std::numeric_limits<double>::infinity());
    return {unknown, unknown};
  }
  // By how much a parameter changes with each residual.
  const MatrixXd gain = normal.inverse() * columns.transpose() * weights.asDiagonal();
  const VectorXd zero = VectorXd::Zero(columns.cols());
  std::unordered_map<std::uint32_t, CornerEffect> effects;
  for (Eigen::Index i = 0; i < columns.rows(); ++i) {
    const auto& corners = truth.mesh.triangles[residuals.triangles[static_cast<std::size_t>(i)]];
    for (std::size_t k = 0; k < 3; ++k) {
      const auto [effect, is_new] = effects.try_emplace(truth.corner_numbers[corners[k]]);
      if (is_new) effect->second = {zero, zero};
      effect->second.shown += residuals.r[i] * gain.col(i);
      effect->second.allowed +=
          residuals.corner_parts(i, static_cast<Eigen::Index>(k)) * gain.col(i);
    }
  }
  VectorXd shown = zero, allowed = zero;
  for (const auto& [corner, effect] : effects) {
    shown += effect.shown.cwiseAbs2();
    allowed += uniform_variance * effect.allowed.cwiseAbs2();
  }
  return {shown.cwiseSqrt(), (shown + allowed).cwiseSqrt()};
}

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
