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
  /// Whether they have labels; the label of one, `unsegmented` where it is none.
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

}  // namespace fathom::mesh_files
