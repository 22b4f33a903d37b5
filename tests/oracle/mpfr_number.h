#pragma once

#include <gmp.h>
#include <mpfr.h>

namespace fathom::oracle {

/// An mpfr_t of so many bits that cleans up after itself; NaN at first.
class MpfrNumber {
 public:
  explicit MpfrNumber(long bits) { mpfr_init2(value_, bits); }
  MpfrNumber(const MpfrNumber&) = delete;
  MpfrNumber& operator=(const MpfrNumber&) = delete;
  ~MpfrNumber() { mpfr_clear(value_); }
  operator mpfr_ptr() { return value_; }

 private:
  mpfr_t value_;
};

/// log(1 + x), rounded twice, to the precision of the result: with x = q − 1, log q, of which
/// nothing is lost where q is near 1.
inline void set_log1p(mpfr_ptr result, mpq_srcptr x) {
  mpfr_set_q(result, x, MPFR_RNDN);
  mpfr_log1p(result, result, MPFR_RNDN);
}

}  // namespace fathom::oracle
