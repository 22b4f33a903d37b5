#pragma once

#include <array>
#include <cmath>
#include <cstdint>

#include "fathom/numeric/certified_value.h"

/// Logarithms and exponentials of double-words, with bounds on their errors: about 80 bits, for
/// values that are rounded to binary32 or to a code (transcendental.h computes as many bits as the
/// caller needs).
///
/// Method ([Tan89], [Tan90]). y = 2^e·c·(1 + r) with c a multiple of 1/64 and |r| ≤ 0.0112, so that
/// log y = e·log 2 + log c + log(1 + r); exp y = 2^(k/64)·exp(r) with |r| ≤ 0.00542. Constants are
/// exact numbers rounded to double-words. Of the series the first three terms are double-words, the
/// rest is binary64.
///
/// How errors are counted. ε = epsilon<DoubleWord> bounds the relative error of each operation and
/// each constant, u = 2⁻⁵³ the relative error of operations and constants in binary64; ρ = |r|.
/// Terms of second order go into `slack`.
namespace fathom {

struct LogarithmTables {
  WordPair log_2, log_2_by_64;
  static constexpr int first = 45, last = 91;
  /// log(j / 64) for j = first … last.
  std::array<WordPair, last - first + 1> logarithms;
  /// 2^(j/64)
  std::array<WordPair, 64> roots;
  WordPair third, sixth;
};
const LogarithmTables& logarithm_tables();

class Real;
/// A double-word nearest to x, up to 2⁻¹⁰⁵|x|.
WordPair to_double_word(const Real& x);

/// log y, for y > 0. The error is +∞ if y.error is more than 2⁻²⁰ of y, or y is beyond 2^±1000.
template <bool fused>
Certified<DoubleWord<fused>> logarithm(const Certified<DoubleWord<fused>>& y) {
  using Wide = DoubleWord<fused>;
  constexpr double e = epsilon<Wide>;
  const LogarithmTables& tables = logarithm_tables();
  if (!(y.value.hi > 0x1p-1000 && y.value.hi < 0x1p1000 && y.error <= y.value.hi * 0x1p-20)) {
    return {};
  }
  int power = 0;
  double m = std::frexp(y.value.hi, &power);
  if (m < 0.70710678118654746) {
    m *= 2;
    --power;
  }
  const double scale = std::ldexp(1.0, -power);
  const double j = std::nearbyint(64 * m);
  const double c = j / 64;
  // A sum and a quotient: r errs by 2ερ, and log(1 + r) by 2.1ερ.
  const Wide r = (Wide(m, y.value.lo * scale) - Wide(c)) / Wide(c);
  const double rho = std::abs(r.hi);

  // log(1 + r) = r − r²/2 + r³/3 − r⁴·P, P = 1/4 − r/5 + … + r⁸/12, and the omitted terms are at
  // most ρ¹³/(13(1 − ρ)). Double-words: r², r³, 1/3, its product, two sums, the last: 5ερ. P: each
  // of 8 steps rounds twice and takes r.hi for r; Σρᵏ/(k + 4) < 0.2525, so P errs by 26u·0.2525 <
  // 7u, r⁴·P by less than 8u·ρ⁴.
  double P = 1.0 / 12;
  for (int i = 11; i >= 4; --i) P = 1.0 / i - P * r.hi;
  const Wide r2 = r * r;
  const Wide series = ((r2 * r) * Wide(tables.third) - r2 * 0.5) + (r - Wide(r2.hi * r2.hi * P));

  // e·log 2: a constant and a product; log c: a constant; two sums.
  const Wide log_c(tables.logarithms[static_cast<std::size_t>(j) - LogarithmTables::first]);
  const Wide power_part = Wide(tables.log_2) * static_cast<double>(power);
  const double rho2 = rho * rho, rho4 = rho2 * rho2;
  const double error = e * (4 * std::abs(power_part.hi) + 3 * std::abs(log_c.hi) + 9 * rho) +
                       0x1p-50 * rho4 + rho4 * rho4 * rho4 * rho / 12 + y.error / y.value.hi;
  return {(power_part + log_c) + series, error * slack};
}

/// exp y, for 0 ≤ y ≤ 690. The error is +∞ for other y, and if y.error is more than 2⁻²⁰.
template <bool fused>
Certified<DoubleWord<fused>> exponential(const Certified<DoubleWord<fused>>& y) {
  using Wide = DoubleWord<fused>;
  constexpr double e = epsilon<Wide>;
  const LogarithmTables& tables = logarithm_tables();
  if (!(y.value.hi >= 0 && y.value.hi <= 690 && y.error <= 0x1p-20)) return {};
  const double k = std::nearbyint(y.value.hi / tables.log_2_by_64.hi);
  // A constant, a product and a difference: r errs by 3ε(y + 1).
  const Wide r = y.value - Wide(tables.log_2_by_64) * k;
  const double rho = std::abs(r.hi);

  // exp(r) − 1 = r + r²/2 + r³/6 + r⁴·Q, Q = 1/4! + … + r⁷/11! < 0.042, and the omitted terms are
  // below 1.01·ρ¹²/12!. Double-words as above: 5ερ; Q errs by 23u·0.042 < u, r⁴·Q by less than
  // 2u·ρ⁴.
  double Q = 1.0 / 39916800;
  double factorial = 39916800;
  for (int i = 11; i >= 5; --i) {
    factorial /= i;
    Q = 1.0 / factorial + Q * r.hi;
  }
  const Wide r2 = r * r;
  const Wide series = ((r2 * r) * Wide(tables.sixth) + r2 * 0.5) + (r + Wide(r2.hi * r2.hi * Q));

  const auto steps = static_cast<int>(k);
  const Wide root(tables.roots[static_cast<std::size_t>(steps % 64)]);
  const double scale = std::ldexp(1.0, steps / 64);
  const Wide value = root + root * series;
  const double rho2 = rho * rho, rho4 = rho2 * rho2;
  // The root: a constant, a product, a sum. exp errs by its value times the errors of r and y.
  const double relative = e * (5 * rho + 4) + 0x1p-52 * rho4 + 0x1p-28 * rho4 * rho4 * rho4 +
                          3 * e * (y.value.hi + 1) + y.error * (1 + 0x1p-19);
  return {Wide(value.hi * scale, value.lo * scale),
          relative * (std::abs(value.hi) * scale) * (1 + 0x1p-6) * slack};
}

}  // namespace fathom
