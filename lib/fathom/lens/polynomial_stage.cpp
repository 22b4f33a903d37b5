#include "fathom/lens/polynomial_stage.h"

#include <algorithm>
#include <cmath>

#include "fathom/lens/disc.h"

namespace fathom::lens {
namespace {

double disc_of(const Lens& lens, const StageNumbers<double>& stage) {
  const double of_stage = greatest_disc(stage);
  return is_plane(lens.model) ? of_stage : std::min(of_stage, end_of_angles);
}

}  // namespace

PolynomialStage::PolynomialStage(const Lens& lens)
    : numbers(stage_of(lens)),
      certified(numbers.in([](double x) {
        return Certified<double>{x, 0};
      })),
      exact(numbers.in([](double x) { return Dyadic(x); })),
      disc(disc_of(lens, numbers)) {
  if (std::isfinite(disc)) limit = disc;
  if (!std::isfinite(lens.max_radius)) return;
  const Dyadic square = Dyadic(lens.max_radius) * Dyadic(lens.max_radius);
  if (!limit || square < *limit) limit = square;
}

}  // namespace fathom::lens
