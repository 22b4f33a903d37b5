#pragma once

#include <array>

#include "fathom/numeric/certified.h"
#include "fathom/numeric/quadratic_form.h"

namespace fathom {

/// A direction with rational components: a ray of the pinhole, of the division model, of a table.
///
/// Exact    d = vector/scale, scale > 0. Signs are those of dyadic numbers.
class RationalDirection {
 public:
  explicit RationalDirection(ExactVector3 vector, Dyadic scale = 1.0);

  [[nodiscard]] Sign sign(const ExactVector3& form) const { return dot(form, vector_).sign(); }
  [[nodiscard]] Sign sign(const QuadraticForm& form) const { return form.at(vector_).sign(); }
  /// d times scale.
  [[nodiscard]] const ExactVector3& vector() const { return vector_; }
  /// Intervals that contain the components of d.
  [[nodiscard]] std::array<Interval, 3> box() const;

 private:
  ExactVector3 vector_;
  Dyadic scale_;
};

}  // namespace fathom
