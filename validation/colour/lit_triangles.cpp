#include "validation/colour/lit_triangles.h"

#include <Eigen/Core>
#include <cmath>

#include "fathom/failures/errors.h"
#include "fathom/geometry/eigen_arrays.h"
#include "fathom/pipeline/fragments/shading.h"
#include "fathom/pipeline/geometry/vertex_transform.h"

namespace fathom::validation {
namespace {

double in_binary32(double x) {
  return static_cast<double>(static_cast<float>(x));
}

void require_rotation(const Camera& camera) {
  const Eigen::Matrix3d rotation = geometry::as_matrix(camera.world_to_camera).leftCols<3>();
  const Eigen::Matrix3d off = rotation * rotation.transpose() - Eigen::Matrix3d::Identity();
  if (off.cwiseAbs().maxCoeff() > 0x1p-40)
    throw InputError("colours are compared for cameras whose matrix is a rotation");
  if (!is_perspective(camera.projection))
    throw InputError(
        "colours are compared for perspective cameras; in a parallel view VTK takes the eye to be "
        "at a point all the same");
}

void require_in_view(const std::array<double, 3>& p, const Camera& camera) {
  const Eigen::Vector3d seen =
      geometry::as_matrix(camera.world_to_camera) * Eigen::Vector4d(p[0], p[1], p[2], 1);
  const double x = seen.x(), y = seen.y(), z = seen.z();
  const PrincipalPoint centre = principal_point(camera.projection);
  const double u = (camera.projection.fx * x + camera.projection.skew * y) / z + centre.x;
  const double v = camera.projection.fy * y / z + centre.y;
  if (!(z > camera.near && z < camera.far && u >= 0 && u <= camera.width && v >= 0 &&
        v <= camera.height))
    throw InputError(
        "colours are compared where every corner is in view; leave out --camera, or take one that "
        "shows all");
}

}  // namespace

LitScene lit_scene(const Scene& scene, const Camera& camera, const pipeline::Material& material) {
  require_rotation(camera);
  LitScene lit;
  lit.camera = camera;
  lit.material = material;
  lit.towards_light = pipeline::lighting_of(camera, {}).towards_light;
  for (std::uint32_t object = 0; object < scene.objects.size(); ++object) {
    pipeline::PipelineOptions options;
    options.depth_format.near = camera.near;
    options.depth_format.far = camera.far;
    const pipeline::VertexTransform<double> transform(camera, scene.objects[object], options);
    for (const pipeline::InputTriangle& t :
         pipeline::assemble_triangles(scene, object, 0, pipeline::FrontFace::counter_clockwise)) {
      LitTriangle triangle;
      for (std::size_t k = 0; k < 3; ++k) {
        const auto vertex = transform(t.corners[k]);
        double length = 0;
        for (std::size_t i = 0; i < 3; ++i) {
          triangle.corners[k][i] = in_binary32(vertex.attributes[pipeline::attribute::world + i]);
          triangle.normals[k][i] = in_binary32(vertex.attributes[pipeline::attribute::normal + i]);
          length += std::abs(triangle.normals[k][i]);
        }
        if (!(length > 0)) throw InputError("a corner's normals cancel each other");
        require_in_view(triangle.corners[k], camera);
      }
      lit.triangles.push_back(triangle);
    }
  }
  return lit;
}

Scene as_scene(const LitScene& lit) {
  Scene scene;
  Mesh mesh;
  for (const LitTriangle& t : lit.triangles) {
    const auto first = static_cast<std::uint32_t>(mesh.vertices.size());
    for (std::size_t k = 0; k < 3; ++k) {
      mesh.vertices.push_back({t.corners[k][0], t.corners[k][1], t.corners[k][2]});
      mesh.normals.push_back(t.normals[k]);
    }
    mesh.triangles.push_back({first, first + 1, first + 2});
  }
  mesh.face_count = mesh.triangles.size();
  scene.meshes.push_back(std::move(mesh));
  scene.objects.push_back({.name = "lit"});
  return scene;
}

}  // namespace fathom::validation
