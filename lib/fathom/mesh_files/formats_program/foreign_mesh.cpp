#include "fathom/mesh_files/formats_program/foreign_mesh.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "fathom/failures/errors.h"
#include "fathom/mesh/mesh_faces.h"

namespace fathom::mesh_files::formats_program {
namespace {

/// Whether there are `width` finite numbers for each vertex.
bool is_complete(const MessageList<float>& numbers, std::size_t width, std::size_t vertices) {
  if (numbers.size() != width * vertices) return false;
  for (std::size_t i = 0; i < numbers.size(); ++i)
    if (!std::isfinite(numbers[i])) return false;
  return true;
}

/// The numbers of one vertex.
template <class Value>
Value value_at(const MessageList<float>& numbers, std::size_t vertex) {
  Value value{};
  for (std::size_t k = 0; k < value.size(); ++k) value[k] = numbers[value.size() * vertex + k];
  return value;
}

/// The faces of one part; its vertices follow the vertices that the mesh had before.
void add_faces(const ForeignMesh& foreign, std::size_t first_vertex, const std::string& file,
               mesh::FaceCollector& faces) {
  std::vector<std::uint32_t> ring;
  std::size_t next = 0;
  for (std::size_t i = 0; i < foreign.face_sizes.size(); ++i) {
    const std::size_t end = next + foreign.face_sizes[i];
    if (end > foreign.corners.size()) throw BadMessage();
    for (ring.clear(); next < end; ++next) {
      const std::uint32_t vertex = foreign.corners[next];
      if (vertex >= foreign.vertex_count())
        throw InputError(file + ": assimp gives a face the vertex " + std::to_string(vertex) +
                         ", expected less than " + std::to_string(foreign.vertex_count()));
      ring.push_back(static_cast<std::uint32_t>(first_vertex) + vertex);
    }
    faces.add(ring);
  }
}

}  // namespace

ForeignMesh read_foreign_mesh(MessageReader& answer) {
  ForeignMesh mesh;
  for (auto list : {&ForeignMesh::positions, &ForeignMesh::texture_coordinates,
                    &ForeignMesh::normals, &ForeignMesh::colours})
    mesh.*list = answer.get_list<float>();
  mesh.face_sizes = answer.get_list<std::uint32_t>();
  mesh.corners = answer.get_list<std::uint32_t>();
  if (mesh.positions.size() % 3 != 0) throw BadMessage();
  return mesh;
}

Mesh ForeignMeshBuilder::build(const MessageList<std::uint32_t>& numbers) {
  Mesh mesh;
  std::vector<Part> parts;
  mesh::FaceCollector faces(mesh, file_);
  for (std::size_t i = 0; i < numbers.size(); ++i) {
    if (numbers[i] >= meshes_.size()) throw BadMessage();
    const ForeignMesh& foreign = meshes_[numbers[i]];
    mesh::expect_countable(mesh.vertices.size() + foreign.vertex_count(), "vertices", file_);
    budget_.take(foreign.vertex_count(), sizeof(MeshPoint));
    budget_.take(foreign.corners.size(), sizeof(CornerIndices));
    parts.push_back({&foreign, mesh.vertices.size(), mesh.triangles.size()});
    add_positions(foreign, mesh);
    add_faces(foreign, parts.back().first_vertex, file_, faces);
  }
  skipped_faces_ += faces.skipped();
  odd_faces_ += mesh::cut_polygons(mesh);
  if (attributes_) add_attributes(parts, mesh);
  return mesh;
}

void ForeignMeshBuilder::add_positions(const ForeignMesh& foreign, Mesh& mesh) const {
  if (!is_complete(foreign.positions, 3, foreign.vertex_count()))
    throw InputError(file_ + ": assimp gives a vertex a coordinate that is not finite");
  for (std::size_t i = 0; i < foreign.vertex_count(); ++i) {
    const auto [x, y, z] = value_at<std::array<double, 3>>(foreign.positions, i);
    mesh.vertices.push_back({x, y, z});
  }
}

/// Makes the lists of attributes as long as the list of vertices. Attributes that a part lacks are
/// filled in: texture coordinates and normals with zeros to which no corner refers, colours with
/// white.
void ForeignMeshBuilder::add_attributes(const std::vector<Part>& parts, Mesh& mesh) {
  const auto has = [&](const Part& part, auto list, std::size_t width) {
    const MessageList<float>& numbers = part.foreign->*list;
    if (numbers.size() == 0) return false;
    const bool complete = is_complete(numbers, width, part.foreign->vertex_count());
    if (!complete) ++bad_attributes_;
    return complete;
  };
  const auto add = [&](auto list, auto& values, auto otherwise, MeshArray<CornerIndices>* corners) {
    using Value = decltype(otherwise);
    std::vector<bool> given;
    given.reserve(parts.size());
    for (const Part& part : parts) given.push_back(has(part, list, otherwise.size()));
    if (std::ranges::find(given, true) == given.end()) return;
    if (corners && std::ranges::find(given, false) != given.end()) *corners = mesh.triangles;
    budget_.take(mesh.vertices.size(), sizeof(Value));
    values.assign(mesh.vertices.size(), otherwise);
    for (std::size_t i = 0; i < parts.size(); ++i) {
      const Part& part = parts[i];
      const std::size_t end =
          i + 1 < parts.size() ? parts[i + 1].first_triangle : mesh.triangles.size();
      for (std::size_t v = 0; given[i] && v < part.foreign->vertex_count(); ++v)
        values[part.first_vertex + v] = value_at<Value>(part.foreign->*list, v);
      for (std::size_t t = part.first_triangle; !given[i] && corners && t < end; ++t)
        (*corners)[t] = {no_index, no_index, no_index};
    }
  };
  add(&ForeignMesh::texture_coordinates, mesh.texture_coordinates, std::array<double, 2>{},
      &mesh.texture_triangles);
  add(&ForeignMesh::normals, mesh.normals, std::array<double, 3>{}, &mesh.normal_triangles);
  add(&ForeignMesh::colours, mesh.colours, std::array<float, 4>{1, 1, 1, 1}, nullptr);
  for (auto& colour : mesh.colours)
    for (float& component : colour) component = std::clamp(component, 0.0F, 1.0F);
}

void ForeignMeshBuilder::report(Warnings& warnings) const {
  mesh::warn_of_faces(skipped_faces_, odd_faces_, file_, warnings);
  if (bad_attributes_ > 0)
    warnings.push_back(file_ + ": " + std::to_string(bad_attributes_) +
                       (bad_attributes_ == 1 ? " list" : " lists") +
                       " of texture coordinates, normals or colours with numbers that are not "
                       "finite left out");
}

}  // namespace fathom::mesh_files::formats_program
