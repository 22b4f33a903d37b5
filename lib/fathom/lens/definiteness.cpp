#include "fathom/lens/definiteness.h"

#include <algorithm>
#include <cmath>
#include <deque>
#include <utility>
#include <vector>

#include "fathom/numeric/big_interval.h"

namespace fathom::lens {
namespace {

ExactPolynomial twice(const ExactPolynomial& p) {
  return p + p;
}

PlaneFunction determinant_of(const StageNumbers<ExactPolynomial>& n, const ExactPolynomial& N,
                             const ExactPolynomial& D, const ExactPolynomial& slope) {
  const ExactPolynomial q = ExactPolynomial::variable();
  const std::array<ExactPolynomial, 2> p{n.p2, n.p1};
  const std::array<ExactPolynomial, 2> g{twice(n.p2) + n.s1 + twice(q * n.s2),
                                         twice(n.p1) + n.s3 + twice(q * n.s4)};
  const ExactPolynomial square = D * D, cube = square * D;
  // D·A = N + u·m, D²·(A + 2qL' + 2g·m) = slope + v·m
  std::array<ExactPolynomial, 2> u, v;
  for (std::size_t i = 0; i < 2; ++i) {
    u[i] = twice(D * p[i]);
    v[i] = twice(square * (p[i] + g[i]));
  }
  return {N * slope,
          {N * v[0] + slope * u[0], N * v[1] + slope * u[1]},
          u[0] * v[0] - cube * g[1] * g[1],
          u[0] * v[1] + u[1] * v[0] + twice(cube * g[0] * g[1]),
          u[1] * v[1] - cube * g[0] * g[0]};
}

/// r·∂/∂r of a function of degree `degree` in m beside its coefficients.
ExactPolynomial growth_of(const ExactPolynomial& coefficient, int degree) {
  return twice(ExactPolynomial::variable() * coefficient.derivative()) +
         ExactPolynomial(degree) * coefficient;
}

PlaneFunction growth_of(const PlaneFunction& f) {
  return {growth_of(f.constant, 0),
          {growth_of(f.linear[0], 1), growth_of(f.linear[1], 1)},
          growth_of(f.xx, 2),
          growth_of(f.xy, 2),
          growth_of(f.yy, 2)};
}

/// |coefficient|·r^power bounds a term of a plane function on the circle of radius r.
struct Term {
  Dyadic coefficient;
  long power;
};

void add_terms(std::vector<Term>& terms, const ExactPolynomial& p, long degree) {
  for (std::size_t i = 0; i < p.coefficients().size(); ++i)
    terms.push_back({p.coefficients()[i], 2 * static_cast<long>(i) + degree});
}

std::vector<Term> terms_in_m(const PlaneFunction& f) {
  std::vector<Term> terms;
  for (const ExactPolynomial& linear : f.linear) add_terms(terms, linear, 1);
  for (const ExactPolynomial* quadratic : {&f.xx, &f.xy, &f.yy}) add_terms(terms, *quadratic, 2);
  return terms;
}

/// Whether the term of `constant` with this index exceeds all others on the circle of radius 2^j.
bool dominates(const PlaneFunction& f, std::size_t index, long j) {
  std::vector<Term> terms = terms_in_m(f);
  add_terms(terms, f.constant, 0);
  Dyadic others;
  for (const Term& term : terms) others += abs(term.coefficient.scaled(term.power * j));
  const Dyadic own = f.constant.coefficients()[index].scaled(2 * static_cast<long>(index) * j);
  return others - abs(own) < own;
}

/// Radii 2^j of which the squares are binary64 numbers.
constexpr long least_j = -537, greatest_j = 511;

double square_of_power(long j) {
  return std::ldexp(1.0, static_cast<int>(2 * j));
}

}  // namespace

Definiteness::Definiteness(const StageNumbers<ExactPolynomial>& stage) {
  const ExactPolynomial q = ExactPolynomial::variable();
  const ExactPolynomial N = horner(stage.numerator, q), D = horner(stage.denominator, q);
  numerator_ = N;
  denominator_ = D;
  radial_slope_ = N * D + twice(q * (N.derivative() * D - N * D.derivative()));
  determinant_ = determinant_of(stage, N, D, radial_slope_);
  growth_ = growth_of(determinant_);
}

std::optional<double> Definiteness::inner_bound() const {
  if (!dominates(determinant_, 0, least_j)) return std::nullopt;
  long holds = least_j, fails = greatest_j + 1;
  while (fails - holds > 1) {
    const long j = holds + (fails - holds) / 2;
    (dominates(determinant_, 0, j) ? holds : fails) = j;
  }
  return square_of_power(holds);
}

std::optional<double> Definiteness::outer_bound() const {
  const std::size_t last = determinant_.constant.coefficients().size() - 1;
  if (!dominates(determinant_, last, greatest_j)) return std::nullopt;
  for (const Term& term : terms_in_m(determinant_))
    if (!term.coefficient.is_zero() && term.power > 2 * static_cast<long>(last))
      return std::nullopt;
  long fails = least_j - 1, holds = greatest_j;
  while (holds - fails > 1) {
    const long j = fails + (holds - fails) / 2;
    (dominates(determinant_, last, j) ? holds : fails) = j;
  }
  return square_of_power(holds);
}

// With a unit vector e the determinant at r·e, times D³, is even(e) + r·odd(e), and at −r·e it is
// even(e) − r·odd(e). Both are positive for all e if even(e)² − q·odd(e)² is, and even(e) for one
// e. In e = (1, τ)/√(1 + τ²) that is, times (1 + τ²)², a polynomial of degree 4 in τ; the
// direction (0, 1) is its leading coefficient. Then A has one sign on the circle, since A = 0 would
// make the determinant negative or 0, and it is the sign of its mean, L.
bool Definiteness::holds_on_circle(const Dyadic& q) const {
  if (numerator_.at(q).sign() != Sign::positive) return false;
  const PlaneFunction& f = determinant_;
  const Dyadic constant = f.constant.at(q);
  const ExactPolynomial even(
      {constant + q * f.xx.at(q), q * f.xy.at(q), constant + q * f.yy.at(q)});
  const ExactPolynomial odd({f.linear[0].at(q), f.linear[1].at(q)});
  const ExactPolynomial norm({Dyadic(1.0), Dyadic(), Dyadic(1.0)});
  const ExactPolynomial product = even * even - ExactPolynomial(q) * odd * odd * norm;
  if (even.at(Dyadic()).sign() != Sign::positive) return false;
  if (product.degree() != 4 || product.sign_at_infinity() != Sign::positive) return false;
  return SturmChain(product).real_roots() == 0;
}

namespace {

/// Enough for boxes that are halved some forty times.
constexpr long ring_bits = 96;

BigInterval number(const Dyadic& x) {
  return {x, ring_bits};
}

/// A square [x, x + size] × [y, y + size].
struct Square {
  Dyadic x, y, size;
};

/// The values of a plane function on a square.
class EnclosedFunction {
 public:
  explicit EnclosedFunction(const PlaneFunction& f)
      : constant_(f.constant), x_(f.linear[0]), y_(f.linear[1]), xx_(f.xx), xy_(f.xy), yy_(f.yy) {}

  [[nodiscard]] BigInterval at(const Dyadic& x, const Dyadic& y) const {
    return sum(&Coefficient::value, number(x), number(y), number(x * x + y * y));
  }

  /// The sign of all values where the square meets the ring inner ≤ |m|² ≤ outer; Sign::zero if
  /// they differ or if that is not seen.
  [[nodiscard]] Sign sign_on(const Square& s, const DyadicInterval& ring) const {
    const BigInterval x(s.x, s.x + s.size, ring_bits), y(s.y, s.y + s.size, ring_bits);
    const BigInterval q = square(x) + square(y);
    const auto [low, high] = q.ends();
    const BigInterval within(std::max(low, ring.low), std::min(high, ring.high), ring_bits);
    const Sign sign = sum(&Coefficient::value, x, y, within).sign();
    return sign != Sign::zero ? sign : from_the_middle(s, x, y, q).sign();
  }

 private:
  /// A polynomial and its derivative.
  struct Coefficient {
    Coefficient(const ExactPolynomial& p) : value(in(p)), slope(in(p.derivative())) {}
    static std::vector<BigInterval> in(const ExactPolynomial& p) {
      std::vector<BigInterval> coefficients;
      for (const Dyadic& c : p.coefficients()) coefficients.push_back(number(c));
      if (coefficients.empty()) coefficients.push_back(number(Dyadic()));
      return coefficients;
    }
    std::vector<BigInterval> value, slope;
  };

  /// The function with these parts of its coefficients: its value, or its slope along q alone.
  [[nodiscard]] BigInterval sum(std::vector<BigInterval> Coefficient::*part, const BigInterval& x,
                                const BigInterval& y, const BigInterval& q) const {
    const auto of = [&](const Coefficient& c) { return horner(c.*part, q); };
    return of(constant_) + x * of(x_) + y * of(y_) + square(x) * of(xx_) + x * y * of(xy_) +
           square(y) * of(yy_);
  }

  /// The mean value theorem: the value in the middle, and the slopes times the distances.
  [[nodiscard]] BigInterval from_the_middle(const Square& s, const BigInterval& x,
                                            const BigInterval& y, const BigInterval& q) const {
    const auto of = [&q](const Coefficient& c) { return horner(c.value, q); };
    const BigInterval by_q = sum(&Coefficient::slope, x, y, q);
    const BigInterval two_x = x + x, two_y = y + y, xy = of(xy_);
    const BigInterval by_x = two_x * by_q + of(x_) + two_x * of(xx_) + y * xy;
    const BigInterval by_y = two_y * by_q + of(y_) + two_y * of(yy_) + x * xy;
    const Dyadic half = s.size.scaled(-1);
    const BigInterval distance(-half, half, ring_bits);
    return at(s.x + half, s.y + half) + distance * (by_x + by_y);
  }

  Coefficient constant_, x_, y_, xx_, xy_, yy_;
};

using Verdict = Definiteness::Verdict;
using RingVerdict = Definiteness::RingVerdict;

/// A ring and the proof that a function is positive on it. Of a square that meets the ring it is
/// enough that the function is positive there, or that it falls there along every ray from 0: then
/// it is at least as great as where the ray leaves the square, which is in another such square, or
/// on the outer circle. The largest squares come first: a counterexample lies in the middle of one
/// of them, unless the function is negative in very small places alone.
class RingProof {
 public:
  RingProof(const PlaneFunction& f, const PlaneFunction& growth, double inner, double outer)
      : f_(f), growth_(growth), ring_{inner, outer} {
    const auto j = static_cast<long>(std::ilogb(outer)) / 2 + 1;
    const Dyadic radius = Dyadic(1.0).scaled(j);
    waiting_.push_back({-radius, -radius, radius.scaled(1)});
  }

  RingVerdict run() {
    for (int count = 0; !waiting_.empty(); ++count) {
      if (count == most_squares) return {Verdict::unknown, {}};
      const Square square = std::move(waiting_.front());
      waiting_.pop_front();
      if (is_settled(square)) continue;
      if (std::optional<Dyadic> q = counterexample(square)) return {Verdict::fails, *q};
      divide(square);
    }
    return {Verdict::holds, {}};
  }

 private:
  static constexpr int most_squares = 1 << 15;

  [[nodiscard]] bool is_settled(const Square& s) const {
    const auto squared = [&s](const Dyadic& x) { return square(DyadicInterval{x, x + s.size}); };
    const DyadicInterval q = squared(s.x) + squared(s.y);
    return q.high < ring_.low || q.low > ring_.high || f_.sign_on(s, ring_) == Sign::positive ||
           growth_.sign_on(s, ring_) == Sign::negative;
  }

  /// |m|² of the middle of a square, if it lies in the ring and the function is negative there.
  [[nodiscard]] std::optional<Dyadic> counterexample(const Square& s) const {
    const Dyadic half = s.size.scaled(-1), x = s.x + half, y = s.y + half, q = x * x + y * y;
    if (q < ring_.low || q > ring_.high) return std::nullopt;
    return f_.at(x, y).sign() == Sign::negative ? std::optional(q) : std::nullopt;
  }

  void divide(const Square& s) {
    const Dyadic half = s.size.scaled(-1);
    for (const bool right : {false, true})
      for (const bool lower : {false, true})
        waiting_.push_back({right ? s.x + half : s.x, lower ? s.y + half : s.y, half});
  }

  EnclosedFunction f_, growth_;
  DyadicInterval ring_;
  std::deque<Square> waiting_;
};

}  // namespace

RingVerdict Definiteness::holds_on_ring(double inner, double outer) const {
  return RingProof(determinant_, growth_, inner, outer).run();
}

}  // namespace fathom::lens
