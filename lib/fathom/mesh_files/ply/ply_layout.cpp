#include "fathom/mesh_files/ply/ply_layout.h"

#include <algorithm>
#include <bit>
#include <cerrno>
#include <cmath>
#include <cstring>
#include <span>
#include <system_error>

#include "fathom/failures/errors.h"
#include "fathom/mesh_files/ply/ply_body.h"
#include "fathom/mesh_files/ply/ply_header.h"

namespace fathom::mesh_files {
using namespace files;

namespace {

template <class T>
double value_at(const char* at, bool big_endian) {
  std::array<char, sizeof(T)> bytes;
  std::memcpy(bytes.data(), at, sizeof(T));
  if (big_endian) std::reverse(bytes.begin(), bytes.end());
  return static_cast<double>(std::bit_cast<T>(bytes));
}

double value_at(const char* at, PlyType type, bool big_endian) {
  switch (type) {
    case PlyType::int8:
      return value_at<std::int8_t>(at, big_endian);
    case PlyType::uint8:
      return value_at<std::uint8_t>(at, big_endian);
    case PlyType::int16:
      return value_at<std::int16_t>(at, big_endian);
    case PlyType::uint16:
      return value_at<std::uint16_t>(at, big_endian);
    case PlyType::int32:
      return value_at<std::int32_t>(at, big_endian);
    case PlyType::uint32:
      return value_at<std::uint32_t>(at, big_endian);
    case PlyType::float32:
      return value_at<float>(at, big_endian);
    case PlyType::float64:
      break;
  }
  return value_at<double>(at, big_endian);
}

}  // namespace

PlyVertexLayout layout_of_vertices(const PlyElement& element, std::uint64_t offset, bool big_endian,
                                   std::optional<std::size_t> label) {
  PlyVertexLayout layout{.offset = offset, .count = element.count, .big_endian = big_endian};
  static constexpr const char* names[] = {"x", "y", "z"};
  for (std::size_t k = 0; k < element.properties.size(); ++k) {
    const PlyProperty& property = element.properties[k];
    if (k == label) {
      layout.label_place = layout.row_size;
      layout.label_type = property.type;
    }
    for (std::size_t i = 0; i < 3; ++i) {
      if (property.name != names[i]) continue;
      layout.places[i] = layout.row_size;
      layout.types[i] = property.type;
    }
    layout.row_size += size_of(property.type);
  }
  return layout;
}

PlyVertices::PlyVertices(const RandomAccessFile& file, const PlyVertexLayout& layout, bool mapped)
    : layout_(layout), name_(file.name()) {
  if (layout.count == 0) return;
  if (!mapped) {
    blocks_.emplace(file);
    return;
  }
  const std::uint64_t size = layout.count * layout.row_size;
  mapped_ = MappedFile(file.descriptor(), layout.offset, static_cast<std::size_t>(size), name_);
  if (!mapped_.is_mapped()) {
    throw InputError(name_ + ": its vertices, " + std::to_string(size) +
                     " bytes, cannot be mapped: " + std::generic_category().message(errno));
  }
  rows_ = reinterpret_cast<const char*>(mapped_.data());
}

double PlyVertices::value(std::uint32_t vertex, std::size_t place, PlyType type) const {
  const std::uint64_t at = layout_.row_size * std::uint64_t{vertex} + place;
  if (rows_) return value_at(rows_ + at, type, layout_.big_endian);
  std::array<char, sizeof(double)> bytes;
  blocks_->read(layout_.offset + at, std::as_writable_bytes(std::span(bytes).first(size_of(type))));
  return value_at(bytes.data(), type, layout_.big_endian);
}

MeshPoint PlyVertices::operator[](std::uint32_t vertex) const {
  if (!rows_ && !blocks_) return list_.points[vertex];
  const auto coordinate = [&](std::size_t i) {
    return value(vertex, layout_.places[i], layout_.types[i]);
  };
  const MeshPoint point{coordinate(0), coordinate(1), coordinate(2)};
  if (!std::isfinite(point.x) || !std::isfinite(point.y) || !std::isfinite(point.z)) {
    throw InputError(name_ + ": vertex " + std::to_string(vertex) +
                     " is not finite any more: the file has been written to since it was opened");
  }
  return point;
}

std::uint32_t PlyVertices::label(std::uint32_t vertex) const {
  if (!rows_ && !blocks_) return list_.labels[vertex];
  // Integers of 32 bits are binary64 numbers.
  return label_from(
      static_cast<std::int64_t>(value(vertex, layout_.label_place, *layout_.label_type)));
}

namespace {

constexpr std::size_t bytes_at_once = std::size_t{1} << 20;

/// PlyBody checks vertices as it reads them; more is not wanted.
struct NothingOfVertices {
  template <class Has, class Rows>
  void begin_vertices(const PlyElement&, const Has&, const Rows&) {}
  void vertex(const PlyVertex&) {}
  template <class Rows>
  void begin_faces(const PlyElement&, const PlyFaceColumns&, std::uint64_t, const Rows&) {}
  template <class Rows>
  void face(const PlyFace&, const Rows&) {}
  void begin_strips(const PlyElement&, std::size_t) {}
  template <class Rows>
  void strip_corner(const PlyStrip&, std::uint64_t, const Rows&) {}
  void strip_triangle(const CornerIndices&) {}
};

bool has_coordinates(const PlyElement& vertices) {
  return vertices.find({"x"}) && vertices.find({"y"}) && vertices.find({"z"});
}

/// The place of the only list of a face, its corners.
std::optional<std::size_t> only_list(const PlyElement& faces) {
  const auto is_list = [](const PlyProperty& property) { return property.count_type.has_value(); };
  if (std::ranges::count_if(faces.properties, is_list) != 1) return std::nullopt;
  const auto indices = faces.find({"vertex_indices", "vertex_index"});
  if (!indices || !is_list(faces.properties[*indices])) return std::nullopt;
  return indices;
}

/// The first of `count` things that belong to a part.
std::uint64_t first_of(std::uint64_t part, std::uint64_t parts, std::uint64_t count) {
  return count * part / parts;
}

}  // namespace

std::optional<PlySupposedTriangles> PlySupposedTriangles::of(const PlyHeader& header,
                                                             std::uint64_t file_size) {
  PlySupposedTriangles rows;
  rows.big_endian_ = header.encoding == PlyHeader::Encoding::big_endian;
  bool has_vertices = false, has_faces = false;
  std::uint64_t offset = header.size;
  for (const PlyElement& element : header.elements) {
    if (element.count > mesh::most_elements) return std::nullopt;
    std::size_t size = element.least_row_size();
    if (element.name == "face") {
      const auto indices = only_list(element);
      if (!indices || !has_vertices || has_faces || element.count == 0) return std::nullopt;
      has_faces = true;
      size += 3 * size_of(element.properties[*indices].type);
      rows.faces_ = element;
      rows.face_offset_ = offset;
      rows.face_size_ = size;
      rows.indices_ = *indices;
    } else if (element.has_lists() || element.name == "tristrips") {
      return std::nullopt;
    } else if (element.name == "vertex") {
      if (has_vertices || !has_coordinates(element)) return std::nullopt;
      has_vertices = true;
      rows.vertices_ = element;
      rows.vertex_offset_ = offset;
    }
    offset += element.count * size;
  }
  if (!has_faces || offset != file_size) return std::nullopt;
  return rows;
}

template <bool big_endian>
void PlySupposedTriangles::check_vertices(const RandomAccessFile& file, std::uint64_t first,
                                          std::uint64_t end) const {
  PlyHeader of_part;
  of_part.elements = {vertices_};
  of_part.elements.front().count = end - first;
  const std::size_t size = vertices_.least_row_size();
  BinaryRows<big_endian> rows(
      ByteWindow(file, vertex_offset_ + first * size, vertex_offset_ + end * size, bytes_at_once),
      file.name());
  NothingOfVertices nothing;
  Warnings none;
  PlyBody<BinaryRows<big_endian>, NothingOfVertices>(std::move(rows), of_part, file.name(), false,
                                                     {}, nothing)
      .read(none);
}

template <bool big_endian>
bool PlySupposedTriangles::are_triangles(const RandomAccessFile& file, std::uint64_t first,
                                         std::uint64_t end) const {
  const PlyProperty& list = faces_.properties[indices_];
  std::size_t before = 0;
  for (std::size_t k = 0; k < indices_; ++k) before += size_of(faces_.properties[k].type);
  const std::size_t after = face_size_ - before - size_of(*list.count_type);
  BinaryRows<big_endian> rows(ByteWindow(file, face_offset_ + first * face_size_,
                                         face_offset_ + end * face_size_, bytes_at_once),
                              file.name());
  for (std::uint64_t face = first; face < end; ++face) {
    rows.skip(PlyType::uint8, before);
    if (rows.integer(*list.count_type, "the count of a list") != 3) return false;
    rows.skip(PlyType::uint8, after);
  }
  return true;
}

template <bool big_endian>
bool PlySupposedTriangles::check_rows(const RandomAccessFile& file, std::uint64_t part,
                                      std::uint64_t parts) const {
  check_vertices<big_endian>(file, first_of(part, parts, vertices_.count),
                             first_of(part + 1, parts, vertices_.count));
  return are_triangles<big_endian>(file, first_of(part, parts, faces_.count),
                                   first_of(part + 1, parts, faces_.count));
}

bool PlySupposedTriangles::check(const RandomAccessFile& file, std::uint64_t part,
                                 std::uint64_t parts) const {
  const bool holds =
      big_endian_ ? check_rows<true>(file, part, parts) : check_rows<false>(file, part, parts);
  file.expect_unchanged();
  return holds;
}

}  // namespace fathom::mesh_files
