#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <optional>
#include <vector>

#include "fathom/attribution/fragment.h"
#include "fathom/attribution/model/renderer_model.h"
#include "fathom/attribution/model/sample_grid.h"
#include "fathom/attribution/raster/raster_polygon.h"

// docs/validation.md, "A rasterizer", "Coverage", derives the bounds in this file.
namespace fathom::attribution {
namespace {

/// An edge of a polygon at a sample: e > 0 inside; the renderer's own e is at most `error` away.
struct EdgeAt {
  double value = 0, error = 0;
};

/// e = (a − s) × (b − s), and the effect of displaced corners on it.
EdgeAt edge_at(const WindowVertex& a, const WindowVertex& b, double x, double y, double spread) {
  const double ax = a.x - x, ay = a.y - y, bx = b.x - x, by = b.y - y;
  const double dax = a.snapped_x + spread, day = a.snapped_y + spread;
  const double dbx = b.snapped_x + spread, dby = b.snapped_y + spread;
  return {ay * bx - ax * by,
          own_roundings * (dax * std::abs(by) + day * std::abs(bx) + dbx * std::abs(ay) +
                           dby * std::abs(ax) + dax * dby + day * dbx)};
}

/// Coverage, open edges and inside of a polygon at a sample; nothing where it is certain not to be
/// covered. `sample_error` in pixels.
std::optional<Fragment> covered(const RasterPolygon& p, double x, double y, double sample_error) {
  Fragment f{.coverage = Coverage::must, .turned = p.turned, .inside = true};
  const bool certain_area =
      p.plane.is_known && p.plane.error < std::numeric_limits<double>::infinity();
  bool one_way = true, other_way = true;  // no edge is certain to exclude the sample
  const std::size_t count = p.corners.size();
  for (std::size_t i = 0; i < count; ++i) {
    const WindowVertex& a = p.corners[i];
    const WindowVertex& b = p.corners[(i + 1) % count];
    if ((a.borders & b.borders) != 0) continue;  // a cut: the border decides
    const EdgeAt e = edge_at(a, b, x, y, sample_error);
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
  // The corners that a polygon lost by cutting are unknown here: it joins no others.
  if (count != 3 && f.coverage == Coverage::may) f.open_edges = joins_no_other;
  return f;
}

/// The facts that hold for both ways to cut a triangle.
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

class RasterFragments final : public FragmentSource {
 public:
  RasterFragments(const WorldMesh& mesh, const Camera& camera, const SamplePosition& sample,
                  const RasterModel& model)
      : mesh_(mesh),
        camera_(camera),
        sample_(sample),
        grid_(camera, sample),
        vertices_(clip_vertices(mesh, camera, model)),
        polygons_(camera, model),
        depth_(camera, model, sample.error) {}

  [[nodiscard]] PixelBox box(std::uint32_t triangle) const override;
  void each(std::uint32_t triangle, const PixelBox& box, const TakeFragment& take) const override;

 private:
  [[nodiscard]] std::array<const ClipVertex*, 3> corners(std::uint32_t triangle) const {
    const CornerIndices& t = mesh_.triangles[triangle];
    return {&vertices_[t[0]], &vertices_[t[1]], &vertices_[t[2]]};
  }
  [[nodiscard]] std::optional<Fragment> on(const RasterPolygon& polygon, double x, double y) const;

  const WorldMesh& mesh_;
  Camera camera_;
  SamplePosition sample_;
  SampleGrid grid_;
  std::vector<ClipVertex> vertices_;
  RasterPolygons polygons_;
  RasterDepth depth_;
};

PixelBox RasterFragments::box(std::uint32_t triangle) const {
  ImageBox box;
  for (const RasterPolygon& p : polygons_.outlines_of(corners(triangle))) {
    if (p.anywhere) return whole_image(camera_);
    for (const WindowVertex& c : p.corners) {
      const double more = sample_.error + grid_.reach();
      box.add(c.x, c.y, c.snapped_x + more, c.snapped_y + more);
    }
  }
  return pixels_of(box, camera_, 1);
}

std::optional<Fragment> RasterFragments::on(const RasterPolygon& p, double x, double y) const {
  if (p.anywhere) {
    Fragment f{.turned = p.turned, .inside = true};
    depth_.set_anything(f);
    return f;
  }
  std::optional<Fragment> f = covered(p, x, y, sample_.error);
  if (!f) return std::nullopt;
  depth_.set(*f, p, x, y);
  if (f->coverage == Coverage::must_not) return std::nullopt;
  return f;
}

void RasterFragments::each(std::uint32_t triangle, const PixelBox& box,
                           const TakeFragment& take) const {
  if (box.is_empty()) return;
  const std::vector<RasterPolygon> found = polygons_.of(corners(triangle));
  if (found.empty()) return;
  for (std::uint32_t row = box.first_row; row <= box.last_row; ++row) {
    for (std::uint32_t column = box.first_column; column <= box.last_column; ++column) {
      const auto [x, y] = grid_.at(column, row);
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
                                                 const SamplePosition& sample,
                                                 const RasterModel& model) {
  return std::make_unique<RasterFragments>(mesh, camera, sample, model);
}

}  // namespace fathom::attribution
