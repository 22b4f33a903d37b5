#include "fathom/pipeline/scan/arithmetic.h"

#include <stdexcept>

namespace fathom::pipeline {

std::int64_t floor_of(const Exact& x) {
  mpz_t quotient;
  mpz_init(quotient);
  mpz_fdiv_q(quotient, mpq_numref(x.mpq()), mpq_denref(x.mpq()));
  const bool fits = mpz_fits_slong_p(quotient) != 0;
  const std::int64_t result = mpz_get_si(quotient);
  mpz_clear(quotient);
  if (!fits) throw std::out_of_range("a coordinate is beyond 2^63");
  return result;
}

}  // namespace fathom::pipeline
