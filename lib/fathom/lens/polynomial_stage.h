#pragma once

#include <optional>

#include "fathom/lens/stage.h"
#include "fathom/numeric/certified_value.h"

namespace fathom::lens {

/// The greatest binary64 number below π²: the disc of a fisheye without a stage, since a ray has an
/// angle below π to the axis.
inline constexpr double end_of_angles = 0x1.3bd3cc9be45dep3;

/// A stage and the disc on which it is used, prepared for preimages.
struct PolynomialStage {
  /// Of a model that has a stage.
  explicit PolynomialStage(const Lens& lens);

  StageNumbers<double> numbers;
  StageNumbers<Certified<double>> certified;
  StageNumbers<Dyadic> exact;
  /// Q; not narrowed by max_radius.
  double disc;
  /// The greatest |m|² that counts; nullopt if there is no bound.
  std::optional<Dyadic> limit;
};

}  // namespace fathom::lens
