#pragma once

#include <cmath>
#include <vector>

#include "fathom/numeric/certified_value.h"
#include "fathom/numeric/dyadic.h"
#include "fathom/numeric/ratio.h"

/// Exact numbers in double-words with bounds on the errors. A sum of quotients takes about as long
/// as two divisions per term, however long the numbers are; its exact value has a denominator as
/// long as all denominators together.
namespace fathom {

/// The leading 106 bits of a number; exact if it has no more. Not known outside [2⁻⁸⁰⁰, 2¹⁰⁰⁰],
/// except 0.
Certified<WordPair> words_of(const Dyadic& x);

/// A number with a bound, for arithmetic.
using Words = Certified<DoubleWord<false>>;

inline Words in_words(const Dyadic& x) {
  return in_words<false>(words_of(x));
}
inline Words in_words(const Ratio& x) {
  return in_words(x.numerator) / in_words(x.denominator);
}
/// The sum of the terms.
Words sum_in_words(const std::vector<Ratio>& terms);

/// The leading word. The other word and the error are its error; the factor covers the rounding of
/// their sum.
inline Certified<double> leading_word(const Words& x) {
  return {x.value.hi, (std::abs(x.value.lo) + x.error) * bound_rounding};
}

}  // namespace fathom
