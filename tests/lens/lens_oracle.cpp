#include "tests/lens/lens_oracle.h"

#include <cmath>
#include <complex>
#include <numbers>
#include <utility>

namespace fathom::oracle {
namespace {

using Point = OraclePoint<ArbBall>;

/// A multiple of 2^−128, the one nearest to the middle of a ball.
ArbBall on_grid(const ArbBall& x) {
  ArbBall scaled, result;
  arb_mul_2exp_si(scaled, x, 128);
  arb_add(scaled, scaled, ArbBall(0.5), ArbBall::bits);
  arb_floor(result, scaled.middle(), ArbBall::bits);
  arb_mul_2exp_si(result, result, -128);
  return result;
}

/// M of the tilt, written out.
std::array<std::array<ArbBall, 3>, 3> tilt(const NamedParameters& n) {
  ArbBall sx, cx, sy, cy;
  arb_sin_cos(sx, cx, ArbBall(n["tauX"]), ArbBall::bits);
  arb_sin_cos(sy, cy, ArbBall(n["tauY"]), ArbBall::bits);
  for (ArbBall* x : {&sx, &cx, &sy, &cy}) *x = on_grid(*x);
  const ArbBall zero(0.0), minus(-1.0);
  // R = R_y·R_x
  const ArbBall r11 = cy, r12 = sy * sx, r13 = minus * sy * cx;
  const ArbBall r21 = zero, r22 = cx, r23 = sx;
  const ArbBall r31 = sy, r32 = minus * cy * sx, r33 = cy * cx;
  return {{{r33 * r11 - r13 * r31, r33 * r12 - r13 * r32, r33 * r13 - r13 * r33},
           {r33 * r21 - r23 * r31, r33 * r22 - r23 * r32, r33 * r23 - r23 * r33},
           {r31, r32, r33}}};
}

bool is_tilted(const NamedParameters& n) {
  return n["tauX"] != 0 || n["tauY"] != 0;
}

/// The point before the tilt, solved for by Cramer's rule; nullopt for one behind the sensor.
std::optional<Point> untilted(const NamedParameters& n, const Point& p) {
  if (!is_tilted(n)) return p;
  const auto M = tilt(n);
  const std::array<ArbBall, 3> y{p.x, p.y, ArbBall(1.0)};
  const auto minor = [&M](int r1, int r2, int c1, int c2) {
    return M[r1][c1] * M[r2][c2] - M[r1][c2] * M[r2][c1];
  };
  std::array<ArbBall, 3> x;
  for (int column = 0; column < 3; ++column) {
    const int c1 = (column + 1) % 3, c2 = (column + 2) % 3;
    x[column] =
        y[0] * minor(1, 2, c1, c2) + y[1] * minor(2, 0, c1, c2) + y[2] * minor(0, 1, c1, c2);
  }
  if (x[2].sign() <= 0) return std::nullopt;
  return Point{x[0] / x[2], x[1] / x[2]};
}

Point distorted_point(const Projection& camera, const Dyadic& u, const Dyadic& v) {
  const ArbBall shift = ArbBall(0.5) - ArbBall(camera.pixel_centre);
  const ArbBall U = ArbBall(u) - ArbBall(camera.cx) - shift;
  const ArbBall V = ArbBall(v) - ArbBall(camera.cy) - shift;
  const ArbBall y = V / ArbBall(camera.fy);
  return {(U - ArbBall(camera.skew) * y) / ArbBall(camera.fx), y};
}

/// m − J⁻¹·(G(middle) − y), with J at m.
template <class S>
OraclePoint<S> newton_step(const NamedParameters& n, const OraclePoint<S>& middle,
                           const OraclePoint<S>& around, const OraclePoint<S>& y) {
  const auto at = distorted(n, middle.x, middle.y), J = distorted(n, around.x, around.y);
  const S ex = at.x.v - y.x, ey = at.y.v - y.y;
  const S determinant = J.x.dx * J.y.dy - J.x.dy * J.y.dx;
  return {middle.x - (J.y.dy * ex - J.x.dy * ey) / determinant,
          middle.y - (J.x.dx * ey - J.y.dx * ex) / determinant};
}

/// The zero that lies within 2^−400 of a point, if that is proved.
std::optional<Point> proved(const NamedParameters& n, Point m, const Point& y) {
  for (int step = 0; step < 14; ++step) {
    const Point middle{m.x.middle(), m.y.middle()};
    m = newton_step(n, middle, middle, y);
  }
  const Point middle{m.x.middle(), m.y.middle()};
  const Point box{m.x.widened(-400), m.y.widened(-400)};
  const Point image = newton_step(n, middle, box, y);
  if (!image.x.lies_within(box.x) || !image.y.lies_within(box.y)) return std::nullopt;
  return image;
}

}  // namespace

NamedParameters::NamedParameters(const Lens& lens) : model_(lens.model) {
  const auto names = entry_of(lens.model).distortion;
  for (std::size_t i = 0; i < names.size(); ++i)
    values_[std::string(names[i])] = lens.distortion[i];
}

int sign_of_determinant(const NamedParameters& n, const Point& m) {
  const auto J = distorted(n, m.x, m.y);
  const ArbBall side = (J.x.dy + J.y.dx) * ArbBall(0.5);
  return (J.x.dx * J.y.dy - side * side).sign();
}

Point tilted(const NamedParameters& n, const Point& p) {
  if (!is_tilted(n)) return p;
  const auto M = tilt(n);
  const auto row = [&](int i) { return M[i][0] * p.x + M[i][1] * p.y + M[i][2]; };
  return {row(0) / row(2), row(1) / row(2)};
}

bool is_shown(const NamedParameters& n, const Point& m) {
  if (!is_tilted(n)) return true;
  const auto d = distorted(n, m.x, m.y);
  const auto M = tilt(n);
  return (M[2][0] * d.x.v + M[2][1] * d.y.v + M[2][2]).sign() > 0;
}

Point distorted_point(const Projection& camera, double u, double v) {
  const ArbBall shift = ArbBall(0.5) - ArbBall(camera.pixel_centre);
  const ArbBall y = (ArbBall(v) - ArbBall(camera.cy) - shift) / ArbBall(camera.fy);
  const ArbBall U = ArbBall(u) - ArbBall(camera.cx) - shift;
  return {(U - ArbBall(camera.skew) * y) / ArbBall(camera.fx), y};
}

Point sample_of(const Projection& camera, const NamedParameters& n, const Point& m) {
  const auto d = distorted(n, m.x, m.y);
  const Point p = tilted(n, {d.x.v, d.y.v});
  const ArbBall shift = ArbBall(0.5) - ArbBall(camera.pixel_centre);
  return {ArbBall(camera.fx) * p.x + ArbBall(camera.skew) * p.y + ArbBall(camera.cx) + shift,
          ArbBall(camera.fy) * p.y + ArbBall(camera.cy) + shift};
}

std::optional<Point> preimage(const Projection& camera, const NamedParameters& n, const Dyadic& u,
                              const Dyadic& v, double disc) {
  const std::optional<Point> y = untilted(n, distorted_point(camera, u, v));
  if (!y) return std::nullopt;
  const OraclePoint<double> target{y->x.approximate(), y->y.approximate()};
  const double reach = std::sqrt(std::min(disc, 1e6));
  for (int start = 0; start < 64; ++start) {
    const double radius = start == 0 ? 0 : std::min(reach, 3.0) * std::sqrt(start / 64.0);
    const double angle = 2.399963 * start;
    OraclePoint<double> m{radius * std::cos(angle), radius * std::sin(angle)};
    for (int step = 0; step < 40; ++step) m = newton_step(n, m, m, target);
    if (!std::isfinite(m.x) || !std::isfinite(m.y)) continue;
    if (m.x * m.x + m.y * m.y > disc * (1 + 1e-6)) continue;
    const std::optional<Point> found = proved(n, {ArbBall(m.x), ArbBall(m.y)}, *y);
    if (!found) continue;
    const ArbBall q = found->x * found->x + found->y * found->y;
    if (std::isinf(disc) || (ArbBall(disc) - q).sign() >= 0) return found;
  }
  return std::nullopt;
}

int windings(const Projection& camera, const NamedParameters& n, double u, double v, double q) {
  const std::optional<Point> y = untilted(n, distorted_point(camera, u, v));
  if (!y) return 0;
  const std::complex<double> target(y->x.approximate(), y->y.approximate());
  constexpr int steps = 4000;
  const auto at = [&](int i) {
    const double angle = 2 * std::numbers::pi * i / steps, r = std::sqrt(q * (1 - 0x1p-20));
    const auto d = distorted(n, r * std::cos(angle), r * std::sin(angle));
    return std::complex<double>(d.x.v, d.y.v) - target;
  };
  double turned = 0;
  for (int i = 0; i < steps; ++i) turned += std::arg(at(i + 1) / at(i));
  return static_cast<int>(std::lround(turned / (2 * std::numbers::pi)));
}

Lens random_lens(std::mt19937_64& random, LensModel model, double size) {
  std::uniform_real_distribution<double> uniform(-size, size);
  Lens lens;
  lens.model = model;
  const auto names = entry_of(model).distortion;
  for (std::size_t i = 0; i < names.size(); ++i) {
    const bool is_small = names[i][0] == 'p' || names[i][0] == 's';
    lens.distortion[i] = uniform(random) * (is_small ? 0.1 : 1);
  }
  return lens;
}

Projection random_camera(std::mt19937_64& random) {
  std::uniform_real_distribution<double> uniform(-1, 1);
  Projection camera;
  camera.fx = 700 + 200 * uniform(random);
  camera.fy = 700 + 200 * uniform(random);
  camera.cx = 640 + 50 * uniform(random);
  camera.cy = 360 + 50 * uniform(random);
  if (random() % 2 == 0) camera.skew = 3 * uniform(random);
  if (random() % 3 == 0) camera.fx = -camera.fx;
  if (random() % 3 == 0) camera.pixel_centre = 0;
  return camera;
}

}  // namespace fathom::oracle
