#pragma once

#include <cstdint>
#include <span>
#include <string>

#include "fathom/failures/errors.h"
#include "fathom/mesh/mesh.h"

/// From the faces of a file to the triangles of a mesh, and how many of them can be numbered.
namespace fathom::mesh {

/// The most triangles, vertices or faces that are allowed: the next number means "none".
inline constexpr std::uint64_t most_elements = 0xFFFFFFFE;

/// Throws InputError "FILE: N WHAT are more than …" where `count` is above most_elements.
void expect_countable(std::uint64_t count, const char* what, const std::string& file);

/// Throws the InputError of a file with more than most_elements triangles or faces.
[[noreturn]] void fail_too_many_triangles(const std::string& file);

/// Warns of faces that were skipped, and of `odd` ones that were cut in spite of their shape.
void warn_of_faces(std::uint64_t skipped, std::uint64_t odd, const std::string& file,
                   Warnings& warnings);

/// Adds the faces of a file one by one, for now each as a fan; see cut_polygons().
class FaceCollector {
 public:
  FaceCollector(Mesh& mesh, const std::string& file) : mesh_(mesh), file_(file) {}

  /// `corners` are indices of vertices, in range. A face of fewer than three counts but is skipped.
  void add(std::span<const std::uint32_t> corners) {
    if (corners.size() != 3) note_odd_face(corners.size());
    for (std::size_t k = 2; k < corners.size(); ++k) {
      mesh_.triangles.push_back({corners[0], corners[k - 1], corners[k]});
      if (odd_) mesh_.face_of_triangle.push_back(static_cast<std::uint32_t>(mesh_.face_count));
    }
    ++mesh_.face_count;
    if (mesh_.triangles.size() > most_elements || mesh_.face_count > most_elements)
      fail_too_many_triangles(file_);
  }

  [[nodiscard]] std::uint64_t skipped() const { return skipped_; }

 private:
  void note_odd_face(std::size_t corners);

  Mesh& mesh_;
  const std::string& file_;
  bool odd_ = false;  // an earlier face did not have three corners
  std::uint64_t skipped_ = 0;
};

/// Cuts the faces of more than three corners, which are in the mesh as fans (0, k, k+1), by section
/// 3 of the specification. Texture and normal triangles have the same layout and are cut in the
/// same way. Returns how many faces were cut in spite of their shape.
std::uint64_t cut_polygons(Mesh& mesh);

/// The same, with warnings of those and of the faces that were skipped.
void cut_polygons(Mesh& mesh, std::uint64_t skipped_faces, const std::string& file,
                  Warnings& warnings);

}  // namespace fathom::mesh
