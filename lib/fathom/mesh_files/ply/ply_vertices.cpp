#include "fathom/mesh_files/ply/ply_vertices.h"

#include <algorithm>
#include <bit>
#include <cerrno>
#include <cmath>
#include <cstring>
#include <span>
#include <system_error>

#include "fathom/failures/errors.h"
#include "fathom/mesh_files/ply/ply_labels.h"

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

}  // namespace fathom::mesh_files
