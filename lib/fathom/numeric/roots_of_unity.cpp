#include "fathom/numeric/roots_of_unity.h"

#include <algorithm>
#include <array>
#include <cstdint>
#include <map>
#include <optional>
#include <span>
#include <stdexcept>
#include <utility>

#include "fathom/numeric/big_numbers.h"

namespace fathom {

namespace {

/// Two numbers as integers times the same power of two.
struct Aligned {
  Integer a, b;
  long exponent;

  Aligned(const Dyadic& x, const Dyadic& y) : exponent(std::min(x.exponent(), y.exponent())) {
    const auto shift = [this](const Dyadic& z) {
      return static_cast<mp_bitcnt_t>(z.exponent() - exponent);
    };
    mpz_mul_2exp(a, x.significand(), shift(x));
    mpz_mul_2exp(b, y.significand(), shift(y));
  }
};

}  // namespace

Dyadic without_whole_turns(const Dyadic& part, const Dyadic& turn) {
  Aligned n(part, turn);
  mpz_fdiv_r(n.a, n.a, n.b);
  return Dyadic::of(n.a, n.exponent);
}

Waves product(const Waves& a, const Waves& b) {
  Waves waves;
  for (const Wave& x : a) {
    for (const Wave& y : b) {
      const Dyadic half = (x.amplitude * y.amplitude).scaled(-1);
      waves.push_back({half, x.part + y.part});
      waves.push_back({half, x.part - y.part});
    }
  }
  return waves;
}

Waves operator*(const Dyadic& factor, Waves waves) {
  for (Wave& wave : waves) wave.amplitude *= factor;
  return waves;
}

Waves& operator+=(Waves& a, const Waves& b) {
  a.insert(a.end(), b.begin(), b.end());
  return a;
}

namespace {

/// coefficient·e^(2πi·part/turn), 0 ≤ part < turn/2.
struct Root {
  Dyadic coefficient;
  Dyadic part;
};

/// The roots in twice a sum of waves, each once: 2·cos x = e^(ix) + e^(−ix), and a root of the
/// second half of the turn is the negative of one of the first half.
std::vector<Root> roots_of(const Waves& waves, const Dyadic& turn) {
  std::map<Dyadic, Dyadic> coefficients;
  const auto add = [&](const Dyadic& part, const Dyadic& coefficient) {
    const Dyadic rest = without_whole_turns(part, turn), half = turn.scaled(-1);
    if (rest < half) {
      coefficients[rest] += coefficient;
    } else {
      coefficients[rest - half] -= coefficient;
    }
  };
  for (const auto& [amplitude, part] : waves) {
    add(part, amplitude);
    add(-part, amplitude);
  }
  std::vector<Root> roots;
  for (const auto& [part, coefficient] : coefficients)
    if (!coefficient.is_zero()) roots.push_back({coefficient, part});
  return roots;
}

/// The product of all of them is below 2³³.
constexpr std::array<std::uint64_t, 10> all_primes{2, 3, 5, 7, 11, 13, 17, 19, 23, 29};
constexpr std::size_t most_roots = 30;

std::uint64_t product_of(std::span<const std::uint64_t> primes) {
  std::uint64_t product = 1;
  for (const std::uint64_t p : primes) product *= p;
  return product;
}

/// coefficient·ζ^power, ζ an m-th root of unity; power < m.
struct Power {
  Dyadic coefficient;
  std::uint64_t power;
};

/// x/p + y/rest = e/(p·rest) up to integers, p and rest without common factors.
std::pair<std::uint64_t, std::uint64_t> split(std::uint64_t e, std::uint64_t p,
                                              std::uint64_t rest) {
  std::uint64_t x = 0;
  while (x * rest % p != e % p) ++x;
  return {x, (e + (p - x) * rest) / p % rest};
}

std::vector<Power> difference(std::vector<Power> a, const std::vector<Power>& b) {
  for (const auto& [coefficient, power] : b) a.push_back({-coefficient, power});
  return a;
}

/// Whether a sum of powers vanishes, m the product of the primes.
bool vanishes(const std::vector<Power>& sum, std::span<const std::uint64_t> primes) {
  if (sum.empty()) return true;
  if (primes.empty()) {
    Dyadic total;
    for (const Power& each : sum) total += each.coefficient;
    return total.is_zero();
  }
  const std::uint64_t p = primes.back();
  const auto others = primes.first(primes.size() - 1);
  const std::uint64_t rest = product_of(others);
  std::vector<std::vector<Power>> factors(p);
  for (const auto& [coefficient, power] : sum) {
    const auto [x, y] = split(power, p, rest);
    factors[x].push_back({coefficient, y});
  }
  const auto& shortest = *std::ranges::min_element(
      factors, {}, [](const std::vector<Power>& factor) { return factor.size(); });
  return std::ranges::all_of(factors, [&](const std::vector<Power>& factor) {
    return &factor == &shortest || vanishes(difference(factor, shortest), others);
  });
}

/// (a − b)·m/turn modulo m if that is an integer: the quotient of two roots is then this power of
/// the m-th root of unity.
std::optional<std::uint64_t> power_between(const Root& a, const Root& b, std::uint64_t m,
                                           const Dyadic& turn) {
  Aligned n(a.part - b.part, turn);
  mpz_mul_ui(n.a, n.a, m);
  if (mpz_divisible_p(n.a, n.b) == 0) return std::nullopt;
  mpz_divexact(n.a, n.a, n.b);
  return mpz_fdiv_ui(n.a, m);
}

/// Takes the roots out whose quotients with the last one are m-th roots of unity.
std::vector<Power> take_related(std::vector<Root>& roots, std::uint64_t m, const Dyadic& turn) {
  const Root first = roots.back();
  std::vector<Power> related;
  std::erase_if(roots, [&](const Root& root) {
    const auto power = power_between(root, first, m, turn);
    if (power) related.push_back({root.coefficient, *power});
    return power.has_value();
  });
  return related;
}

}  // namespace

bool is_zero(const Waves& waves, const Dyadic& turn) {
  std::vector<Root> roots = roots_of(waves, turn);
  if (roots.size() > most_roots) throw std::logic_error("a sum of too many roots of unity");
  const auto count = std::ranges::upper_bound(all_primes, roots.size()) - all_primes.begin();
  const std::span primes = std::span(all_primes).first(static_cast<std::size_t>(count));
  const std::uint64_t m = product_of(primes);
  while (!roots.empty())
    if (!vanishes(take_related(roots, m, turn), primes)) return false;
  return true;
}

}  // namespace fathom
