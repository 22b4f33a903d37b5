#pragma once

#include <array>
#include <variant>

#include "fathom/lens/rational_direction.h"
#include "fathom/numeric/dyadic_interval.h"

namespace fathom {

/// The direction d ≠ 0 of a ray in the camera frame, exactly: the preimage of a sample, never a
/// rounded vector. Where a lens is in use it belongs to a LensField, which must outlive it.
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

  /// The sign of form·d.
  [[nodiscard]] Sign sign(const ExactVector3& form) const;
  /// The sign of a quadratic form at d.
  [[nodiscard]] Sign sign(const QuadraticForm& form) const;

  /// d times a positive number where that is a vector of dyadic numbers, else nullptr.
  [[nodiscard]] const ExactVector3* rational() const;
  /// Intervals that contain d times a positive number. Their widths go to zero as `bits` grows;
  /// `bits` is about their relative precision.
  [[nodiscard]] std::array<DyadicInterval, 3> enclosure(long bits) const;
  /// Binary64 intervals that contain d, scaled as the specification (section 2) defines the model:
  /// z = 1 for models of the plane. For filters.
  [[nodiscard]] const std::array<Interval, 3>& box() const { return box_; }

 private:
  std::array<Interval, 3> box_;
  std::variant<RationalDirection> direction_;
};

}  // namespace fathom
