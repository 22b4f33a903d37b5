#include "apps/study/hidden_surface/sight.h"

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <utility>

#include "fathom/geometry/eigen_arrays.h"

namespace fathom::studies {

using geometry::as_array;
using geometry::as_vector;

double volume(const EyePoint& a, const EyePoint& b, const EyePoint& c) {
  if (b < a) return -volume(b, a, c);
  return geometry::dot_from_left(as_vector(a).cross(as_vector(b)), as_vector(c));
}

EyePoint ray_at(const Camera& camera, double x, double y) {
  return {(x - camera.projection.cx) / camera.projection.fx,
          (y - camera.projection.cy) / camera.projection.fy, 1};
}

std::vector<EyePolygon> eye_polygons(const Scene& scene) {
  const Mesh& mesh = scene.meshes[0];
  std::vector<EyePolygon> polygons;
  for (const CornerIndices& t : mesh.triangles) {
    polygons.emplace_back();
    for (const std::uint32_t v : t) {
      const MeshPoint& p = mesh.vertices[v];
      polygons.back().push_back({p.x, p.y, p.z});
    }
  }
  return polygons;
}

bool is_met(const EyePolygon& polygon, const EyePoint& ray) {
  bool left = true, right = true;
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    const double side = volume(polygon[i], polygon[(i + 1) % polygon.size()], ray);
    left &= side >= 0;
    right &= side <= 0;
  }
  return left || right;
}

double EyePlane::at(const EyePoint& p) const {
  return geometry::dot_from_left(as_vector(normal), as_vector(p)) - offset;
}

EyePlane plane_of(const EyePolygon& polygon) {
  const Eigen::Vector3d a = as_vector(polygon[0]), b = as_vector(polygon[1]),
                        c = as_vector(polygon[2]);
  const Eigen::Vector3d normal = (b - a).cross(c - a);
  return {as_array(normal), geometry::dot_from_left(normal, a)};
}

}  // namespace fathom::studies
