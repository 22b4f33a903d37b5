#pragma once

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "fathom/failures/errors.h"
#include "fathom/files/random_access_file.h"
#include "fathom/mesh/mesh.h"
#include "fathom/mesh_files/ply/ply_header.h"

static_assert(std::endian::native == std::endian::little, "little endian PLY is read as it lies");

/// The values of the rows of a binary PLY file, one after another.
namespace fathom::mesh_files {

/// Where the coordinates lie in a row of an element whose rows all have one size.
struct PlyPointLayout {
  std::size_t row_size = 0;
  std::array<std::size_t, 3> offsets{};
  PlyType type = PlyType::float32;  // or float64
};

/// The values of a binary body, one after another.
template <bool big_endian>
class BinaryRows {
 public:
  BinaryRows(std::string_view body, const std::string& file, const PlyHeader& header)
      : BinaryRows(files::ByteWindow(body, header.size), file) {}
  BinaryRows(files::ByteWindow bytes, const std::string& file)
      : bytes_(std::move(bytes)), file_(file) {}

  static std::uint64_t least_row_size(const PlyElement& element) {
    return element.least_row_size();
  }
  static std::uint64_t least_triangle_size(const PlyElement& element, const PlyProperty& indices) {
    return least_row_size(element) + 3 * size_of(indices.type);
  }
  [[nodiscard]] std::uint64_t rest() const { return bytes_.rest(); }
  /// Number of the next byte in the file.
  [[nodiscard]] std::uint64_t position() const { return bytes_.position(); }

  /// Reads a row at once if only its three coordinates are needed. False if the row is not in the
  /// buffer or has a coordinate that is not finite: it must then be read value by value.
  bool take_point(const PlyPointLayout& layout, std::array<double, 3>& point) {
    if (!bytes_.has_at_hand(layout.row_size)) return false;
    for (std::size_t k = 0; k < 3; ++k) {
      const char* const at = bytes_.at() + layout.offsets[k];
      point[k] = layout.type == PlyType::float32 ? static_cast<double>(value_at<float>(at))
                                                 : value_at<double>(at);
    }
    if (!std::isfinite(point[0]) || !std::isfinite(point[1]) || !std::isfinite(point[2]))
      return false;
    bytes_.advance(layout.row_size);
    return true;
  }
  /// The same of a list of three indices below `count`, as most faces are: a byte and three
  /// integers of 32 bits.
  bool take_triangle(const PlyProperty& list, std::uint64_t count, CornerIndices& triangle) {
    if (list.count_type != PlyType::uint8) return false;
    if (list.type != PlyType::int32 && list.type != PlyType::uint32) return false;
    if (!bytes_.has_at_hand(1 + sizeof triangle) || *bytes_.at() != 3) return false;
    for (std::size_t k = 0; k < 3; ++k)
      triangle[k] = value_at<std::uint32_t>(bytes_.at() + 1 + k * sizeof(std::uint32_t));
    const std::uint32_t greatest = std::max({triangle[0], triangle[1], triangle[2]});
    if (greatest >= count || greatest > 0x7FFFFFFF) return false;  // or negative
    bytes_.advance(1 + sizeof triangle);
    return true;
  }

  void begin_row(const PlyElement&, std::uint64_t) {}
  void end_row() {}
  void expect_face(std::size_t) const {}

  double finite(PlyType type, const char* what) {
    const double value = attribute(type);
    if (!std::isfinite(value)) {
      bytes_.back(size_of(type));
      fail(std::string(what) + " is not finite, expected a finite number");
    }
    return value;
  }
  double attribute(PlyType type) {
    if (type == PlyType::float32) return static_cast<double>(take<float>());
    if (type == PlyType::float64) return take<double>();
    return static_cast<double>(integer(type, ""));
  }
  std::int64_t integer(PlyType type, const char*) {
    switch (type) {
      case PlyType::int8:
        return take<std::int8_t>();
      case PlyType::uint8:
        return take<std::uint8_t>();
      case PlyType::int16:
        return take<std::int16_t>();
      case PlyType::uint16:
        return take<std::uint16_t>();
      case PlyType::int32:
        return take<std::int32_t>();
      default:
        return take<std::uint32_t>();
    }
  }
  /// A label; `unsegmented` if the number cannot be a label.
  std::uint32_t label(PlyType type) { return label_from(integer(type, "")); }
  void skip(PlyType type, std::uint64_t count = 1) {
    if (count > rest() / size_of(type)) fail_end();
    bytes_.skip(count * size_of(type));
  }
  [[nodiscard]] bool has_more() const { return rest() > 0; }
  /// What more there is to say of a failure: nothing.
  [[nodiscard]] static std::string explained(const std::string& message) { return message; }
  [[nodiscard]] std::string place() const { return "byte " + std::to_string(position()); }
  [[noreturn]] void fail(const std::string& message) const {
    throw InputError(file_ + ": " + place() + ": " + message);
  }

 private:
  [[noreturn]] void fail_end() const { fail("the file ends, expected more rows"); }

  template <class T>
  T take() {
    if (!bytes_.has(sizeof(T))) fail_end();
    const T value = value_at<T>(bytes_.at());
    bytes_.advance(sizeof(T));
    return value;
  }
  template <class T>
  static T value_at(const char* at) {
    std::array<char, sizeof(T)> bytes;
    std::memcpy(bytes.data(), at, sizeof(T));
    if constexpr (big_endian) std::reverse(bytes.begin(), bytes.end());
    return std::bit_cast<T>(bytes);
  }

  files::ByteWindow bytes_;
  const std::string& file_;
};

/// The position of the reader in a list of triangle strips.
struct PlyStrip {
  /// Indices that are left in the list.
  std::uint64_t left = 0;
  /// Corners since the strip began, and the last two of them.
  std::uint64_t corners = 0;
  std::array<std::uint32_t, 2> last{};
};

/// The properties of a face that are read, as places among the properties of its element.
struct PlyFaceColumns {
  std::size_t indices = 0;
  std::optional<std::size_t> label = std::nullopt;
};

/// A face as it is read.
struct PlyFace {
  /// The vertices of its corners.
  std::vector<std::uint32_t> ring;
  std::uint32_t label = unsegmented;
};

/// Reads faces: lists of indices of vertices, labels, and properties that are skipped.
template <class Rows>
class PlyRowReader {
 public:
  PlyRowReader(Rows rows, std::uint64_t vertex_count)
      : rows_(std::move(rows)), vertex_count_(vertex_count) {}

  [[nodiscard]] Rows& rows() { return rows_; }
  [[nodiscard]] std::uint64_t vertex_count() const { return vertex_count_; }

  /// One row of element face.
  void read_face(const PlyElement& element, const PlyFaceColumns& columns, PlyFace& face) {
    for (std::size_t k = 0; k < element.properties.size(); ++k) {
      if (k == columns.indices) {
        read_ring(element.properties[k], face.ring);
      } else if (k == columns.label) {
        face.label = rows_.label(element.properties[k].type);
      } else {
        skip(element.properties[k]);
      }
    }
  }

  /// The list of a row of element tristrips begins.
  PlyStrip begin_strip(const PlyProperty& indices) {
    return {.left = read_list_count(indices), .corners = 0, .last = {}};
  }

  /// Reads the next index of a strip: a corner, or −1, which begins another strip. The triangle, if
  /// the corner completes one; every other one is turned round, as in [GLTF20] 3.7.2.1.
  std::optional<CornerIndices> next_corner(const PlyProperty& indices, PlyStrip& strip) {
    --strip.left;
    const std::int64_t index = rows_.integer(indices.type, "the index of a vertex");
    if (index == -1) {
      strip.corners = 0;
      return std::nullopt;
    }
    if (static_cast<std::uint64_t>(index) >= vertex_count_)
      fail_index(std::to_string(index), " or -1");
    const auto corner = static_cast<std::uint32_t>(index);
    const auto [a, b] = strip.last;
    strip.last = {b, corner};
    ++strip.corners;
    if (strip.corners < 3) return std::nullopt;
    if (strip.corners % 2 == 0) return CornerIndices{a, corner, b};
    return CornerIndices{a, b, corner};
  }

  /// The index of a vertex, in range.
  std::uint32_t read_index(const PlyProperty& property) {
    if (is_integer(property.type)) {
      const std::int64_t index = rows_.integer(property.type, "the index of a vertex");
      if (static_cast<std::uint64_t>(index) >= vertex_count_) fail_index(std::to_string(index));
      return static_cast<std::uint32_t>(index);
    }
    const double index = rows_.finite(property.type, "the index of a vertex");
    if (!(index >= 0 && index < static_cast<double>(vertex_count_)) || index != std::floor(index))
      fail_index(std::to_string(index));
    return static_cast<std::uint32_t>(index);
  }

  void skip(const PlyProperty& property) {
    if (!property.count_type) return rows_.skip(property.type);
    const std::uint64_t count = read_list_count(property);
    rows_.skip(property.type, count);
  }

 private:
  std::uint64_t read_list_count(const PlyProperty& property) {
    const std::int64_t count = rows_.integer(*property.count_type, "the count of a list");
    if (count < 0) rows_.fail("expected the count of a list, found a negative one");
    return static_cast<std::uint64_t>(count);
  }

  void read_ring(const PlyProperty& property, std::vector<std::uint32_t>& ring) {
    const std::uint64_t corners = read_list_count(property);
    ring.clear();
    for (std::uint64_t k = 0; k < corners; ++k) ring.push_back(read_index(property));
  }

  [[noreturn]] void fail_index(const std::string& index, const char* other = "") const {
    if (vertex_count_ == 0) rows_.fail("index " + index + " is out of range, there is no vertex");
    rows_.fail("index " + index + " is out of range, expected 0 to " +
               std::to_string(vertex_count_ - 1) + other);
  }

  Rows rows_;
  std::uint64_t vertex_count_;
};

}  // namespace fathom::mesh_files
