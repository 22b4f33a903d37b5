#include "validation/studies/hidden_surface/sight.h"

#include <utility>

namespace fathom::studies {

double volume(const EyePoint& a, const EyePoint& b, const EyePoint& c) {
  if (b < a) return -volume(b, a, c);
  return (a[1] * b[2] - a[2] * b[1]) * c[0] + (a[2] * b[0] - a[0] * b[2]) * c[1] +
         (a[0] * b[1] - a[1] * b[0]) * c[2];
}

EyePoint ray_at(const Camera& camera, double x, double y) {
  return {(x - camera.cx) / camera.fx, (y - camera.cy) / camera.fy, 1};
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
  return normal[0] * p[0] + normal[1] * p[1] + normal[2] * p[2] - offset;
}

EyePlane plane_of(const EyePolygon& polygon) {
  const EyePoint &a = polygon[0], &b = polygon[1], &c = polygon[2];
  const EyePoint u{b[0] - a[0], b[1] - a[1], b[2] - a[2]};
  const EyePoint v{c[0] - a[0], c[1] - a[1], c[2] - a[2]};
  EyePlane plane{{u[1] * v[2] - u[2] * v[1], u[2] * v[0] - u[0] * v[2], u[0] * v[1] - u[1] * v[0]},
                 0};
  plane.offset = plane.at(a);
  return plane;
}

}  // namespace fathom::studies
