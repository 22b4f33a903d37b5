#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>

#include "fathom/files/random_access_file.h"
#include "fathom/mesh_files/ply/ply_header.h"

namespace fathom::mesh_files {

/// Where things are in a binary PLY file if all of its faces are triangles, which its size lets
/// suppose and does not prove: two faces of three corners take as much as one of two and one of
/// four. It is proved when every part has been checked, in whatever order and by whomever: the
/// first row begins where it is said to, and each that has three corners puts the next one in its
/// place.
class PlySupposedTriangles {
 public:
  /// nullopt where the file has another size, no faces, rows of other lengths, strips of triangles,
  /// faces before vertices, or a header that is wrong, which reading the file will tell.
  static std::optional<PlySupposedTriangles> of(const PlyHeader& header, std::uint64_t file_size);

  [[nodiscard]] const PlyElement& vertices() const { return vertices_; }
  [[nodiscard]] std::uint64_t vertex_offset() const { return vertex_offset_; }
  [[nodiscard]] const PlyElement& faces() const { return faces_; }
  [[nodiscard]] std::uint64_t face_offset() const { return face_offset_; }
  [[nodiscard]] std::size_t face_size() const { return face_size_; }
  /// The place of the list of corners among the properties of a face.
  [[nodiscard]] std::size_t indices() const { return indices_; }

  /// Whether the faces of one of `parts` equal parts have three corners each. Looks at its
  /// vertices, too.
  /// Fails    InputError, as the ordinary reader, where a vertex is not finite.
  [[nodiscard]] bool check(const files::RandomAccessFile& file, std::uint64_t part,
                           std::uint64_t parts) const;

 private:
  template <bool big_endian>
  void check_vertices(const files::RandomAccessFile& file, std::uint64_t first,
                      std::uint64_t end) const;
  template <bool big_endian>
  [[nodiscard]] bool are_triangles(const files::RandomAccessFile& file, std::uint64_t first,
                                   std::uint64_t end) const;
  template <bool big_endian>
  [[nodiscard]] bool check_rows(const files::RandomAccessFile& file, std::uint64_t part,
                                std::uint64_t parts) const;

  bool big_endian_ = false;
  PlyElement vertices_, faces_;
  std::uint64_t vertex_offset_ = 0, face_offset_ = 0;
  std::size_t face_size_ = 0, indices_ = 0;
};

}  // namespace fathom::mesh_files
