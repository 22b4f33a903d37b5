#include <fathom/camera/camera_making.h>
#include <fathom/eigen_conversions.h>

// With an Eigen that multiplies in vectors, beside that of the library, which does not.
bool use_eigen_conversions() {
  const fathom::Camera camera = fathom::look_at({0, 0, 5}, {0, 0, 0}, {0, 1, 0});
  const Eigen::Vector3d eye = fathom::world_from_camera(camera).translation();
  fathom::Mesh mesh = fathom::mesh_of(Eigen::Matrix3f::Identity(), Eigen::RowVector3i(0, 1, 2));
  fathom::vertices_of(mesh) *= 2;
  const Eigen::Vector4d seen = fathom::camera_from_world(camera).matrix() * eye.homogeneous();
  return eye == Eigen::Vector3d(0, 0, 5) && seen == Eigen::Vector4d(0, 0, 0, 1) &&
         mesh.vertices[2] == fathom::MeshPoint{0, 0, 2};
}
