#include "fathom/attribution/raster/raster_polygon.h"

#include <utility>

#include "fathom/attribution/raster/cut_polygon.h"

// docs/validation.md, "A rasterizer", "Cuts", derives what stands here.
namespace fathom::attribution {
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

}  // namespace fathom::attribution
