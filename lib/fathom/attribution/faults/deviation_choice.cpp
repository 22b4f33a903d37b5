#include "fathom/attribution/faults/deviation_choice.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <variant>

namespace fathom::attribution {
namespace {

/// A smaller set is as good as a larger set whose cost is at least this fraction of its own: larger
/// sets also fit roundings that the corners of a triangle share.
constexpr double as_good = 0.5;
/// Residuals below a tenth of the model's half width are roundings, whatever fits them.
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
  return "depths were decoded with " + (!set.has(P::far)    ? near
                                        : !set.has(P::near) ? far
                                                            : near + " and " + far);
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

}  // namespace fathom::attribution
