#include "fathom/numeric/real_sums.h"

#include <algorithm>
#include <array>
#include <cstdint>
#include <memory>
#include <optional>
#include <unordered_map>
#include <utility>

#include "fathom/numeric/big_numbers.h"

namespace fathom {
namespace {

/// So few terms are added exactly at once.
constexpr std::size_t few_terms = 4;
/// EnclosedSum provides enclosures up to this many bits; beyond, the exact number is used.
constexpr long enclosed_bits = 96;

Enclosure enclosure_of(const std::vector<Ratio>& terms) {
  EnclosedSum sum;
  for (const Ratio& term : terms) sum.add(term);
  return sum.get();
}

/// A number within `around` that `exactly` computes.
template <class Exactly>
Real real_within(Enclosure around, const Exactly& exactly) {
  return {[around = std::move(around), exactly](long bits) {
            if (bits <= enclosed_bits) return around;
            const Ratio value = exactly();
            return Enclosure{value, value};
          },
          [exactly]() -> std::optional<Ratio> { return exactly(); }};
}

}  // namespace

Real real_sum(std::vector<Ratio> terms) {
  if (terms.size() <= few_terms) return sum_of(std::move(terms));
  Enclosure around = enclosure_of(terms);
  return real_within(std::move(around), [sum = std::make_shared<const std::vector<Ratio>>(
                                             std::move(terms))] { return sum_of(*sum); });
}

Real real_quotient(std::vector<Ratio> over, std::vector<Ratio> under) {
  const Enclosure above = enclosure_of(over), below = enclosure_of(under);
  const auto exactly = [sums = std::make_shared<const std::array<std::vector<Ratio>, 2>>(
                            std::array{std::move(over), std::move(under)})] {
    return quotient(sum_of((*sums)[0]), sum_of((*sums)[1]));
  };
  // Terms may be too small for the enclosure's resolution.
  if (below.low.sign() != Sign::positive) return exactly();
  return real_within(quotient(above, below), exactly);
}

Enclosure quotient(const Enclosure& over, const Enclosure& under) {
  const bool falls = over.low.sign() == Sign::negative;
  const bool rises = over.high.sign() == Sign::positive;
  return {quotient(over.low, falls ? under.low : under.high),
          quotient(over.high, rises ? under.low : under.high)};
}

namespace {

/// x is the significand times 2^exponent with an even exponent.
void to_even_exponent(const Dyadic& x, mpz_ptr significand, long& exponent) {
  exponent = x.exponent();
  const bool is_odd = exponent % 2 != 0;
  mpz_mul_2exp(significand, x.significand(), is_odd ? 1 : 0);
  if (is_odd) --exponent;
}

/// Bounds of √x with at least `bits` bits.
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

/// For each of some primes, whether a number is a square modulo this prime. Two numbers whose
/// product is a square have the same bits if none of the primes divides them.
struct ResidueBits {
  std::uint32_t bits = 0;
  bool is_complete = true;
};

/// Any odd primes are right. Large ones divide a number seldom.
std::array<unsigned long, 32> residue_primes() {
  std::array<unsigned long, 32> primes{};
  Integer prime;
  mpz_set_ui(prime, 1UL << 31);
  for (unsigned long& each : primes) {
    mpz_nextprime(prime, prime);
    each = mpz_get_ui(prime);
  }
  return primes;
}

ResidueBits residues_of(const Dyadic& x) {
  static const std::array<unsigned long, 32> primes = residue_primes();
  Integer m;
  long exponent = 0;
  to_even_exponent(x, m, exponent);
  ResidueBits residues;
  for (const unsigned long prime : primes) {
    const int symbol = mpz_kronecker_ui(m, prime);
    residues.bits = residues.bits << 1 | (symbol > 0 ? 1U : 0U);
    if (symbol == 0) residues.is_complete = false;
  }
  return residues;
}

/// Positive numbers by classes: the product of two numbers of one class is a square. The bits of a
/// number lead to its class, so that n numbers take about n steps.
class SquareClasses {
 public:
  /// A class, and the root of the product of a number and the representative of the class.
  struct Found {
    std::size_t index;
    Dyadic common;
  };

  [[nodiscard]] std::optional<Found> find(const Dyadic& number) const {
    const ResidueBits residues = residues_of(number);
    if (!residues.is_complete) {
      for (std::size_t k = 0; k < representatives_.size(); ++k) {
        if (auto common = root_with(k, number)) return Found{k, *common};
      }
      return std::nullopt;
    }
    const auto same = by_residues_.find(residues.bits);
    if (same != by_residues_.end()) {
      if (auto found = find_among(same->second, number)) return found;
    }
    return find_among(incomplete_, number);
  }

  /// Makes a class.
  /// Needs    a number that belongs to no class.
  void add(const Dyadic& number) {
    const ResidueBits residues = residues_of(number);
    auto& others = residues.is_complete ? by_residues_[residues.bits] : incomplete_;
    others.push_back(representatives_.size());
    representatives_.push_back(number);
  }

  [[nodiscard]] const Dyadic& representative(std::size_t index) const {
    return representatives_[index];
  }

 private:
  [[nodiscard]] std::optional<Dyadic> root_with(std::size_t index, const Dyadic& number) const {
    return exact_root(representatives_[index] * number);
  }
  [[nodiscard]] std::optional<Found> find_among(const std::vector<std::size_t>& some,
                                                const Dyadic& number) const {
    for (const std::size_t index : some) {
      if (auto common = root_with(index, number)) return Found{index, *common};
    }
    return std::nullopt;
  }

  std::vector<Dyadic> representatives_;
  std::unordered_map<std::uint32_t, std::vector<std::size_t>> by_residues_;
  /// Classes of whose representative a prime is a divisor.
  std::vector<std::size_t> incomplete_;
};

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
  SquareClasses classes;
  std::vector<std::vector<Ratio>> factors;
  for (const Term& term : terms_) {
    if (const auto same = classes.find(term.radicand)) {
      factors[same->index].push_back(term.factor *
                                     Ratio(same->common, classes.representative(same->index)));
    } else {
      classes.add(term.radicand);
      factors.push_back({term.factor});
    }
  }
  std::vector<Term> result;
  for (std::size_t k = 0; k < factors.size(); ++k) {
    Ratio factor = sum_of(std::move(factors[k]));
    if (factor.sign() != Sign::zero) {
      result.push_back({std::move(factor), classes.representative(k)});
    }
  }
  return result;
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
              return quotient(over, under);
            }
          },
          [sums]() -> std::optional<Ratio> {
            const auto& [over, under] = *sums;
            const std::vector<RootSum::Term> of_over = over.by_classes(),
                                             of_under = under.by_classes();
            if (of_over.empty()) return Ratio();
            if (of_over.size() != of_under.size()) return std::nullopt;
            SquareClasses classes;
            for (const RootSum::Term& term : of_over) classes.add(term.radicand);
            std::optional<Ratio> result;
            for (const RootSum::Term& term : of_under) {
              const auto same = classes.find(term.radicand);
              if (!same) return std::nullopt;
              const Ratio& factor = of_over[same->index].factor;
              const Ratio its = quotient(factor * Ratio(same->common, term.radicand), term.factor);
              if (result && !(its == *result)) return std::nullopt;
              result = its;
            }
            return result;
          }};
}

}  // namespace fathom
