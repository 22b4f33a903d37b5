#include "fathom/area/coplanar.h"

#include <algorithm>
#include <limits>
#include <optional>

#include "fathom/area/cell_coverage.h"
#include "fathom/area/image_cell.h"
#include "fathom/area/surface_pairs.h"
#include "fathom/area/visible_fragments.h"
#include "fathom/failures/errors.h"
#include "fathom/numeric/standard_arithmetic.h"
#include "fathom/scene/scene_fault.h"
#include "fathom/threads/threads.h"

// How to read this file: start with coplanar_pairs() at the end. For each triangle, within its box,
// each nearby triangle is tested: does it lie close behind the first where the first is visible?
// Pairs that pass are tested again in each pixel.
namespace fathom {
using namespace area;
using namespace triangle;

namespace {

template <class Point>
bool share_a_corner(const std::array<Point, 3>& a, const std::array<Point, 3>& b) {
  for (const Point& p : a) {
    for (const Point& q : b) {
      if (p.x == q.x && p.y == q.y && p.z == q.z) return true;
    }
  }
  return false;
}

/// Whether two triangles share the position of a corner. Most of those near each other are
/// neighbours in a mesh, so the corners of the meshes are compared first: equal ones of one object
/// have one position, and where both objects are placed as they are, they are the positions.
bool share_a_corner(const TriangleSource& triangles, std::uint32_t a, std::uint32_t b) {
  const TriangleSource::Triangle first = triangles.triangle(a), second = triangles.triangle(b);
  const auto is_as_placed = [&](const TriangleSource::Triangle& t) {
    return triangles.objects()[t.origin.object].placed_as_is;
  };
  const bool are_positions = is_as_placed(first) && is_as_placed(second);
  if (are_positions || first.origin.object == second.origin.object) {
    if (share_a_corner(first.corners, second.corners)) return true;
    if (are_positions) return false;
  }
  return share_a_corner(triangles.world_corners(a), triangles.world_corners(b));
}

/// Whether a triangle is certainly on the outer side of an edge of another one, so that they have
/// no area in common: by enclosures of its corners, if all are in front of the camera.
bool is_certainly_beyond_an_edge(const SurfaceRegion& triangle, const SurfaceRegion& of) {
  const auto& corners = triangle.corners;
  const auto is_in_front = [](const SurfaceCorner& corner) {
    return corner.enclosure[2].lower > 0;
  };
  if (!std::ranges::all_of(corners, is_in_front)) return false;
  return std::any_of(of.region.begin(), of.region.begin() + 3, [&](const LinearForm& edge) {
    return std::ranges::all_of(corners, [&](const SurfaceCorner& corner) {
      return edge.enclose_at(corner.enclosure).upper <= 0;
    });
  });
}

/// Whether a depth is certainly more than `within` behind another one.
bool is_farther(double depth, double than, double within) {
  // The difference is rounded, by less than this factor.
  return (depth - than) * (1 - 0x1p-50) > within;
}

/// A triangle within its box, and its visible part.
class VisibleTriangle {
 public:
  VisibleTriangle(const SceneSurfaces& surfaces, std::uint32_t number)
      : surfaces_(surfaces),
        number_(number),
        cell_(cell_of(surfaces.box(number))),
        visibility_(cell_),
        is_in_cell_(visibility_.add(surface())) {}

  /// The area that both triangles cover and in which this triangle is visible, as convex polygons.
  /// Empty if the other triangle is nowhere behind it, or certainly farther than `within`. If they
  /// are equally deep, the other triangle must have the higher number; `other_in_front` is
  /// in_front() of both.
  std::vector<ConvexPolygon> visible_before(std::uint32_t other, const LinearForm& other_in_front,
                                            double within) {
    const auto both = before(other, other_in_front);
    if (!both || is_certainly_apart(*both, other, within)) return {};
    std::vector<ConvexPolygon> result;
    for (ConvexPolygon part : visible()) {
      if (cell_.all().clip(part, *both, counts_)) result.push_back(std::move(part));
    }
    return result;
  }

  /// Whether the separation of both is at most `within` over an area.
  static bool is_close(const Separation& separation, const Boundary& boundary, double within) {
    if (boundary.empty()) return false;
    return separation.is_below(boundary, within) || separation.is_constantly(within);
  }

  [[nodiscard]] const SurfaceRegion& surface() const { return *surfaces_.surface(number_); }
  [[nodiscard]] ImageCell& cell() { return cell_; }

 private:
  /// The points that both triangles cover, with this triangle in front or equally deep.
  std::optional<ConvexPolygon> before(std::uint32_t other, const LinearForm& other_in_front) {
    if (!is_in_cell_) return std::nullopt;
    const auto piece = cell_.clip(surfaces_.surface(other)->region, counts_);
    ConvexPolygon part = visibility_.polygon(0);
    if (!piece || !cell_.all().clip(part, piece->polygon, counts_)) return std::nullopt;
    if (other_in_front.is_zero()) return part;
    return cell_.clip(part, -other_in_front, counts_);
  }

  /// D is monotone along lines: in a polygon it lies between its values at the corners.
  [[nodiscard]] bool is_certainly_apart(const ConvexPolygon& polygon, std::uint32_t other,
                                        double within) const {
    const CellDepths front(cell_, surface()), behind(cell_, *surfaces_.surface(other));
    constexpr double infinity = std::numeric_limits<double>::infinity();
    double greatest = -infinity, least = infinity;
    for (std::size_t k = 0; k < polygon.edges().size(); ++k) {
      const HalfPlane& edge = *polygon.edges()[k];
      greatest = std::max(greatest, front.enclose_at(edge, polygon.after(k)).upper);
      least = std::min(least, behind.enclose_at(edge, polygon.after(k)).lower);
    }
    return is_farther(least, greatest, within);
  }

  /// The visible part of the triangle; computed on first use.
  const std::vector<ConvexPolygon>& visible() {
    if (!visible_) visible_ = find_visible();
    return *visible_;
  }

  std::vector<ConvexPolygon> find_visible() {
    std::vector<ConvexPolygon> result;
    CoveredParts hidden(cell_, visibility_.polygon(0));
    for (const std::uint32_t other : surfaces_.in_front(number_)) {
      if (!surfaces_.is_first(other)) continue;
      const auto part = visibility_.add_if_it_hides(*surfaces_.surface(other), 0);
      if (!part) continue;
      if (!hidden.add(*part)) visibility_.drop_last();
      if (hidden.is_all()) return result;
    }
    divide(visibility_, [&](CellVisibility& part) {
      for (std::size_t piece = 0; piece < part.size(); ++piece) {
        if (&part.surface(piece) != &surface()) continue;
        for (ConvexPolygon& polygon : part.visible_polygons(piece)) {
          result.push_back(std::move(polygon));
        }
      }
    });
    return result;
  }

  const SceneSurfaces& surfaces_;
  std::uint32_t number_;
  ImageCell cell_;
  /// The triangle, and the triangles that hide a part of it.
  CellVisibility visibility_;
  bool is_in_cell_;
  std::optional<std::vector<ConvexPolygon>> visible_;
  TierCounts counts_;
};

Boundary boundary_of(const std::vector<ConvexPolygon>& polygons) {
  Boundary boundary;
  for (const ConvexPolygon& polygon : polygons) {
    const Boundary its = area::boundary_of(polygon);
    boundary.insert(boundary.end(), its.begin(), its.end());
  }
  return boundary;
}

/// The polygons between two parallel sides.
std::vector<ConvexPolygon> between(const std::vector<ConvexPolygon>& polygons,
                                   const HalfPlane& first, const HalfPlane& second) {
  std::vector<ConvexPolygon> result;
  TierCounts counts;
  for (ConvexPolygon part : polygons) {
    if (part.clip(first, counts) && part.clip(second, counts)) result.push_back(std::move(part));
  }
  return result;
}

class PairFinder {
 public:
  PairFinder(const CoverageFrame& frame, double within, Progress& progress)
      : triangles_(frame.triangles), surfaces_(frame, progress), within_(within) {}

  [[nodiscard]] std::uint32_t count() const { return surfaces_.count(); }

  /// The pairs whose visible triangle is t.
  [[nodiscard]] std::vector<CoplanarPair> pairs_of(std::uint32_t t) const {
    const SurfaceRegion* const surface = surfaces_.surface(t);
    if (surface == nullptr || !surfaces_.is_first(t)) return {};
    std::optional<VisibleTriangle> triangle;  // most triangles need none
    std::vector<CoplanarPair> found;
    for (const std::uint32_t s : surfaces_.near(t)) {
      const SurfaceRegion& other = *surfaces_.surface(s);
      if (are_certainly_apart(*surface, other)) continue;
      if (share_a_corner(triangles_, t, s)) continue;
      if (is_certainly_beyond_an_edge(other, *surface) ||
          is_certainly_beyond_an_edge(*surface, other))
        continue;
      const LinearForm other_in_front = in_front(other, *surface);
      if (within_ == 0 && !other_in_front.is_zero()) continue;
      // Equally deep, but hidden by the other.
      if (other_in_front.is_zero() && s < t) continue;
      if (!triangle) triangle.emplace(surfaces_, t);
      const std::vector<ConvexPolygon> polygons =
          triangle->visible_before(s, other_in_front, within_);
      const Boundary boundary = boundary_of(polygons);
      if (boundary.empty()) continue;
      const Separation separation(triangle->cell(), *surface, other);
      if (!VisibleTriangle::is_close(separation, boundary, within_)) continue;
      CoplanarPair pair{t, s, separation.least(boundary), 0, {}};
      count_pixels(pair, polygons, separation);
      found.push_back(pair);
    }
    return found;
  }

 private:
  /// The pixels in which the separation is small over an area of the polygons, whose coordinates
  /// begin at the corner of the box of the visible triangle.
  void count_pixels(CoplanarPair& pair, const std::vector<ConvexPolygon>& polygons,
                    const Separation& separation) const {
    const PixelBox& a = surfaces_.box(pair.visible);
    const PixelBox& b = surfaces_.box(pair.behind);
    const std::uint32_t first_column = std::max(a.first_column, b.first_column);
    const std::uint32_t last_column = std::min(a.last_column, b.last_column);
    for (std::uint32_t row = std::max(a.first_row, b.first_row);
         row <= std::min(a.last_row, b.last_row); ++row) {
      const double top = row - a.first_row;
      const HalfPlane below({0.0, 1.0, -top}), above({0.0, -1.0, top + 1});
      const std::vector<ConvexPolygon> in_row = between(polygons, below, above);
      if (in_row.empty()) continue;
      for (std::uint32_t column = first_column; column <= last_column; ++column) {
        const double left = column - a.first_column;
        const HalfPlane after({1.0, 0.0, -left}), before({-1.0, 0.0, left + 1});
        const Boundary boundary = boundary_of(between(in_row, after, before));
        if (VisibleTriangle::is_close(separation, boundary, within_)) add_pixel(pair, column, row);
      }
    }
  }

  /// Whether the second triangle is nowhere behind the first, or everywhere farther behind it than
  /// counts.
  [[nodiscard]] bool are_certainly_apart(const SurfaceRegion& front,
                                         const SurfaceRegion& behind) const {
    if (behind.depths.upper < front.depths.lower) return true;
    return is_farther(behind.depths.lower, front.depths.upper, within_);
  }

  static void add_pixel(CoplanarPair& pair, std::uint32_t column, std::uint32_t row) {
    PixelBox& box = pair.box;
    if (pair.pixels == 0) box = {column, column, row, row};
    ++pair.pixels;
    box.first_column = std::min(box.first_column, column);
    box.last_column = std::max(box.last_column, column);
    box.first_row = std::min(box.first_row, row);
    box.last_row = std::max(box.last_row, row);
  }

  TriangleSource triangles_;
  SceneSurfaces surfaces_;
  double within_;
};

}  // namespace

std::vector<CoplanarPair> coplanar_pairs(const TriangleSource& triangles, const Camera& camera,
                                         double within, const RenderOptions& options,
                                         const std::function<void(double)>& progress) {
  const StandardArithmetic standard;
  if (!(within >= 0) || !std::isfinite(within)) {
    throw UsageError(Setting{"within"}, "expected a distance of 0 or more");
  }
  return with_threads(options.threads, [&] {
    require_renderable(triangles, camera);
    constexpr std::uint32_t chunk = 8;
    const std::uint32_t chunks = triangles.count() / chunk + 1;
    Progress done(progress, SceneSurfaces::parts(triangles.count()) + chunks);
    const PairFinder finder({triangles, camera, options.cull}, within, done);
    std::vector<std::vector<CoplanarPair>> found(finder.count());
    parallel_for(std::uint32_t{0}, chunks, [&](std::uint32_t k) {
      const std::uint32_t end = std::min(finder.count(), (k + 1) * chunk);
      for (std::uint32_t t = k * chunk; t < end; ++t) found[t] = finder.pairs_of(t);
      done.part_done();
    });
    std::vector<CoplanarPair> all;
    for (const auto& pairs : found) all.insert(all.end(), pairs.begin(), pairs.end());
    return all;
  });
}

}  // namespace fathom
