#include "fathom/attribution/model/window_depth.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "fathom/attribution/model/renderer_model.h"
#include "fathom/failures/errors.h"
#include "fathom/numeric/standard_arithmetic.h"

namespace fathom::attribution {

double WindowDepth::of_depth(double depth) const {
  if (log_range != 0) return std::log(depth / near) / log_range;
  return perspective ? a + b / depth : a * depth + b;
}

double WindowDepth::to_depth(double window) const {
  if (log_range != 0) return near * std::exp(window * log_range);
  if (!perspective) return (window - b) / a;
  const double beyond = window - a;  // of the sign of b in front of the camera
  if (beyond == 0 || (beyond > 0) != (b > 0)) return std::numeric_limits<double>::infinity();
  return b / beyond;
}

WindowDepth window_depth(ProjectionModel projection, Mapping mapping, double near, double far) {
  WindowDepth window{.perspective = projection == ProjectionModel::perspective,
                     .minus_one_to_one = mapping == Mapping::opengl};
  if (mapping == Mapping::log_ulrich) {
    window.near = near;
    window.log_range = std::log(far / near);
    return window;
  }
  const bool reversed = is_reversed(mapping);
  if (takes_infinite_far(mapping)) {
    window.a = reversed ? 0 : 1;
    window.b = reversed ? near : -near;
    return window;
  }
  const double range = far - near;
  if (window.perspective) {
    window.a = reversed ? -near / range : far / range;
    window.b = (reversed ? far : -far) * near / range;
  } else {
    window.a = (reversed ? -1 : 1) / range;
    window.b = (reversed ? far : -near) / range;
  }
  return window;
}

namespace {

constexpr double u = unit_roundoff<float>;

}  // namespace

double log2_error(double log2_x) {
  const double magnitude = std::abs(log2_x);
  // An ulp is at most 2u of the value.
  return magnitude < 1 ? 0x1p-21 : std::max(0x1p-21, 6 * u * magnitude);
}

double WrittenDepth::value(double q) const {
  const double t = term + double{factor} * q;
  return mapping == Mapping::log_ulrich ? scale * std::log2(t) : t;
}

Interval WrittenDepth::values(double q, double q_error) const {
  const double product = double{factor} * q, t = term + product;
  const double t_error =
      own_roundings * (std::abs(double{factor}) * q_error + u * (std::abs(product) + std::abs(t)));
  if (mapping != Mapping::log_ulrich) return {t - t_error, t + t_error};
  if (!(t - t_error > 0)) {
    constexpr double infinity = std::numeric_limits<double>::infinity();
    return {-infinity, infinity};
  }
  const double low = std::log2(t - t_error), high = std::log2(t + t_error);
  const auto scaled = [&](double logarithm, double error) {
    const double z = scale * (logarithm + error);
    return std::array{z - own_roundings * u * std::abs(z), z + own_roundings * u * std::abs(z)};
  };
  const auto a = scaled(low, -own_roundings * log2_error(low));
  const auto b = scaled(high, own_roundings * log2_error(high));
  return {std::min(a[0], b[0]), std::max(a[1], b[1])};
}

WrittenDepth written_depth(ProjectionModel projection, Mapping mapping, double near, double far) {
  const bool perspective = projection == ProjectionModel::perspective;
  const double range = far - near;
  WrittenDepth written{.mapping = mapping, .of_w = perspective};
  if (mapping == Mapping::log_ulrich) {
    if (!(near > 0)) {
      throw InputError("a logarithmic depth needs a near plane in front of the eye");
    }
    const double doublings = std::log2(far / near);
    written.term = perspective ? 0 : 1;
    written.factor = static_cast<float>(perspective ? near : range / near);
    written.scale = static_cast<float>((perspective ? -1 : 1) / doublings);
  } else {
    written.term = perspective ? static_cast<float>(-near / range) : 1;
    written.factor = perspective ? static_cast<float>(far * near / range) : -1;
  }
  return written;
}

namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();

/// The distance of neighbouring numbers of `bits` bits about x, at least 2^least.
double spacing(double x, int bits, int least) {
  if (x == 0 || !std::isfinite(x)) return std::ldexp(1.0, least);
  return std::ldexp(1.0, std::max(std::ilogb(x) - bits, least));
}

}  // namespace

double term_of(DepthTerm term, double depth) {
  return term == DepthTerm::depth     ? depth
         : term == DepthTerm::inverse ? 1 / depth
                                      : std::log(depth);
}

double depth_of(DepthTerm term, double value) {
  if (term == DepthTerm::depth) return value;
  if (term == DepthTerm::logarithm) return std::exp(value);
  return value > 0 ? 1 / value : infinity;
}

double round_to_binary16(double x) {
  if (!(std::abs(x) <= 65504)) return x;
  const double unit = spacing(x, 10, -24);
  return std::nearbyint(x / unit) * unit;
}

double RecordedDepth::exact(double depth) const {
  return factor * term_of(term, depth) + offset;
}

double RecordedDepth::rounded(double recorded) const {
  if (!std::isfinite(recorded)) return recorded;
  switch (rounding) {
    case Rounding::binary32:
      return recorded;
    case Rounding::binary16:
      return round_to_binary16(recorded);
    case Rounding::nearest:
      return origin + step * std::nearbyint((recorded - origin) / step);
    case Rounding::down:
      break;
  }
  return origin + step * std::floor((recorded - origin) / step);
}

double RecordedDepth::to_depth(double recorded) const {
  return depth_of(term, (recorded - offset) / factor);
}

double RecordedDepth::step_at(double recorded) const {
  if (rounding == Rounding::binary32) return spacing(recorded, 23, -149);
  return rounding == Rounding::binary16 ? spacing(recorded, 10, -24) : step;
}

Interval RecordedDepth::read_back(const Interval& depths) const {
  const double a = exact(depths.lower), b = exact(depths.upper);
  double least = std::min(a, b), greatest = std::max(a, b);
  least = rounded(least - error);
  greatest = rounded(greatest + error);
  least -= 2 * unit_roundoff<float> * std::abs(least);
  greatest += 2 * unit_roundoff<float> * std::abs(greatest);
  const double p = to_depth(least), q = to_depth(greatest);
  return {std::min(p, q), std::max(p, q)};
}

}  // namespace fathom::attribution
