#pragma once

#include <array>

#include "fathom/numeric/certified.h"
#include "fathom/numeric/real.h"

namespace fathom {

/// xx·x² + yy·y² + zz·z² + xy·x·y + xz·x·z + yz·y·z
struct QuadraticForm {
  Dyadic xx, yy, zz, xy, xz, yz;
};

/// A direction with rational components: a ray of the pinhole, of the division model, of a table.
///
/// Exact    d = vector/scale, scale > 0. Signs are those of dyadic numbers.
class RationalDirection {
 public:
  explicit RationalDirection(ExactVector3 vector, Dyadic scale = 1.0);

  [[nodiscard]] Sign sign(const ExactVector3& form) const { return dot(form, vector_).sign(); }
  [[nodiscard]] Sign sign(const QuadraticForm& form) const;
  /// The components of d, exactly: both ends of an enclosure are the same, whatever `bits` is.
  [[nodiscard]] std::array<Enclosure, 3> enclosure(long bits) const;
  /// Intervals that contain the components of d.
  [[nodiscard]] std::array<Interval, 3> box() const;

 private:
  ExactVector3 vector_;
  Dyadic scale_;
};

}  // namespace fathom
