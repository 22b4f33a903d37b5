#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "fathom/geometry/frames.h"
#include "fathom/mesh_files/ply_header.h"
#include "fathom/text/random_access_file.h"

namespace fathom::mesh_files {

/// Where the coordinates of the vertices of a binary PLY file lie: rows of equal length.
struct PlyVertexLayout {
  /// Of the first row in the file.
  std::uint64_t offset = 0;
  std::uint64_t count = 0;
  std::size_t row_size = 0;
  bool big_endian = false;
  /// Of x, y and z within a row.
  std::array<std::size_t, 3> places{};
  std::array<PlyType, 3> types{};
};

/// The layout of an element without lists that has x, y and z.
PlyVertexLayout layout_of_vertices(const PlyElement& element, std::uint64_t offset,
                                   bool big_endian);

/// The vertices of a PLY file by their numbers: mapped, so that they take addresses but no memory
/// that the system could not take back; or, where their rows differ in length, a list.
class PlyVertices {
 public:
  /// Fails    InputError if the block cannot be mapped, for want of addresses for instance.
  PlyVertices(const text::RandomAccessFile& file, const PlyVertexLayout& layout);
  explicit PlyVertices(std::vector<MeshPoint> list) : list_(std::move(list)) {}
  PlyVertices(const PlyVertices&) = delete;
  PlyVertices& operator=(const PlyVertices&) = delete;
  ~PlyVertices();

  [[nodiscard]] MeshPoint operator[](std::uint32_t vertex) const;

 private:
  PlyVertexLayout layout_;
  std::vector<MeshPoint> list_;
  void* mapping_ = nullptr;
  std::size_t mapped_ = 0;
  const char* rows_ = nullptr;
};

}  // namespace fathom::mesh_files
