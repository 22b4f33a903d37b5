#include "fathom/scene/bounds.h"

#include <algorithm>
#include <cstdint>
#include <limits>
#include <span>
#include <vector>

#include "fathom/geometry/approximate_row.h"
#include "fathom/numeric/standard_arithmetic.h"
#include "fathom/scene/element_checks.h"
#include "fathom/scene/scene_fault.h"

namespace fathom {
using namespace scene;

namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();

/// A part of a list at a time, which is looked at and then read again while it is at hand.
template <class T, class Visit>
void for_each_part(std::span<const T> list, const Visit& visit) {
  constexpr std::size_t part = 1024;
  for (std::size_t first = 0; first < list.size(); first += part)
    visit(list.subspan(first, std::min(part, list.size() - first)));
}

/// 1 for each vertex that something uses: bytes rather than bits, because setting a bit would read
/// its neighbours.
using UsedVertices = std::vector<std::uint8_t>;

void note_used(std::uint32_t vertex, UsedVertices& used) {
  if (vertex >= used.size()) throw ElementFault();
  used[vertex] = 1;
}

/// The vertices that at least one triangle, line or point uses.
UsedVertices used_vertices(const Mesh& mesh) {
  UsedVertices used(mesh.vertices.size());
  for_each_part(std::span(mesh.triangles), [&](std::span<const CornerIndices> part) {
    if (!all_below(part, used.size())) throw ElementFault();
    for (const CornerIndices& triangle : part)
      for (const std::uint32_t corner : triangle) used[corner] = 1;
  });
  for (const auto& line : mesh.lines)
    for (const std::uint32_t end : line) note_used(end, used);
  for (const std::uint32_t point : mesh.points) note_used(point, used);
  return used;
}

void include(WorldBounds& bounds, int axis, const Interval& value) {
  bounds.lower[axis] = std::min(bounds.lower[axis], value.lower);
  bounds.upper[axis] = std::max(bounds.upper[axis], value.upper);
}

void include_as_is(WorldBounds& bounds, const Mesh& mesh, const UsedVertices& used) {
  std::size_t i = 0;
  for_each_part(std::span(mesh.vertices), [&](std::span<const MeshPoint> part) {
    if (!all_finite(part)) throw ElementFault();
    for (const auto& [x, y, z] : part) {
      if (used[i++] == 0) continue;
      include(bounds, 0, {x, x});
      include(bounds, 1, {y, y});
      include(bounds, 2, {z, z});
    }
  });
}

/// Widens one axis of the bounds to the placed vertices: exactly, but only for the vertices that
/// the approximation cannot distinguish from an extreme one.
void include_placed(WorldBounds& bounds, int axis, const Object& object, const Mesh& mesh,
                    const UsedVertices& used) {
  const auto& row = object.world_from_mesh.rows[axis];
  const ApproximateRow approximate(row);
  // The minimum is at most `lowest`, the maximum at least `highest`.
  double lowest = infinity, highest = -infinity;
  for (std::size_t i = 0; i < mesh.vertices.size(); ++i) {
    if (used[i] == 0) continue;
    const Interval value = approximate.at(mesh.vertices[i]);
    lowest = std::min(lowest, value.upper);
    highest = std::max(highest, value.lower);
  }
  for (std::size_t i = 0; i < mesh.vertices.size(); ++i) {
    if (used[i] == 0) continue;
    const MeshPoint& p = mesh.vertices[i];
    const Interval value = approximate.at(p);
    if (value.lower > lowest && value.upper < highest) continue;
    include(bounds, axis, enclose(row[0] * p.x + row[1] * p.y + row[2] * p.z + row[3]));
  }
}

/// Looks at the elements of placed meshes. Throws ElementFault.
std::optional<WorldBounds> bounds_of(const Scene& scene) {
  WorldBounds bounds{{infinity, infinity, infinity}, {-infinity, -infinity, -infinity}};
  bool empty = true;
  for (const Object& object : scene.objects) {
    const Mesh& mesh = scene.meshes[object.mesh];
    if (mesh.is_empty()) continue;
    empty = false;
    const UsedVertices used = used_vertices(mesh);
    if (object.placed_as_is) {
      include_as_is(bounds, mesh, used);
    } else {
      if (!all_finite(mesh.vertices)) throw ElementFault();
      for (int axis = 0; axis < 3; ++axis) include_placed(bounds, axis, object, mesh, used);
    }
  }
  if (empty) return std::nullopt;
  // −0 and +0 are the same number; return +0.
  for (int axis = 0; axis < 3; ++axis) {
    bounds.lower[axis] += 0.0;
    bounds.upper[axis] += 0.0;
  }
  return bounds;
}

}  // namespace

std::optional<WorldBounds> world_bounds(const Scene& scene) {
  const StandardArithmetic standard;
  require_valid(scene, LookAtElements::later);
  return explaining_faults(scene, [&] { return bounds_of(scene); });
}

}  // namespace fathom
