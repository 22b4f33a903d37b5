#pragma once

#include <algorithm>
#include <utility>

#include "fathom/numeric/dyadic.h"

namespace fathom {

/// A closed interval with exact ends, whose sums and products are exact, too: it grows with what
/// its operands leave open and by no rounding.
struct DyadicInterval {
  Dyadic low, high;

  /// The sign of all its numbers; Sign::zero if they differ in sign, or are 0.
  [[nodiscard]] Sign sign() const {
    if (low.sign() == Sign::positive) return Sign::positive;
    return high.sign() == Sign::negative ? Sign::negative : Sign::zero;
  }
};

inline DyadicInterval operator+(const DyadicInterval& a, const DyadicInterval& b) {
  return {a.low + b.low, a.high + b.high};
}

inline DyadicInterval operator*(const Dyadic& a, const DyadicInterval& b) {
  if (a.sign() == Sign::negative) return {a * b.high, a * b.low};
  return {a * b.low, a * b.high};
}

inline DyadicInterval operator*(const DyadicInterval& a, const DyadicInterval& b) {
  const DyadicInterval of_low = a.low * b, of_high = a.high * b;
  return {std::min(of_low.low, of_high.low), std::max(of_low.high, of_high.high)};
}

inline DyadicInterval square(const DyadicInterval& a) {
  DyadicInterval squares{a.low * a.low, a.high * a.high};
  if (squares.high < squares.low) std::swap(squares.low, squares.high);
  if (a.sign() == Sign::zero) squares.low = {};
  return squares;
}

}  // namespace fathom
