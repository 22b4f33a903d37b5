#pragma once

#include <array>
#include <optional>
#include <variant>

#include "fathom/lens/angle_direction.h"
#include "fathom/lens/bent_root_direction.h"
#include "fathom/lens/direction_words.h"
#include "fathom/lens/plane_direction.h"
#include "fathom/lens/root_direction.h"
#include "fathom/lens/turn_direction.h"
#include "fathom/numeric/certified.h"
#include "fathom/numeric/dyadic.h"
#include "fathom/numeric/exact_polynomial.h"

namespace fathom::lens {

/// The direction d ≠ 0 of a ray in the camera frame, exactly: the preimage of a sample, never a
/// rounded vector. It belongs to the Preimages that it is from, which must outlive it.
///
/// It answers what a renderer asks: on which side of a plane the ray lies, which of two surfaces
/// is nearer, on which side of a limit or of a midpoint between two numbers a value lies. Each is
/// the sign of a linear or quadratic form at d, which does not depend on a positive factor of d.
/// Not in it: the components as numbers. They are irrational for most lenses.
///
/// Exact    every sign is the true one, and every question ends.
/// Threads  immutable; any number of threads may ask at once.
class ExactDirection {
 public:
  explicit ExactDirection(RationalDirection direction);
  explicit ExactDirection(PolynomialDirection direction);
  explicit ExactDirection(AngleDirection direction);
  explicit ExactDirection(OneRootDirection direction);
  explicit ExactDirection(NestedRootDirection direction);
  explicit ExactDirection(BentRootDirection direction);
  explicit ExactDirection(TurnDirection direction);

  /// Binary64 intervals that contain d: the filter that should be asked first. d has z = 1 for
  /// models of the plane with a stage, |d| = 1 for fisheyes by the angle and equirectangular
  /// panoramas; the greatest component of a RootDirection is about 1. An end may be infinite.
  [[nodiscard]] const std::array<Interval, 3>& box() const;

  /// The sign of form·d. Does not try the box.
  [[nodiscard]] Sign sign_of(const ExactVector3& form) const;
  /// The sign of a quadratic form at d.
  [[nodiscard]] Sign sign_of(const QuadraticForm& form) const;

  /// Encloses the same d as the box; its widths go to zero as `bits` grows. `bits` is about the
  /// precision relative to d, of x and y relative to the greater of them.
  [[nodiscard]] std::array<DyadicInterval, 3> enclosure(long bits) const;

  /// d times a positive number, in double-words with bounds on the errors; nullopt if the bounds
  /// are too wide.
  [[nodiscard]] std::optional<DirectionWords> words() const;

  /// d times a positive number, if d is known to be rational; otherwise nullptr.
  [[nodiscard]] const ExactVector3* rational() const;

 private:
  std::variant<RationalDirection, PolynomialDirection, AngleDirection, OneRootDirection,
               NestedRootDirection, BentRootDirection, TurnDirection>
      direction_;
};

}  // namespace fathom::lens
