#include "tests/evaluation/rational_judge.h"

#include <CGAL/Gmpq.h>
#include <CGAL/Simple_cartesian.h>
#include <CGAL/squared_distance_3.h>

#include <array>
#include <bit>
#include <cmath>
#include <cstdint>
#include <optional>

#include "fathom/numeric/rounding.h"
#include "fathom/scene/triangle_source.h"

namespace fathom::evaluation::test {
namespace {

using Rational = CGAL::Gmpq;
using Kernel = CGAL::Simple_cartesian<Rational>;
using Vector3 = std::array<Rational, 3>;
using Corners = std::array<Vector3, 3>;

Vector3 minus(const Vector3& a, const Vector3& b) {
  return {a[0] - b[0], a[1] - b[1], a[2] - b[2]};
}
Rational dot(const Vector3& a, const Vector3& b) {
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}
Vector3 cross(const Vector3& a, const Vector3& b) {
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}

/// All triangles of a scene whose objects are placed as they are.
std::vector<Corners> triangles_of(const Scene& scene) {
  std::vector<Corners> triangles;
  for (const Object& object : scene.objects) {
    const Mesh& mesh = scene.meshes[object.mesh];
    for (const CornerIndices& indices : mesh.triangles) {
      Corners corners;
      for (std::size_t i = 0; i < 3; ++i) {
        const MeshPoint& p = mesh.vertices[indices[i]];
        corners[i] = {Rational(p.x), Rational(p.y), Rational(p.z)};
      }
      triangles.push_back(corners);
    }
  }
  return triangles;
}

Vector3 place_of(const Corners& corners, const SurfacePoint& point) {
  Vector3 place;
  for (std::size_t k = 0; k < 3; ++k)
    place[k] = corners[0][k] + Rational(point.v) * (corners[1][k] - corners[0][k]) +
               Rational(point.w) * (corners[2][k] - corners[0][k]);
  return place;
}

Vector3 exactly(const std::array<double, 3>& v) {
  return {Rational(v[0]), Rational(v[1]), Rational(v[2])};
}

Vector3 in_camera(const Camera& camera, const Vector3& X) {
  Vector3 p;
  for (std::size_t i = 0; i < 3; ++i) {
    const auto& row = camera.world_to_camera[i];
    p[i] = dot({Rational(row[0]), Rational(row[1]), Rational(row[2])}, X) + Rational(row[3]);
  }
  return p;
}

bool is_in_image(const Camera& camera, const Vector3& p) {
  const bool perspective = is_perspective(camera.projection);
  const Rational w = perspective ? p[2] : Rational(1);
  const Rational half_less_centre = Rational(0.5) - Rational(camera.projection.pixel_centre);
  const Rational u =
      (Rational(camera.projection.fx) * p[0] + Rational(camera.projection.skew) * p[1]) / w +
      Rational(camera.projection.cx) + half_less_centre;
  const Rational v =
      Rational(camera.projection.fy) * p[1] / w + Rational(camera.projection.cy) + half_less_centre;
  return u >= 0 && u <= Rational(camera.width) && v >= 0 && v <= Rational(camera.height);
}

bool is_in_range(const Camera& camera, const Rational& depth) {
  return depth > 0 && depth >= Rational(camera.near) &&
         (std::isinf(camera.far) || depth <= Rational(camera.far));
}

/// A plane in the camera's frame, and what the camera sees of its side.
struct Plane {
  Vector3 corner, normal;
  bool edge_on, front;
};

Plane plane_of(const Camera& camera, const Corners& c) {
  const bool perspective = is_perspective(camera.projection);
  Plane plane{c[0], cross(minus(c[1], c[0]), minus(c[2], c[0])), false, false};
  const Rational towards = perspective ? dot(plane.normal, plane.corner) : plane.normal[2];
  const bool mirrored = (camera.projection.fx > 0) != (camera.projection.fy > 0);
  plane.edge_on = towards == 0;
  plane.front = (towards < 0) != mirrored;
  return plane;
}

bool is_kept(const Plane& plane, Cull cull) {
  return !plane.edge_on && (cull == Cull::none || plane.front == (cull == Cull::back));
}

/// Where the line of sight through p meets a plane that it does not see edge on.
std::optional<Vector3> met(const Camera& camera, const Plane& plane, const Vector3& p) {
  const Rational away = dot(plane.normal, plane.corner);
  if (is_orthographic(camera.projection)) {
    const Rational z = (away - plane.normal[0] * p[0] - plane.normal[1] * p[1]) / plane.normal[2];
    return Vector3{p[0], p[1], z};
  }
  const Rational along = dot(plane.normal, p);
  if (along == 0) return std::nullopt;
  const Rational s = away / along;
  return Vector3{s * p[0], s * p[1], s * p[2]};
}

bool is_inside(const Corners& c, const Vector3& normal, const Vector3& hit) {
  for (std::size_t i = 0; i < 3; ++i) {
    const Vector3 turn = cross(minus(c[(i + 1) % 3], c[i]), minus(hit, c[i]));
    if (dot(turn, normal) < 0) return false;
  }
  return true;
}

Kernel::Point_3 point_of(const Vector3& p) {
  return {p[0], p[1], p[2]};
}

/// The nearest of the doubles around; a tie goes to the even one.
double rounded(const Rational& x) {
  const double near = CGAL::to_double(x);
  double best = near;
  Rational least = CGAL::abs(x - Rational(near));
  for (const double other : {std::nextafter(near, 0.0), std::nextafter(near, HUGE_VAL)}) {
    const Rational distance = CGAL::abs(x - Rational(other));
    const bool is_even = std::bit_cast<std::uint64_t>(other) % 2 == 0;
    if (!(distance < least || (distance == least && is_even))) continue;
    best = other;
    least = distance;
  }
  return best;
}

}  // namespace

bool is_seen(const Scene& scene, const SightPoint& point, const Camera& camera, Cull cull) {
  std::vector<Corners> triangles = triangles_of(scene);
  const auto* const on_surface = std::get_if<SurfacePoint>(&point);
  const Vector3 place = on_surface ? place_of(triangles[on_surface->triangle], *on_surface)
                                   : exactly(std::get<std::array<double, 3>>(point));
  const Vector3 p = in_camera(camera, place);
  for (Corners& corners : triangles)
    for (Vector3& corner : corners) corner = in_camera(camera, corner);
  if (!is_in_range(camera, p[2]) || !is_in_image(camera, p)) return false;
  if (on_surface && !is_kept(plane_of(camera, triangles[on_surface->triangle]), cull)) return false;
  for (const Corners& corners : triangles) {
    const Plane plane = plane_of(camera, corners);
    if (!is_kept(plane, cull)) continue;
    const auto hit = met(camera, plane, p);
    if (hit && is_in_range(camera, (*hit)[2]) && (*hit)[2] < p[2] &&
        is_inside(corners, plane.normal, *hit))
      return false;
  }
  return true;
}

double squared_distance(const Scene& scene, const SurfacePoint& point, const Scene& other) {
  const Vector3 p = place_of(triangles_of(scene)[point.triangle], point);
  std::optional<Rational> least;
  for (const Corners& c : triangles_of(other)) {
    const Kernel::Triangle_3 triangle(point_of(c[0]), point_of(c[1]), point_of(c[2]));
    const Rational squared = CGAL::squared_distance(point_of(p), triangle);
    if (!least || squared < *least) least = squared;
  }
  return rounded(*least);
}

}  // namespace fathom::evaluation::test
