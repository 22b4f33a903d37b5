#pragma once

#include <array>

#include "fathom/numeric/certified.h"

namespace fathom {

/// A quadratic form on three coordinates with exact coefficients: squares of linear forms, and sums
/// of such squares, on the directions of rays.
struct QuadraticForm {
  /// Of x², y², z², xy, xz and yz.
  std::array<Dyadic, 6> coefficients;

  QuadraticForm& operator+=(const QuadraticForm& other);
  QuadraticForm& operator-=(const QuadraticForm& other);
  friend QuadraticForm operator*(const Dyadic& factor, QuadraticForm form);
  [[nodiscard]] Dyadic at(const ExactVector3& d) const;
};

/// (l·d)²
QuadraticForm square_of(const ExactVector3& l);
/// d·d
QuadraticForm squared_length();

}  // namespace fathom
