#include "fathom/camera/image_points.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

#include "fathom/camera/pose.h"
#include "fathom/failures/errors.h"
#include "fathom/numeric/certified.h"
#include "fathom/numeric/certified_rounding.h"
#include "fathom/numeric/double_word.h"
#include "fathom/numeric/rounding.h"
#include "fathom/numeric/standard_arithmetic.h"

namespace fathom {
namespace {

constexpr std::string_view no_projection =
    "points are projected and unprojected without a lens only; 'fathom camera directions' (in "
    "Python camera.directions()) computes the rays of the pixels";

constexpr double nan = std::numeric_limits<double>::quiet_NaN();

/// The top left corner of the image is at (corner, corner) in the camera's own coordinates.
Dyadic corner_of(const Projection& projection) {
  return Dyadic(projection.pixel_centre) - Dyadic(0.5);
}

/// x as a double-word: its error is at most 2⁻¹⁰⁶ of it, unless the second word underflows.
WordPair words_of(const Ratio& x) {
  const double hi = round_to_binary64(x);
  if (!std::isfinite(hi)) return {hi, 0};
  return {hi, round_to_binary64(x - Ratio(Dyadic(hi)))};
}

}  // namespace

ImageOfPoint project(const Camera& camera, const std::array<double, 3>& world) {
  const StandardArithmetic standard;
  require_straight(camera, no_projection);
  const CameraPoint p = to_camera(camera.world_to_camera, {world[0], world[1], world[2]});
  const double depth = round_to_binary64(Ratio(p.z));
  if (is_perspective(camera.projection) && p.z.sign() != Sign::positive) return {nan, nan, depth};
  const HomogeneousImagePoint image = to_image(camera.projection, p);
  const Dyadic shift = corner_of(camera.projection) * image.W;
  return {round_to_binary64(Ratio(image.U + shift, image.W)),
          round_to_binary64(Ratio(image.V + shift, image.W)), depth};
}

// A point p of the camera frame at (u, v) and depth d has
//   p.y = (v − cy)·w / fy,  p.x = ((u − cx)·w − skew·p.y) / fx,  p.z = d.
// Over the common denominator fx·fy that is
//   p = (fy, 0, 0)·(u − cx)·w + (−skew, fx, 0)·(v − cy)·w + (0, 0, fx·fy)·d,
// and the world's X = R⁻¹·(p − t), with R⁻¹ = adj R / det R.
ImageRays::ImageRays(const Camera& camera, PointFrame frame)
    : cx_(camera.projection.cx),
      cy_(camera.projection.cy),
      perspective_(is_perspective(camera.projection)) {
  const StandardArithmetic standard;
  require_straight(camera, no_projection);
  const Projection& projection = camera.projection;
  const Dyadic fx = projection.fx, fy = projection.fy, skew = projection.skew, zero = 0.0;
  const ExactVector3 u{fy, zero, zero}, v{-skew, fx, zero}, d{zero, zero, fx * fy};
  // In the camera frame, the pose is the identity.
  const auto [rows, det, t] = camera::adjugate(
      frame == PointFrame::world ? camera.world_to_camera : Camera().world_to_camera);
  denominator_ = fx * fy * det;
  for (std::size_t k = 0; k < 3; ++k) {
    U_[k] = dot(rows[k], u);
    V_[k] = dot(rows[k], v);
    D_[k] = dot(rows[k], d);
    O_[k] = -dot(rows[k], t) * (fx * fy);
  }
  first_x_ = Dyadic(projection.pixel_centre) - Dyadic(cx_);
  first_y_ = Dyadic(projection.pixel_centre) - Dyadic(cy_);
  for (std::size_t k = 0; k < 3; ++k) {
    const Dyadic start = U_[k] * first_x_ + V_[k] * first_y_ + (perspective_ ? D_[k] : O_[k]);
    const auto words = [&](const Dyadic& numerator) {
      return words_of(Ratio(numerator, denominator_));
    };
    lines_[k] = {words(U_[k]), words(V_[k]), words(start)};
  }
}

std::array<double, 3> ImageRays::point(double u, double v, double depth) const {
  const StandardArithmetic standard;
  const Dyadic w = perspective_ ? Dyadic(depth) : Dyadic(1.0);
  const Dyadic across = (Dyadic(u) - Dyadic(cx_)) * w, down = (Dyadic(v) - Dyadic(cy_)) * w;
  std::array<double, 3> result;
  for (std::size_t k = 0; k < 3; ++k)
    result[k] = round_to_binary64(
        Ratio(U_[k] * across + V_[k] * down + D_[k] * Dyadic(depth) + O_[k], denominator_));
  return result;
}

// First in double-words. Their sum errs by less than 2⁻¹⁰⁰ of the sum of its terms' sizes: by 2⁻¹⁰⁶
// of each coefficient, and by epsilon of each of two products and two sums. The bound is twice
// that, for its own roundings, and for coefficients whose second word underflows: the lost part is
// negligible for the numbers that to_binary64() settles.
std::array<double, 3> ImageRays::of_pixel(std::uint32_t x, std::uint32_t y) const {
  const StandardArithmetic standard;
  using Words = DoubleWord<false>;
  const double column = x, row = y;
  std::array<double, 3> result;
  for (std::size_t k = 0; k < 3; ++k) {
    const auto& [across, down, start] = lines_[k];
    const WordPair sum = Words(across) * column + Words(down) * row + Words(start);
    const double size = std::abs(across.hi) * column + std::abs(down.hi) * row + std::abs(start.hi);
    const double error = size * 0x1p-99;
    const std::optional<double> settled = error > 0 ? to_binary64(sum, error) : std::nullopt;
    result[k] = settled ? *settled : exactly_of_pixel(k, x, y);
  }
  return result;
}

double ImageRays::exactly_of_pixel(std::size_t k, double x, double y) const {
  const Dyadic numerator = U_[k] * (first_x_ + Dyadic(x)) + V_[k] * (first_y_ + Dyadic(y)) +
                           (perspective_ ? D_[k] : O_[k]);
  return round_to_binary64(Ratio(numerator, denominator_));
}

Camera resized(const Camera& camera, std::uint32_t width, std::uint32_t height) {
  const StandardArithmetic standard;
  if (camera.projection.lens && camera.projection.lens->directions) {
    require_straight(camera,
                     "a table has directions for its own pixels only; make a table of the "
                     "other size");
  }
  Camera result = camera;
  result.width = width;
  result.height = height;
  const Dyadic corner = corner_of(camera.projection);
  const auto scaled = [](const Dyadic& length, std::uint32_t to, std::uint32_t from) {
    return Ratio(length * Dyadic(static_cast<double>(to)), Dyadic(static_cast<double>(from)));
  };
  const auto position = [&](double c, std::uint32_t to, std::uint32_t from) {
    return round_to_binary64(scaled(Dyadic(c) - corner, to, from) + Ratio(corner));
  };
  const Projection& from = camera.projection;
  Projection& to = result.projection;
  to.fx = round_to_binary64(scaled(Dyadic(from.fx), width, camera.width));
  to.skew = round_to_binary64(scaled(Dyadic(from.skew), width, camera.width));
  to.fy = round_to_binary64(scaled(Dyadic(from.fy), height, camera.height));
  to.cx = position(from.cx, width, camera.width);
  to.cy = position(from.cy, height, camera.height);
  if (to.lens && to.fx != to.fy) to.lens = with_two_focal_lengths(*to.lens);
  require_valid(result);
  return result;
}

Camera scaled(const Camera& camera, double factor) {
  const StandardArithmetic standard;
  if (!(factor > 0) || !std::isfinite(factor)) {
    throw UsageError(Setting{"factor"}, "expected a positive number");
  }
  const auto length = [&](std::uint32_t pixels) {
    const double whole = std::max(1.0, std::nearbyint(factor * pixels));
    if (whole > std::numeric_limits<std::uint32_t>::max()) {
      throw UsageError(Setting{"factor"},
                       "the image would have more than 4294967295 pixels a side");
    }
    return static_cast<std::uint32_t>(whole);
  };
  return resized(camera, length(camera.width), length(camera.height));
}

}  // namespace fathom
