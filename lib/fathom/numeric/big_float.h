#pragma once

#include <mpfr.h>

#include "fathom/numeric/dyadic.h"
#include "fathom/numeric/integer.h"

/// MPFR's numbers, to and from exact ones. Only for .cpp files of this room.
namespace fathom {

/// An mpfr_t that cleans up after itself.
class BigFloat {
 public:
  explicit BigFloat(long bits) { mpfr_init2(value_, bits); }
  BigFloat(const BigFloat&) = delete;
  BigFloat& operator=(const BigFloat&) = delete;
  ~BigFloat() { mpfr_clear(value_); }
  operator mpfr_ptr() { return value_; }

 private:
  mpfr_t value_;
};

/// The value of a finite x, exactly.
inline Dyadic to_dyadic(mpfr_srcptr x) {
  if (mpfr_zero_p(x) != 0) return {};
  Integer significand;
  const mpfr_exp_t exponent = mpfr_get_z_2exp(significand, x);
  return Dyadic::of(significand, exponent);
}

}  // namespace fathom
