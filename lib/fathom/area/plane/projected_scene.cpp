#include "fathom/area/plane/projected_scene.h"

#include <algorithm>
#include <cmath>
#include <mutex>
#include <unordered_map>

#include "fathom/mesh/object.h"
#include "fathom/threads/interruption.h"

namespace fathom::area {
using namespace triangle;

namespace {

constexpr std::uint32_t triangles_of_chunk = 4096;
/// The number of triangles of a file that are in memory at the same time.
constexpr std::uint32_t triangles_in_memory = 1U << 20U;

/// A point, which is not finite if the quotient is unknown.
BoundedPoint bounded_point(const Interval& U, const Interval& V, const Interval& W) {
  const Interval x = quotient(U, W), y = quotient(V, W);
  const BoundedPoint p{x.lower / 2 + x.upper / 2, y.lower / 2 + y.upper / 2, 0};
  const double error = std::max({x.upper - p.u, p.u - x.lower, y.upper - p.v, p.v - y.lower});
  // Each difference is rounded once.
  return {p.u, p.v, error * (1 + 0x1p-50) + 0x1p-1000};
}

bool is_known(const BoundedPoint& p) {
  return std::isfinite(p.u) && std::isfinite(p.v) && std::isfinite(p.error);
}

}  // namespace

/// Numbers for places, by their exact coordinates.
class ProjectedScene::VertexNumbers {
 public:
  explicit VertexNumbers(ProjectedScene& scene) : scene_(scene) {}

  std::uint32_t of(ExactVertex&& vertex, const BoundedPoint& point, const Interval& depth) {
    const std::size_t hash =
        (hash_of(vertex.U) * 31 + hash_of(vertex.V)) * 31 + hash_of(vertex.depth);
    const auto [first, end] = by_hash_.equal_range(hash);
    for (auto other = first; other != end; ++other) {
      const ExactVertex& its = scene_.vertices_[other->second];
      if (its.U == vertex.U && its.V == vertex.V && its.depth == vertex.depth) {
        return other->second;
      }
    }
    const auto number = static_cast<std::uint32_t>(scene_.vertices_.size());
    by_hash_.emplace(hash, number);
    scene_.vertices_.push_back(std::move(vertex));
    scene_.points_.push_back(point);
    scene_.depths_.push_back(depth);
    return number;
  }

 private:
  ProjectedScene& scene_;
  std::unordered_multimap<std::size_t, std::uint32_t> by_hash_;
};

namespace {

std::uint64_t chunks_of(const TriangleSource& triangles) {
  return triangles.count() / triangles_of_chunk + 1;
}

/// Reports the share of `steps` that piece number `piece` of `pieces` is.
void report_piece(Progress& progress, std::uint64_t steps, std::uint64_t piece,
                  std::uint64_t pieces) {
  for (std::uint64_t k = steps * piece / pieces; k < steps * (piece + 1) / pieces; ++k) {
    progress.part_done();
  }
}

}  // namespace

/// Transforming vertices, numbering them and classifying triangles take about as long.
std::uint64_t ProjectedScene::parts(const TriangleSource& triangles) {
  return 2 * (triangles.count() / triangles_of_chunk) + chunks_of(triangles);
}

ProjectedScene::ProjectedScene(const CoverageFrame& frame, Progress& progress)
    : is_perspective_(is_perspective(frame.camera.projection)),
      image_{0, 0, static_cast<double>(frame.camera.width),
             static_cast<double>(frame.camera.height)},
      corners_(frame.triangles.count()),
      kinds_(frame.triangles.count(), TriangleKind::absent),
      orientations_(frame.triangles.count(), Sign::zero) {
  {
    VertexNumbers numbers(*this);
    frame.triangles.for_each_part(triangles_in_memory, [&](const TriangleSource::Part& part) {
      add_part(frame, part, numbers, progress);
    });
  }
  parallel_for(std::uint64_t{0}, chunks_of(frame.triangles), [&](std::uint64_t k) {
    const auto end = std::min<std::uint64_t>(count(), (k + 1) * triangles_of_chunk);
    for (std::uint64_t number = k * triangles_of_chunk; number < end; ++number) {
      check_interruption();
      const CornerIndices& its = corners_[number];
      const bool has_area = its[0] != its[1] && its[1] != its[2] && its[2] != its[0];
      if (has_area) classify(frame, static_cast<std::uint32_t>(number));
    }
    progress.part_done();
  });
  for (std::uint32_t number = 0; number < count(); ++number) {
    if (kinds_[number] != TriangleKind::by_forms) continue;
    check_interruption();
    TierCounts counts;
    const ProjectedTriangle t =
        project(frame.triangles.world_corners(number), number, frame.camera, counts);
    std::optional<SurfaceRegion> surface;
    if (t.orientation != Sign::zero && is_kept(t, frame.cull)) {
      surface = surface_region(t, frame.camera);
    }
    if (surface) {
      orientations_[number] = t.orientation;
      by_forms_.emplace(number, std::move(*surface));
    } else {
      kinds_[number] = TriangleKind::absent;
    }
  }
}

void ProjectedScene::add_part(const CoverageFrame& frame, const TriangleSource::Part& part,
                              VertexNumbers& numbers, Progress& progress) {
  const std::size_t count = part.mesh.vertices.size();
  const std::size_t chunks = count / triangles_of_chunk + 1;
  const std::uint64_t end = part.first_number + part.mesh.triangles.size();
  const std::uint64_t steps = end / triangles_of_chunk - part.first_number / triangles_of_chunk;
  std::vector<ExactVertex> exact(count);
  std::vector<BoundedPoint> points(count);
  std::vector<Interval> depths(count);
  const Camera& camera = frame.camera;
  in_parallel(chunks, [&](std::size_t k) {
    for (std::size_t i = k * triangles_of_chunk; i < std::min(count, (k + 1) * triangles_of_chunk);
         ++i) {
      check_interruption();
      CameraPoint p =
          to_camera(camera.world_to_camera, to_world(part.object, part.mesh.vertices[i]));
      depths[i] = enclose(p.z);
      HomogeneousImagePoint image = to_image(camera.projection, p);
      points[i] = bounded_point(enclose(image.U), enclose(image.V), enclose(image.W));
      exact[i] = {std::move(image.U), std::move(image.V), std::move(p.z)};
    }
    report_piece(progress, steps, k, chunks);
  });
  std::vector<std::uint32_t> number_of(count);
  for (std::size_t i = 0; i < count; ++i) {
    check_interruption();
    number_of[i] = numbers.of(std::move(exact[i]), points[i], depths[i]);
    report_piece(progress, steps, i, count);
  }
  std::uint32_t number = part.first_number;
  for (const CornerIndices& triangle : part.mesh.triangles) {
    for (std::size_t k = 0; k < 3; ++k) corners_[number][k] = number_of[triangle[k]];
    ++number;
  }
}

ExactVector3 ProjectedScene::homogeneous(std::uint32_t vertex) const {
  const ExactVertex& v = vertices_[vertex];
  return {v.U, v.V, is_perspective_ ? v.depth : Dyadic(1.0)};
}

ExactVector3 ProjectedScene::line_through(std::uint32_t from, std::uint32_t to) const {
  if (is_perspective_) return cross(homogeneous(from), homogeneous(to));
  const ExactVertex &p = vertices_[from], &q = vertices_[to];
  return {p.V - q.V, q.U - p.U, p.U * q.V - p.V * q.U};
}

Sign ProjectedScene::orientation(std::uint32_t number) const {
  if (kinds_[number] != TriangleKind::absent) return orientations_[number];
  const CornerIndices& its = corners_[number];
  return determinant(homogeneous(its[0]), homogeneous(its[1]), homogeneous(its[2])).sign();
}

Sign ProjectedScene::orientation_of(const CornerIndices& corners) const {
  const int side = certain_side(points_[corners[0]], points_[corners[1]], points_[corners[2]]);
  if (side != 0) return sign_of(side);
  return determinant(homogeneous(corners[0]), homogeneous(corners[1]), homogeneous(corners[2]))
      .sign();
}

void ProjectedScene::classify(const CoverageFrame& frame, std::uint32_t number) {
  CornerIndices& its = corners_[number];
  const Camera& camera = frame.camera;
  bool regular = true;
  int behind = 0;
  for (const std::uint32_t vertex : its) {
    const Interval& depth = depths_[vertex];
    if (depth.upper < 0 || depth.upper < camera.near) ++behind;
    regular &= depth.lower > 0 && depth.lower >= camera.near && depth.upper <= camera.far &&
               is_known(points_[vertex]);
  }
  if (behind == 3) return;
  if (!regular) {
    kinds_[number] = TriangleKind::by_forms;
    return;
  }
  const Sign turn = orientation_of(its);
  if (turn == Sign::zero) return;
  if (frame.cull == (turn == Sign::negative ? Cull::front : Cull::back)) return;
  orientations_[number] = turn;
  if (turn == Sign::negative) std::swap(its[1], its[2]);
  kinds_[number] = TriangleKind::regular;
}

SurfaceRegion ProjectedScene::surface(std::uint32_t number) const {
  if (kinds_[number] == TriangleKind::by_forms) return by_forms_.at(number);
  const CornerIndices& its = corners_[number];
  SurfaceRegion surface;
  surface.number = number;
  constexpr double infinity = std::numeric_limits<double>::infinity();
  surface.depths = {infinity, -infinity};
  for (std::size_t i = 0; i < 3; ++i) {
    ExactVector3 point = homogeneous(its[i]);
    const std::array<Interval, 3> enclosure{enclose(point[0]), enclose(point[1]),
                                            enclose(point[2])};
    surface.corners[i] = {std::move(point), enclosure};
    surface.depths.lower = std::min(surface.depths.lower, depths_[its[i]].lower);
    surface.depths.upper = std::max(surface.depths.upper, depths_[its[i]].upper);
  }
  ExactVector3 weight, depth;
  for (std::size_t i = 0; i < 3; ++i) {
    ExactVector3 edge =
        cross(surface.corners[(i + 1) % 3].point, surface.corners[(i + 2) % 3].point);
    for (std::size_t k = 0; k < 3; ++k) {
      weight[k] += edge[k];
      depth[k] += vertices_[its[i]].depth * edge[k];
    }
    surface.region.emplace_back(std::move(edge));
  }
  surface.weight = LinearForm(std::move(weight));
  surface.depth_numerator = LinearForm(std::move(depth));
  return surface;
}

TriangleExtent ProjectedScene::extent(std::uint32_t number) const {
  if (kinds_[number] == TriangleKind::absent) return TriangleExtent::none;
  if (kinds_[number] == TriangleKind::by_forms) return TriangleExtent::elsewhere;
  const auto& [a, b, c] = corners_[number];
  const PlaneBox box(points_[a], points_[b], points_[c]);
  if (box.misses(image_)) return TriangleExtent::none;
  return box.is_inside(image_) ? TriangleExtent::within_image : TriangleExtent::elsewhere;
}

// With the corners a, b, c on the plane, (b − a) × (c − a) = det(a, b, c) of their homogeneous
// coordinates over the product of their weights.
Ratio ProjectedScene::own_area(std::uint32_t number) const {
  const CornerIndices& its = corners_[number];
  const ExactVector3 a = homogeneous(its[0]), b = homogeneous(its[1]), c = homogeneous(its[2]);
  return {determinant(a, b, c), (a[2] * b[2] * c[2]).scaled(1)};
}

}  // namespace fathom::area
