#include "fathom/pipeline/geometry/primitive_assembly.h"

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

#include "fathom/mesh/vertex_normals.h"
#include "fathom/threads/interruption.h"

namespace fathom::pipeline {
namespace {

using Vector = Eigen::Vector3d;

/// Twice the area times the unit normal of a triangle.
Vector area_vector(const MeshPoint& a, const MeshPoint& b, const MeshPoint& c) {
  return Vector(b.x - a.x, b.y - a.y, b.z - a.z).cross(Vector(c.x - a.x, c.y - a.y, c.z - a.z));
}

std::vector<std::array<double, 3>> smooth_normals(const Mesh& mesh, FrontFace front_face,
                                                  NormalSource shared) {
  const double side = front_face == FrontFace::counter_clockwise ? 1 : -1;
  const std::vector<std::uint32_t> first = mesh::sharing_vertices(mesh, shared);
  std::vector<Vector> sums(mesh.vertices.size(), Vector::Zero());
  for (const CornerIndices& t : mesh.triangles) {
    check_interruption();
    const Vector n = area_vector(mesh.vertices[t[0]], mesh.vertices[t[1]], mesh.vertices[t[2]]);
    for (const std::uint32_t v : t) sums[first[v]] += n;
  }
  std::vector<std::array<double, 3>> normals(sums.size());
  for (std::size_t v = 0; v < sums.size(); ++v) {
    const Vector& sum = sums[first[v]];
    const double length = sum.stableNorm();
    if (!(length > 0) || !std::isfinite(length)) continue;
    Eigen::Map<Vector>(normals[v].data()) = sum * (side / length);
  }
  return normals;
}

/// The index of a corner into a list with triangles of its own, otherwise the index of the vertex.
std::uint32_t index_of(const MeshArray<CornerIndices>& own, const Mesh& mesh, std::size_t t,
                       std::size_t corner) {
  return own.empty() ? mesh.triangles[t][corner] : own[t][corner];
}

/// A vertex with its colour, without a normal and texture coordinates.
InputVertex vertex_at(const Mesh& mesh, std::uint32_t v) {
  InputVertex vertex;
  vertex.position = mesh.vertices[v];
  if (v < mesh.colours.size())
    for (std::size_t c = 0; c < 3; ++c) vertex.colour[c] = static_cast<double>(mesh.colours[v][c]);
  return vertex;
}

}  // namespace

std::vector<InputLine> assemble_lines(const Scene& scene, std::uint32_t object,
                                      std::uint32_t first_number) {
  const Mesh& mesh = scene.meshes[scene.objects[object].mesh];
  std::vector<InputLine> lines;
  lines.reserve(mesh.lines.size());
  for (const auto& [a, b] : mesh.lines)
    lines.push_back({first_number++, object, {vertex_at(mesh, a), vertex_at(mesh, b)}});
  return lines;
}

std::vector<InputLine> assemble_points(const Scene& scene, std::uint32_t object,
                                       std::uint32_t first_number) {
  const Mesh& mesh = scene.meshes[scene.objects[object].mesh];
  std::vector<InputLine> points;
  points.reserve(mesh.points.size());
  for (const std::uint32_t v : mesh.points)
    points.push_back({first_number++, object, {vertex_at(mesh, v), vertex_at(mesh, v)}});
  return points;
}

bool has_lines_or_points(const Scene& scene) {
  return std::ranges::any_of(scene.objects, [&](const Object& object) {
    const Mesh& mesh = scene.meshes[object.mesh];
    return !mesh.lines.empty() || !mesh.points.empty();
  });
}

std::vector<InputTriangle> assemble_triangles(const Scene& scene, std::uint32_t object,
                                              std::uint32_t first_number, FrontFace front_face,
                                              NormalSource normals) {
  const Mesh& mesh = scene.meshes[scene.objects[object].mesh];
  const bool of_file = normals == NormalSource::file;
  const auto smooth = mesh::needs_sums(mesh, normals) ? smooth_normals(mesh, front_face, normals)
                                                      : std::vector<std::array<double, 3>>();
  std::vector<InputTriangle> triangles(mesh.triangles.size());
  for (std::size_t t = 0; t < triangles.size(); ++t) {
    check_interruption();
    triangles[t].number = first_number + static_cast<std::uint32_t>(t);
    triangles[t].object = object;
    for (std::size_t k = 0; k < 3; ++k) {
      InputVertex& corner = triangles[t].corners[k];
      const std::uint32_t v = mesh.triangles[t][k];
      corner = vertex_at(mesh, v);
      if (const auto n = mesh::normal_index(mesh, t, k); of_file && n != no_index) {
        corner.normal = mesh.normals[n];
      } else if (!smooth.empty()) {
        corner.normal = smooth[v];
      }
      if (const auto u = index_of(mesh.texture_triangles, mesh, t, k);
          u < mesh.texture_coordinates.size())
        corner.uv = mesh.texture_coordinates[u];
    }
  }
  return triangles;
}

bool has_texture_coordinates(const Scene& scene) {
  return std::all_of(scene.objects.begin(), scene.objects.end(), [&](const Object& object) {
    const Mesh& mesh = scene.meshes[object.mesh];
    if (mesh.texture_coordinates.empty()) return mesh.triangles.empty();
    return std::all_of(
        mesh.texture_triangles.begin(), mesh.texture_triangles.end(),
        [](const CornerIndices& t) { return std::find(t.begin(), t.end(), no_index) == t.end(); });
  });
}

}  // namespace fathom::pipeline
