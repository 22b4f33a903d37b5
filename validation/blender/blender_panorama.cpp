#include "validation/blender/blender_panorama.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>
#include <utility>

#include "fathom/numeric/rounding.h"
#include "fathom/numeric/standard_arithmetic.h"

namespace fathom::validation {
namespace {

using attribution::PixelRays;
using Type = BlenderPanorama::Type;

constexpr double u = unit_roundoff<float>;
constexpr double pi = std::numbers::pi;

/// A number that a program in binary32 computes, and a bound on how far its own is off.
struct Approximate {
  double value = 0, error = 0;

  [[nodiscard]] double size() const { return std::abs(value) + error; }
};

/// A result that is computed with an error, and then errs by some roundings.
Approximate rounded(double value, double error, double roundings = 1) {
  return {value, error + roundings * u * (std::abs(value) + error) + 0x1p-140};
}

/// A constant of the program, rounded once.
Approximate constant(double value) {
  return rounded(value, 0);
}

Approximate operator-(const Approximate& a) {
  return {-a.value, a.error};
}
Approximate operator+(const Approximate& a, const Approximate& b) {
  return rounded(a.value + b.value, a.error + b.error);
}
Approximate operator-(const Approximate& a, const Approximate& b) {
  return a + -b;
}
Approximate operator*(const Approximate& a, const Approximate& b) {
  return rounded(a.value * b.value, a.size() * b.error + b.size() * a.error);
}
/// Needs    a b that is not 0.
Approximate operator/(const Approximate& a, const Approximate& b) {
  const double quotient = a.value / b.value, least = std::abs(b.value) - b.error;
  return rounded(quotient, (a.error + std::abs(quotient) * b.error) / least, 2);
}

/// A function of the mathematical library, monotone between the ends of the argument in
/// [least, greatest], where the program clamps it.
template <class Function>
Approximate monotone(const Function& f, const Approximate& x, double least, double greatest) {
  const auto at = [&](double y) { return f(std::clamp(y, least, greatest)); };
  const double value = at(x.value);
  const double error =
      std::max(std::abs(at(x.value + x.error) - value), std::abs(at(x.value - x.error) - value));
  return rounded(value, error, 8);
}

Approximate root(const Approximate& x) {
  return monotone([](double y) { return std::sqrt(y); }, x, 0,
                  std::numeric_limits<double>::infinity());
}
Approximate arc_cosine(const Approximate& x) {
  return monotone([](double y) { return std::acos(y); }, x, -1, 1);
}
Approximate arc_sine(const Approximate& x) {
  return monotone([](double y) { return std::asin(y); }, x, -1, 1);
}
/// By Taylor's formula.
Approximate sine(const Approximate& x) {
  const double sine = std::sin(x.value), slope = std::abs(std::cos(x.value));
  return rounded(sine, slope * x.error + x.error * x.error / 2, 8);
}
Approximate cosine(const Approximate& x) {
  const double cosine = std::cos(x.value), slope = std::abs(std::sin(x.value));
  return rounded(cosine, slope * x.error + x.error * x.error / 2, 8);
}

/// Frame    the camera's: x right, y down, z forward.
using Direction = std::array<Approximate, 3>;

/// A position in the image, from 0 to 1, v upwards.
struct Position {
  double u = 0, v = 0;
};

/// The direction of a position, or none; `is_certain`: whether roundings cannot change which.
struct Sight {
  std::optional<Direction> direction;
  bool is_certain = true;
};

Sight equirectangular(const Position& p) {
  const Approximate longitude = constant(-2 * pi) * Approximate{p.u} + constant(pi);
  const Approximate colatitude = constant(-pi) * Approximate{p.v} + constant(pi);
  const Approximate across = sine(colatitude);
  return {.direction = Direction{-(across * sine(longitude)), -cosine(colatitude),
                                 across * cosine(longitude)}};
}

/// Whether a number is beyond a limit, as the program decides it.
Sight decided(const Approximate& x, const Approximate& limit, const Direction& direction) {
  const Approximate beyond = x - limit;
  Sight sight{.is_certain = std::abs(beyond.value) > beyond.error};
  if (beyond.value <= 0) sight.direction = direction;
  return sight;
}

Sight mirror_ball(const Position& p) {
  const Approximate one{1}, two{2};
  const Approximate x{2 * p.u - 1}, y{2 * p.v - 1};
  const Approximate square = x * x + y * y, depth = root(one - square), twice = two * depth;
  return decided(square, one, {twice * x, -(twice * y), twice * depth - one});
}

/// The azimuth of a point relative to the middle, from the right, anticlockwise.
Approximate azimuth_of(const Approximate& x, const Approximate& y, const Approximate& r,
                       CyclesAzimuth azimuth) {
  if (azimuth == CyclesAzimuth::exact) return rounded(std::atan2(y.value, x.value), 0, 8);
  const Approximate half_turn = arc_cosine(x / r);
  return y.value < 0 ? -half_turn : half_turn;
}

/// `width` and `height` of the image in the unit of the radius.
Sight fisheye(const BlenderPanorama& panorama, const Position& p, double width, double height,
              CyclesAzimuth azimuth) {
  const Approximate half{0.5}, two{2};
  const Approximate x{(p.u - 0.5) * width}, y{(p.v - 0.5) * height};
  const Approximate r = root(x * x + y * y);
  const bool is_equidistant = panorama.type == Type::fisheye_equidistant;
  const Approximate fov = constant(panorama.fov), lens = constant(panorama.lens);
  const Approximate limit =
      is_equidistant ? Approximate{1} : two * lens * sine(fov * Approximate{0.25});
  const Approximate angle = is_equidistant ? r * fov * half : two * arc_sine(r / (two * lens));
  if (r.value == 0) return {.direction = Direction{Approximate{}, Approximate{}, Approximate{1}}};
  const Approximate across = sine(angle), turn = azimuth_of(x, y, r, azimuth);
  return decided(r, limit, {cosine(turn) * across, -(sine(turn) * across), cosine(angle)});
}

Sight sight_at(const BlenderPanorama& panorama, const Camera& camera, const Position& p,
               CyclesAzimuth azimuth) {
  switch (panorama.type) {
    case Type::equirectangular:
      return equirectangular(p);
    case Type::mirror_ball:
      return mirror_ball(p);
    case Type::fisheye_equidistant:
      return fisheye(panorama, p, 2, 2, azimuth);
    case Type::fisheye_equisolid:
      break;
  }
  return fisheye(panorama, p, blender_sensor_width,
                 blender_sensor_width * camera.height / camera.width, azimuth);
}

/// Cycles normalizes the direction.
PixelRays::PixelRay as_ray(const Direction& d) {
  PixelRays::PixelRay ray;
  for (std::size_t k = 0; k < 3; ++k) {
    ray.direction[k] = d[k].value;
    ray.error[k] = d[k].error + 8 * u * d[k].size();
  }
  return ray;
}

/// The ray of the middle of a square of positions, with bounds for a program that takes any
/// position of it: the greatest roundings and the greatest change among its corners, enlarged for
/// what is not linear in between.
PixelRays::PixelRay ray_of(const BlenderPanorama& panorama, const Camera& camera,
                           const Position& middle, const Position& reach, CyclesAzimuth azimuth) {
  const Sight sight = sight_at(panorama, camera, middle, azimuth);
  PixelRays::PixelRay ray;
  if (sight.direction) ray = as_ray(*sight.direction);
  bool is_certain = sight.is_certain;
  std::array<double, 3> change{};
  for (const auto& [x, y] : {std::pair{-1, -1}, {-1, 1}, {1, -1}, {1, 1}}) {
    const Position corner{middle.u + x * reach.u, middle.v + y * reach.v};
    const Sight there = sight_at(panorama, camera, corner, azimuth);
    is_certain = is_certain && there.is_certain &&
                 there.direction.has_value() == sight.direction.has_value();
    if (!there.direction) continue;
    const PixelRays::PixelRay at_corner = as_ray(*there.direction);
    for (std::size_t k = 0; k < 3; ++k) {
      change[k] = std::max(change[k], std::abs(at_corner.direction[k] - ray.direction[k]));
      ray.error[k] = std::max(ray.error[k], at_corner.error[k]);
    }
  }
  if (!is_certain) return {.direction = {0, 0, 1}, .error = {2, 2, 2}};
  if (!sight.direction) return {};
  for (std::size_t k = 0; k < 3; ++k) ray.error[k] += change[k] * (1 + 0x1p-7);
  return ray;
}

bool is_in_the_middle(const Camera& camera) {
  const PrincipalPoint c = principal_point(camera.projection);
  return c.x * 2 == camera.width && c.y * 2 == camera.height && camera.projection.skew == 0;
}

}  // namespace

std::string name_of(Type type) {
  constexpr const char* names[] = {"EQUIRECTANGULAR", "MIRRORBALL", "FISHEYE_EQUIDISTANT",
                                   "FISHEYE_EQUISOLID"};
  return names[static_cast<std::size_t>(type)];
}

std::optional<BlenderPanorama> panorama_of(const Camera& camera) {
  const auto& [model, fx, fy, cx, cy, skew, pixel_centre, lens] = camera.projection;
  if (!lens || !is_in_the_middle(camera)) return std::nullopt;
  const double width = camera.width, height = camera.height;
  const bool has_end = std::isfinite(lens->max_radius);
  if (lens->model == LensModel::equirectangular && fx == width && fy == height && !has_end)
    return BlenderPanorama{Type::equirectangular};
  if (lens->model == LensModel::fisheye_equisolid) {
    if (!has_end && fx == width / 4 && fy == height / 4) return BlenderPanorama{Type::mirror_ball};
    if (has_end && fx == fy) {
      return BlenderPanorama{.type = Type::fisheye_equisolid,
                             .fov = 2 * lens->max_radius,
                             .lens = fx * blender_sensor_width / width};
    }
  }
  if (lens->model == LensModel::fisheye && has_end && fx == width / (2 * lens->max_radius) &&
      fy == height / (2 * lens->max_radius))
    return BlenderPanorama{.type = Type::fisheye_equidistant, .fov = 2 * lens->max_radius};
  return std::nullopt;
}

std::vector<Camera> blender_panoramas(std::uint32_t width, std::uint32_t height) {
  const double w = width, h = height;
  const auto camera = [&](const char* name, const char* model, double fx, double fy,
                          double max_radius = std::numeric_limits<double>::infinity()) {
    Camera made{.width = width, .height = height};
    made.projection = {.fx = fx, .fy = fy, .cx = w / 2, .cy = h / 2};
    made.projection.lens = lens_of_numbers(model, {}, max_radius);
    made.near = 0x1p-10;
    made.far = 0x1p20;
    made.name = name;
    return made;
  };
  const double reach = 100 * pi / 180, lens = 10.5;
  return {camera("equirectangular", "EQUIRECTANGULAR", w, h),
          camera("mirror-ball", "FISHEYE_EQUISOLID", w / 4, h / 4),
          camera("equidistant", "FISHEYE", w / (2 * reach), h / (2 * reach), reach),
          camera("equisolid", "FISHEYE_EQUISOLID", lens * w / blender_sensor_width,
                 lens * w / blender_sensor_width, pi / 2)};
}

PixelRays cycles_rays(const Camera& camera, double sample_error, CyclesAzimuth azimuth) {
  const StandardArithmetic standard;
  const BlenderPanorama panorama = panorama_of(camera).value();
  PixelRays made;
  // The position is a sum and a product with a rounded factor, relative to the whole image.
  const Position reach{sample_error / camera.width + 6 * u, sample_error / camera.height + 6 * u};
  // Rays start at near.
  made.origin_error = 4 * u * camera.near;
  for (std::uint32_t row = 0; row < camera.height; ++row) {
    for (std::uint32_t column = 0; column < camera.width; ++column) {
      const Position middle{(column + 0.5) / camera.width,
                            (camera.height - row - 0.5) / camera.height};
      made.rays.push_back(ray_of(panorama, camera, middle, reach, azimuth));
    }
  }
  return made;
}

}  // namespace fathom::validation
