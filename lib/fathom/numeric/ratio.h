#pragma once

#include <string>
#include <vector>

#include "fathom/numeric/dyadic.h"

namespace fathom {

/// An exact quotient of two dyadic numbers; the denominator is positive. Not reduced.
struct Ratio {
  Dyadic numerator;
  Dyadic denominator = 1.0;

  Ratio() = default;
  Ratio(Dyadic value) : numerator(std::move(value)) {}
  /// Throws std::domain_error if the denominator is zero.
  Ratio(Dyadic num, Dyadic den);

  [[nodiscard]] Sign sign() const { return numerator.sign(); }
};

Ratio operator+(const Ratio& a, const Ratio& b);
Ratio operator-(const Ratio& a, const Ratio& b);
Ratio operator*(const Ratio& a, const Ratio& b);
/// Throws std::domain_error if b is zero.
Ratio quotient(const Ratio& a, const Ratio& b);
/// The sum of terms. Adds pairs, then pairs of those: operands stay about equally long.
Ratio sum_of(std::vector<Ratio> terms);
int compare(const Ratio& a, const Ratio& b);
inline bool operator==(const Ratio& a, const Ratio& b) {
  return compare(a, b) == 0;
}
inline bool operator<(const Ratio& a, const Ratio& b) {
  return compare(a, b) < 0;
}

/// "p/q" in lowest terms, "p" if q is 1.
std::string to_fraction(const Ratio& x);

/// `digits` significant decimal digits in scientific notation, rounded half to even.
std::string to_decimal(const Ratio& x, int digits);

}  // namespace fathom
