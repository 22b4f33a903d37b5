#pragma once

#include <array>
#include <map>
#include <optional>
#include <random>
#include <string>

#include "fathom/camera/lens.h"
#include "fathom/camera/projection.h"
#include "tests/lens/arb_ball.h"

/// Lenses read anew from the table of the specification, by the names of parameters, and preimages
/// found by Newton's method. Shares with the library the names of models and parameters.
namespace fathom::oracle {

/// A number and its derivatives by x and y.
template <class S>
struct Dual {
  S v, dx{0.0}, dy{0.0};
};

template <class S>
Dual<S> operator+(const Dual<S>& a, const Dual<S>& b) {
  return {a.v + b.v, a.dx + b.dx, a.dy + b.dy};
}
template <class S>
Dual<S> operator*(const Dual<S>& a, const Dual<S>& b) {
  return {a.v * b.v, a.v * b.dx + a.dx * b.v, a.v * b.dy + a.dy * b.v};
}
template <class S>
Dual<S> operator/(const Dual<S>& a, const Dual<S>& b) {
  const S q = a.v / b.v;
  return {q, (a.dx - q * b.dx) / b.v, (a.dy - q * b.dy) / b.v};
}

template <class S>
struct OraclePoint {
  S x, y;
};

/// The parameters of a lens, by name; those that a model lacks are 0.
class NamedParameters {
 public:
  explicit NamedParameters(const Lens& lens);
  [[nodiscard]] double operator[](const std::string& name) const {
    const auto found = values_.find(name);
    return found == values_.end() ? 0 : found->second;
  }
  [[nodiscard]] LensModel model() const { return model_; }

 private:
  LensModel model_;
  std::map<std::string, double> values_;
};

/// Both stages of RAD_TAN_THIN_PRISM_FISHEYE, with derivatives.
template <class S>
OraclePoint<Dual<S>> distorted_twice(const NamedParameters& n, const Dual<S>& x, const Dual<S>& y) {
  const auto c = [](double value) { return Dual<S>{S(value)}; };
  const Dual<S> angle2 = x * x + y * y, two = c(2);
  Dual<S> radial = c(1), power = c(1);
  for (const char* const k : {"k0", "k1", "k2", "k3", "k4", "k5"}) {
    power = power * angle2;
    radial = radial + c(n[k]) * power;
  }
  const Dual<S> u = x * radial, v = y * radial, r2 = u * u + v * v, r4 = r2 * r2;
  return {u + two * c(n["p1"]) * u * v + c(n["p0"]) * (r2 + two * u * u) + c(n["s0"]) * r2 +
              c(n["s1"]) * r4,
          v + two * c(n["p0"]) * u * v + c(n["p1"]) * (r2 + two * v * v) + c(n["s2"]) * r2 +
              c(n["s3"]) * r4};
}

/// The stage, with derivatives; without the tilt.
template <class S>
OraclePoint<Dual<S>> distorted(const NamedParameters& n, const S& px, const S& py) {
  const Dual<S> x{px, S(1.0), S(0.0)}, y{py, S(0.0), S(1.0)};
  const auto c = [](double value) { return Dual<S>{S(value)}; };
  if (n.model() == LensModel::rad_tan_thin_prism_fisheye) return distorted_twice(n, x, y);
  const Dual<S> r2 = x * x + y * y, r4 = r2 * r2, r6 = r4 * r2, r8 = r4 * r4, one = c(1);
  const bool has_four_above = n.model() == LensModel::brown ||
                              n.model() == LensModel::opencv_fisheye ||
                              n.model() == LensModel::thin_prism_fisheye;
  const Dual<S> numerator = one + c(n["k"] + n["k1"]) * r2 + c(n["k2"]) * r4 + c(n["k3"]) * r6 +
                            c(has_four_above ? n["k4"] : 0) * r8;
  const Dual<S> denominator =
      one + c(has_four_above ? 0 : n["k4"]) * r2 + c(n["k5"]) * r4 + c(n["k6"]) * r6;
  const Dual<S> L = numerator / denominator, p1 = c(n["p1"]), p2 = c(n["p2"]), two = c(2);
  return {x * L + two * p1 * x * y + p2 * (r2 + two * x * x) + c(n["s1"] + n["sx1"]) * r2 +
              c(n["s2"]) * r4,
          y * L + p1 * (r2 + two * y * y) + two * p2 * x * y + c(n["s3"] + n["sy1"]) * r2 +
              c(n["s4"]) * r4};
}

/// The sign of the determinant of the symmetric part of the Jacobian at a point.
int sign_of_determinant(const NamedParameters& n, const OraclePoint<ArbBall>& m);

/// The tilted point (OPENCV_14); the point itself if there is no tilt.
OraclePoint<ArbBall> tilted(const NamedParameters& n, const OraclePoint<ArbBall>& p);

/// Whether the ray (m, 1) is in front of the tilted sensor.
bool is_shown(const NamedParameters& n, const OraclePoint<ArbBall>& m);

/// The distorted point that a camera shows at the sample (u, v).
OraclePoint<ArbBall> distorted_point(const Projection& camera, double u, double v);

/// The sample at which a camera shows the ray (m, 1).
OraclePoint<ArbBall> sample_of(const Projection& camera, const NamedParameters& n,
                               const OraclePoint<ArbBall>& m);

/// A preimage m with |m|² ≤ disc of a sample: found by Newton's method from many places, enclosed
/// and proved by interval Newton in 640 bits. nullopt if none is found.
std::optional<OraclePoint<ArbBall>> preimage(const Projection& camera, const NamedParameters& n,
                                             const Dyadic& u, const Dyadic& v, double disc);

/// How often the image of a circle just inside |m|² = q runs round a sample: 1 if it has a preimage
/// inside, and 0 if it has none. Counted in steps, in binary64: not for samples near that image.
int windings(const Projection& camera, const NamedParameters& n, double u, double v, double q);

/// A lens of this model with parameters below `size`.
Lens random_lens(std::mt19937_64& random, LensModel model, double size);
/// A camera of 1280 × 720 pixels; with skew and mirrored for some seeds.
Projection random_camera(std::mt19937_64& random);

/// The models of the plane that have a stage.
inline constexpr std::array<LensModel, 6> stage_models{
    LensModel::simple_radial, LensModel::radial,    LensModel::opencv,
    LensModel::full_opencv,   LensModel::opencv_14, LensModel::brown};
/// The fisheyes that have a stage which may change something.
inline constexpr std::array<LensModel, 5> fisheye_models{
    LensModel::simple_radial_fisheye, LensModel::radial_fisheye, LensModel::opencv_fisheye,
    LensModel::thin_prism_fisheye, LensModel::rad_tan_thin_prism_fisheye};

}  // namespace fathom::oracle
