#include "fathom/area/plane/sheets.h"

#include <algorithm>
#include <optional>
#include <unordered_set>

#include "fathom/threads/interruption.h"

namespace fathom::area {
namespace {

CornerIndices sorted(CornerIndices corners) {
  std::sort(corners.begin(), corners.end());
  return corners;
}

struct HashOfCorners {
  std::size_t operator()(const CornerIndices& corners) const {
    std::uint64_t hash = 0;
    for (const std::uint32_t corner : corners) hash = (hash ^ corner) * 0x9e3779b97f4a7c15U;
    return hash ^ hash >> 32U;
  }
};

/// An edge of a triangle of positive area, from corner k to the next.
struct Edge {
  std::uint64_t ends;  // the lower number first
  std::uint32_t triangle;
  std::uint8_t k;
  bool ascends;
};

}  // namespace

PlaneMesh::PlaneMesh(const ProjectedScene& scene, std::span<const std::uint32_t> numbers)
    : scene_(&scene) {
  keep_first_of_equal(numbers);
  mates_.assign(numbers_.size(), {none, none, none});
  find_mates();
}

void PlaneMesh::keep_first_of_equal(std::span<const std::uint32_t> numbers) {
  std::unordered_set<CornerIndices, HashOfCorners> known;
  known.reserve(numbers.size());
  OccasionalInterruption check;
  for (const std::uint32_t number : numbers) {
    check();
    if (scene_->kind(number) == TriangleKind::absent) continue;
    if (known.insert(sorted(scene_->corners(number))).second) numbers_.push_back(number);
  }
}

void PlaneMesh::find_mates() {
  std::vector<Edge> edges;
  edges.reserve(3 * numbers_.size());
  for (std::uint32_t i = 0; i < size(); ++i) {
    if (!is_regular(i)) continue;
    for (std::uint8_t k = 0; k < 3; ++k) {
      const std::uint32_t from = corners(i)[k], to = corners(i)[(k + 1) % 3];
      const std::uint64_t low = std::min(from, to), high = std::max(from, to);
      edges.push_back({low << 32U | high, i, k, from < to});
    }
  }
  check_interruption();
  std::sort(edges.begin(), edges.end(), [](const Edge& a, const Edge& b) {
    return a.ends != b.ends ? a.ends < b.ends : a.triangle < b.triangle;
  });
  for (std::size_t first = 0; first < edges.size();) {
    std::size_t end = first + 1;
    while (end < edges.size() && edges[end].ends == edges[first].ends) ++end;
    const Edge &a = edges[first], &b = edges[end - 1];
    if (end - first == 2 && a.ascends != b.ascends) {
      mates_[a.triangle][a.k] = b.triangle;
      mates_[b.triangle][b.k] = a.triangle;
    }
    first = end;
  }
}

namespace {

/// Bounds of the values of a form at the corners of a part; unknown if an end is NaN.
Interval values_at_corners(const LinearForm& form, const PlanePart& part) {
  constexpr double infinity = std::numeric_limits<double>::infinity();
  Interval range{infinity, -infinity};
  for (std::size_t k = 0; k < 4; ++k) {
    const BoundedPoint corner = part.corner(k);
    const Interval value = form.enclose_at(corner.u, corner.v);
    if (!(value.lower <= value.upper)) return {-infinity, infinity};
    range = {std::min(range.lower, value.lower), std::max(range.upper, value.upper)};
  }
  return range;
}

/// Bounds of a surface's depth over a part. D is a quotient of affine functions whose divisor is
/// positive, and so monotone along every line: its extremes are at corners.
Interval depth_of_plane(const SurfaceRegion& surface, const PlanePart& part) {
  constexpr double infinity = std::numeric_limits<double>::infinity();
  Interval depth{infinity, -infinity};
  for (std::size_t k = 0; k < 4; ++k) {
    const BoundedPoint corner = part.corner(k);
    const Interval weight = surface.weight.enclose_at(corner.u, corner.v);
    if (!(weight.lower > 0)) return {-infinity, infinity};
    const Interval at = quotient(surface.depth_numerator.enclose_at(corner.u, corner.v), weight);
    if (!(at.lower <= at.upper)) return {-infinity, infinity};
    depth = {std::min(depth.lower, at.lower), std::max(depth.upper, at.upper)};
  }
  return depth;
}

Interval common(const Interval& a, const Interval& b) {
  return {std::max(a.lower, b.lower), std::min(a.upper, b.upper)};
}

}  // namespace

bool misses(const PlaneMesh& mesh, std::uint32_t i, const PlanePart& part) {
  if (!mesh.is_regular(i)) {
    const SurfaceRegion& surface = mesh.scene().kept_surface(mesh.number(i));
    return std::any_of(surface.region.begin(), surface.region.end(), [&](const LinearForm& form) {
      return values_at_corners(form, part).upper < 0;
    });
  }
  const PlaneBox box = mesh.box(i);
  if (box.misses(part)) return true;
  if (box.is_inside(part)) return false;
  for (std::size_t k = 0; k < 3; ++k) {
    if (lies_on_side(part, mesh.point(i, k), mesh.point(i, k + 1), -1)) return true;
  }
  return false;
}

Interval depth_of(const PlaneMesh& mesh, std::uint32_t i) {
  if (!mesh.is_regular(i)) return mesh.scene().kept_surface(mesh.number(i)).depths;
  const CornerIndices& corners = mesh.corners(i);
  const Interval &a = mesh.scene().depth(corners[0]), &b = mesh.scene().depth(corners[1]),
                 &c = mesh.scene().depth(corners[2]);
  return {std::min({a.lower, b.lower, c.lower}), std::max({a.upper, b.upper, c.upper})};
}

// The plane's depth at the part's corners gives tighter bounds than the corners of the triangle
// only if the triangle is larger than the part.
Interval depth_in(const PlaneMesh& mesh, std::uint32_t i, const PlanePart& part) {
  const Interval of_corners = depth_of(mesh, i);
  if (!mesh.is_regular(i)) {
    const SurfaceRegion& surface = mesh.scene().kept_surface(mesh.number(i));
    return common(of_corners, depth_of_plane(surface, part));
  }
  const PlaneBox box = mesh.box(i);
  const bool is_larger = box.right - box.left > part.right - part.left &&
                         box.bottom - box.top > part.bottom - part.top;
  if (!is_larger || of_corners.lower == of_corners.upper) return of_corners;
  return common(of_corners, depth_of_plane(mesh.scene().surface(mesh.number(i)), part));
}

bool SheetFinder::is_in_list(std::uint32_t triangle,
                             std::span<const std::uint32_t> triangles) const {
  if (triangle == PlaneMesh::none) return false;
  const std::uint32_t place = place_[triangle];
  return place < triangles.size() && triangles[place] == triangle;
}

std::vector<Sheet> SheetFinder::sheets(const PlanePart& part,
                                       std::span<const std::uint32_t> triangles) {
  for (std::uint32_t place = 0; place < triangles.size(); ++place) {
    place_[triangles[place]] = place;
  }
  std::vector<Sheet> result;
  std::vector<bool> is_taken(triangles.size());
  for (std::uint32_t first = 0; first < triangles.size(); ++first) {
    if (is_taken[first]) continue;
    Sheet& sheet = result.emplace_back();
    sheet.members.push_back(first);
    is_taken[first] = true;
    for (std::size_t next = 0; next < sheet.members.size(); ++next) {
      const std::uint32_t triangle = triangles[sheet.members[next]];
      for (std::size_t k = 0; k < 3; ++k) {
        const std::uint32_t mate = mesh_.mate(triangle, k);
        if (!is_in_list(mate, triangles) || is_taken[place_[mate]]) continue;
        is_taken[place_[mate]] = true;
        sheet.members.push_back(place_[mate]);
      }
    }
    if (is_closed(part, triangles, sheet)) sheet.count = count(part, triangles, sheet);
  }
  return result;
}

bool SheetFinder::is_closed(const PlanePart& part, std::span<const std::uint32_t> triangles,
                            const Sheet& sheet) const {
  return std::all_of(sheet.members.begin(), sheet.members.end(), [&](std::uint32_t place) {
    const std::uint32_t i = triangles[place];
    if (!mesh_.is_regular(i)) {
      const SurfaceRegion& surface = mesh_.scene().kept_surface(mesh_.number(i));
      return std::all_of(surface.region.begin(), surface.region.end(), [&](const LinearForm& form) {
        return values_at_corners(form, part).lower >= 0;
      });
    }
    for (std::size_t k = 0; k < 3; ++k) {
      if (is_in_list(mesh_.mate(i, k), triangles)) continue;
      if (!misses(part, mesh_.point(i, k), mesh_.point(i, k + 1))) return false;
    }
    return true;
  });
}

/// In how many triangles of a closed sheet a point lies; nullopt if it may lie on an edge.
static std::optional<std::uint32_t> count_at(const PlaneMesh& mesh, const BoundedPoint& at,
                                             std::span<const std::uint32_t> triangles,
                                             const Sheet& sheet) {
  const PlanePart place{at.u, at.v, at.u, at.v};
  std::uint32_t count = 0;
  for (const std::uint32_t member : sheet.members) {
    const std::uint32_t i = triangles[member];
    // A closed sheet of forms is the whole part.
    if (!mesh.is_regular(i)) return 1;
    if (mesh.box(i).misses(place)) continue;
    int inside = 0, least = 1;
    for (std::size_t k = 0; k < 3; ++k) {
      const int side = certain_side(mesh.point(i, k), mesh.point(i, k + 1), at);
      inside += side == 1;
      least = std::min(least, side);
    }
    if (least < 0) continue;
    if (inside < 3) return std::nullopt;
    ++count;
  }
  return count;
}

std::uint32_t SheetFinder::count(const PlanePart& part, std::span<const std::uint32_t> triangles,
                                 const Sheet& sheet) const {
  // No place is better than another; a point of few bits is more often on an edge.
  constexpr std::array<std::array<double, 2>, 4> places{
      {{0.4871, 0.5193}, {0.6127, 0.3719}, {0.2713, 0.6491}, {0.8311, 0.8237}}};
  for (const auto& [x, y] : places) {
    const BoundedPoint at{part.left + x * (part.right - part.left),
                          part.top + y * (part.bottom - part.top), 0};
    if (const auto count = count_at(mesh_, at, triangles, sheet)) return *count;
  }
  return 0;
}

}  // namespace fathom::area
