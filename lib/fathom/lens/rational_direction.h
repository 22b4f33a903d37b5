#pragma once

#include <array>

#include "fathom/numeric/certified.h"
#include "fathom/numeric/dyadic_interval.h"
#include "fathom/numeric/quadratic_form.h"

namespace fathom::lens {

/// A direction with rational components: a ray of the pinhole, of the division model, of a table.
///
/// Exact    d = vector/scale, scale > 0. Signs are those of dyadic numbers.
class RationalDirection {
 public:
  explicit RationalDirection(ExactVector3 vector, Dyadic scale = 1.0);

  /// d, times a positive number.
  [[nodiscard]] const ExactVector3& vector() const { return vector_; }
  [[nodiscard]] Sign sign_of(const ExactVector3& form) const { return dot(form, vector_).sign(); }
  [[nodiscard]] Sign sign_of(const QuadraticForm& form) const { return form.at(vector_).sign(); }
  /// Encloses the components of d, each with a relative precision of about `bits`.
  [[nodiscard]] std::array<DyadicInterval, 3> enclosure(long bits) const;
  /// Intervals that contain the components of d.
  [[nodiscard]] const std::array<Interval, 3>& box() const { return box_; }

 private:
  ExactVector3 vector_;
  Dyadic scale_;
  std::array<Interval, 3> box_;
};

}  // namespace fathom::lens
