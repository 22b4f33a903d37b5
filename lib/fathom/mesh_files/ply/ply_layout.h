#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "fathom/files/mapped_file.h"
#include "fathom/files/random_access_file.h"
#include "fathom/geometry/frames.h"
#include "fathom/mesh_files/ply/ply_header.h"

/// Where vertices and faces lie in a binary PLY file.
namespace fathom::mesh_files {

/// Where the coordinates of the vertices are in a binary PLY file: rows of equal length.
struct PlyVertexLayout {
  /// The position of the first row in the file.
  std::uint64_t offset = 0;
  std::uint64_t count = 0;
  std::size_t row_size = 0;
  bool big_endian = false;
  /// Positions of x, y and z within a row.
  std::array<std::size_t, 3> places{};
  std::array<PlyType, 3> types{};
  /// The position of the label within a row, and its type, if it has one.
  std::size_t label_place = 0;
  std::optional<PlyType> label_type = std::nullopt;
};

/// The layout of an element without lists that has x, y and z, whose property `label`, if it is
/// one, is a label.
PlyVertexLayout layout_of_vertices(const PlyElement& element, std::uint64_t offset, bool big_endian,
                                   std::optional<std::size_t> label);

/// Vertices in memory, with their labels, if they have any.
struct PlyVertexList {
  std::vector<MeshPoint> points;
  std::vector<std::uint32_t> labels;
};

/// The vertices of a PLY file by number: read through a few blocks; or mapped, so that they take
/// addresses but no memory that the system could not take back; or, if their rows differ in length,
/// a list.
class PlyVertices {
 public:
  /// The file must outlive this.
  /// Fails    InputError if the vertices cannot be mapped, for instance for lack of addresses.
  PlyVertices(const files::RandomAccessFile& file, const PlyVertexLayout& layout, bool mapped);
  explicit PlyVertices(PlyVertexList list) : list_(std::move(list)) {}
  PlyVertices(const PlyVertices&) = delete;
  PlyVertices& operator=(const PlyVertices&) = delete;

  /// Fails    InputError if the vertex is not finite, which it was when the file was checked, or
  ///          cannot be read any more.
  [[nodiscard]] MeshPoint operator[](std::uint32_t vertex) const;
  /// Whether vertices have labels; and the label of a vertex, `unsegmented` if its number is not a
  /// label.
  [[nodiscard]] bool have_labels() const {
    return layout_.label_type.has_value() || !list_.labels.empty();
  }
  [[nodiscard]] std::uint32_t label(std::uint32_t vertex) const;

 private:
  /// The number at `place` in the row of a vertex.
  [[nodiscard]] double value(std::uint32_t vertex, std::size_t place, PlyType type) const;

  PlyVertexLayout layout_;
  PlyVertexList list_;
  std::string name_;
  files::MappedFile mapped_;
  const char* rows_ = nullptr;
  std::optional<files::FileBlocks> blocks_;
};

/// The layout of a binary PLY file if all of its faces are triangles. The size of the file suggests
/// that without a proof: two faces of three corners take as much as one of two and one of four. It
/// is proved when every part has been checked, in any order: the first row begins at the assumed
/// place, and each row of three corners puts the next row at its assumed place.
class PlySupposedTriangles {
 public:
  /// nullopt if the file has another size, no faces, rows of other lengths, strips of triangles,
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
