#include "fathom/attribution/faults/deviation_fit.h"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>
#include <limits>
#include <unordered_map>
#include <vector>

#include "fathom/attribution/faults/deviation_choice.h"
#include "fathom/attribution/faults/residuals.h"
#include "fathom/numeric/errors.h"

// How to read this file: fitted_deviation() at the end. All sets are compared by one linear step,
// those that are best among sets of their size are fitted, and the smallest that is good enough is
// taken.
namespace fathom::attribution {
namespace {

using Eigen::MatrixXd;
using Eigen::VectorXd;

constexpr double infinity = std::numeric_limits<double>::infinity();

constexpr int most_rounds = 8;
/// Sets of one size that are fitted.
constexpr std::size_t most_of_a_size = 4;
/// Weights that fall with what a residual exceeds the typical ones by.
/// Source   [GM85].
VectorXd weights_of(const VectorXd& r) {
  const double scale = 3 * Residuals{.r = r, .slopes = {}, .triangles = {}}.median() +
                       std::numeric_limits<double>::min();
  return (1 + (r.array() / scale).square()).square().inverse();
}

/// The columns of a set's parameters; a single focal length is the sum of two.
MatrixXd columns_of(const Residuals& residuals, const DeviationSet& set) {
  MatrixXd columns(residuals.r.size(), set.size());
  int k = 0;
  for (const Parameter p : set.parameters) {
    if (set.one_focal && p == Parameter::focal_y) {
      columns.col(0) += residuals.slopes.col(static_cast<int>(p));
    } else {
      columns.col(k++) = residuals.slopes.col(static_cast<int>(p));
    }
  }
  return columns;
}

/// A value for each of a set's columns as a deviation. Sets with one focal length have it first.
Deviation as_deviation(const VectorXd& values, const DeviationSet& set) {
  Deviation d = Deviation::Zero();
  int k = 0;
  for (const Parameter p : set.parameters) {
    const bool is_same = set.one_focal && p == Parameter::focal_y;
    d[static_cast<int>(p)] = is_same ? values[0] : values[k++];
  }
  return d;
}

/// The weighted normal equations of columns that are scaled to length 1.
struct Normal {
  VectorXd scale;
  Eigen::LLT<MatrixXd> products;
  VectorXd right;
  bool is_regular = false;

  [[nodiscard]] VectorXd solution() const { return products.solve(right).cwiseProduct(scale); }
};

Normal normal_of(const MatrixXd& columns, const VectorXd& r, const VectorXd& weights) {
  Normal n;
  const MatrixXd weighted = weights.asDiagonal() * columns;
  MatrixXd products = columns.transpose() * weighted;
  n.scale = products.diagonal().cwiseSqrt().cwiseInverse();
  if (!n.scale.allFinite()) return n;
  products = n.scale.asDiagonal() * products * n.scale.asDiagonal();
  n.products.compute(products);
  n.right = n.scale.cwiseProduct(weighted.transpose() * r);
  n.is_regular = n.products.info() == Eigen::Success && n.products.rcond() > 1e-11;
  return n;
}

/// Standard deviations: residuals of all triangles that share a corner count as one, since they
/// share its roundings. A triangle then counts with each of its corners, which is to the safe side.
VectorXd standard_deviations(const Truth& truth, const Residuals& residuals,
                             const MatrixXd& columns) {
  const VectorXd weights = weights_of(residuals.r);
  const Normal normal = normal_of(columns, residuals.r, weights);
  if (!normal.is_regular) return VectorXd::Constant(columns.cols(), infinity);
  std::unordered_map<std::uint32_t, VectorXd> sums;
  for (Eigen::Index i = 0; i < columns.rows(); ++i) {
    const VectorXd score = weights[i] * residuals.r[i] * columns.row(i).transpose();
    const std::uint32_t triangle = residuals.triangles[static_cast<std::size_t>(i)];
    for (const std::uint32_t point : truth.mesh.triangles[triangle]) {
      const auto [sum, is_new] =
          sums.try_emplace(truth.corner_numbers[point], VectorXd::Zero(columns.cols()));
      sum->second += score;
    }
  }
  MatrixXd squares = MatrixXd::Zero(columns.cols(), columns.cols());
  for (const auto& [corner, sum] : sums) squares += sum * sum.transpose();
  const MatrixXd inverse =
      normal.scale.asDiagonal() * normal.products.solve(MatrixXd(normal.scale.asDiagonal()));
  return (inverse * squares * inverse).diagonal().cwiseMax(0).cwiseSqrt();
}

/// A set, how much one linear step leaves, and the fit itself.
struct Candidate {
  const DeviationSet* set = nullptr;
  double linear_cost = infinity;
};

class Fitting {
 public:
  Fitting(const Truth& truth, const OtherMap& other, const RendererModel& model,
          const Attribution& found)
      : truth_(truth),
        source_(truth, other, model, found),
        before_(source_.of(truth, Deviation::Zero())) {}

  [[nodiscard]] bool can_be_fitted() const { return source_.has_enough(before_); }
  [[nodiscard]] double cost_before() const { return before_.cost(); }
  [[nodiscard]] std::vector<Candidate> candidates() const;
  [[nodiscard]] FittedDeviation fitted(const DeviationSet& set) const;

 private:
  [[nodiscard]] double linear_cost(const DeviationSet& set, const VectorXd& weights) const;
  [[nodiscard]] VectorXd robust_weights() const;
  [[nodiscard]] std::optional<Residuals> residuals_at(const DeviationSet& set,
                                                      const Deviation& deviation) const;

  const Truth& truth_;
  ResidualSource source_;
  Residuals before_;
};

/// Those of what the largest sets leave.
VectorXd Fitting::robust_weights() const {
  VectorXd weights = weights_of(before_.r);
  const DeviationSet& largest = deviation_sets().back();
  const MatrixXd columns = columns_of(before_, largest);
  for (int round = 0; round < 5; ++round) {
    const Normal normal = normal_of(columns, before_.r, weights);
    if (!normal.is_regular) break;
    weights = weights_of(before_.r - columns * normal.solution());
  }
  return weights;
}

double Fitting::linear_cost(const DeviationSet& set, const VectorXd& weights) const {
  const MatrixXd columns = columns_of(before_, set);
  const Normal normal = normal_of(columns, before_.r, weights);
  if (!normal.is_regular) return infinity;
  const VectorXd left = before_.r - columns * normal.solution();
  return left.dot(weights.asDiagonal() * left) / weights.sum();
}

/// The smallest first; of each size, those that leave least.
std::vector<Candidate> Fitting::candidates() const {
  const VectorXd own = weights_of(before_.r), robust = robust_weights();
  std::vector<Candidate> all;
  for (const DeviationSet& set : deviation_sets()) {
    const double cost = std::min(linear_cost(set, own), linear_cost(set, robust));
    if (cost < infinity) all.push_back({&set, cost});
  }
  std::stable_sort(all.begin(), all.end(), [](const Candidate& a, const Candidate& b) {
    return std::pair(a.set->size(), a.linear_cost) < std::pair(b.set->size(), b.linear_cost);
  });
  std::vector<Candidate> best;
  std::size_t of_size = 0;
  for (const Candidate& c : all) {
    of_size = !best.empty() && best.back().set->size() == c.set->size() ? of_size + 1 : 0;
    if (of_size < most_of_a_size) best.push_back(c);
  }
  return best;
}

/// Nothing for what no camera can be.
std::optional<Residuals> Fitting::residuals_at(const DeviationSet& set,
                                               const Deviation& deviation) const {
  if (!set.moves_the_view()) return source_.of(truth_, deviation);
  const Camera camera = deviating(truth_.camera, deviation);
  if (find_fault(camera)) return std::nullopt;
  return source_.of(seen_by(truth_, camera), deviation);
}

FittedDeviation Fitting::fitted(const DeviationSet& set) const {
  FittedDeviation best{.set = &set, .cost_before = cost_before(), .cost = cost_before()};
  Residuals now = before_;
  for (int round = 0; round < most_rounds; ++round) {
    const Normal normal = normal_of(columns_of(now, set), now.r, weights_of(now.r));
    if (!normal.is_regular) break;
    const Deviation next = best.deviation + as_deviation(normal.solution(), set);
    std::optional<Residuals> residuals = residuals_at(set, next);
    if (!residuals || !source_.has_enough(*residuals)) break;
    const double cost = residuals->cost();
    if (!(cost < best.cost)) break;
    const bool stands = cost > 0.99 * best.cost;
    best.deviation = next;
    best.cost = cost;
    now = std::move(*residuals);
    if (stands) break;
  }
  best.standard = as_deviation(standard_deviations(truth_, now, columns_of(now, set)), set);
  return best;
}

}  // namespace

std::optional<FittedDeviation> fitted_deviation(const Truth& truth, const OtherMap& other,
                                                const RendererModel& model,
                                                const Attribution& found) {
  const Fitting fitting(truth, other, model, found);
  if (!fitting.can_be_fitted()) return std::nullopt;
  const std::vector<Candidate> candidates = fitting.candidates();
  double least_linear = infinity;
  for (const Candidate& c : candidates) least_linear = std::min(least_linear, c.linear_cost);

  std::vector<FittedDeviation> fits;
  double least = infinity;
  for (const Candidate& c : candidates) {
    const bool is_larger = !fits.empty() && fits.back().set->size() < c.set->size();
    // Residuals of half of what is allowed are explained: larger sets need not be tried.
    if (is_larger && least < 0.25 && is_as_good(least, least_linear)) break;
    fits.push_back(fitting.fitted(*c.set));
    least = std::min(least, fits.back().cost);
  }
  return simplest_of(fits, least);
}

}  // namespace fathom::attribution
