#include "fathom/numeric/grid_trigonometry.h"

#include "fathom/numeric/big_float.h"

namespace fathom {
namespace {

using Function = int (*)(mpfr_ptr, mpfr_srcptr, mpfr_rnd_t);

/// The function in `precision` bits, rounded to one side, then to the nearest multiple.
void round_on_grid(mpz_ptr result, Function function, double radians, long bits, long precision,
                   mpfr_rnd_t side) {
  BigFloat value(precision);
  mpfr_set_d(value, radians, MPFR_RNDN);  // exact: there are at least 53 bits
  function(value, value, side);
  mpfr_mul_2si(value, value, bits, MPFR_RNDN);
  mpfr_get_z(result, value, MPFR_RNDN);
}

Dyadic on_grid(Function function, double radians, long bits) {
  for (long precision = bits + 64;; precision *= 2) {
    Integer below, above;
    round_on_grid(below, function, radians, bits, precision, MPFR_RNDD);
    round_on_grid(above, function, radians, bits, precision, MPFR_RNDU);
    if (mpz_cmp(below, above) == 0) return Dyadic::of(below, -bits);
  }
}

}  // namespace

Dyadic sine_on_grid(double radians, long bits) {
  return on_grid(mpfr_sin, radians, bits);
}

Dyadic cosine_on_grid(double radians, long bits) {
  return on_grid(mpfr_cos, radians, bits);
}

}  // namespace fathom
