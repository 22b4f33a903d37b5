#include "fathom/attribution/model/written_depth.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "fathom/attribution/model/own_roundings.h"
#include "fathom/failures/errors.h"
#include "fathom/numeric/unit_roundoff.h"

namespace fathom::attribution {
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

WrittenDepth written_depth(Projection projection, Mapping mapping, double near, double far) {
  const bool perspective = projection == Projection::perspective;
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

}  // namespace fathom::attribution
