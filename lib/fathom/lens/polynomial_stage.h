#pragma once

#include <optional>

#include "fathom/lens/stage.h"
#include "fathom/numeric/certified_value.h"

namespace fathom::lens {

/// The disc |m|² ≤ Q on which a stage is used (specification, section 2): Q is the greatest
/// binary64 number such that on it the stage is defined and the symmetric part of its Jacobian is
/// positive definite, so that it is one to one. Of two stages, such that this holds for the first
/// on the disc, and for the second on the disc around its image. +∞ if there is no bound.
///
/// Exact    always for a radial stage. For others the number is proved to be good, and to be the
///          greatest one if the determinant of the symmetric part changes its sign at the edge, or
///          if D has a root there that is none of N. Otherwise it may be smaller.
/// Cost     milliseconds; up to a minute where it may be smaller.
double greatest_disc(const StageNumbers<double>& numbers);

/// The greatest binary64 number below π²: the disc of a fisheye without a stage, since a ray has an
/// angle below π to the axis.
inline constexpr double end_of_angles = 0x1.3bd3cc9be45dep3;

/// A stage and the disc on which it is used, prepared for preimages. Each thread keeps the discs of
/// its last stages: renders with the same lens follow each other.
struct PolynomialStage {
  /// Of a lens that has a stage.
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
