#include "fathom/numeric/exact_polynomial.h"

#include <algorithm>
#include <bit>
#include <cstdint>
#include <limits>
#include <utility>

#include "fathom/numeric/certified.h"

namespace fathom {
namespace {

using Coefficients = std::vector<Dyadic>;

const Dyadic& leading(const ExactPolynomial& p) {
  return p.coefficients().back();
}

/// What x^power times p has for coefficients.
ExactPolynomial shifted(const ExactPolynomial& p, long power) {
  Coefficients coefficients(static_cast<std::size_t>(power));
  coefficients.insert(coefficients.end(), p.coefficients().begin(), p.coefficients().end());
  return ExactPolynomial(std::move(coefficients));
}

/// A positive multiple of the remainder of a divided by b.
ExactPolynomial remainder_of(ExactPolynomial a, const ExactPolynomial& b) {
  const Dyadic size = abs(leading(b));
  while (a.degree() >= b.degree()) {
    const Dyadic factor = leading(b).sign() == Sign::negative ? -leading(a) : leading(a);
    const long power = a.degree() - b.degree();
    a = ExactPolynomial(size) * a - ExactPolynomial(factor) * shifted(b, power);
  }
  return a;
}

/// A positive or negative multiple of the quotient of a divided by its divisor b.
ExactPolynomial quotient_of(ExactPolynomial a, const ExactPolynomial& b) {
  ExactPolynomial quotient;
  while (!a.is_zero()) {
    const ExactPolynomial term = shifted(leading(a), a.degree() - b.degree());
    const ExactPolynomial size(leading(b));
    a = size * a - term * b;
    quotient = size * quotient + term;
  }
  return quotient;
}

/// How many neighbours differ in sign, zeroes left out.
template <class SignOf>
int variations(const std::vector<ExactPolynomial>& chain, const SignOf& sign_of_member) {
  int count = 0;
  Sign before = Sign::zero;
  for (const ExactPolynomial& p : chain) {
    const Sign sign = sign_of_member(p);
    if (sign == Sign::zero) continue;
    if (sign == -before) ++count;
    before = sign;
  }
  return count;
}

int variations_at(const std::vector<ExactPolynomial>& chain, const Dyadic& x) {
  return variations(chain, [&x](const ExactPolynomial& p) { return p.at(x).sign(); });
}

int variations_at_infinity(const std::vector<ExactPolynomial>& chain) {
  return variations(chain, [](const ExactPolynomial& p) { return p.sign_at_infinity(); });
}

}  // namespace

ExactPolynomial::ExactPolynomial(const Dyadic& constant)
    : ExactPolynomial(std::vector<Dyadic>{constant}) {}

ExactPolynomial::ExactPolynomial(std::vector<Dyadic> coefficients)
    : coefficients_(std::move(coefficients)) {
  while (!coefficients_.empty() && coefficients_.back().is_zero()) coefficients_.pop_back();
}

ExactPolynomial operator+(const ExactPolynomial& a, const ExactPolynomial& b) {
  if (a.coefficients_.size() < b.coefficients_.size()) return b + a;
  Coefficients sum = a.coefficients_;
  for (std::size_t i = 0; i < b.coefficients_.size(); ++i) sum[i] += b.coefficients_[i];
  return ExactPolynomial(std::move(sum));
}

ExactPolynomial operator-(const ExactPolynomial& a, const ExactPolynomial& b) {
  return a + -b;
}

ExactPolynomial operator*(const ExactPolynomial& a, const ExactPolynomial& b) {
  if (a.is_zero() || b.is_zero()) return {};
  Coefficients product(a.coefficients_.size() + b.coefficients_.size() - 1);
  for (std::size_t i = 0; i < a.coefficients_.size(); ++i)
    for (std::size_t j = 0; j < b.coefficients_.size(); ++j)
      product[i + j] += a.coefficients_[i] * b.coefficients_[j];
  return ExactPolynomial(std::move(product));
}

ExactPolynomial ExactPolynomial::operator-() const {
  Coefficients negated;
  negated.reserve(coefficients_.size());
  for (const Dyadic& c : coefficients_) negated.push_back(-c);
  return ExactPolynomial(std::move(negated));
}

ExactPolynomial ExactPolynomial::derivative() const {
  Coefficients derived;
  for (std::size_t i = 1; i < coefficients_.size(); ++i)
    derived.push_back(Dyadic(static_cast<double>(i)) * coefficients_[i]);
  return ExactPolynomial(std::move(derived));
}

Sign ExactPolynomial::sign_at_infinity() const {
  return is_zero() ? Sign::zero : coefficients_.back().sign();
}

Dyadic ExactPolynomial::at(const Dyadic& x) const {
  return is_zero() ? Dyadic() : horner(coefficients_, x);
}

ExactPolynomial primitive(const ExactPolynomial& p) {
  Coefficients coefficients = p.coefficients();
  divide_by_common_factor(coefficients);
  return ExactPolynomial(std::move(coefficients));
}

// The last member is the greatest common divisor of p and p'; dividing all by it would change no
// count, as long as p is not 0 where the signs are taken. At a root of p the whole chain vanishes
// if the root is multiple, so the counts below are made of a p without multiple roots.
SturmChain::SturmChain(const ExactPolynomial& p) {
  const auto chain_of = [](const ExactPolynomial& first) {
    std::vector<ExactPolynomial> chain{primitive(first), primitive(first.derivative())};
    while (!chain.back().is_zero()) {
      const std::size_t last = chain.size() - 1;
      chain.push_back(-primitive(remainder_of(chain[last - 1], chain[last])));
    }
    chain.pop_back();
    return chain;
  };
  chain_ = chain_of(p);
  if (chain_.back().degree() > 0) chain_ = chain_of(quotient_of(chain_.front(), chain_.back()));
}

int SturmChain::real_roots() const {
  const int at_minus_infinity = variations(chain_, [](const ExactPolynomial& p) {
    return p.degree() % 2 == 0 ? p.sign_at_infinity() : -p.sign_at_infinity();
  });
  return at_minus_infinity - variations_at_infinity(chain_);
}

int SturmChain::positive_roots() const {
  return variations_at(chain_, Dyadic()) - variations_at_infinity(chain_);
}

int SturmChain::positive_roots_up_to(const Dyadic& x) const {
  return variations_at(chain_, Dyadic()) - variations_at(chain_, x);
}

// The bits of binary64 numbers ≥ 0 are in the order of the numbers.
std::optional<double> greatest_before_positive_root(const ExactPolynomial& p) {
  const SturmChain chain(p);
  if (chain.positive_roots() == 0) return std::nullopt;
  const auto has_root = [&chain](std::uint64_t bits) {
    return chain.positive_roots_up_to(std::bit_cast<double>(bits)) > 0;
  };
  std::uint64_t without = 0;
  auto with = std::bit_cast<std::uint64_t>(std::numeric_limits<double>::infinity());
  while (with - without > 1) {
    const std::uint64_t between = without + (with - without) / 2;
    (has_root(between) ? with : without) = between;
  }
  return std::bit_cast<double>(without);
}

long zero_bound_bits(const ExactPolynomial& f, const ExactPolynomial& h) {
  Dyadic sum_of_h, squares_of_f;
  for (const Dyadic& c : h.coefficients()) sum_of_h += abs(c);
  for (const Dyadic& c : f.coefficients()) squares_of_f += c * c;
  const long half_up = (squares_of_f.top() + 1) / 2;
  return std::max(f.degree() - 1, 0L) * sum_of_h.top() + h.degree() * half_up;
}

namespace {

/// The pairs of coordinates in the order of the coefficients.
constexpr std::array<std::array<std::size_t, 2>, 6> pairs{
    {{0, 0}, {1, 1}, {2, 2}, {0, 1}, {0, 2}, {1, 2}}};

}  // namespace

QuadraticForm& QuadraticForm::operator+=(const QuadraticForm& other) {
  for (std::size_t k = 0; k < pairs.size(); ++k) coefficients[k] += other.coefficients[k];
  return *this;
}

QuadraticForm& QuadraticForm::operator-=(const QuadraticForm& other) {
  for (std::size_t k = 0; k < pairs.size(); ++k) coefficients[k] -= other.coefficients[k];
  return *this;
}

QuadraticForm operator*(const Dyadic& factor, QuadraticForm form) {
  for (Dyadic& coefficient : form.coefficients) coefficient *= factor;
  return form;
}

Dyadic QuadraticForm::at(const ExactVector3& d) const {
  Dyadic sum;
  for (std::size_t k = 0; k < pairs.size(); ++k) {
    sum += coefficients[k] * d[pairs[k][0]] * d[pairs[k][1]];
  }
  return sum;
}

QuadraticForm square_of(const ExactVector3& l) {
  QuadraticForm form;
  for (std::size_t k = 0; k < pairs.size(); ++k) {
    const auto& [i, j] = pairs[k];
    const Dyadic product = l[i] * l[j];
    form.coefficients[k] = i == j ? product : product.scaled(1);
  }
  return form;
}

QuadraticForm squared_length() {
  QuadraticForm form;
  for (std::size_t k = 0; k < 3; ++k) form.coefficients[k] = 1.0;
  return form;
}

}  // namespace fathom
