#include "fathom/pipeline/geometry/vertex_transform.h"

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>

#include "fathom/camera/projection.h"
#include "fathom/failures/errors.h"
#include "fathom/geometry/eigen_arrays.h"

namespace fathom::pipeline {
namespace {

using geometry::as_matrix;
using geometry::as_vector;

template <class Real>
using Matrix4 = geometry::RowMatrix<Real, 4, 4>;

template <class Real>
Matrix<Real> rounded(const Matrix4<double>& m) {
  Matrix<Real> result;
  as_matrix(result) = m.cast<Real>();
  return result;
}

Matrix4<double> model_matrix(const Object& object) {
  Matrix4<double> m = Matrix4<double>::Identity();
  m.topRows<3>() = geometry::rounded(object.world_from_mesh);
  return m;
}

/// The camera's frame has y down and z forward; the eye's has y up and z backward.
Matrix4<double> view_matrix(const Pose& world_to_camera) {
  Matrix4<double> m = Matrix4<double>::Identity();
  m.topRows<3>() = Eigen::Vector3d(1, -1, -1).asDiagonal() * as_matrix(world_to_camera);
  return m;
}

/// The row of z: z_clip = a·z_eye + b, for a projection with w = −z_eye or with w = 1.
std::array<double, 2> depth_row(const DepthFormat& f, bool perspective) {
  const double n = f.near, r = f.far - f.near;
  switch (f.mapping) {
    case Mapping::opengl:
      if (perspective) return {-(f.far + n) / r, -2 * f.far * n / r};
      return {-2 / r, -(f.far + n) / r};
    case Mapping::reversed:
      if (perspective) return {n / r, f.far * n / r};
      return {1 / r, f.far / r};
    case Mapping::infinite:
      return {-1, -n};
    case Mapping::reversed_infinite:
      return {0, n};
    default:
      if (perspective) return {-f.far / r, -f.far * n / r};
      return {-1 / r, -n / r};
  }
}

Matrix4<double> projection_matrix(const Camera& camera, const DepthFormat& format) {
  const bool perspective = is_perspective(camera.projection);
  const ClipRows rows = RoundedProjection(camera.projection).clip_rows(camera.width, camera.height);
  const auto [za, zb] = depth_row(format, perspective);
  Matrix4<double> m;
  m << rows.xx, -rows.xy, 0, 0,  //
      0, -rows.yy, 0, 0,         //
      0, 0, za, zb,              //
      0, 0, 0, 0;
  m(0, perspective ? 2 : 3) = perspective ? -rows.x1 : rows.x1;
  m(1, perspective ? 2 : 3) = perspective ? -rows.y1 : rows.y1;
  m(3, perspective ? 2 : 3) = perspective ? -1 : 1;
  return m;
}

/// The first `rows` of M·(x, y, z, 1), each summed from the left, as a chain of multiplications and
/// additions runs on a graphics card. (Eigen's product of a matrix and a vector adds in pairs.)
template <int rows, class Real>
Eigen::Matrix<Real, rows, 1> transformed(const Matrix<Real>& matrix, Real x, Real y, Real z) {
  const auto M = as_matrix(matrix).template topRows<rows>();
  return M.col(0) * x + M.col(1) * y + M.col(2) * z + M.col(3);
}

/// Scaled to unit length; zero remains zero. First by its greatest component: squares would
/// overflow.
Eigen::Vector3d unit(const Eigen::Vector3d& n) {
  const double greatest = n.cwiseAbs().maxCoeff();
  if (!(greatest > 0)) return n;
  return (n / greatest).normalized();
}

/// Transforms a normal of the mesh to the world by the cofactors of the model matrix, which are its
/// inverse transpose times its determinant. They transform a normal as the matrix transforms the
/// cross product of two edges, so that it stays on its side of the triangle, the side from which
/// the corners run as before, even if the matrix mirrors.
Eigen::Vector3d to_world_normal(const Eigen::Matrix3d& world_from_mesh,
                                const Eigen::Vector3d& normal) {
  const double greatest = world_from_mesh.cwiseAbs().maxCoeff();
  if (!(greatest > 0)) return Eigen::Vector3d::Zero();
  const Eigen::Matrix3d columns = world_from_mesh / greatest;
  const Eigen::Vector3d x = columns.col(0), y = columns.col(1), z = columns.col(2);
  Eigen::Matrix3d cofactors;
  cofactors << y.cross(z), z.cross(x), x.cross(y);
  return unit(cofactors * unit(normal));
}

}  // namespace

template <class Real>
VertexTransform<Real>::VertexTransform(const Camera& camera, const Object& object,
                                       const PipelineOptions& options)
    : world_from_mesh(rounded<Real>(model_matrix(object))),
      eye_from_world(rounded<Real>(view_matrix(camera.world_to_camera))),
      clip_from_eye(rounded<Real>(projection_matrix(camera, options.depth_format))) {}

template <class Real>
WorldVertex<Real> VertexTransform<Real>::to_world(const MeshPoint& p) const {
  const auto world = transformed<3>(world_from_mesh, static_cast<Real>(p.x), static_cast<Real>(p.y),
                                    static_cast<Real>(p.z));
  return {world.x(), world.y(), world.z()};
}

template <class Real>
EyeVertex<Real> VertexTransform<Real>::to_eye(const WorldVertex<Real>& p) const {
  const auto eye = transformed<3>(eye_from_world, p.x, p.y, p.z);
  return {eye.x(), eye.y(), eye.z()};
}

template <class Real>
clipping::Point4<Real> VertexTransform<Real>::to_clip(const EyeVertex<Real>& p) const {
  const auto clip = transformed<4>(clip_from_eye, p.x, p.y, p.z);
  return {clip.x(), clip.y(), clip.z(), clip.w()};
}

template <class Real>
ClipVertex<Real> VertexTransform<Real>::operator()(const InputVertex& vertex) const {
  const WorldVertex<Real> world = to_world(vertex.position);
  const EyeVertex<Real> eye = to_eye(world);
  ClipVertex<Real> clip{to_clip(eye), std::vector<Real>(attribute::count)};
  auto& a = clip.attributes;
  a[attribute::depth] = -eye.z;
  a[attribute::world] = world.x;
  a[attribute::world + 1] = world.y;
  a[attribute::world + 2] = world.z;
  const Eigen::Vector3d normal = to_world_normal(
      as_matrix(world_from_mesh).template topLeftCorner<3, 3>().template cast<double>(),
      as_vector(vertex.normal));
  Eigen::Map<Eigen::Matrix<Real, 3, 1>>(a.data() + attribute::normal) = normal.cast<Real>();
  for (std::size_t k = 0; k < 3; ++k)
    a[attribute::colour + k] = static_cast<Real>(vertex.colour[k]);
  a[attribute::uv] = static_cast<Real>(vertex.uv[0]);
  a[attribute::uv + 1] = static_cast<Real>(vertex.uv[1]);
  return clip;
}

clipping::Volume volume_of(Mapping mapping) {
  return mapping == Mapping::opengl ? clipping::Volume::opengl : clipping::Volume::zero_one;
}

bool is_per_fragment(Mapping mapping) {
  return mapping == Mapping::linear || mapping == Mapping::w || is_logarithmic(mapping);
}

void fill_in_range(const Scene& scene, const Camera& camera, DepthFormat& format) {
  if (is_orthographic(camera.projection) && takes_infinite_far(format.mapping))
    throw UsageError(Setting{"mapping"},
                     std::string(name_of(format.mapping)) + " needs a perspective camera");
  format.near = camera.near;
  format.far = camera.far;
  const bool needs_far = std::isinf(format.far) && !takes_infinite_far(format.mapping);
  if (format.near > 0 && !needs_far) return;
  double least = std::numeric_limits<double>::infinity(), greatest = 0;
  for (const Object& object : scene.objects) {
    const VertexTransform<double> transform(camera, object, {});
    for (const MeshPoint& p : scene.meshes[object.mesh].vertices) {
      const double depth = -transform.to_eye(transform.to_world(p)).z;
      least = std::min(least, depth);
      greatest = std::max(greatest, depth);
    }
  }
  if (!(greatest > 0) || std::isinf(greatest)) greatest = 1;
  if (!(format.near > 0))
    format.near = least > 0 && least <= greatest ? least / 2 : greatest * 1e-4;
  if (needs_far) format.far = std::max(2 * greatest, 2 * format.near);
}

template struct VertexTransform<float>;
template struct VertexTransform<double>;

}  // namespace fathom::pipeline
