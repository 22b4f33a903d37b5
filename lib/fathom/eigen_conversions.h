#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <array>
#include <cmath>
#include <concepts>
#include <cstdint>
#include <limits>
#include <string>
#include <type_traits>
#include <utility>

#include "fathom/camera/camera.h"
#include "fathom/failures/errors.h"
#include "fathom/geometry/frames.h"
#include "fathom/mesh/mesh.h"
#include "fathom/numeric/rounding.h"

/// Cameras, points, placements and meshes from and to Eigen. Link fathom::eigen_conversions, which
/// the package provides if Eigen is found. No other header of Fathom includes Eigen, so your Eigen
/// may be compiled with any settings.
///
/// Exact    numbers are copied, except in functions that are documented to round. Eigen's own
///          functions round: an inverse or the rotation of a quaternion several times, whereas
///          camera_to_world() and import_colmap() round once.
namespace fathom {

// Cameras

/// A camera's world_to_camera as Eigen sees it, row by row.
using PoseRows = Eigen::Matrix<double, 3, 4, Eigen::RowMajor>;
static_assert(sizeof(Camera::world_to_camera) == 12 * sizeof(double));

/// [R | t] of a camera. Exact.
/// Frame    world to camera: x right, y down, z forward; scene units. R need not be a rotation; if
///          it is, an Isometry3d may hold it, whose inverse() transposes R.
inline Eigen::Affine3d camera_from_world(const Camera& camera) {
  Eigen::Affine3d pose = Eigen::Affine3d::Identity();
  pose.affine() = Eigen::Map<const PoseRows>(camera.world_to_camera.front().data());
  return pose;
}

/// Its inverse, each entry rounded once (camera_to_world()).
/// Fails    InputError where R is singular.
inline Eigen::Affine3d world_from_camera(const Camera& camera) {
  const auto rows = camera_to_world(camera.world_to_camera);
  Eigen::Affine3d pose = Eigen::Affine3d::Identity();
  pose.affine() = Eigen::Map<const PoseRows>(rows.front().data());
  return pose;
}

/// Gives a camera the pose [R | t], 3×4. Exact.
/// Frame    as camera_from_world().
inline void set_camera_from_world(Camera& camera, const Eigen::Matrix<double, 3, 4>& pose) {
  Eigen::Map<PoseRows>(camera.world_to_camera.front().data()) = pose;
}
/// The same of an Isometry3d, an Affine3d or an AffineCompact3d. Exact.
template <int mode, int options>
requires(mode != int{Eigen::Projective}) void set_camera_from_world(
    Camera& camera, const Eigen::Transform<double, 3, mode, options>& pose) {
  set_camera_from_world(camera, Eigen::Matrix<double, 3, 4>(pose.affine()));
}

/// K = [fx skew cx; 0 fy cy; 0 0 1] with the camera's numbers: its pixel_centre defines the origin
/// of cx and cy. Exact.
inline Eigen::Matrix3d intrinsic_matrix(const Camera& camera) {
  Eigen::Matrix3d K;
  K << camera.projection.fx, camera.projection.skew, camera.projection.cx, 0, camera.projection.fy,
      camera.projection.cy, 0, 0, 1;
  return K;
}

/// Gives a camera the numbers of K and keeps its pixel_centre. Exact.
/// Fails    InputError if K does not have the form [fx skew cx; 0 fy cy; 0 0 1].
inline void set_intrinsic_matrix(Camera& camera, const Eigen::Matrix3d& K) {
  if (K(1, 0) != 0 || K.row(2) != Eigen::RowVector3d(0, 0, 1))
    throw InputError("the intrinsic matrix: expected fx s cx, 0 fy cy, 0 0 1");
  camera.projection.fx = K(0, 0);
  camera.projection.skew = K(0, 1);
  camera.projection.cx = K(0, 2);
  camera.projection.fy = K(1, 1);
  camera.projection.cy = K(1, 2);
}

// Points and placements

/// Exact.
inline Eigen::Vector3d to_eigen(const MeshPoint& p) {
  return {p.x, p.y, p.z};
}
/// Exact.
inline MeshPoint to_mesh_point(const Eigen::Vector3d& p) {
  return {p.x(), p.y(), p.z()};
}
/// Exact. For functions that take three numbers, such as look_at().
inline std::array<double, 3> to_array(const Eigen::Vector3d& p) {
  return {p.x(), p.y(), p.z()};
}

/// A point of exact coordinates, in the world or in the camera frame: each is rounded once.
template <class Point>
requires std::same_as<Point, WorldPoint> || std::same_as<Point, CameraPoint> Eigen::Vector3d
rounded(const Point& p) {
  return {round_to_binary64(p.x), round_to_binary64(p.y), round_to_binary64(p.z)};
}

/// Where a mesh stands. Exact.
template <int mode, int options>
requires(mode != int{Eigen::Projective}) WorldFromMesh
    to_world_from_mesh(const Eigen::Transform<double, 3, mode, options>& placement) {
  WorldFromMesh result;
  for (Eigen::Index i = 0; i < 3; ++i)
    for (Eigen::Index k = 0; k < 4; ++k)
      result.rows[static_cast<std::size_t>(i)][static_cast<std::size_t>(k)] =
          placement.matrix()(i, k);
  return result;
}
/// The other way round: each entry is rounded once, which changes nothing where it was a binary64
/// number (scene files, to_world_from_mesh()) and something in a product of several (glTF).
inline Eigen::Affine3d rounded(const WorldFromMesh& placement) {
  Eigen::Affine3d result = Eigen::Affine3d::Identity();
  for (Eigen::Index i = 0; i < 3; ++i)
    for (Eigen::Index k = 0; k < 4; ++k)
      result(i, k) = round_to_binary64(
          placement.rows[static_cast<std::size_t>(i)][static_cast<std::size_t>(k)]);
  return result;
}

// Meshes

/// N×3, a vertex per row: the mesh's own, not a copy. Valid until the list changes its length.
using VertexRows = Eigen::Matrix<double, Eigen::Dynamic, 3, Eigen::RowMajor>;
/// M×3, a triangle per row, indices of vertices.
using TriangleRows = Eigen::Matrix<std::uint32_t, Eigen::Dynamic, 3, Eigen::RowMajor>;
static_assert(sizeof(MeshPoint) == 3 * sizeof(double) && std::is_standard_layout_v<MeshPoint>);
static_assert(sizeof(CornerIndices) == 3 * sizeof(std::uint32_t));

inline Eigen::Map<const VertexRows> vertices_of(const Mesh& mesh) {
  return {reinterpret_cast<const double*>(mesh.vertices.data()),
          static_cast<Eigen::Index>(mesh.vertices.size()), 3};
}
inline Eigen::Map<VertexRows> vertices_of(Mesh& mesh) {
  return {reinterpret_cast<double*>(mesh.vertices.data()),
          static_cast<Eigen::Index>(mesh.vertices.size()), 3};
}
inline Eigen::Map<const TriangleRows> triangles_of(const Mesh& mesh) {
  return {reinterpret_cast<const std::uint32_t*>(mesh.triangles.data()),
          static_cast<Eigen::Index>(mesh.triangles.size()), 3};
}
inline Eigen::Map<TriangleRows> triangles_of(Mesh& mesh) {
  return {reinterpret_cast<std::uint32_t*>(mesh.triangles.data()),
          static_cast<Eigen::Index>(mesh.triangles.size()), 3};
}
void vertices_of(const Mesh&& mesh) = delete;
void triangles_of(const Mesh&& mesh) = delete;

/// The mesh of N×3 vertices (double or float) and M×3 triangles (integers), triangle t face t; a
/// copy. Exact: float is widened.
/// Fails    InputError where a matrix has not 3 columns, a coordinate is not finite, or an index is
///          of no vertex, naming the row; where there are more than a mesh can have.
template <class Vertices, class Triangles>
Mesh mesh_of(const Eigen::MatrixBase<Vertices>& vertices,
             const Eigen::MatrixBase<Triangles>& triangles) {
  using Coordinate = typename Vertices::Scalar;
  using VertexIndex = typename Triangles::Scalar;
  static_assert(std::is_same_v<Coordinate, double> || std::is_same_v<Coordinate, float>);
  static_assert(std::is_integral_v<VertexIndex>);
  constexpr auto most = std::numeric_limits<std::uint32_t>::max() - 1;
  if (vertices.cols() != 3 || triangles.cols() != 3)
    throw InputError("a mesh: expected N×3 vertices and M×3 triangles");
  if (static_cast<std::uint64_t>(vertices.rows()) > most ||
      static_cast<std::uint64_t>(triangles.rows()) > most)
    throw InputError("a mesh: expected at most " + std::to_string(most) +
                     " vertices and as many triangles");
  Mesh mesh;
  mesh.vertices.reserve(static_cast<std::size_t>(vertices.rows()));
  for (Eigen::Index v = 0; v < vertices.rows(); ++v) {
    const MeshPoint p{static_cast<double>(vertices(v, 0)), static_cast<double>(vertices(v, 1)),
                      static_cast<double>(vertices(v, 2))};
    if (!std::isfinite(p.x) || !std::isfinite(p.y) || !std::isfinite(p.z))
      throw InputError("vertex " + std::to_string(v) + ": a coordinate is not finite");
    mesh.vertices.push_back(p);
  }
  mesh.triangles.reserve(static_cast<std::size_t>(triangles.rows()));
  for (Eigen::Index t = 0; t < triangles.rows(); ++t) {
    CornerIndices corners{};
    for (Eigen::Index k = 0; k < 3; ++k) {
      const VertexIndex index = triangles(t, k);
      if (std::cmp_less(index, 0) || std::cmp_greater_equal(index, mesh.vertices.size()))
        throw InputError("triangle " + std::to_string(t) + ": there is no vertex " +
                         std::to_string(index));
      corners[static_cast<std::size_t>(k)] = static_cast<std::uint32_t>(index);
    }
    mesh.triangles.push_back(corners);
  }
  mesh.face_count = mesh.triangles.size();
  return mesh;
}

}  // namespace fathom
