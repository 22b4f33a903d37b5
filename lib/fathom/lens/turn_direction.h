#pragma once

#include <array>
#include <cstddef>

#include "fathom/lens/sample_plane.h"
#include "fathom/numeric/certified.h"
#include "fathom/numeric/dyadic.h"
#include "fathom/numeric/exact_polynomial.h"
#include "fathom/numeric/roots_of_unity.h"

namespace fathom::lens {

template <class T>
struct SineAndCosine {
  T sine, cosine;
};

/// Those of an angle and so many quarters of a turn.
template <class T>
SineAndCosine<T> after_quarters(long quarters, const SineAndCosine<T>& of_angle) {
  const auto& [sine, cosine] = of_angle;
  switch (quarters & 3) {
    case 0:
      return {sine, cosine};
    case 1:
      return {cosine, -sine};
    case 2:
      return {-sine, -cosine};
    default:
      return {-cosine, sine};
  }
}

/// The direction of a panorama. With the sample at (x, y), x in turns:
/// equirectangular, y in half turns and |y| ≤ ½:  d = (cos πy·sin 2πx, sin πy, cos πy·cos 2πx)
/// cylindrical:                                   d = (sin 2πx, y, cos 2πx)
///
/// Exact    the angles are rational parts of a turn. A form at d is a sum of cosines of such
///          angles; where 128 bits do not settle its sign, is_zero(Waves) decides whether it is 0
///          (roots_of_unity.h). All other signs are found in intervals of more and more bits.
class TurnDirection {
 public:
  /// |y| ≤ ½.
  static TurnDirection equirectangular(const DistortedPoint& sample);
  static TurnDirection cylindrical(const DistortedPoint& sample);

  [[nodiscard]] Sign sign_of(const ExactVector3& form) const;
  [[nodiscard]] Sign sign_of(const QuadraticForm& form) const;
  /// Encloses the components of d, each with a relative precision of about `bits`; a component
  /// that is 0 is a point.
  [[nodiscard]] std::array<DyadicInterval, 3> enclosure(long bits) const;
  /// Binary64 intervals that contain d.
  [[nodiscard]] const std::array<Interval, 3>& box() const { return box_; }

 private:
  /// factor·cos(first)·cos(second), with angles as parts of turn_.
  struct Component {
    Dyadic factor, first, second;
  };
  TurnDirection(std::array<Component, 3> components, Dyadic turn, Dyadic scale);
  [[nodiscard]] Waves waves_of(std::size_t component) const;
  [[nodiscard]] Waves waves_at(const ExactVector3& form) const;
  [[nodiscard]] Waves waves_at(const QuadraticForm& form) const;
  template <class Form>
  [[nodiscard]] Sign sign_of_form(const Form& form) const;

  /// d times scale_ > 0.
  std::array<Component, 3> components_;
  Dyadic turn_, scale_;
  std::array<Interval, 3> box_;
};

}  // namespace fathom::lens
