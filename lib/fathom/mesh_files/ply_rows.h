#pragma once

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "fathom/mesh_files/ply_header.h"
#include "fathom/numeric/errors.h"
#include "fathom/text/byte_window.h"
#include "fathom/text/text_cursor.h"

static_assert(std::endian::native == std::endian::little, "little endian PLY is read as it lies");

/// The values of the rows of a PLY file, one after the other, whatever its encoding.
namespace fathom::mesh_files {

/// The values of a body that is text. Every row stands on a line of its own.
class AsciiRows {
 public:
  AsciiRows(std::string_view body, const std::string& file, const PlyHeader& header)
      : cursor_(body, file, {}, text::TextCursor::line_end_of(body), header.lines + 1) {}

  static std::uint64_t least_row_size(const PlyElement& element) {
    return 2 * element.properties.size();  // a digit and what divides it from the next
  }
  static std::uint64_t least_triangle_size(const PlyElement& element, const PlyProperty&) {
    return least_row_size(element) + 6;
  }
  [[nodiscard]] std::uint64_t rest() const { return cursor_.rest() + 1; }

  void begin_row(const PlyElement& element, std::uint64_t row) {
    if (!cursor_.next_line_with_words())
      cursor_.fail("the file ends after " + std::to_string(row) + " of " +
                   std::to_string(element.count) + " rows of element " + element.name);
  }
  void end_row() {
    if (!cursor_.at_line_end()) cursor_.fail_here("expected the line to end");
  }

  /// A coordinate: rounded once to the type that the file declares.
  double finite(PlyType type, const char* what) {
    if (type == PlyType::float64) return cursor_.number<double>(what);
    if (type == PlyType::float32) return static_cast<double>(cursor_.number<float>(what));
    return static_cast<double>(integer(type, what));
  }
  double attribute(PlyType type) {
    if (type == PlyType::float64) return cursor_.attribute<double>("a number");
    if (type == PlyType::float32) return static_cast<double>(cursor_.attribute<float>("a number"));
    return static_cast<double>(integer(type, "an integer"));
  }
  std::int64_t integer(PlyType type, const char* what) {
    const std::int64_t value = cursor_.integer(what);
    const bool is_signed =
        type == PlyType::int8 || type == PlyType::int16 || type == PlyType::int32;
    const auto bits = static_cast<int>(8 * size_of(type));
    const std::int64_t least = is_signed ? -(std::int64_t{1} << (bits - 1)) : 0;
    const std::int64_t greatest = (std::int64_t{1} << (is_signed ? bits - 1 : bits)) - 1;
    if (value < least || value > greatest)
      cursor_.fail(std::string(what) + " " + std::to_string(value) +
                   " does not fit the type of its property, expected " + std::to_string(least) +
                   " to " + std::to_string(greatest));
    return value;
  }
  void skip(PlyType) {
    if (cursor_.word().empty()) cursor_.fail("expected a value, found the end of the line");
  }
  void skip(PlyType type, std::uint64_t count) {
    for (std::uint64_t i = 0; i < count; ++i) skip(type);
  }
  /// Meant for binary rows alone.
  [[nodiscard]] static std::uint64_t position() { return 0; }
  [[nodiscard]] bool has_more() { return cursor_.next_line_with_words(); }
  [[nodiscard]] std::string place() const { return "line " + std::to_string(cursor_.line()); }
  [[noreturn]] void fail(const std::string& message) const { cursor_.fail(message); }

 private:
  text::TextCursor cursor_;
};

/// The values of a binary body, one after the other.
template <bool big_endian>
class BinaryRows {
 public:
  BinaryRows(std::string_view body, const std::string& file, const PlyHeader& header)
      : BinaryRows(text::ByteWindow(body, header.size), file) {}
  BinaryRows(text::ByteWindow bytes, const std::string& file)
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

  void begin_row(const PlyElement&, std::uint64_t) {}
  void end_row() {}

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
  void skip(PlyType type, std::uint64_t count = 1) {
    if (count > rest() / size_of(type)) fail_end();
    bytes_.skip(count * size_of(type));
  }
  [[nodiscard]] bool has_more() const { return rest() > 0; }
  [[nodiscard]] std::string place() const { return "byte " + std::to_string(position()); }
  [[noreturn]] void fail(const std::string& message) const {
    throw InputError(file_ + ": " + place() + ": " + message);
  }

 private:
  [[noreturn]] void fail_end() const { fail("the file ends, expected more rows"); }

  template <class T>
  T take() {
    if (!bytes_.has(sizeof(T))) fail_end();
    std::array<char, sizeof(T)> bytes;
    std::memcpy(bytes.data(), bytes_.at(), sizeof(T));
    bytes_.advance(sizeof(T));
    if constexpr (big_endian) std::reverse(bytes.begin(), bytes.end());
    return std::bit_cast<T>(bytes);
  }

  text::ByteWindow bytes_;
  const std::string& file_;
};

/// What faces are made of: lists of indices of vertices, and properties that nobody asked for.
template <class Rows>
class PlyRowReader {
 public:
  PlyRowReader(Rows rows, std::uint64_t vertex_count)
      : rows_(std::move(rows)), vertex_count_(vertex_count) {}

  [[nodiscard]] Rows& rows() { return rows_; }

  /// One row of element face, whose property `indices` is the list of its corners.
  void read_face(const PlyElement& element, std::size_t indices, std::vector<std::uint32_t>& ring) {
    for (std::size_t k = 0; k < element.properties.size(); ++k) {
      if (k == indices) {
        read_ring(element.properties[k], ring);
      } else {
        skip(element.properties[k]);
      }
    }
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
    for (std::uint64_t k = 0; k < corners; ++k) {
      if (is_integer(property.type)) {
        const std::int64_t index = rows_.integer(property.type, "the index of a vertex");
        if (static_cast<std::uint64_t>(index) >= vertex_count_) fail_index(std::to_string(index));
        ring.push_back(static_cast<std::uint32_t>(index));
      } else {
        const double index = rows_.finite(property.type, "the index of a vertex");
        if (!(index >= 0 && index < static_cast<double>(vertex_count_)) ||
            index != std::floor(index))
          fail_index(std::to_string(index));
        ring.push_back(static_cast<std::uint32_t>(index));
      }
    }
  }

  [[noreturn]] void fail_index(const std::string& index) const {
    if (vertex_count_ == 0) rows_.fail("index " + index + " is out of range, there is no vertex");
    rows_.fail("index " + index + " is out of range, expected 0 to " +
               std::to_string(vertex_count_ - 1));
  }

  Rows rows_;
  std::uint64_t vertex_count_;
};

}  // namespace fathom::mesh_files
