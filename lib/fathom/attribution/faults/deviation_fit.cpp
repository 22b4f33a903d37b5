#include "fathom/attribution/faults/deviation_fit.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "fathom/attribution/faults/deviation_choice.h"
#include "fathom/attribution/faults/residuals.h"
#include "fathom/attribution/faults/standard_deviations.h"
#include "fathom/failures/errors.h"

// How to read this file: fitted_deviation() at the end. All sets are compared by one linear step,
// the best sets of each size are fitted, and the smallest set that is good enough is taken.
namespace fathom::attribution {
namespace {

using Eigen::MatrixXd;
using Eigen::VectorXd;

constexpr double infinity = std::numeric_limits<double>::infinity();

constexpr int most_rounds = 8;
/// Sets of one size that are fitted.
constexpr std::size_t most_of_a_size = 4;

/// Weights that decrease with the ratio of a residual to the typical residual.
/// Source   [GM85].
VectorXd weights_of(const VectorXd& r) {
  const double scale =
      3 * Residuals{.r = r, .slopes = {}, .triangles = {}, .corner_parts = {}}.median() +
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

/// Weights from the residuals of the largest sets.
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

/// Smallest sets first; for each size, the sets with the least cost.
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
  const StandardDeviations deviations =
      standard_deviations(truth_, now, columns_of(now, set), weights_of(now.r));
  best.standard = as_deviation(deviations.all, set);
  best.shown = as_deviation(deviations.shown, set);
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
    // Residuals below half of the allowed width are explained: larger sets need not be tried.
    if (is_larger && least < 0.25 && is_as_good(least, least_linear)) break;
    fits.push_back(fitting.fitted(*c.set));
    least = std::min(least, fits.back().cost);
  }
  return simplest_of(fits, least);
}

}  // namespace fathom::attribution
