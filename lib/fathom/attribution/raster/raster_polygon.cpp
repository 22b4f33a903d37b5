#include "fathom/attribution/raster/raster_polygon.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "fathom/numeric/standard_arithmetic.h"

namespace fathom::attribution {
namespace {

constexpr double u = unit_roundoff<float>;

/// The borders of the view volume, in the order in which they cut. Every renderer cuts at the
/// first.
enum Border : unsigned { near_plane, far_plane, left, right, bottom, top, border_count };

bool is_of_depth(unsigned border) {
  return border == near_plane || border == far_plane;
}

/// Signed distances from the borders, positive inside; linear in the clip coordinates.
double distance(const ClipVertex& v, unsigned border) {
  const auto& [x, y, z, w] = v.value;
  switch (border) {
    case near_plane:
      return z;
    case far_plane:
      return w - z;
    case left:
      return w + x;
    case right:
      return w - x;
    case bottom:
      return w + y;
    default:
      return w - y;
  }
}

/// Near and far are cut as far out as the errors allow: the range of depths decides there, not the
/// cut.
double slack(const ClipVertex& v, unsigned border) {
  if (!is_of_depth(border)) return 0;
  return v.error[2] + (border == far_plane ? v.error[3] : 0);
}

/// The new corner between `a` and `b`. The renderer's own lies on its own edge up to the roundings
/// of an interpolation; where along the edge does not matter, because nothing beyond the border is
/// drawn.
ClipVertex between(const ClipVertex& a, const ClipVertex& b, unsigned border) {
  const double from_a = distance(a, border) + slack(a, border);
  const double from_b = distance(b, border) + slack(b, border);
  const double t = from_a / (from_a - from_b);
  ClipVertex v{.borders = 1U << border | (a.borders & b.borders)};
  for (std::size_t k = 0; k < 4; ++k) {
    v.value[k] = a.value[k] + t * (b.value[k] - a.value[k]);
    v.error[k] = std::max(a.error[k], b.error[k]) +
                 4 * u * std::max(std::abs(a.value[k]), std::abs(b.value[k]));
  }
  return v;
}

std::vector<ClipVertex> cut_at(const std::vector<ClipVertex>& polygon, unsigned border) {
  std::vector<ClipVertex> inside;
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    const ClipVertex& a = polygon[i];
    const ClipVertex& b = polygon[(i + 1) % polygon.size()];
    const bool a_in = distance(a, border) + slack(a, border) >= 0;
    const bool b_in = distance(b, border) + slack(b, border) >= 0;
    if (a_in) inside.push_back(a);
    if (a_in != b_in) inside.push_back(between(a, b, border));
  }
  return inside;
}

}  // namespace

bool is_certainly_outside(const std::array<const ClipVertex*, 3>& triangle) {
  for (unsigned border = 0; border < border_count; ++border) {
    bool outside = true;
    for (const ClipVertex* v : triangle) {
      const double across = is_of_depth(border) ? v->error[2] : v->error[border <= right ? 0 : 1];
      const double error = across + (border == near_plane ? 0 : v->error[3]);
      outside = outside && distance(*v, border) + error < 0;
    }
    if (outside) return true;
  }
  return false;
}

bool is_certainly_inside(const std::array<const ClipVertex*, 3>& triangle) {
  for (const ClipVertex* v : triangle) {
    const auto& [x, y, z, w] = v->value;
    const auto& [dx, dy, dz, dw] = v->error;
    if (!(std::abs(x) + dx < w - dw) || !(std::abs(y) + dy < w - dw)) return false;
    if (!(z - dz > 0) || !(z + dz < w - dw)) return false;
  }
  return true;
}

std::vector<ClipVertex> cut(const std::array<const ClipVertex*, 3>& triangle, bool at_border) {
  std::vector<ClipVertex> polygon{*triangle[0], *triangle[1], *triangle[2]};
  const unsigned last = at_border ? top : near_plane;
  for (unsigned border = near_plane; border <= last && !polygon.empty(); ++border) {
    polygon = cut_at(polygon, border);
  }
  return polygon;
}

// docs/validation.md, "A rasterizer", "Cuts", derives the bounds below.

namespace {

/// Twice the area, signed.
double area_of(const std::vector<WindowVertex>& corners) {
  double area = 0;
  for (std::size_t i = 1; i + 1 < corners.size(); ++i) {
    area += area_of(corners[0], corners[i], corners[i + 1]);
  }
  return area;
}

}  // namespace

std::vector<RasterPolygon> RasterPolygons::of(
    const std::array<const ClipVertex*, 3>& triangle) const {
  std::vector<RasterPolygon> found = outlines_of(triangle);
  for (RasterPolygon& polygon : found) {
    if (polygon.anywhere) continue;
    set_planes(polygon);
    polygon.turned = area_of(polygon.corners) < 0;
  }
  return found;
}

std::vector<RasterPolygon> RasterPolygons::outlines_of(
    const std::array<const ClipVertex*, 3>& triangle) const {
  std::vector<RasterPolygon> found;
  const bool whole = is_certainly_inside(triangle);
  const bool cut = !whole && model_.border != RasterModel::Cut::never;
  if (auto p = outline(triangle, cut)) found.push_back(std::move(*p));
  if (!whole && model_.border == RasterModel::Cut::unknown) {
    if (auto p = outline(triangle, false)) found.push_back(std::move(*p));
  }
  return found;
}

std::optional<RasterPolygon> RasterPolygons::outline(
    const std::array<const ClipVertex*, 3>& triangle, bool at_border) const {
  if (is_certainly_outside(triangle)) return std::nullopt;
  RasterPolygon polygon;
  for (const ClipVertex& v : cut(triangle, at_border)) {
    if (!(v.value[3] - 2 * v.error[3] > 0)) polygon.anywhere = true;
    if (!polygon.anywhere) polygon.corners.push_back(to_window(v, camera_, model_));
  }
  if (!polygon.anywhere && polygon.corners.size() < 3) return std::nullopt;
  return polygon;
}

void RasterPolygons::set_planes(RasterPolygon& polygon) const {
  const auto plane = [&](CornerValue value, CornerValue error) {
    return depth_plane(polygon.corners, value, error, model_.depth_before_snap);
  };
  polygon.plane = plane(&WindowVertex::z, &WindowVertex::error_z);
  if (model_.written) polygon.q = plane(&WindowVertex::q, &WindowVertex::error_q);
  if (!model_.affine) return;
  for (WindowVertex& c : polygon.corners) c.depth = window_.to_depth(c.z);
  polygon.linear = plane(&WindowVertex::depth, &WindowVertex::error_z);
}

namespace {

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
  return error;  // the interpolated value is binary32 already
}

/// Of an interpolated value: the bound of its plane, and where the sample lies.
double RasterDepth::error_of(const DepthPlane& plane) const {
  return plane.error + sample_error_ * (std::abs(plane.g_x) + std::abs(plane.g_y));
}

/// The stored value without roundings.
double RasterDepth::expected(const RasterPolygon& p, double x, double y) const {
  if (model_.affine && p.plane.is_known) return stored_.of_depth(p.linear.at(x, y));
  const DepthPlane& plane = model_.written ? p.q : p.plane;
  const double value = plane.is_known ? plane.at(x, y) : plane.least;
  return model_.written ? model_.written->value(value) + model_.bias : value;
}

/// All possible values about the expected value, before rounding to the storage.
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
