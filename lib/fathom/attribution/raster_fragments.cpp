#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <vector>

#include "fathom/attribution/depth_plane.h"
#include "fathom/attribution/fragment_source.h"

// docs/validation.md, "A rasterizer", derives what stands here, in the same order.
namespace fathom::attribution {
namespace {

constexpr double u = unit_roundoff;
constexpr double infinity = std::numeric_limits<double>::infinity();

/// An edge of a polygon at a sample: e > 0 inside; the renderer's own e is at most `error` away.
struct EdgeAt {
  double value = 0, error = 0;
};

/// e = (a − s) × (b − s), and what displaced corners do to it.
EdgeAt edge_at(const WindowVertex& a, const WindowVertex& b, double x, double y, double spread) {
  const double ax = a.x - x, ay = a.y - y, bx = b.x - x, by = b.y - y;
  const double dax = a.snapped_x + spread, day = a.snapped_y + spread;
  const double dbx = b.snapped_x + spread, dby = b.snapped_y + spread;
  return {ay * bx - ax * by,
          own_roundings * (dax * std::abs(by) + day * std::abs(bx) + dbx * std::abs(ay) +
                           dby * std::abs(ax) + dax * dby + day * dbx)};
}

struct Polygon {
  std::vector<WindowVertex> corners;
  /// Of the window depth; of what a fragment shader makes its own of, where it writes one.
  DepthPlane plane, q;
  /// The plane of depths instead, for a renderer that interpolates those linearly.
  DepthPlane linear;
  bool turned = false;
  /// A corner may lie in the plane of the eye: nothing is known of where it is seen.
  bool anywhere = false;
};

class RasterFragments final : public FragmentSource {
 public:
  RasterFragments(const WorldMesh& mesh, const Camera& camera, const RendererModel& model)
      : mesh_(mesh),
        camera_(camera),
        model_(model),
        window_(window_depth(camera.projection, model.mapping, camera.near, camera.far)),
        stored_(window_depth(camera.projection, model.stored_mapping(), camera.near, camera.far)),
        vertices_(clip_vertices(mesh, camera, model)),
        sign_(stored_.reversed() ? -1 : 1) {}

  [[nodiscard]] PixelBox box(std::uint32_t triangle) const override;
  void each(std::uint32_t triangle, const PixelBox& box, const TakeFragment& take) const override;

 private:
  [[nodiscard]] std::array<const ClipVertex*, 3> corners(std::uint32_t triangle) const {
    const CornerIndices& t = mesh_.triangles[triangle];
    return {&vertices_[t[0]], &vertices_[t[1]], &vertices_[t[2]]};
  }
  [[nodiscard]] bool is_whole(std::uint32_t triangle) const;
  [[nodiscard]] std::optional<Polygon> polygon(std::uint32_t triangle, bool at_border) const;
  [[nodiscard]] std::vector<Polygon> polygons(std::uint32_t triangle) const;
  void set_planes(Polygon& polygon) const;
  [[nodiscard]] std::optional<Fragment> on(const Polygon& polygon, double x, double y) const;
  [[nodiscard]] double error_of(const DepthPlane& plane) const;
  [[nodiscard]] double expected(const Polygon& polygon, double x, double y) const;
  [[nodiscard]] Interval around(double z, const Polygon& polygon, double x, double y) const;
  [[nodiscard]] Coverage in_range(const Polygon& polygon, double x, double y) const;
  void set_value(Fragment& fragment, const Polygon& polygon, double x, double y) const;
  [[nodiscard]] double storage_error(double z) const;

  const WorldMesh& mesh_;
  Camera camera_;
  RendererModel model_;
  WindowDepth window_, stored_;  ///< of what is interpolated, of what is stored
  std::vector<ClipVertex> vertices_;
  double sign_;
};

/// Whether all of it lies inside the view volume whatever the errors are, so that nothing is cut.
bool RasterFragments::is_whole(std::uint32_t triangle) const {
  for (const ClipVertex* v : corners(triangle)) {
    const auto& [x, y, z, w] = v->value;
    const auto& [dx, dy, dz, dw] = v->error;
    if (!(std::abs(x) + dx < w - dw) || !(std::abs(y) + dy < w - dw)) return false;
    if (!(z - dz > 0) || !(z + dz < w - dw)) return false;
  }
  return true;
}

std::optional<Polygon> RasterFragments::polygon(std::uint32_t triangle, bool at_border) const {
  if (is_certainly_outside(corners(triangle))) return std::nullopt;
  Polygon polygon;
  for (const ClipVertex& v : cut(corners(triangle), at_border)) {
    if (!(v.value[3] - 2 * v.error[3] > 0)) polygon.anywhere = true;
    if (!polygon.anywhere) polygon.corners.push_back(to_window(v, camera_, model_));
  }
  if (polygon.anywhere) return polygon;
  if (polygon.corners.size() < 3) return std::nullopt;
  set_planes(polygon);
  double area = 0;
  for (std::size_t i = 1; i + 1 < polygon.corners.size(); ++i) {
    area += area_of(polygon.corners[0], polygon.corners[i], polygon.corners[i + 1]);
  }
  polygon.turned = area < 0;
  return polygon;
}

void RasterFragments::set_planes(Polygon& polygon) const {
  const auto plane = [&](CornerValue value, CornerValue error) {
    return depth_plane(polygon.corners, value, error, model_.depth_before_snap);
  };
  polygon.plane = plane(&WindowVertex::z, &WindowVertex::error_z);
  if (model_.written) polygon.q = plane(&WindowVertex::q, &WindowVertex::error_q);
  if (!model_.affine) return;
  for (WindowVertex& c : polygon.corners) c.depth = window_.to_depth(c.z);
  polygon.linear = plane(&WindowVertex::depth, &WindowVertex::error_z);
}

/// As a renderer may have cut it: one or two polygons, whatever its roundings are.
std::vector<Polygon> RasterFragments::polygons(std::uint32_t triangle) const {
  std::vector<Polygon> found;
  const bool whole = is_whole(triangle);
  const bool cut = !whole && model_.border != RendererModel::Cut::never;
  if (auto p = polygon(triangle, cut)) found.push_back(std::move(*p));
  if (!whole && model_.border == RendererModel::Cut::unknown) {
    if (auto p = polygon(triangle, false)) found.push_back(std::move(*p));
  }
  return found;
}

PixelBox RasterFragments::box(std::uint32_t triangle) const {
  double least_x = infinity, least_y = infinity, greatest_x = -infinity, greatest_y = -infinity;
  for (const Polygon& p : polygons(triangle)) {
    if (p.anywhere) return {0, camera_.width - 1, 0, camera_.height - 1};
    for (const WindowVertex& c : p.corners) {
      const double margin_x = c.snapped_x + model_.sample_error;
      const double margin_y = c.snapped_y + model_.sample_error;
      least_x = std::min(least_x, c.x - margin_x);
      greatest_x = std::max(greatest_x, c.x + margin_x);
      least_y = std::min(least_y, c.y - margin_y);
      greatest_y = std::max(greatest_y, c.y + margin_y);
    }
  }
  PixelBox box;
  const double last_x = camera_.width - 1.0, last_y = camera_.height - 1.0;
  if (!(least_x - 1 <= last_x) || !(least_y - 1 <= last_y) || greatest_x < 0 || greatest_y < 0) {
    return box;
  }
  const auto clamped = [](double x, double last) {
    return static_cast<std::uint32_t>(std::clamp(std::floor(x), 0.0, last));
  };
  return {clamped(least_x - 1, last_x), clamped(greatest_x + 1, last_x),
          clamped(least_y - 1, last_y), clamped(greatest_y + 1, last_y)};
}

/// Rounding to the storage, with the conversion to whole numbers in binary32.
double RasterFragments::storage_error(double z) const {
  double error = model_.decoded_in_binary32 ? 4 * u : 0;
  if (is_unorm(model_.storage)) {
    return error + 0.5 / (std::ldexp(1.0, bits_of(model_.storage)) - 1) + u * std::abs(z);
  }
  if (model_.storage == Storage::float16) return error + 0x1p-11 * std::abs(z) + 0x1p-25;
  return error;  // what is interpolated is binary32 already
}

/// Of an interpolated value: the bound of its plane, and where the sample lies.
double RasterFragments::error_of(const DepthPlane& plane) const {
  return plane.error + model_.sample_error * (std::abs(plane.g_x) + std::abs(plane.g_y));
}

/// What is stored where nothing is rounded.
double RasterFragments::expected(const Polygon& p, double x, double y) const {
  if (model_.affine && p.plane.is_known) return stored_.of_depth(p.linear.at(x, y));
  const DepthPlane& plane = model_.written ? p.q : p.plane;
  const double value = plane.is_known ? plane.at(x, y) : plane.least;
  return model_.written ? model_.written->value(value) + model_.bias : value;
}

/// All values about the expected one that may come before they are rounded to the storage.
Interval RasterFragments::around(double z, const Polygon& p, double x, double y) const {
  const double error = error_of(model_.written ? p.q : p.plane);
  if (!std::isfinite(z) || !(error < infinity)) return {-infinity, infinity};
  if (!model_.written) return {z - error, z + error};
  const double q = p.q.at(x, y), middle = model_.written->value(q);
  const Interval values = model_.written->values(q, error);
  return {z - (middle - values.lower) - model_.bias_error,
          z + (values.upper - middle) + model_.bias_error};
}

/// Whether the range of window depths cuts here, as they are interpolated.
Coverage RasterFragments::in_range(const Polygon& p, double x, double y) const {
  const double z = p.plane.at(x, y), error = error_of(p.plane);
  if (!p.plane.is_known || !(error < infinity)) return Coverage::may;
  if (z + error < 0 || z - error > 1) return Coverage::must_not;
  return z - error < 0 || z + error > 1 ? Coverage::may : Coverage::must;
}

void RasterFragments::set_value(Fragment& f, const Polygon& p, double x, double y) const {
  const double z = expected(p, x, y);
  Interval stored = around(z, p, x, y);
  if (stored.lower == -infinity || stored.upper == infinity) {
    stored = {0, 1};
  } else {
    const double error = storage_error(z);
    stored = {stored.lower - error, stored.upper + error};
  }
  if (model_.written && in_range(p, x, y) == Coverage::must_not) f.coverage = Coverage::must_not;
  // Nearer than near, beyond far: cut away; what is written there is kept or becomes 0 or 1.
  if (!model_.written && (stored.upper < 0 || stored.lower > 1)) f.coverage = Coverage::must_not;
  if (f.coverage == Coverage::must_not) return;
  const bool may_be_cut = model_.written && in_range(p, x, y) == Coverage::may;
  if (may_be_cut || stored.lower < 0 || stored.upper > 1) {
    f.coverage = Coverage::may;
    f.open_edges = joins_no_other;
  }
  if (model_.written) {
    stored = {std::min(stored.lower, 1.0), std::max(stored.upper, 0.0)};
  }
  f.exact = sign_ * z;
  f.value = sign_ > 0 ? stored : Interval{-stored.upper, -stored.lower};
}

std::optional<Fragment> RasterFragments::on(const Polygon& p, double x, double y) const {
  Fragment f{.coverage = Coverage::must, .turned = p.turned, .inside = true};
  if (p.anywhere) {
    f.coverage = Coverage::may;
    f.open_edges = joins_no_other;
    f.exact = sign_ > 0 ? 1 : 0;
    f.value = sign_ > 0 ? Interval{0, 1} : Interval{-1, 0};
    return f;
  }
  bool certain_area = p.plane.is_known && p.plane.error < infinity;
  bool one_way = true, other_way = true;  // no edge is certain to exclude the sample
  const std::size_t count = p.corners.size();
  for (std::size_t i = 0; i < count; ++i) {
    const WindowVertex& a = p.corners[i];
    const WindowVertex& b = p.corners[(i + 1) % count];
    if ((a.borders & b.borders) != 0) continue;  // a cut: the border decides
    const EdgeAt e = edge_at(a, b, x, y, model_.sample_error);
    one_way = one_way && e.value + e.error >= 0;
    other_way = other_way && e.value - e.error <= 0;
    const double inward = p.turned ? -e.value : e.value;
    if (inward < 0) f.inside = false;
    if (!(inward > e.error)) {
      f.coverage = Coverage::may;
      if (count == 3) f.open_edges |= static_cast<std::uint8_t>(1U << ((i + 2) % 3));
    }
  }
  if (!certain_area) f.coverage = Coverage::may;
  if (!one_way && !other_way) return std::nullopt;
  if (certain_area && !(p.turned ? other_way : one_way)) return std::nullopt;
  // Of a cut polygon the corners that were cut off are not told: it joins no others.
  if (count != 3 && f.coverage == Coverage::may) f.open_edges = joins_no_other;
  set_value(f, p, x, y);
  if (f.coverage == Coverage::must_not) return std::nullopt;
  return f;
}

/// What holds for both ways to cut a triangle.
std::optional<Fragment> both(const std::optional<Fragment>& a, const std::optional<Fragment>& b) {
  if (!a && !b) return std::nullopt;
  Fragment f = a ? *a : *b;
  if (a && b) {
    f.coverage = std::min(a->coverage, b->coverage);
    f.open_edges = a->open_edges | b->open_edges;
    f.value = {std::min(a->value.lower, b->value.lower), std::max(a->value.upper, b->value.upper)};
  } else {
    f.coverage = Coverage::may;
    f.open_edges = joins_no_other;
  }
  return f;
}

void RasterFragments::each(std::uint32_t triangle, const PixelBox& box,
                           const TakeFragment& take) const {
  const std::vector<Polygon> found = polygons(triangle);
  if (found.empty() || box.is_empty()) return;
  for (std::uint32_t row = box.first_row; row <= box.last_row; ++row) {
    for (std::uint32_t column = box.first_column; column <= box.last_column; ++column) {
      const double x = column + model_.sample[0], y = row + model_.sample[1];
      std::optional<Fragment> f = on(found[0], x, y);
      if (found.size() == 2) f = both(f, on(found[1], x, y));
      if (!f) continue;
      f->triangle = triangle;
      take(column, row, *f);
    }
  }
}

}  // namespace

std::unique_ptr<FragmentSource> raster_fragments(const WorldMesh& mesh, const Camera& camera,
                                                 const RendererModel& model) {
  return std::make_unique<RasterFragments>(mesh, camera, model);
}

std::unique_ptr<FragmentSource> fragments(const WorldMesh& mesh, const Camera& camera,
                                          const RendererModel& model) {
  return model.kind == RendererModel::Kind::raster ? raster_fragments(mesh, camera, model)
                                                   : ray_fragments(mesh, camera, model);
}

}  // namespace fathom::attribution
