#include "fathom/attribution/faults/deviation_choice.h"

#include <algorithm>
#include <cmath>

namespace fathom::attribution {
namespace {

/// A smaller set is as good as a larger one whose cost is not less than this part of its own: a
/// larger one also follows roundings that corners of a triangle share.
constexpr double as_good = 0.5;
/// Residuals of a tenth of what the model allows are its roundings, whatever would follow them.
constexpr double roundings = 0.01;
/// Sets of the same size whose costs are so close cannot be told apart: the first in their order is
/// named, the others are alternatives.
constexpr double indistinguishable = 1.05;
/// What the cost has to fall to for anything to be named, and how many standard deviations each
/// parameter has to be off by, of those that the residuals show. (What corners may be off by is
/// told as part of the deviation, but it is the most that there may be: a set of six parameters
/// would have to be far off before each of them were beyond it.) That it then explains the pixels
/// that were unexplained is for others to see.
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

}  // namespace fathom::attribution
