#pragma once

#include <array>
#include <cstddef>
#include <optional>
#include <vector>

#include "fathom/numeric/certified.h"
#include "fathom/numeric/dyadic.h"

/// Polynomials with exact coefficients: in one variable, and quadratic forms in three.
namespace fathom {

/// A polynomial in one variable with dyadic coefficients, dense, exactly.
class ExactPolynomial {
 public:
  ExactPolynomial() = default;
  /// A constant.
  ExactPolynomial(const Dyadic& constant);
  ExactPolynomial(double constant) : ExactPolynomial(Dyadic(constant)) {}
  /// Coefficients by ascending powers.
  explicit ExactPolynomial(std::vector<Dyadic> coefficients);
  /// The variable itself.
  static ExactPolynomial variable() { return ExactPolynomial({Dyadic(), Dyadic(1.0)}); }

  friend ExactPolynomial operator+(const ExactPolynomial& a, const ExactPolynomial& b);
  friend ExactPolynomial operator-(const ExactPolynomial& a, const ExactPolynomial& b);
  friend ExactPolynomial operator*(const ExactPolynomial& a, const ExactPolynomial& b);
  ExactPolynomial operator-() const;
  [[nodiscard]] ExactPolynomial derivative() const;

  /// Without leading zeroes: none for the polynomial 0.
  [[nodiscard]] const std::vector<Dyadic>& coefficients() const { return coefficients_; }
  [[nodiscard]] bool is_zero() const { return coefficients_.empty(); }
  /// −1 for the polynomial 0.
  [[nodiscard]] long degree() const { return static_cast<long>(coefficients_.size()) - 1; }
  /// The sign for arguments that are great enough.
  [[nodiscard]] Sign sign_at_infinity() const;
  [[nodiscard]] Dyadic at(const Dyadic& x) const;

 private:
  std::vector<Dyadic> coefficients_;
};

/// The value of Σ coefficients[i]·xⁱ in any arithmetic; there is at least one coefficient.
template <class T>
T horner(const std::vector<T>& coefficients, const T& x) {
  T value = coefficients.back();
  for (std::size_t i = coefficients.size() - 1; i-- > 0;) value = value * x + coefficients[i];
  return value;
}

/// p times a positive number, so that the coefficients are integers without a common divisor.
ExactPolynomial primitive(const ExactPolynomial& p);

/// Counts real roots exactly, each once, regardless of its multiplicity. Sturm's theorem, with
/// primitive pseudo-remainders.
class SturmChain {
 public:
  /// The chain of a polynomial other than 0.
  explicit SturmChain(const ExactPolynomial& p);
  [[nodiscard]] int real_roots() const;
  [[nodiscard]] int positive_roots() const;
  /// The roots in (0, x].
  [[nodiscard]] int positive_roots_up_to(const Dyadic& x) const;

 private:
  std::vector<ExactPolynomial> chain_;
};

/// The greatest binary64 number x such that p has no root in [0, x]; nullopt if it has no positive
/// root.
/// Needs    p(0) ≠ 0.
std::optional<double> greatest_before_positive_root(const ExactPolynomial& p);

/// A number B such that |h(q)| ≥ 2^−B for all q with f(q) = 0 and h(q) ≠ 0; f and h are primitive
/// polynomials other than 0. With their degrees n and m, |h(q)| ≥ ‖h‖₁^(1−n)·‖f‖₂^(−m).
///
/// With P the irreducible factor of f that has the root q and leading coefficient p, Res(P, h) is
/// an integer other than 0, the product of p^m and all h(qᵢ), qᵢ the roots of P; each of the others
/// is at most ‖h‖₁·max(1, |qᵢ|)^m; and p·Π max(1, |qᵢ|), the measure of P, is at most the measure
/// of f, which is at most ‖f‖₂ (Landau). (Mignotte, Mathematics for Computer Algebra.)
long zero_bound_bits(const ExactPolynomial& f, const ExactPolynomial& h);

/// A quadratic form on three coordinates with exact coefficients: squares of linear forms, and sums
/// of such squares, on the directions of rays.
struct QuadraticForm {
  /// The coefficients of x², y², z², xy, xz and yz.
  std::array<Dyadic, 6> coefficients;

  QuadraticForm& operator+=(const QuadraticForm& other);
  QuadraticForm& operator-=(const QuadraticForm& other);
  friend QuadraticForm operator*(const Dyadic& factor, QuadraticForm form);
  [[nodiscard]] Dyadic at(const ExactVector3& d) const;
};

/// (l·d)²
QuadraticForm square_of(const ExactVector3& l);
/// d·d
QuadraticForm squared_length();

}  // namespace fathom
