#include "fathom/numeric/certified_logarithm.h"

#include "fathom/numeric/transcendental.h"

namespace fathom {
namespace {

Ratio fraction(double a, double b) {
  return {Dyadic(a), Dyadic(b)};
}

LogarithmTables make_tables() {
  LogarithmTables tables;
  tables.log_2 = to_double_word(natural_logarithm(Dyadic(2.0)));
  tables.log_2_by_64 = {tables.log_2.hi / 64, tables.log_2.lo / 64};
  for (int j = LogarithmTables::first; j <= LogarithmTables::last; ++j) {
    const bool below_one = j < 64;
    const WordPair log =
        to_double_word(natural_logarithm(below_one ? fraction(64, j) : fraction(j, 64)));
    tables.logarithms[static_cast<std::size_t>(j - LogarithmTables::first)] =
        below_one ? WordPair{-log.hi, -log.lo} : log;
  }
  for (int j = 0; j < 64; ++j) {
    tables.roots[static_cast<std::size_t>(j)] = to_double_word(
        affine(power_minus_one(Dyadic(2.0), fraction(j, 64)), Dyadic(1.0), Dyadic(1.0)));
  }
  tables.third = to_double_word(fraction(1, 3));
  tables.sixth = to_double_word(fraction(1, 6));
  return tables;
}

}  // namespace

const LogarithmTables& logarithm_tables() {
  static const LogarithmTables tables = make_tables();
  return tables;
}

// The low end of an enclosure with 160 bits is off by less than 2⁻¹⁵⁰|x|; two roundings to nearest
// leave 2⁻¹⁰⁶|x|.
WordPair to_double_word(const Real& x) {
  const Ratio low = x.enclose(160).low;
  const double hi = round_to_binary64(low);
  return {hi, round_to_binary64(low - Dyadic(hi))};
}

}  // namespace fathom
