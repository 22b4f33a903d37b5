#include "fathom/numeric/root_sum.h"

#include <algorithm>
#include <memory>
#include <utility>

#include "fathom/numeric/integer.h"

namespace fathom {
namespace {

/// x is the significand times 2^exponent with an even exponent.
void to_even_exponent(const Dyadic& x, mpz_ptr significand, long& exponent) {
  exponent = x.exponent();
  const bool is_odd = exponent % 2 != 0;
  mpz_mul_2exp(significand, x.significand(), is_odd ? 1 : 0);
  if (is_odd) --exponent;
}

/// Bounds of √x with at least so many bits.
Enclosure root(const Dyadic& x, long bits) {
  Integer m, s, rest;
  long exponent = 0;
  to_even_exponent(x, m, exponent);
  const long have = static_cast<long>(mpz_sizeinbase(m.get(), 2));
  const long shift = std::max(0L, bits + 2 - have / 2);
  mpz_mul_2exp(m, m, static_cast<mp_bitcnt_t>(2 * shift));
  mpz_sqrtrem(s, rest, m);
  const long unit = exponent / 2 - shift;
  const Dyadic low = Dyadic::of(s, unit);
  if (mpz_sgn(rest.get()) == 0) return {low, low};
  return {low, low + Dyadic(1.0).scaled(unit)};
}

/// x rounded down to a multiple of 2^unit.
Dyadic rounded_down(const Ratio& x, long unit) {
  Integer numerator, denominator;
  mpz_set(numerator, x.numerator.significand());
  mpz_set(denominator, x.denominator.significand());
  shift(numerator, denominator, x.numerator.exponent() - x.denominator.exponent() - unit);
  mpz_fdiv_q(numerator, numerator, denominator);
  return Dyadic::of(numerator, unit);
}

/// The exponent of a power of two that is about as great as a term, or greater.
long size_of(const Ratio& factor, const Dyadic& radicand) {
  return factor.numerator.top() - factor.denominator.top() + 1 + radicand.top() / 2 + 1;
}

}  // namespace

std::optional<Dyadic> exact_root(const Dyadic& x) {
  if (x.sign() == Sign::negative) return std::nullopt;
  Integer m, s;
  long exponent = 0;
  to_even_exponent(x, m, exponent);
  if (mpz_perfect_square_p(m.get()) == 0) return std::nullopt;
  mpz_sqrt(s, m);
  return Dyadic::of(s, exponent / 2);
}

void RootSum::add(Ratio q, Dyadic r) {
  if (q.sign() != Sign::zero && !r.is_zero()) terms_.push_back({std::move(q), std::move(r)});
}

// √r = √s · √(r·s) / s.
std::vector<RootSum::Term> RootSum::by_classes() const {
  std::vector<Term> classes;
  for (const Term& term : terms_) {
    bool is_known = false;
    for (Term& its : classes) {
      const std::optional<Dyadic> common = exact_root(term.radicand * its.radicand);
      if (!common) continue;
      its.factor = its.factor + term.factor * Ratio(*common, its.radicand);
      is_known = true;
      break;
    }
    if (!is_known) classes.push_back(term);
  }
  std::erase_if(classes, [](const Term& term) { return term.factor.sign() == Sign::zero; });
  return classes;
}

Enclosure RootSum::enclose(long bits) const {
  if (terms_.empty()) return {};
  long greatest = size_of(terms_[0].factor, terms_[0].radicand);
  for (const Term& term : terms_)
    greatest = std::max(greatest, size_of(term.factor, term.radicand));
  const long unit = greatest - bits - 8;
  Dyadic low, high;
  for (const Term& term : terms_) {
    Enclosure its = root(term.radicand, bits + 8);
    if (term.factor.sign() == Sign::negative) std::swap(its.low, its.high);
    low += rounded_down(term.factor * its.low, unit);
    const Ratio above = term.factor * its.high;
    high += -rounded_down(Ratio(-above.numerator, above.denominator), unit);
  }
  return {low, high};
}

Real RootSum::value() const {
  if (terms_.empty()) return Ratio();
  const auto sum = std::make_shared<const RootSum>(*this);
  return {[sum](long bits) { return sum->enclose(bits); },
          [sum]() -> std::optional<Ratio> {
            const std::vector<Term> classes = sum->by_classes();
            if (classes.empty()) return Ratio();
            if (classes.size() > 1) return std::nullopt;
            const std::optional<Dyadic> root = exact_root(classes[0].radicand);
            if (!root) return std::nullopt;
            return classes[0].factor * Ratio(*root);
          }};
}

// a/b = c means that a − c·b has no class left: c is the quotient of the factors in each.
Real quotient(const RootSum& a, const RootSum& b) {
  if (a.terms_.empty()) return Ratio();
  const auto sums = std::make_shared<const std::pair<RootSum, RootSum>>(a, b);
  return {[sums](long bits) {
            for (long more = bits;; more *= 2) {
              const Enclosure over = sums->first.enclose(more), under = sums->second.enclose(more);
              if (under.low.sign() != Sign::positive) continue;
              const bool falls = over.low.sign() == Sign::negative;
              const bool rises = over.high.sign() == Sign::positive;
              return Enclosure{quotient(over.low, falls ? under.low : under.high),
                               quotient(over.high, rises ? under.low : under.high)};
            }
          },
          [sums]() -> std::optional<Ratio> {
            const auto& [over, under] = *sums;
            const std::vector<RootSum::Term> of_over = over.by_classes(),
                                             of_under = under.by_classes();
            if (of_over.empty()) return Ratio();
            if (of_over.size() != of_under.size()) return std::nullopt;
            std::optional<Ratio> result;
            for (const RootSum::Term& term : of_under) {
              std::optional<Ratio> its;
              for (const RootSum::Term& other : of_over) {
                const auto common = exact_root(term.radicand * other.radicand);
                if (common)
                  its = quotient(other.factor * Ratio(*common, term.radicand), term.factor);
              }
              if (!its || (result && !(*its == *result))) return std::nullopt;
              result = its;
            }
            return result;
          }};
}

}  // namespace fathom
