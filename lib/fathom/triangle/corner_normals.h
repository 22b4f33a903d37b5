#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "fathom/mesh/vertex_normals.h"
#include "fathom/numeric/certified.h"
#include "fathom/scene/triangle_source.h"
#include "fathom/triangle/recent_triangles.h"

/// The normals of the corners of triangles, from which channel Ns is interpolated (specification,
/// section 6).
namespace fathom::triangle {

/// The normal of a corner, in the frame of its mesh.
struct CornerNormal {
  /// The normal of the file, if there is one; otherwise null: the normal is the sum of the area
  /// vectors of `triangles`.
  const std::array<double, 3>* given = nullptr;
  std::span<const std::uint32_t> triangles;
  /// A number shared by exactly the corners of the scene with this sum.
  std::uint64_t number = 0;
};

/// The normals of all corners of a scene. Threads share it.
class CornerNormals {
 public:
  /// The scene must outlive this unchanged.
  /// Fails    UsageError if the scene stays in its files: sums need all triangles of a mesh.
  CornerNormals(const TriangleSource& triangles, NormalSource source);

  [[nodiscard]] const TriangleSource& triangles() const { return triangles_; }
  [[nodiscard]] const Mesh& mesh_of(const TriangleOrigin& origin) const;
  [[nodiscard]] CornerNormal at(const TriangleOrigin& origin, std::size_t corner) const;

 private:
  TriangleSource triangles_;
  NormalSource source_;
  /// For each mesh; empty for meshes that no object places or that need no sums.
  std::vector<mesh::SharedTriangles> shared_;
  /// For each mesh, the number of vertices of all previous meshes.
  std::vector<std::uint64_t> first_vertex_;
};

/// The normals of corners in the world, as exact numbers. One for each thread, because it caches
/// the sums that it used last.
class ExactCornerNormals {
 public:
  explicit ExactCornerNormals(std::shared_ptr<const CornerNormals> normals)
      : normals_(std::move(normals)) {}

  /// The normals of the three corners of a triangle, to be interpolated: their lengths count. All
  /// three may be multiplied by a common factor above 0.
  std::array<ExactVector3, 3> of_triangle(std::uint32_t number);

 private:
  ExactVector3 in_mesh(const TriangleOrigin& origin, std::size_t corner);

  std::shared_ptr<const CornerNormals> normals_;
  RecentTriangles<ExactVector3, 1024> sums_;
};

/// (B − A) × (C − A), exactly.
template <class Point>
ExactVector3 area_vector(const std::array<Point, 3>& corners) {
  const auto from_A = [&](const Point& p) {
    const Point& A = corners[0];
    return ExactVector3{Dyadic(p.x) - Dyadic(A.x), Dyadic(p.y) - Dyadic(A.y),
                        Dyadic(p.z) - Dyadic(A.z)};
  };
  return cross(from_A(corners[1]), from_A(corners[2]));
}

/// The corners of a triangle of a mesh.
inline std::array<MeshPoint, 3> corners_of(const Mesh& mesh, std::uint32_t triangle) {
  const CornerIndices& t = mesh.triangles[triangle];
  return {mesh.vertices[t[0]], mesh.vertices[t[1]], mesh.vertices[t[2]]};
}

/// The linear part of a placement.
std::array<ExactVector3, 3> linear_part(const WorldFromMesh& placement);

}  // namespace fathom::triangle
