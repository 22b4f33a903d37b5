#include "fathom/numeric/exact_words.h"

#include <algorithm>

#include "fathom/numeric/big_numbers.h"

namespace fathom {

// |x| is cut off below its second word; the error is less than a unit of the last place kept.
Certified<WordPair> words_of(const Dyadic& x) {
  constexpr long word_bits = 53;
  if (x.is_zero()) return {WordPair{}, 0};
  const long top = x.top();
  if (top < -800 || top > 1000) return {};
  mpz_srcptr m = x.significand();
  const long bits = top - x.exponent();
  const long middle = std::max(0L, bits - word_bits), end = std::max(0L, middle - word_bits);
  const auto word = [&](long from, long to) {
    return std::ldexp(bits_between(m, from, to), static_cast<int>(x.exponent() + from));
  };
  WordPair value = two_sum(word(middle, bits), word(end, middle));
  if (x.sign() == Sign::negative) value = {-value.hi, -value.lo};
  const bool is_exact = mpz_scan1(m, 0) >= static_cast<mp_bitcnt_t>(end);
  return {value, is_exact ? 0 : std::ldexp(1.0, static_cast<int>(x.exponent() + end))};
}

Words sum_in_words(const std::vector<Ratio>& terms) {
  Words sum{0.0, 0};
  for (const Ratio& term : terms) sum = sum + in_words(term);
  return sum;
}

}  // namespace fathom
