#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "fathom/geometry/frames.h"
#include "fathom/mesh_files/ply_header.h"
#include "fathom/text/mapped_file.h"
#include "fathom/text/random_access_file.h"

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
};

/// The layout of an element without lists that has x, y and z.
PlyVertexLayout layout_of_vertices(const PlyElement& element, std::uint64_t offset,
                                   bool big_endian);

/// The vertices of a PLY file by number: mapped, so that they take addresses but no memory that the
/// system could not take back; or, if their rows differ in length, a list.
class PlyVertices {
 public:
  /// Fails    InputError if the block cannot be mapped, for instance for lack of addresses.
  PlyVertices(const text::RandomAccessFile& file, const PlyVertexLayout& layout);
  explicit PlyVertices(std::vector<MeshPoint> list) : list_(std::move(list)) {}
  PlyVertices(const PlyVertices&) = delete;
  PlyVertices& operator=(const PlyVertices&) = delete;

  /// Fails    InputError if the vertex is not finite, which it was when the file was checked.
  [[nodiscard]] MeshPoint operator[](std::uint32_t vertex) const;

 private:
  PlyVertexLayout layout_;
  std::vector<MeshPoint> list_;
  std::string name_;
  text::MappedFile mapped_;
  const char* rows_ = nullptr;
};

}  // namespace fathom::mesh_files
