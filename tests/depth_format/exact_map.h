#pragma once

#include <gmp.h>

#include "fathom/depth_format/depth_format.h"
#include "fathom/depth_format/encode.h"
#include "fathom/numeric/ratio.h"

/// An independent judge of depth formats: the formulas of the specification over GMP's rationals,
/// logarithms by MPFR in fixed precisions, values of stored numbers by ldexp. It answers one
/// question, the sign of f(D) − s, by cross-multiplication; no rounding and no inverse of ours.
namespace fathom::test {

/// A format, for messages.
inline std::string text_of(const DepthFormat& format) {
  char numbers[128];
  std::snprintf(numbers, sizeof numbers, " near %a far %a C %a", format.near, format.far, format.c);
  return std::string(name_of(format.mapping)) + " " + std::string(name_of(format.storage)) +
         numbers;
}

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

/// The sign of f(depth) − value. Logarithms are equal where they agree to 4950 bits. With binary64
/// near, far and C, and the boundaries of rounding asked about here, no two different ones come
/// near to that: they do most where C·far is tiny, and then f(D) is D/far up to a factor of 1 +
/// C·far/2, which is above 2⁻²¹⁵⁰.
int compare_map(const DepthFormat& format, const Rational& depth, const Rational& value);

/// Whether `bits` is f(depth) rounded to nearest, ties to even.
bool is_rounded_correctly(const DepthFormat& format, const Rational& depth, std::uint64_t bits);

/// Whether `depth` is the binary64 number nearest to the depth that `bits` stands for, which may be
/// infinite.
bool is_decoded_correctly(const DepthFormat& format, std::uint64_t bits, double depth);

}  // namespace fathom::test
