#include "fathom/attribution/faults/deviation_fit.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <variant>
#include <vector>

#include "fathom/attribution/faults/depth_relation.h"
#include "fathom/attribution/faults/residuals.h"
#include "fathom/failures/errors.h"

// How to read this file: start with fitted_deviation() at the end. All sets are compared by one
// linear step, the best sets of each size are fitted, and the smallest set that is good enough is
// taken (simplest_of()). deviation_hypothesis() describes it.
namespace fathom::attribution {
namespace {

/// A smaller set is as good as a larger set whose cost is at least this fraction of its own: larger
/// sets also fit roundings that the corners of a triangle share.
constexpr double as_good = 0.5;
/// Residuals below a tenth of the model's half width are roundings, whatever parameters fit them.
constexpr double roundings = 0.01;
/// Sets of the same size with costs as close as this cannot be distinguished: the first in order is
/// named, the others are alternatives.
constexpr double indistinguishable = 1.05;
/// Greatest fraction of the cost that may remain for a set to be named, and least deviation of each
/// parameter in standard deviations of the residuals. (The uncertainty of corners is reported with
/// the deviation but not required here: it is a maximum, and a set of six parameters would have to
/// be far off before each exceeded it.) The caller checks that the set explains unexplained pixels.
constexpr double evidence = 0.99, least_shown = 6;

bool is_significant(const FittedDeviation& fit) {
  return fit.cost <= evidence * fit.cost_before &&
         std::all_of(fit.set->parameters.begin(), fit.set->parameters.end(), [&](Parameter p) {
           return std::abs(of(fit.deviation, p)) >= least_shown * of(fit.shown, p);
         });
}

using Fits = std::vector<const FittedDeviation*>;

/// Of the smallest size that has one, all that are good enough and significant.
Fits smallest_good(const std::vector<FittedDeviation>& fits, double least) {
  Fits good;
  for (const FittedDeviation& fit : fits) {
    if (!good.empty() && good.front()->set->size() < fit.set->size()) break;
    if (is_as_good(fit.cost, least) && is_significant(fit)) good.push_back(&fit);
  }
  return good;
}

void add_alternative(FittedDeviation& fit, const std::string& kind) {
  std::vector<std::string>& kinds = fit.alternatives;
  const bool is_known =
      kind == fit.set->kind || std::find(kinds.begin(), kinds.end(), kind) != kinds.end();
  if (!is_known) kinds.push_back(kind);
}

}  // namespace

bool is_as_good(double cost, double least) {
  return cost * as_good <= least || cost <= roundings;
}

std::optional<FittedDeviation> simplest_of(const std::vector<FittedDeviation>& fits, double least) {
  Fits good = smallest_good(fits, least);
  if (good.empty()) return std::nullopt;
  const auto costs_less = [](const auto* a, const auto* b) { return a->cost < b->cost; };
  const double best = (*std::min_element(good.begin(), good.end(), costs_less))->cost;
  std::erase_if(good, [&](const auto* fit) { return fit->cost > indistinguishable * best; });
  std::sort(good.begin(), good.end(), [](const auto* a, const auto* b) { return a->set < b->set; });
  FittedDeviation result = *good.front();
  for (const FittedDeviation* equal : good) add_alternative(result, equal->set->kind);
  return result;
}

namespace {

using P = Parameter;

/// "0.1 % ± 2e-05 %", "1.00e-04 ± 3e-08 rad".
std::string amount(const FittedDeviation& fit, P p) {
  const double value = of(fit.deviation, p), deviation = of(fit.standard, p);
  const std::string unit = unit_of(p);
  if (unit == "relative") return fmt::format("{:+.6g} ± {:.2g} %", 100 * value, 100 * deviation);
  return fmt::format("{:+.6g} ± {:.2g}{}{}", value, deviation, unit.empty() ? "" : " ", unit);
}

/// One amount for each parameter, a single focal length once.
std::string amounts(const FittedDeviation& fit) {
  std::string text;
  for (const P p : fit.set->parameters) {
    if (fit.set->one_focal && p == P::focal_y) continue;
    if (!text.empty()) text += ", ";
    if (fit.set->size() > 1) text += std::string(name_of(p)) + " ";
    text += amount(fit, p);
  }
  return text;
}

/// The wrong plane or both planes, described as the decoder's values.
std::string text_of_planes(const Camera& camera, const RendererModel& model,
                           const FittedDeviation& fit) {
  const DepthDeviation depths(camera, model, fit.deviation);
  const DeviationSet& set = *fit.set;
  const std::string near = fmt::format("near {:.6g} for {:.6g}", depths.near(), camera.near);
  const std::string far = fmt::format("far {:.6g} for {:.6g}", depths.far(), camera.far);
  std::string text = "depths were decoded with " + (!set.has(P::far)    ? near
                                                    : !set.has(P::near) ? far
                                                                        : near + " and " + far);
  if (!is_perspective(camera.projection)) return text;
  return text + " (" + text_of_decoder(camera, {depths.near(), depths.far()}) + ")";
}

/// Where samples lie is the negative of where the principal point does.
std::string text_of_shift(const FittedDeviation& fit) {
  return fmt::format(
      "the image is shifted by ({:.6g}, {:.6g}) pixels, ± ({:.2g}, {:.2g}): it was sampled that "
      "far from the pixel centres, or its principal point (cx, cy, pixel_centre) is off by the "
      "opposite",
      0 - of(fit.deviation, P::centre_x), 0 - of(fit.deviation, P::centre_y),
      of(fit.standard, P::centre_x), of(fit.standard, P::centre_y));
}

std::string text_of(const Camera& camera, const RendererModel& model, const FittedDeviation& fit) {
  const std::string kind = fit.set->kind;
  if (kind == "shift") return text_of_shift(fit);
  if (kind == "decoding") return text_of_planes(camera, model, fit);
  if (kind == "bias") {
    return fmt::format("window depths are biased by {:+.4g} steps of the storage",
                       of(fit.deviation, P::bias));
  }
  return fmt::format("{} is off by {}", fit.set->subject, amounts(fit));
}

std::vector<Estimate> estimates_of(const Camera& camera, const RendererModel& model,
                                   const FittedDeviation& fit) {
  std::vector<Estimate> estimates;
  const DepthDeviation depths(camera, model, fit.deviation);
  for (const P p : fit.set->parameters) {
    Estimate e{name_of(p), of(fit.deviation, p), of(fit.standard, p), unit_of(p)};
    if (p == P::near || p == P::far) {
      const double plane = p == P::near ? depths.near() : depths.far();
      e.deviation *= std::abs(plane);
      e.value = plane;
    }
    estimates.push_back(std::move(e));
  }
  return estimates;
}

/// If a fault before the rounding to steps is undone, depths lie between steps: within half a step,
/// or below by up to a whole step.
void set_between_steps(std::optional<RecordedDepth>& recorded) {
  using Rounding = RecordedDepth::Rounding;
  if (!recorded || recorded->step == 0) return;
  recorded->error += recorded->rounding == Rounding::down ? recorded->step : recorded->step / 2;
  recorded->rounding = Rounding::binary32;
}

void undo_depths(OtherMap& map, const Camera& camera, const RendererModel& model,
                 const FittedDeviation& fit) {
  const DepthDeviation depths(camera, model, fit.deviation);
  map.windows.clear();
  for (double& depth : map.depths) {
    if (std::abs(depth) < std::numeric_limits<double>::infinity()) depth = depths.undone(depth);
  }
}

}  // namespace

Hypothesis deviation_hypothesis(const Truth& truth, const OtherMap& other,
                                const RendererModel& model, const FittedDeviation& fit) {
  Hypothesis h{fit.set->kind, text_of(truth.camera, model, fit), model, other};
  h.estimates = estimates_of(truth.camera, model, fit);
  h.alternatives = fit.alternatives;
  if (fit.set->moves_the_view()) {
    h.truth = seen_by(truth, deviating(truth.camera, fit.deviation));
    h.model.sample.k1 += of(fit.deviation, P::k1);
    h.model.sample.k2 += of(fit.deviation, P::k2);
    // The matrix read back from a renderer is the matrix of the camera that it was given.
    if (auto* const raster = std::get_if<RasterModel>(&h.model.kind)) {
      raster->matrix.reset();
      raster->scale = {1, 1, 1};
    }
  } else {
    undo_depths(h.map, truth.camera, model, fit);
    set_between_steps(h.model.recorded);
  }
  return h;
}

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

/// nullopt if no camera has these parameters.
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
