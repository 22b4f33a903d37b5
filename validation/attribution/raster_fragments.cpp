#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <vector>

#include "validation/attribution/clip_vertex.h"
#include "validation/attribution/fragment_source.h"

// docs/validation.md, "A rasterizer", derives what stands here, in the same order.
namespace fathom::validation {
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

/// The window depth over a polygon, z = z_0 + g·(s − corner), and what bounds its errors.
struct DepthPlane {
  WindowVertex corner;
  double g_x = 0, g_y = 0;
  /// Of a value that is interpolated at a sample inside: corners displaced, plane evaluated.
  double error = infinity;
  double least = -infinity, greatest = infinity;  ///< over the corners
  /// The plane could not be told: its corners may lie on a line.
  bool is_known = false;
  /// The plane of depths instead, for a renderer that interpolates those linearly.
  double depth = 0, depth_x = 0, depth_y = 0;

  [[nodiscard]] double at(double x, double y) const {
    return corner.z + g_x * (x - corner.x) + g_y * (y - corner.y);
  }
  [[nodiscard]] double depth_at(double x, double y) const {
    return depth + depth_x * (x - corner.x) + depth_y * (y - corner.y);
  }
};

struct Polygon {
  std::vector<WindowVertex> corners;
  DepthPlane plane;
  bool turned = false;
  /// A corner may lie in the plane of the eye: nothing is known of where it is seen.
  bool anywhere = false;
};

double area_of(const WindowVertex& a, const WindowVertex& b, const WindowVertex& c) {
  return (b.y - a.y) * (c.x - a.x) - (b.x - a.x) * (c.y - a.y);
}

/// Twice the area by which displaced corners can change that of a triangle.
double area_error(const WindowVertex& a, const WindowVertex& b, const WindowVertex& c) {
  const double dx = std::max({a.snapped_x, b.snapped_x, c.snapped_x});
  const double dy = std::max({a.snapped_y, b.snapped_y, c.snapped_y});
  const double width = std::max({a.x, b.x, c.x}) - std::min({a.x, b.x, c.x});
  const double height = std::max({a.y, b.y, c.y}) - std::min({a.y, b.y, c.y});
  return own_roundings * (4 * dx * height + 4 * dy * width + 8 * dx * dy);
}

/// A triangle of three corners of a polygon, as a renderer may split it.
struct Part {
  const WindowVertex *a, *b, *c;
  [[nodiscard]] double area() const { return std::abs(area_of(*a, *b, *c)); }
  [[nodiscard]] bool on_one_border() const { return (a->borders & b->borders & c->borders) != 0; }
};

std::vector<Part> parts_of(const std::vector<WindowVertex>& corners) {
  std::vector<Part> parts;
  for (std::size_t i = 0; i < corners.size(); ++i) {
    for (std::size_t j = i + 1; j < corners.size(); ++j) {
      for (std::size_t k = j + 1; k < corners.size(); ++k) {
        const Part part{&corners[i], &corners[j], &corners[k]};
        if (!part.on_one_border()) parts.push_back(part);
      }
    }
  }
  return parts;
}

class RasterFragments final : public FragmentSource {
 public:
  RasterFragments(const WorldMesh& mesh, const Camera& camera, const RendererModel& model)
      : mesh_(mesh),
        camera_(camera),
        model_(model),
        window_(window_depth(camera.projection, model.mapping, camera.near, camera.far)),
        vertices_(clip_vertices(mesh, camera, model)),
        sign_(window_.reversed() ? -1 : 1) {}

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
  void set_plane(Polygon& polygon) const;
  [[nodiscard]] double plane_error(const DepthPlane& plane, const Part& part) const;
  [[nodiscard]] std::optional<Fragment> on(const Polygon& polygon, double x, double y) const;
  void set_value(Fragment& fragment, const Polygon& polygon, double x, double y) const;
  [[nodiscard]] double storage_error(double z) const;

  const WorldMesh& mesh_;
  Camera camera_;
  RendererModel model_;
  WindowDepth window_;
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
  set_plane(polygon);
  double area = 0;
  for (std::size_t i = 1; i + 1 < polygon.corners.size(); ++i) {
    area += area_of(polygon.corners[0], polygon.corners[i], polygon.corners[i + 1]);
  }
  polygon.turned = area < 0;
  return polygon;
}

/// The plane through the largest part; the bound is the worst over all parts.
void RasterFragments::set_plane(Polygon& polygon) const {
  const std::vector<Part> parts = parts_of(polygon.corners);
  DepthPlane& plane = polygon.plane;
  plane.least = infinity;
  plane.greatest = -infinity;
  for (const WindowVertex& c : polygon.corners) {
    plane.least = std::min(plane.least, c.z - c.error_z);
    plane.greatest = std::max(plane.greatest, c.z + c.error_z);
  }
  const auto largest = std::max_element(
      parts.begin(), parts.end(), [](const Part& p, const Part& q) { return p.area() < q.area(); });
  if (largest == parts.end() || largest->area() == 0) return;
  const auto& [a, b, c] = *largest;
  const double area = area_of(*a, *b, *c);
  const double bx = b->x - a->x, by = b->y - a->y, bz = b->z - a->z;
  const double cx = c->x - a->x, cy = c->y - a->y, cz = c->z - a->z;
  plane.corner = *a;
  plane.g_x = (by * cz - cy * bz) / area;
  plane.g_y = (cx * bz - bx * cz) / area;
  plane.is_known = true;
  plane.error = 0;
  if (model_.affine) {
    plane.depth = window_.to_depth(a->z);
    const double bd = window_.to_depth(b->z) - plane.depth;
    const double cd = window_.to_depth(c->z) - plane.depth;
    plane.depth_x = (by * cd - cy * bd) / area;
    plane.depth_y = (cx * bd - bx * cd) / area;
  }
  for (const Part& part : parts) plane.error = std::max(plane.error, plane_error(plane, part));
}

double RasterFragments::plane_error(const DepthPlane& plane, const Part& part) const {
  const auto& [a, b, c] = part;
  const double area = part.area(), uncertain = area_error(*a, *b, *c);
  if (!(area > 2 * uncertain)) return infinity;
  const double width = std::max({a->x, b->x, c->x}) - std::min({a->x, b->x, c->x});
  const double height = std::max({a->y, b->y, c->y}) - std::min({a->y, b->y, c->y});
  const double g_x = std::abs(plane.g_x), g_y = std::abs(plane.g_y);

  // Corners displaced: Σ λ'ᵢ(z'ᵢ − zᵢ − g·αᵢ), λ' of a sample inside the snapped triangle.
  double displaced = 0, depths = 0, offset_x = 0, offset_y = 0;
  for (const WindowVertex* v : {a, b, c}) {
    const double dx = model_.depth_before_snap ? v->error_x : v->snapped_x;
    const double dy = model_.depth_before_snap ? v->error_y : v->snapped_y;
    displaced = std::max(displaced, v->error_z + g_x * dx + g_y * dy);
    depths = std::max(depths, std::abs(v->z));
    offset_x = std::max(offset_x, std::abs(v->x));
    offset_y = std::max(offset_y, std::abs(v->y));
  }
  const double outside = 2 * uncertain / (area - uncertain);  // how far λ' may be negative, in all
  const double spread = 1 + 2 * outside;

  // The plane evaluated in binary32: a gradient, quotients of products over an area; the value at
  // the image's corner; the value at the sample.
  const double z_range = std::abs(b->z - a->z) + std::abs(c->z - a->z) + 4 * displaced;
  const double shape = width * height / (area - uncertain);
  const double slope_x = g_x + 2 * displaced * height / (area - uncertain);
  const double slope_y = g_y + 2 * displaced * width / (area - uncertain);
  const double gradient =
      8 * u * z_range * shape + (slope_x * width + slope_y * height) * (8 * shape + 4) * u;
  const double evaluated = 8 * u * (depths + slope_x * offset_x + slope_y * offset_y);
  return own_roundings * (spread * displaced + spread * gradient + evaluated);
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

void RasterFragments::set_value(Fragment& f, const Polygon& p, double x, double y) const {
  const DepthPlane& plane = p.plane;
  double z = plane.is_known ? plane.at(x, y) : plane.least;
  if (model_.affine && plane.is_known) z = window_.of_depth(plane.depth_at(x, y));
  double error = plane.error + model_.sample_error * (std::abs(plane.g_x) + std::abs(plane.g_y));
  if (!std::isfinite(z)) error = infinity;
  error += storage_error(z);
  double lower = z - error, upper = z + error;
  if (!(error < infinity)) {
    lower = 0;
    upper = 1;
  }
  f.exact = sign_ * z;
  f.value = sign_ > 0 ? Interval{lower, upper} : Interval{-upper, -lower};
  if (upper < 0 || lower > 1) {  // nearer than near, beyond far
    f.coverage = Coverage::must_not;
    return;
  }
  if (lower < 0 || upper > 1) {
    f.coverage = Coverage::may;
    f.open_edges = joins_no_other;
  }
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

}  // namespace fathom::validation
