#include "fathom/triangle/corner_normals.h"

#include <utility>

#include "fathom/failures/errors.h"

namespace fathom::triangle {

std::array<ExactVector3, 3> linear_part(const WorldFromMesh& placement) {
  std::array<ExactVector3, 3> linear;
  for (std::size_t i = 0; i < 3; ++i) {
    for (std::size_t k = 0; k < 3; ++k) linear[i][k] = placement.rows[i][k];
  }
  return linear;
}

CornerNormals::CornerNormals(const TriangleSource& triangles, NormalSource source)
    : triangles_(triangles), source_(source) {
  const Scene* const scene = triangles.scene();
  if (scene == nullptr) {
    throw UsageError(
        "a scene that stays in its files has no normals of vertices: leave out channel Ns");
  }
  shared_.resize(scene->meshes.size());
  std::vector<bool> seen(scene->meshes.size(), false);
  for (const Object& object : scene->objects) {
    if (seen[object.mesh]) continue;
    seen[object.mesh] = true;
    const Mesh& mesh = scene->meshes[object.mesh];
    if (mesh::needs_sums(mesh, source)) shared_[object.mesh] = mesh::SharedTriangles(mesh, source);
  }
  std::uint64_t vertices = 0;
  for (const Mesh& mesh : scene->meshes) {
    first_vertex_.push_back(vertices);
    vertices += mesh.vertices.size();
  }
}

const Mesh& CornerNormals::mesh_of(const TriangleOrigin& origin) const {
  const Scene& scene = *triangles_.scene();
  return scene.meshes[scene.objects[origin.object].mesh];
}

CornerNormal CornerNormals::at(const TriangleOrigin& origin, std::size_t corner) const {
  const std::size_t number = triangles_.objects()[origin.object].mesh;
  const Mesh& mesh = triangles_.scene()->meshes[number];
  CornerNormal normal;
  if (source_ == NormalSource::file) {
    const std::uint32_t index = mesh::normal_index(mesh, origin.triangle, corner);
    if (index != no_index) {
      normal.given = &mesh.normals[index];
      return normal;
    }
  }
  const mesh::SharedTriangles& shared = shared_[number];
  const std::uint32_t vertex = shared.shared(mesh.triangles[origin.triangle][corner]);
  normal.triangles = shared.at(vertex);
  normal.number = first_vertex_[number] + vertex;
  return normal;
}

ExactVector3 ExactCornerNormals::in_mesh(const TriangleOrigin& origin, std::size_t corner) {
  const CornerNormal normal = normals_->at(origin, corner);
  if (normal.given) return {(*normal.given)[0], (*normal.given)[1], (*normal.given)[2]};
  return sums_.get(normal.number, [&](ExactVector3& sum) {
    sum = {};
    const Mesh& mesh = normals_->mesh_of(origin);
    for (const std::uint32_t t : normal.triangles) {
      const ExactVector3 n = area_vector(corners_of(mesh, t));
      for (std::size_t k = 0; k < 3; ++k) sum[k] += n[k];
    }
  });
}

// The inverse transpose of M is the cofactors of M over det M; of its magnitude only the sign
// matters. Where det M = 0 the cofactors are taken as they are.
std::array<ExactVector3, 3> ExactCornerNormals::of_triangle(std::uint32_t number) {
  const TriangleOrigin origin = normals_->triangles().origin(number);
  std::array<ExactVector3, 3> normals;
  for (std::size_t k = 0; k < 3; ++k) normals[k] = in_mesh(origin, k);
  const Object& object = normals_->triangles().objects()[origin.object];
  if (object.placed_as_is) return normals;
  const std::array<ExactVector3, 3> M = linear_part(object.world_from_mesh);
  const std::array<ExactVector3, 3> C = cofactors(M);
  const bool mirrors = determinant(M[0], M[1], M[2]).sign() == Sign::negative;
  for (ExactVector3& n : normals) {
    n = {dot(C[0], n), dot(C[1], n), dot(C[2], n)};
    if (mirrors) n = {-n[0], -n[1], -n[2]};
  }
  return normals;
}

}  // namespace fathom::triangle
