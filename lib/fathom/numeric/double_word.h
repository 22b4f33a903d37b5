#pragma once

#include <array>
#include <cmath>

#include "fathom/numeric/standard_arithmetic.h"

/// Double-word ("double-double") arithmetic: a number is kept as the unevaluated sum of two
/// binary64 numbers, hi being the one nearest to the sum.
///
/// Exactness  Each operation has a relative error of at most the multiple of u² = 2⁻¹⁰⁶ that is
///            written beside it, for all operands, even if they cancel, as long as no intermediate
///            result overflows and every one is 0 or a multiple of 2⁻⁹⁰⁰ (so that errors of
///            products are representable). epsilon<Real> is above all of them.
/// Needs      rounding to nearest, no fast-math, no contraction: std::fma is fused where it is
///            written and nothing else is (-ffp-contract=off).
/// Source     [JMP17], whose numbers of algorithms and theorems are used here; [MR22] for formal
///            proofs of the bounds.
namespace fathom {

/// A double-word number without its operations, as tables hold it.
struct WordPair {
  double hi = 0, lo = 0;
};

/// a + b exactly (Algorithm 2, 2Sum).
inline WordPair two_sum(double a, double b) {
  const double s = a + b;
  const double a_part = s - b;
  const double b_part = s - a_part;
  return {s, (a - a_part) + (b - b_part)};
}

/// a + b exactly, if |a| ≥ |b| or a = 0 (Algorithm 1, Fast2Sum).
inline WordPair fast_two_sum(double a, double b) {
  const double s = a + b;
  return {s, b - (s - a)};
}

/// x as a sum of two numbers of at most 26 bits (Veltkamp, see [Dek71]); |x| < 2⁹⁹⁵.
inline WordPair split(double x) {
  const double c = 0x1p27 * x + x;  // either sign: 2²⁷ − 1 splits as well
  const double high = c - (c - x);
  return {high, x - high};
}

/// a · b exactly (Algorithm 3, 2Prod): by a fused multiply-add, or by the algorithm of [Dek71].
template <bool fused>
inline WordPair two_product(double a, double b) {
  const double p = a * b;
  if constexpr (fused) {
    return {p, std::fma(a, b, -p)};
  } else {
    const WordPair x = split(a), y = split(b);
    return {p, ((x.hi * y.hi - p) + x.hi * y.lo + x.lo * y.hi) + x.lo * y.lo};
  }
}

/// A double-word number. `fused` selects how products are computed; it affects no bound.
template <bool fused>
struct DoubleWord {
  double hi = 0, lo = 0;

  DoubleWord() = default;
  DoubleWord(double value) : hi(value) {}  // implicit: a binary64 number is one
  DoubleWord(double high, double low) : hi(high), lo(low) {}
  DoubleWord(const WordPair& x) : hi(x.hi), lo(x.lo) {}
  operator WordPair() const { return {hi, lo}; }

  DoubleWord operator-() const { return {-hi, -lo}; }

  /// 3u²/(1 − 4u) (Algorithm 6, AccurateDWPlusDW; Theorem 3.1).
  friend DoubleWord operator+(const DoubleWord& x, const DoubleWord& y) {
    const WordPair s = two_sum(x.hi, y.hi);
    const WordPair t = two_sum(x.lo, y.lo);
    const WordPair v = fast_two_sum(s.hi, s.lo + t.hi);
    return fast_two_sum(v.hi, t.lo + v.lo);
  }
  friend DoubleWord operator-(const DoubleWord& x, const DoubleWord& y) { return x + -y; }

  /// 3u²/2 + 4u³ < 2u² (Algorithm 7, DWTimesFP1; Theorem 4.1).
  friend DoubleWord operator*(const DoubleWord& x, double y) {
    const WordPair c = two_product<fused>(x.hi, y);
    const WordPair t = fast_two_sum(c.hi, x.lo * y);
    return fast_two_sum(t.hi, t.lo + c.lo);
  }

  /// 7u² (Algorithm 10, DWTimesDW1; Theorem 5.1).
  friend DoubleWord operator*(const DoubleWord& x, const DoubleWord& y) {
    const WordPair c = two_product<fused>(x.hi, y.hi);
    return fast_two_sum(c.hi, c.lo + (x.hi * y.lo + x.lo * y.hi));
  }

  /// 15u² + 56u³ (Algorithm 17, DWDivDW2; Theorem 7.1).
  friend DoubleWord operator/(const DoubleWord& x, const DoubleWord& y) {
    const double t = x.hi / y.hi;
    const DoubleWord r = y * t;
    const double rest = (x.hi - r.hi) + (x.lo - r.lo);
    return fast_two_sum(t, rest / y.hi);
  }
};

/// One step of Newton's iteration from r = fl(√hi). With x = r² + d exactly,
/// √x = r + d/(2r) − d²/(8r³) + …; r has a relative error of less than 1.01u, hi one of u with
/// respect to x, so |d| ≤ 3.1u·x and the terms left out are below 1.3u²·√x. d/(2r) ≤ 1.6u·√x goes
/// through three roundings: of x.lo − error of r², of the sum with hi − r² (exact by Sterbenz's
/// lemma, [Ste74]), of the quotient: 5u² together. At most 8u².
template <bool fused>
inline DoubleWord<fused> square_root(const DoubleWord<fused>& x) {
  if (!(x.hi > 0)) return 0.0;
  const double r = std::sqrt(x.hi);
  const WordPair square = two_product<fused>(r, r);
  const double d = (x.hi - square.hi) + (x.lo - square.lo);
  return fast_two_sum(r, d / (2 * r));
}
inline double square_root(double x) {
  return std::sqrt(x);
}

/// The bound of the root, 8u² (validation/proofs/channels/double_word_root.gappa.in).
inline constexpr double root_error = 0x8p-106;

/// Bound on the relative error of one operation: 2⁻⁵³ in binary64; 2⁻¹⁰² = 16u² in double-words.
template <class Real>
inline constexpr double epsilon = 0x1p-102;
template <>
inline constexpr double epsilon<double> = unit_roundoff<double>;

/// a − b: rounded in binary64, exact in double-words.
template <class Real>
inline Real difference(double a, double b) {
  return two_sum(a, -b);
}
template <>
inline double difference<double>(double a, double b) {
  return a - b;
}

/// The binary64 number nearest to x.
inline double nearest(double x) {
  return x;
}
template <bool fused>
inline double nearest(const DoubleWord<fused>& x) {
  return x.hi;
}

/// An entry of a table in an arithmetic: binary64 takes its leading part.
template <class Real>
inline Real entry(const WordPair& x) {
  return x;
}
template <>
inline double entry<double>(const WordPair& x) {
  return x.hi;
}

template <class Real>
using Vector = std::array<Real, 3>;

}  // namespace fathom
