#include "fathom/attribution/raster/raster_depth.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "fathom/numeric/unit_roundoff.h"

namespace fathom::attribution {
namespace {

constexpr double u = unit_roundoff<float>;
constexpr double infinity = std::numeric_limits<double>::infinity();

}  // namespace

/// Rounding to the storage, with the conversion to whole numbers in binary32.
double RasterDepth::storage_error(double z) const {
  double error = model_.decoded_in_binary32 ? 4 * u : 0;
  if (is_unorm(model_.storage)) {
    const double codes = model_.nearest_codes ? 0.5 : 1;
    return error + codes / greatest_code(model_.storage) + u * std::abs(z);
  }
  if (model_.storage == Storage::float16) return error + 0x1p-11 * std::abs(z) + 0x1p-25;
  return error;  // what is interpolated is binary32 already
}

/// Of an interpolated value: the bound of its plane, and where the sample lies.
double RasterDepth::error_of(const DepthPlane& plane) const {
  return plane.error + sample_error_ * (std::abs(plane.g_x) + std::abs(plane.g_y));
}

/// What is stored where nothing is rounded.
double RasterDepth::expected(const RasterPolygon& p, double x, double y) const {
  if (model_.affine && p.plane.is_known) return stored_.of_depth(p.linear.at(x, y));
  const DepthPlane& plane = model_.written ? p.q : p.plane;
  const double value = plane.is_known ? plane.at(x, y) : plane.least;
  return model_.written ? model_.written->value(value) + model_.bias : value;
}

/// All values about the expected one that may come before they are rounded to the storage.
Interval RasterDepth::around(double z, const RasterPolygon& p, double x, double y) const {
  const double error = error_of(model_.written ? p.q : p.plane);
  if (!std::isfinite(z) || !(error < infinity)) return {-infinity, infinity};
  if (!model_.written) return {z - error, z + error};
  const double q = p.q.at(x, y), middle = model_.written->value(q);
  const Interval values = model_.written->values(q, error);
  return {z - (middle - values.lower) - model_.bias_error,
          z + (values.upper - middle) + model_.bias_error};
}

/// Whether the range of window depths cuts here, as they are interpolated.
Coverage RasterDepth::in_range(const RasterPolygon& p, double x, double y) const {
  const double z = p.plane.at(x, y), error = error_of(p.plane);
  if (!p.plane.is_known || !(error < infinity)) return Coverage::may;
  if (z + error < 0 || z - error > 1) return Coverage::must_not;
  return z - error < 0 || z + error > 1 ? Coverage::may : Coverage::must;
}

Interval RasterDepth::nearer_is_less(const Interval& window) const {
  return sign_ > 0 ? window : Interval{-window.upper, -window.lower};
}

void RasterDepth::set(Fragment& f, const RasterPolygon& p, double x, double y) const {
  const double z = expected(p, x, y);
  Interval stored = around(z, p, x, y);
  if (stored.lower == -infinity || stored.upper == infinity) {
    stored = {0, 1};
  } else {
    const double error = storage_error(z);
    stored = {stored.lower - error, stored.upper + error};
  }
  // Nearer than near, beyond far: cut away. A written depth is cut by the interpolated one; beyond
  // 0 or 1 it may be kept or become that.
  const bool is_beyond = stored.upper < 0 || stored.lower > 1;
  const bool may_be_beyond = stored.lower < 0 || stored.upper > 1;
  const Coverage range = model_.written ? in_range(p, x, y)
                         : is_beyond    ? Coverage::must_not
                                        : Coverage::must;
  if (range == Coverage::must_not) f.coverage = Coverage::must_not;
  if (f.coverage == Coverage::must_not) return;
  if (range == Coverage::may || may_be_beyond) {
    f.coverage = Coverage::may;
    f.open_edges = joins_no_other;
  }
  if (model_.written) {
    stored = {std::min(stored.lower, 1.0), std::max(stored.upper, 0.0)};
  }
  f.exact = sign_ * z;
  f.value = nearer_is_less(stored);
}

void RasterDepth::set_anything(Fragment& f) const {
  f.coverage = Coverage::may;
  f.open_edges = joins_no_other;
  f.exact = sign_ > 0 ? 1 : 0;
  f.value = nearer_is_less({0, 1});
}

}  // namespace fathom::attribution
