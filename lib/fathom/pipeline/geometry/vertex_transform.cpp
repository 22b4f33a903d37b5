#include "fathom/pipeline/geometry/vertex_transform.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "fathom/numeric/errors.h"
#include "fathom/numeric/rounding.h"

namespace fathom::pipeline {
namespace {

using Rows = std::array<std::array<double, 4>, 4>;

template <class Real>
Matrix<Real> rounded(const Rows& rows) {
  Matrix<Real> m;
  for (std::size_t i = 0; i < 4; ++i)
    for (std::size_t j = 0; j < 4; ++j) m[i][j] = static_cast<Real>(rows[i][j]);
  return m;
}

Rows model_matrix(const Object& object) {
  Rows m{};
  for (std::size_t i = 0; i < 3; ++i)
    for (std::size_t j = 0; j < 4; ++j)
      m[i][j] = round_to_binary64(object.world_from_mesh.rows[i][j]);
  m[3][3] = 1;
  return m;
}

/// The camera's frame has y down and z forward; the eye's has y up and z backward.
Rows view_matrix(const Camera& camera) {
  Rows m{};
  for (std::size_t i = 0; i < 3; ++i)
    for (std::size_t j = 0; j < 4; ++j)
      m[i][j] = i == 0 ? camera.world_to_camera[i][j] : -camera.world_to_camera[i][j];
  m[3][3] = 1;
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

Rows projection_matrix(const Camera& camera, const DepthFormat& format) {
  const bool perspective = camera.projection == Projection::perspective;
  const double w = camera.width, h = camera.height;
  const PrincipalPoint centre = principal_point(camera);
  const double cx = 2 * centre.x / w - 1;
  const double cy = 1 - 2 * centre.y / h;
  const auto [za, zb] = depth_row(format, perspective);
  Rows m{};
  m[0] = {2 * camera.fx / w, -2 * camera.skew / w, 0, 0};
  m[1] = {0, 2 * camera.fy / h, 0, 0};
  m[2] = {0, 0, za, zb};
  m[0][perspective ? 2 : 3] = perspective ? -cx : cx;
  m[1][perspective ? 2 : 3] = perspective ? -cy : cy;
  m[3][perspective ? 2 : 3] = perspective ? -1 : 1;
  return m;
}

template <class Real>
Real row_times(const std::array<Real, 4>& row, Real x, Real y, Real z) {
  return row[0] * x + row[1] * y + row[2] * z + row[3];
}

using Vector = std::array<double, 3>;

/// Scaled to unit length, without overflow; zero stays zero.
Vector unit(const Vector& n) {
  const double greatest = std::max({std::abs(n[0]), std::abs(n[1]), std::abs(n[2])});
  if (!(greatest > 0)) return n;
  const Vector scaled{n[0] / greatest, n[1] / greatest, n[2] / greatest};
  const double length = std::hypot(scaled[0], scaled[1], scaled[2]);
  return {scaled[0] / length, scaled[1] / length, scaled[2] / length};
}

/// Takes a normal of the mesh to the world: by the cofactors of the model matrix, which are its
/// inverse transpose times its determinant. They do to a normal what the matrix does to the cross
/// product of two edges, so that it stays on its side of the triangle, the side from which the
/// corners run as before, also where the matrix mirrors.
Vector to_world_normal(const Rows& rows, const Vector& normal) {
  double greatest = 0;
  for (std::size_t i = 0; i < 3; ++i)
    for (std::size_t j = 0; j < 3; ++j) greatest = std::max(greatest, std::abs(rows[i][j]));
  if (!(greatest > 0)) return {};
  Rows m{};
  for (std::size_t i = 0; i < 3; ++i)
    for (std::size_t j = 0; j < 3; ++j) m[i][j] = rows[i][j] / greatest;
  const auto cofactor = [&](std::size_t i, std::size_t j) {
    const std::size_t i1 = (i + 1) % 3, i2 = (i + 2) % 3, j1 = (j + 1) % 3, j2 = (j + 2) % 3;
    return m[i1][j1] * m[i2][j2] - m[i1][j2] * m[i2][j1];
  };
  const Vector n = unit(normal);
  Vector result{};
  for (std::size_t i = 0; i < 3; ++i)
    for (std::size_t j = 0; j < 3; ++j) result[i] += cofactor(i, j) * n[j];
  return unit(result);
}

}  // namespace

template <class Real>
VertexTransform<Real>::VertexTransform(const Camera& camera, const Object& object,
                                       const PipelineOptions& options)
    : world_from_mesh(rounded<Real>(model_matrix(object))),
      eye_from_world(rounded<Real>(view_matrix(camera))),
      clip_from_eye(rounded<Real>(projection_matrix(camera, options.depth_format))) {}

template <class Real>
WorldVertex<Real> VertexTransform<Real>::to_world(const MeshPoint& p) const {
  const auto x = static_cast<Real>(p.x), y = static_cast<Real>(p.y), z = static_cast<Real>(p.z);
  const auto& m = world_from_mesh;
  return {row_times(m[0], x, y, z), row_times(m[1], x, y, z), row_times(m[2], x, y, z)};
}

template <class Real>
EyeVertex<Real> VertexTransform<Real>::to_eye(const WorldVertex<Real>& p) const {
  const auto& m = eye_from_world;
  return {row_times(m[0], p.x, p.y, p.z), row_times(m[1], p.x, p.y, p.z),
          row_times(m[2], p.x, p.y, p.z)};
}

template <class Real>
clipping::Point4<Real> VertexTransform<Real>::to_clip(const EyeVertex<Real>& p) const {
  const auto& m = clip_from_eye;
  return {row_times(m[0], p.x, p.y, p.z), row_times(m[1], p.x, p.y, p.z),
          row_times(m[2], p.x, p.y, p.z), row_times(m[3], p.x, p.y, p.z)};
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
  Rows model{};
  for (std::size_t i = 0; i < 3; ++i)
    for (std::size_t j = 0; j < 3; ++j) model[i][j] = static_cast<double>(world_from_mesh[i][j]);
  const auto normal = to_world_normal(model, vertex.normal);
  for (std::size_t k = 0; k < 3; ++k) {
    a[attribute::normal + k] = static_cast<Real>(normal[k]);
    a[attribute::colour + k] = static_cast<Real>(vertex.colour[k]);
  }
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
  if (camera.projection == Projection::orthographic && takes_infinite_far(format.mapping))
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
