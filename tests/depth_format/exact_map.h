#pragma once

#include <gmp.h>

#include "fathom/depth_format/depth_format.h"
#include "fathom/depth_format/stored_depth.h"
#include "fathom/numeric/ratio.h"

/// An independent judge of depth formats: the formulas of the specification over GMP's rationals,
/// logarithms by MPFR in one fixed precision, values of stored numbers by ldexp. It answers one
/// question, the sign of f(D) − s, by cross-multiplication; no rounding and no inverse of ours.
namespace fathom::test {

/// A GMP rational that cleans up after itself.
class Rational {
 public:
  Rational(double value = 0) {
    mpq_init(q_);
    mpq_set_d(q_, value);
  }
  Rational(double numerator, double denominator) : Rational(numerator) {
    *this = *this / Rational(denominator);
  }
  explicit Rational(const Ratio& x);
  Rational(const Rational& other) {
    mpq_init(q_);
    mpq_set(q_, other.q_);
  }
  Rational& operator=(const Rational& other) {
    mpq_set(q_, other.q_);
    return *this;
  }
  ~Rational() { mpq_clear(q_); }
  [[nodiscard]] mpq_srcptr get() const { return q_; }

  friend Rational operator+(const Rational& a, const Rational& b) { return of(mpq_add, a, b); }
  friend Rational operator-(const Rational& a, const Rational& b) { return of(mpq_sub, a, b); }
  friend Rational operator*(const Rational& a, const Rational& b) { return of(mpq_mul, a, b); }
  friend Rational operator/(const Rational& a, const Rational& b) { return of(mpq_div, a, b); }
  friend int compare(const Rational& a, const Rational& b) { return mpq_cmp(a.q_, b.q_); }

 private:
  template <class Operation>
  static Rational of(Operation operation, const Rational& a, const Rational& b) {
    Rational result;
    operation(result.q_, a.q_, b.q_);
    return result;
  }
  mpq_t q_;
};

/// The number that a stored value is.
Rational number(Storage storage, std::uint64_t bits);

/// The sign of f(depth) − value. Logarithms are compared with 300 bits, and are equal where they
/// agree to 250: for binary64 depths and the boundaries of rounding asked about here, no two
/// different ones come near to that.
int compare_map(const DepthFormat& format, const Rational& depth, const Rational& value);

/// Whether `bits` is f(depth) rounded to nearest, ties to even.
bool is_rounded_correctly(const DepthFormat& format, double depth, std::uint64_t bits);

/// Whether `depth` is the binary64 number nearest to the depth that `bits` stands for. An infinite
/// one is right only where f(the greatest binary64 number) still has not reached the value.
bool is_decoded_correctly(const DepthFormat& format, std::uint64_t bits, double depth);

}  // namespace fathom::test
