#include "fathom/lens/definiteness.h"

#include <cmath>
#include <limits>
#include <utility>

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
  const ExactPolynomial D2 = D * D, D3 = D2 * D;
  // D·A = N + u·m, D²·(A + 2qL' + 2g·m) = slope + v·m
  std::array<ExactPolynomial, 2> u, v;
  for (std::size_t i = 0; i < 2; ++i) {
    u[i] = twice(D * p[i]);
    v[i] = twice(D2 * (p[i] + g[i]));
  }
  return {N * slope,
          {N * v[0] + slope * u[0], N * v[1] + slope * u[1]},
          u[0] * v[0] - D3 * g[1] * g[1],
          u[0] * v[1] + u[1] * v[0] + twice(D3 * g[0] * g[1]),
          u[1] * v[1] - D3 * g[0] * g[0]};
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
// direction (0, 1) is its leading coefficient.
bool Definiteness::holds_on_circle(const Dyadic& q) const {
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

/// A plane function in intervals.
class EnclosedFunction {
 public:
  explicit EnclosedFunction(const PlaneFunction& f)
      : constant_(enclosed(f.constant)),
        x_(enclosed(f.linear[0])),
        y_(enclosed(f.linear[1])),
        xx_(enclosed(f.xx)),
        xy_(enclosed(f.xy)),
        yy_(enclosed(f.yy)) {}

  [[nodiscard]] BigInterval at(const BigInterval& x, const BigInterval& y,
                               const BigInterval& q) const {
    return horner(constant_, q) + x * horner(x_, q) + y * horner(y_, q) +
           square(x) * horner(xx_, q) + x * y * horner(xy_, q) + square(y) * horner(yy_, q);
  }

 private:
  using Coefficients = std::vector<BigInterval>;

  static Coefficients enclosed(const ExactPolynomial& p) {
    Coefficients coefficients;
    for (const Dyadic& c : p.coefficients()) coefficients.push_back(number(c));
    if (coefficients.empty()) coefficients.push_back(number(Dyadic()));
    return coefficients;
  }

  Coefficients constant_, x_, y_, xx_, xy_, yy_;
};

/// A square [x, x + size] × [y, y + size].
struct Square {
  Dyadic x, y, size;
};

using Verdict = Definiteness::Verdict;
using RingVerdict = Definiteness::RingVerdict;

/// A ring and the proof that a function is positive on it. Of a square that meets the ring it is
/// enough that the function is positive there, or that it falls there along every ray from 0: then
/// it is at least as great as where the ray leaves the square, which is in another such square, or
/// on the outer circle.
class RingProof {
 public:
  RingProof(const PlaneFunction& f, const PlaneFunction& growth, double inner, double outer)
      : f_(f), growth_(growth), inner_(inner), outer_(outer) {
    const auto j = static_cast<long>(std::ilogb(outer)) / 2 + 1;
    const Dyadic radius = Dyadic(1.0).scaled(j);
    waiting_.push_back({-radius, -radius, radius.scaled(1)});
  }

  RingVerdict run() {
    for (int count = 0; !waiting_.empty(); ++count) {
      if (count == most_squares) return {Verdict::unknown, {}};
      const Square square = std::move(waiting_.back());
      waiting_.pop_back();
      if (is_settled(square)) continue;
      if (std::optional<Dyadic> q = counterexample(square)) return {Verdict::fails, *q};
      divide(square);
    }
    return {Verdict::holds, {}};
  }

 private:
  static constexpr int most_squares = 1 << 15;

  [[nodiscard]] bool is_settled(const Square& s) const {
    const BigInterval x(s.x, s.x + s.size, ring_bits), y(s.y, s.y + s.size, ring_bits);
    auto [low, high] = (square(x) + square(y)).ends();
    if (high < inner_ || low > outer_) return true;
    const BigInterval q(std::max(low, inner_), std::min(high, outer_), ring_bits);
    return f_.at(x, y, q).sign() == Sign::positive || growth_.at(x, y, q).sign() == Sign::negative;
  }

  /// |m|² of the middle of a square, if it lies in the ring and the function is negative there.
  [[nodiscard]] std::optional<Dyadic> counterexample(const Square& s) const {
    const Dyadic half = s.size.scaled(-1), x = s.x + half, y = s.y + half, q = x * x + y * y;
    if (q < inner_ || q > outer_) return std::nullopt;
    const Sign sign = f_.at(number(x), number(y), number(q)).sign();
    return sign == Sign::negative ? std::optional(q) : std::nullopt;
  }

  void divide(const Square& s) {
    const Dyadic half = s.size.scaled(-1);
    for (const bool right : {false, true})
      for (const bool lower : {false, true})
        waiting_.push_back({right ? s.x + half : s.x, lower ? s.y + half : s.y, half});
  }

  EnclosedFunction f_, growth_;
  Dyadic inner_, outer_;
  std::vector<Square> waiting_;
};

}  // namespace

RingVerdict Definiteness::holds_on_ring(double inner, double outer) const {
  return RingProof(determinant_, growth_, inner, outer).run();
}

}  // namespace fathom::lens
