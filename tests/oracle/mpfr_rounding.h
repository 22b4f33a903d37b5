#pragma once

#include "tests/oracle/mpfr_number.h"

/// Rounding by MPFR, for holding ours against: the quotient is computed by MPFR itself in the
/// target's precision and exponent range, then mpfr_subnormalize keeps double rounding out.
namespace fathom::oracle {

struct Range {
  int precision;
  mpfr_exp_t emin, emax;
};
inline constexpr Range binary16{11, -23, 16};
inline constexpr Range binary32{24, -148, 128};
inline constexpr Range binary64{53, -1073, 1024};

/// Calls `compute(result)`, which returns MPFR's ternary value, in the format's range.
template <class Compute>
double round_with(const Range& range, const Compute& compute) {
  const mpfr_exp_t old_emin = mpfr_get_emin(), old_emax = mpfr_get_emax();
  mpfr_set_emin(range.emin);
  mpfr_set_emax(range.emax);
  MpfrNumber result(range.precision);
  const int ternary = compute(result);
  mpfr_check_range(result, ternary, MPFR_RNDN);
  mpfr_subnormalize(result, ternary, MPFR_RNDN);
  const double value = mpfr_get_d(result, MPFR_RNDN);
  mpfr_set_emin(old_emin);
  mpfr_set_emax(old_emax);
  return value;
}

inline double quotient(const Range& range, const mpq_t q) {
  return round_with(range, [&](mpfr_ptr r) { return mpfr_set_q(r, q, MPFR_RNDN); });
}

/// √q: q is first squeezed into more bits than could matter. A root of a rational is rational or
/// irrational; at 4000 bits a sticky last bit (rounding to odd) keeps ties and near-ties apart.
inline double root(const Range& range, const mpq_t q) {
  MpfrNumber wide(4000);
  const int inexact = mpfr_set_q(wide, q, MPFR_RNDZ);
  if (inexact != 0)
    mpfr_nextabove(wide);  // half an ulp of 4000 bits above, never a square of few bits
  return round_with(range, [&](mpfr_ptr r) { return mpfr_sqrt(r, wide, MPFR_RNDN); });
}

}  // namespace fathom::oracle
