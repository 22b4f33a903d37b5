#include "fathom/numeric/common_factor.h"

#include <algorithm>
#include <limits>

#include "fathom/numeric/integer.h"

namespace fathom {

ExactVector3 without_common_factor(const ExactVector3& v) {
  long unit = std::numeric_limits<long>::max();
  for (const Dyadic& x : v) {
    if (!x.is_zero()) unit = std::min(unit, x.exponent());
  }
  std::array<Integer, 3> magnitudes;
  Integer divisor;
  for (std::size_t k = 0; k < 3; ++k) {
    if (v[k].is_zero()) continue;
    mpz_abs(magnitudes[k], v[k].significand());
    mpz_mul_2exp(magnitudes[k], magnitudes[k], static_cast<mp_bitcnt_t>(v[k].exponent() - unit));
    mpz_gcd(divisor, divisor, magnitudes[k]);
  }
  ExactVector3 result;
  for (std::size_t k = 0; k < 3; ++k) {
    if (v[k].is_zero()) continue;
    mpz_divexact(magnitudes[k], magnitudes[k], divisor);
    result[k] = Dyadic::of(magnitudes[k]);
    if (v[k].sign() == Sign::negative) result[k] = -result[k];
  }
  return result;
}

}  // namespace fathom
