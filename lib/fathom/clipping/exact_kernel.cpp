#include "fathom/clipping/exact_kernel.h"

#include "fathom/numeric/rounding.h"
#include "fathom/numeric/standard_arithmetic.h"

namespace fathom::clipping {
Ratio to_ratio(const Rational& x) {
  return {Dyadic::of(mpq_numref(x.mpq())), Dyadic::of(mpq_denref(x.mpq()))};
}

double to_binary64(const Rational& x) {
  const StandardArithmetic standard;
  return round_to_binary64(to_ratio(x));
}

std::string to_fraction(const Rational& x) {
  std::string text(
      mpz_sizeinbase(mpq_numref(x.mpq()), 10) + mpz_sizeinbase(mpq_denref(x.mpq()), 10) + 3, '\0');
  mpq_get_str(text.data(), 10, x.mpq());
  text.resize(text.find('\0'));
  return text;
}

Rings<Rational> to_exact(const Rings<double>& rings) {
  const StandardArithmetic standard;
  Rings<Rational> exact;
  for (const Ring<double>& ring : rings) {
    exact.emplace_back();
    for (const Point2<double>& p : ring) exact.back().push_back({Rational(p.x), Rational(p.y)});
  }
  return exact;
}

}  // namespace fathom::clipping
