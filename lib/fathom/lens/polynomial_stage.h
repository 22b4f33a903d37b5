#pragma once

#include <optional>

#include "fathom/lens/stage.h"
#include "fathom/numeric/certified_value.h"

namespace fathom::lens {

/// A stage and the disc on which it is used, prepared for preimages.
struct PolynomialStage {
  /// `radius`: |m| is at most that; +∞ if only the disc bounds it.
  PolynomialStage(const StageNumbers<double>& stage, double radius);

  StageNumbers<double> numbers;
  StageNumbers<Certified<double>> certified;
  StageNumbers<Dyadic> exact;
  /// Q; not narrowed by `radius`.
  double disc;
  /// The greatest |m|² that counts; nullopt if there is no bound.
  std::optional<Dyadic> limit;
};

}  // namespace fathom::lens
