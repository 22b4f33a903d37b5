#include "tests/oracle/lens_rays.h"

#include <cmath>

namespace fathom::oracle {
namespace {

using F = mpf_class;
constexpr int bits = lens_bits + 500;

F number(double x) {
  return {x, bits};
}

struct Point {
  F x, y;
};

/// The lens and its derivatives, in any arithmetic, term by term as written.
template <class T>
struct Image {
  T x, y, x_by_x, x_by_y, y_by_x, y_by_y;
};

template <class T, class Make>
Image<T> image_of_last(const LensNumbers& lens, const T& x, const T& y, const Make& make) {
  const T q = x * x + y * y;
  T above = make(1), above_by_q = make(0), below = make(1), below_by_q = make(0), power = make(1);
  for (std::size_t i = 0; i < lens.above.size(); ++i) {
    const T by_q = power * make(static_cast<double>(i) + 1);
    power = power * q;
    above = above + make(lens.above[i]) * power;
    above_by_q = above_by_q + make(lens.above[i]) * by_q;
    if (i >= lens.below.size()) continue;
    below = below + make(lens.below[i]) * power;
    below_by_q = below_by_q + make(lens.below[i]) * by_q;
  }
  const T factor = above / below;
  const T factor_by_q = (above_by_q * below - above * below_by_q) / (below * below);
  const T two = make(2), six = make(6);
  const T p1 = make(lens.p1), p2 = make(lens.p2), s1 = make(lens.s1), s2 = make(lens.s2),
          s3 = make(lens.s3), s4 = make(lens.s4);
  // d/dq of s1·q + s2·q² and s3·q + s4·q²
  const T u = s1 + two * s2 * q, v = s3 + two * s4 * q;
  Image<T> image{x * factor + two * p1 * x * y + p2 * (q + two * x * x) + s1 * q + s2 * q * q,
                 y * factor + p1 * (q + two * y * y) + two * p2 * x * y + s3 * q + s4 * q * q,
                 factor + two * x * x * factor_by_q + two * p1 * y + six * p2 * x + two * x * u,
                 two * x * y * factor_by_q + two * p1 * x + two * p2 * y + two * y * u,
                 two * x * y * factor_by_q + two * p1 * x + two * p2 * y + two * x * v,
                 factor + two * y * y * factor_by_q + six * p1 * y + two * p2 * x + two * y * v};
  return image;
}

/// The same of both stages, by the rule of the chain.
template <class T, class Make>
Image<T> image_of(const LensNumbers& lens, const T& x, const T& y, const Make& make) {
  const T q = x * x + y * y;
  T factor = make(1), factor_by_q = make(0), power = make(1);
  for (std::size_t i = 0; i < lens.first.size(); ++i) {
    factor_by_q = factor_by_q + make(lens.first[i] * (static_cast<double>(i) + 1)) * power;
    power = power * q;
    factor = factor + make(lens.first[i]) * power;
  }
  const T bend = make(2) * factor_by_q;
  const T u_by_x = factor + x * x * bend, u_by_y = x * y * bend, v_by_y = factor + y * y * bend;
  const T u = x * factor, v = y * factor;
  const Image<T> last = image_of_last(lens, u, v, make);
  Image<T> image{last.x,
                 last.y,
                 last.x_by_x * u_by_x + last.x_by_y * u_by_y,
                 last.x_by_x * u_by_y + last.x_by_y * v_by_y,
                 last.y_by_x * u_by_x + last.y_by_y * u_by_y,
                 last.y_by_x * u_by_y + last.y_by_y * v_by_y};
  return image;
}

/// A step of Newton's method towards the point whose image is (target_x, target_y).
template <class T, class Make>
void step(const LensNumbers& lens, T& x, T& y, const T& target_x, const T& target_y,
          const Make& make) {
  const Image<T> i = image_of(lens, x, y, make);
  const T dx = i.x - target_x, dy = i.y - target_y;
  const T det = i.x_by_x * i.y_by_y - i.x_by_y * i.y_by_x;
  if (det == 0) return;  // on a fold
  x = x - (i.y_by_y * dx - i.x_by_y * dy) / det;
  y = y - (i.x_by_x * dy - i.y_by_x * dx) / det;
}

/// The point within the disc from one start, in binary64.
std::optional<std::array<double, 2>> search(const LensNumbers& lens, double x, double y,
                                            double target_x, double target_y, double greatest_q) {
  const auto make = [](double v) { return v; };
  for (int i = 0; i < 60; ++i) step(lens, x, y, target_x, target_y, make);
  if (!std::isfinite(x) || !std::isfinite(y)) return std::nullopt;
  const Image<double> found = image_of(lens, x, y, make);
  const double miss = std::hypot(found.x - target_x, found.y - target_y);
  const bool is_within = x * x + y * y <= greatest_q * (1 + 1e-12) + 1e-300;
  if (!(miss <= 1e-9 * (1 + std::hypot(target_x, target_y))) || !is_within) return std::nullopt;
  return std::array{x, y};
}

std::optional<std::array<double, 2>> search(const LensNumbers& lens, double target_x,
                                            double target_y, double greatest_q) {
  const double end = std::min(std::sqrt(greatest_q), 4 + 2 * std::hypot(target_x, target_y));
  constexpr int steps = 12;
  for (int j = -steps; j <= steps; ++j) {
    for (int i = -steps; i <= steps; ++i) {
      // The nearest starts first, about the target.
      const double x = std::clamp(target_x, -end, end) + end * i / steps;
      const double y = std::clamp(target_y, -end, end) + end * j / steps;
      if (const auto found = search(lens, x, y, target_x, target_y, greatest_q)) return found;
    }
  }
  return std::nullopt;
}

Q rational(const F& x) {
  Q q;
  mpq_set_f(q.get_mpq_t(), x.get_mpf_t());
  return q;
}

/// The multiple of 2^−300 nearest to x.
Q of_few_bits(const Q& x) {
  Q shifted = x;
  mpq_mul_2exp(shifted.get_mpq_t(), shifted.get_mpq_t(), 300);
  mpz_class floor;
  mpz_fdiv_q(floor.get_mpz_t(), Q(shifted + Q(1, 2)).get_num_mpz_t(),
             Q(shifted + Q(1, 2)).get_den_mpz_t());
  Q few(floor);
  mpq_div_2exp(few.get_mpq_t(), few.get_mpq_t(), 300);
  return few;
}

/// The dyadic number of few bits that x is but for its error, or x.
Q settled(const F& x) {
  const Q q = rational(x), few = of_few_bits(q);
  return abs(few - q) < power_of_two_below(zero_bits) ? few : q;
}

/// (m·sin θ/θ, cos θ) with θ = |m| < 4, by the series in θ²; 200 terms leave less than 2^−1500.
Vector on_sphere(const Q& x, const Q& y) {
  const F q(x * x + y * y, bits);
  F sine_term = number(1), cosine_term = number(1), sine = number(0), cosine = number(0);
  for (int k = 0; k < 200; ++k) {
    sine = sine + sine_term;
    cosine = cosine + cosine_term;
    sine_term = -sine_term * q / number((2.0 * k + 2) * (2.0 * k + 3));
    cosine_term = -cosine_term * q / number((2.0 * k + 1) * (2.0 * k + 2));
  }
  return Vector{x * rational(sine), y * rational(sine), rational(cosine)};
}

Q root_of(const Q& x) {
  return rational(sqrt(F(x, bits)));
}

/// The formulas of the specification, as written.
std::optional<Vector> bent_by_root(const LensNumbers& lens, const Q& x, const Q& y) {
  using Root = LensNumbers::Root;
  const Q q = x * x + y * y, alpha = lens.alpha, beta = lens.beta, xi = lens.xi;
  if (lens.root == Root::orthographic) {
    if (q >= 1) return std::nullopt;
    return Vector{x, y, root_of(1 - q)};
  }
  if (lens.root == Root::equisolid) {
    if (q >= 4) return std::nullopt;
    const Q c = root_of(1 - q / 4);
    return Vector{c * x, c * y, 1 - q / 2};
  }
  if (lens.root == Root::unified || lens.root == Root::double_sphere) {
    const Q under = (2 * alpha - 1) * beta * q;
    if (under >= 1) return std::nullopt;
    const Q z = (1 - alpha * alpha * beta * q) / (alpha * root_of(1 - under) + 1 - alpha);
    if (lens.root == Root::unified) return Vector{x, y, z};
    const Q kappa = (z * xi + root_of(z * z + (1 - xi * xi) * q)) / (z * z + q);
    return Vector{kappa * x, kappa * y, kappa * z - xi};
  }
  const Q under = (xi * xi - 1) * q;
  if (under >= 1) return std::nullopt;
  const Q eta = (xi + root_of(1 - under)) / (1 + q);
  return Vector{eta * x, eta * y, eta - xi};
}

/// atan(1/n) by its series.
F arc_of_inverse(int n) {
  F power = number(1) / number(n), sum = number(0);
  for (int k = 0; k < 4000; ++k) {
    const F term = power / number(2.0 * k + 1);
    sum = k % 2 == 0 ? F(sum + term) : F(sum - term);
    power = power / number(static_cast<double>(n) * n);
  }
  return sum;
}

/// Machin's 16·atan(1/5) − 4·atan(1/239).
const F& pi() {
  static const F value = 16 * arc_of_inverse(5) - 4 * arc_of_inverse(239);
  return value;
}

struct SineAndCosine {
  Q sine, cosine;
};

/// Of an angle below 4; 400 terms of the series leave less than 2^−4000.
SineAndCosine of_angle(const F& angle) {
  const F q = angle * angle;
  F sine_term = angle, cosine_term = number(1), sine = number(0), cosine = number(0);
  for (int k = 0; k < 400; ++k) {
    sine = sine + sine_term;
    cosine = cosine + cosine_term;
    sine_term = -sine_term * q / number((2.0 * k + 2) * (2.0 * k + 3));
    cosine_term = -cosine_term * q / number((2.0 * k + 1) * (2.0 * k + 2));
  }
  return {settled(sine), settled(cosine)};
}

SineAndCosine of_turns(const Q& turns) {
  mpz_class whole;
  const Q shifted = turns + Q(1, 2);
  mpz_fdiv_q(whole.get_mpz_t(), shifted.get_num_mpz_t(), shifted.get_den_mpz_t());
  return of_angle(2 * pi() * F(Q(turns - whole), bits));
}

/// FOV, as the specification has it.
std::optional<Vector> in_field_of_view(double signed_omega, const Q& x, const Q& y) {
  const F omega = number(std::abs(signed_omega)), r(sqrt(F(x * x + y * y, bits)));
  if (omega == 0 || r == 0) return Vector{x, y, 1};
  const F angle = omega * r;
  if (angle >= pi() / 2) return std::nullopt;
  const SineAndCosine of_ray = of_angle(angle), of_half = of_angle(omega / 2);
  const Q aside = of_ray.sine / rational(r);
  return Vector{x * aside, y * aside, 2 * of_half.sine / of_half.cosine * of_ray.cosine};
}

/// FTHETA, as the specification has it. That the angle grows is tried at 1000 places.
std::optional<Vector> at_angle(const std::array<double, 6>& p, const Q& x, const Q& y) {
  const F r(sqrt(F(x * x + y * y, bits)));
  F angle = number(0);
  for (std::size_t i = p.size(); i-- > 0;) angle = angle * r + number(p[i]);
  if (r == 0) return p[0] == 0 ? std::optional(Vector{0, 0, 1}) : std::nullopt;
  for (int i = 1; i <= 1000; ++i) {
    const double s = r.get_d() * i / 1000;
    double slope = 0;
    for (std::size_t k = p.size(); k-- > 1;) slope = slope * s + static_cast<double>(k) * p[k];
    if (!(slope > 0)) return std::nullopt;
  }
  if (abs(angle) >= pi()) return std::nullopt;
  const SineAndCosine of_ray = of_angle(angle);
  const Q aside = of_ray.sine / rational(r);
  return Vector{x * aside, y * aside, of_ray.cosine};
}

std::optional<Vector> turned(LensNumbers::Panorama panorama, const Q& x, const Q& y) {
  const SineAndCosine around = of_turns(x);
  if (panorama == LensNumbers::Panorama::cylinder) return Vector{around.sine, y, around.cosine};
  if (abs(y) > Q(1, 2)) return std::nullopt;
  const SineAndCosine down = of_turns(y / 2);
  return Vector{down.cosine * around.sine, down.sine, down.cosine * around.cosine};
}

/// At a fold each step of Newton's method only halves the error: a point of few bits is it if its
/// image is exactly the target.
std::optional<std::array<Q, 2>> at_fold(const LensNumbers& lens, Point m, const Q& x, const Q& y) {
  const F target_x(x, bits), target_y(y, bits);
  for (int i = 0; i < 1000; ++i) step(lens, m.x, m.y, target_x, target_y, number);
  const Q few_x = of_few_bits(rational(m.x)), few_y = of_few_bits(rational(m.y));
  const Image<Q> image = image_of(lens, few_x, few_y, [](double v) { return Q(v); });
  if (image.x != x || image.y != y) return std::nullopt;
  return std::array{few_x, few_y};
}

std::optional<Vector> bent_by_polynomial(const LensNumbers& lens, const Q& x, const Q& y,
                                         double greatest_q) {
  const auto start = search(lens, x.get_d(), y.get_d(), greatest_q);
  if (!start) return std::nullopt;
  const F target_x(x, bits), target_y(y, bits);
  Point m{number((*start)[0]), number((*start)[1])}, before = m;
  for (int i = 0; i < 8; ++i) {
    before = m;
    step(lens, m.x, m.y, target_x, target_y, number);
  }
  std::array<Q, 2> found{settled(m.x), settled(m.y)};
  const Q last_step = abs(rational(m.x - before.x)) + abs(rational(m.y - before.y));
  if (last_step > power_of_two_below(zero_bits)) found = at_fold(lens, m, x, y).value_or(found);
  const Q q = found[0] * found[0] + found[1] * found[1];
  if (std::isfinite(greatest_q) && q > Q(greatest_q)) return std::nullopt;
  return Vector{found[0], found[1], 1};
}

bool is_bent(const LensNumbers& lens) {
  return lens.above != std::array<double, 4>{} || lens.p1 != 0 || lens.p2 != 0;
}

}  // namespace

std::function<std::optional<Vector>(const Q& u, const Q& v)> lens_rays(const RayCamera& camera,
                                                                       const LensNumbers& lens,
                                                                       double greatest_q) {
  return [=](const Q& u, const Q& v) -> std::optional<Vector> {
    const Q shift = camera.pixel_centre - Q(1, 2);
    const Q y = (v + shift - camera.cy) / camera.fy;
    const Q x = (u + shift - camera.cx - camera.skew * y) / camera.fx;
    if (lens.root == LensNumbers::Root::omnidirectional && is_bent(lens)) {
      const auto m = bent_by_polynomial(lens, x, y, greatest_q);
      return m ? bent_by_root(lens, (*m)[0], (*m)[1]) : m;
    }
    if (lens.root != LensNumbers::Root::none) return bent_by_root(lens, x, y);
    if (lens.angle) return at_angle(*lens.angle, x, y);
    if (lens.omega) return in_field_of_view(*lens.omega, x, y);
    if (lens.panorama != LensNumbers::Panorama::none) return turned(lens.panorama, x, y);
    if (!lens.division) {
      const auto ray = bent_by_polynomial(lens, x, y, greatest_q);
      return ray && lens.is_angle ? on_sphere((*ray)[0], (*ray)[1]) : ray;
    }
    const Q bend = Q(*lens.division) * (x * x + y * y);
    if (bend >= 1) return std::nullopt;
    return Vector{x, y, 1 + bend};
  };
}

}  // namespace fathom::oracle
