#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "fathom/failures/errors.h"
#include "fathom/mesh/mesh.h"
#include "fathom/mesh_files/expansion_budget.h"
#include "fathom/mesh_files/formats_program/messages.h"

/// Converts the meshes in replies of fathom-formats, without trusting any of their numbers.
namespace fathom::mesh_files::formats_program {

/// One mesh within an answer, which must outlive it.
struct ForeignMesh {
  /// Three, two, three and four numbers per vertex; empty if there is no such attribute.
  MessageList<float> positions, texture_coordinates, normals, colours;
  /// For each face, how many corners it has; the vertices of all corners.
  MessageList<std::uint32_t> face_sizes, corners;

  [[nodiscard]] std::size_t vertex_count() const { return positions.size() / 3; }
};

ForeignMesh read_foreign_mesh(MessageReader& answer);

/// Makes one Mesh of some of the meshes of a file, and counts findings that deserve a warning.
class ForeignMeshBuilder {
 public:
  /// `meshes` and `budget` must outlive this.
  ForeignMeshBuilder(const std::vector<ForeignMesh>& meshes, std::string file, bool attributes,
                     ExpansionBudget& budget)
      : meshes_(meshes), file_(std::move(file)), attributes_(attributes), budget_(budget) {}

  /// Joins the meshes with these numbers, one after the other.
  /// Fails    InputError: a vertex that does not exist, a coordinate that is not finite.
  Mesh build(const MessageList<std::uint32_t>& numbers);

  void report(Warnings& warnings) const;

 private:
  /// One of the meshes, in the mesh that is being built.
  struct Part {
    const ForeignMesh* foreign;
    std::size_t first_vertex;
    std::size_t first_triangle;
  };
  void add_positions(const ForeignMesh& foreign, Mesh& mesh) const;
  void add_attributes(const std::vector<Part>& parts, Mesh& mesh);

  const std::vector<ForeignMesh>& meshes_;
  std::string file_;
  bool attributes_;
  ExpansionBudget& budget_;
  std::uint64_t skipped_faces_ = 0, odd_faces_ = 0, bad_attributes_ = 0;
};

}  // namespace fathom::mesh_files::formats_program
