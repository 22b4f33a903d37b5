#include "fathom/lens/polynomial_stage.h"

#include <cmath>

#include "fathom/lens/disc.h"

namespace fathom::lens {

PolynomialStage::PolynomialStage(const StageNumbers<double>& stage, double radius)
    : numbers(stage),
      certified(stage.in([](double x) {
        return Certified<double>{x, 0};
      })),
      exact(stage.in([](double x) { return Dyadic(x); })),
      disc(greatest_disc(stage)) {
  if (std::isfinite(disc)) limit = disc;
  if (!std::isfinite(radius)) return;
  const Dyadic square = Dyadic(radius) * Dyadic(radius);
  if (!limit || square < *limit) limit = square;
}

}  // namespace fathom::lens
