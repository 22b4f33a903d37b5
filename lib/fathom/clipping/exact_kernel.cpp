#include "fathom/clipping/exact_kernel.h"

#include <cstdint>
#include <vector>

#include "fathom/numeric/rounding.h"
#include "fathom/numeric/standard_arithmetic.h"

namespace fathom::clipping {
namespace {

/// An integer as a dyadic number, put together from its 32-bit words.
Dyadic to_dyadic(mpz_srcptr integer) {
  std::vector<std::uint32_t> words((mpz_sizeinbase(integer, 2) + 31) / 32);
  std::size_t count = 0;
  mpz_export(words.data(), &count, -1, sizeof(std::uint32_t), 0, 0, integer);
  Dyadic sum;
  for (std::size_t i = 0; i < count; ++i)
    sum += Dyadic(static_cast<double>(words[i])).scaled(static_cast<long>(32 * i));
  return mpz_sgn(integer) < 0 ? -sum : sum;
}

}  // namespace

Ratio to_ratio(const Rational& x) {
  return {to_dyadic(mpq_numref(x.mpq())), to_dyadic(mpq_denref(x.mpq()))};
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
