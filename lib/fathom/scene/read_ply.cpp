#include <algorithm>
#include <bit>
#include <cmath>
#include <cstring>
#include <limits>
#include <utility>

#include "fathom/numeric/errors.h"
#include "fathom/scene/mesh_faces.h"
#include "fathom/scene/ply_header.h"
#include "fathom/scene/read_mesh.h"
#include "fathom/scene/text_cursor.h"

static_assert(std::endian::native == std::endian::little, "little endian PLY is read as it lies");

namespace fathom {
namespace {

/// The values of a body that is text. Every row stands on a line of its own.
class AsciiRows {
 public:
  AsciiRows(std::string_view body, const std::string& file, const PlyHeader& header)
      : cursor_(body, file, {}, TextCursor::line_end_of(body), header.lines + 1) {}

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
  [[nodiscard]] bool has_more() { return cursor_.next_line_with_words(); }
  [[nodiscard]] std::string place() const { return "line " + std::to_string(cursor_.line()); }
  [[noreturn]] void fail(const std::string& message) const { cursor_.fail(message); }

 private:
  TextCursor cursor_;
};

/// The values of a binary body, one after the other.
template <bool big_endian>
class BinaryRows {
 public:
  BinaryRows(std::string_view body, const std::string& file, const PlyHeader& header)
      : at_(body.data()),
        end_(body.data() + body.size()),
        first_(at_),
        offset_(header.size),
        file_(file) {}

  static std::uint64_t least_row_size(const PlyElement& element) {
    return element.least_row_size();
  }
  static std::uint64_t least_triangle_size(const PlyElement& element, const PlyProperty& indices) {
    return least_row_size(element) + 3 * size_of(indices.type);
  }
  [[nodiscard]] std::uint64_t rest() const { return static_cast<std::uint64_t>(end_ - at_); }

  void begin_row(const PlyElement&, std::uint64_t) {}
  void end_row() {}

  double finite(PlyType type, const char* what) {
    const double value = attribute(type);
    if (!std::isfinite(value)) {
      at_ -= size_of(type);
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
    at_ += count * size_of(type);
  }
  [[nodiscard]] bool has_more() const { return at_ != end_; }
  [[nodiscard]] std::string place() const {
    return "byte " + std::to_string(offset_ + static_cast<std::size_t>(at_ - first_));
  }
  [[noreturn]] void fail(const std::string& message) const {
    throw InputError(file_ + ": " + place() + ": " + message);
  }

 private:
  [[noreturn]] void fail_end() const { fail("the file ends, expected more rows"); }

  template <class T>
  T take() {
    if (rest() < sizeof(T)) fail_end();
    std::array<char, sizeof(T)> bytes;
    std::memcpy(bytes.data(), at_, sizeof(T));
    at_ += sizeof(T);
    if constexpr (big_endian) std::reverse(bytes.begin(), bytes.end());
    return std::bit_cast<T>(bytes);
  }

  const char* at_;
  const char* end_;
  const char* first_;
  std::size_t offset_;
  const std::string& file_;
};

/// What the properties of a vertex are for us.
enum Slot : int { slot_x = 0, slot_normal = 3, slot_texture = 6, slot_colour = 8, slot_count = 12 };
constexpr int skipped = -1;

/// Reads the rows of all elements into a mesh.
template <class Rows>
class PlyBody {
 public:
  PlyBody(Rows rows, const PlyHeader& header, const std::string& file, bool attributes)
      : rows_(std::move(rows)), header_(header), file_(file), attributes_(attributes) {}

  Mesh read(Warnings& warnings) {
    const PlyElement* vertices = header_.find("vertex");
    if (!vertices) throw InputError(file_ + ": has no element vertex, expected one");
    if (header_.find("tristrips"))
      throw InputError(file_ +
                       ": triangle strips (element tristrips) are not supported, expected "
                       "element face");
    vertex_count_ = vertices->count;
    FaceCollector faces(mesh_, file_);
    for (const PlyElement& element : header_.elements) {
      if (element.properties.empty()) continue;
      expect_room(element);
      if (element.name == "vertex") {
        read_vertices(element);
      } else if (element.name == "face") {
        read_faces(element, faces);
      } else {
        skip_rows(element);
      }
    }
    if (rows_.has_more())
      warnings.push_back(file_ + ": " + rows_.place() + ": what follows the last row is ignored");
    cut_polygons(mesh_, faces.skipped(), file_, warnings);
    return std::move(mesh_);
  }

 private:
  /// The rows that the header claims must be able to stand in what is left of the file.
  void expect_room(const PlyElement& element) {
    expect_countable(element.count, ("rows of element " + element.name).c_str(), file_);
    const std::uint64_t size = Rows::least_row_size(element);
    if (element.count > rows_.rest() / size)
      throw InputError(file_ + ": " + std::to_string(element.count) + " rows of element " +
                       element.name + " are claimed, expected a file long enough for them");
  }

  std::vector<int> plan_vertex(const PlyElement& element) const {
    std::vector<int> plan(element.properties.size(), skipped);
    const auto assign = [&](int slot, std::initializer_list<std::string_view> names) {
      const auto at = element.find(names);
      if (!at || element.properties[*at].count_type) return false;
      plan[*at] = slot;
      return true;
    };
    if (!assign(slot_x, {"x"}) || !assign(slot_x + 1, {"y"}) || !assign(slot_x + 2, {"z"}))
      throw InputError(file_ + ": element vertex lacks x, y or z, expected all three");
    if (!attributes_) return plan;
    assign(slot_normal, {"nx"}), assign(slot_normal + 1, {"ny"}), assign(slot_normal + 2, {"nz"});
    assign(slot_texture, {"s", "u", "texture_u"}),
        assign(slot_texture + 1, {"t", "v", "texture_v"});
    assign(slot_colour, {"red"}), assign(slot_colour + 1, {"green"});
    assign(slot_colour + 2, {"blue"}), assign(slot_colour + 3, {"alpha"});
    return plan;
  }

  void read_vertices(const PlyElement& element) {
    const std::vector<int> plan = plan_vertex(element);
    const auto has = [&](int slot) {
      return std::find(plan.begin(), plan.end(), slot) != plan.end();
    };
    const bool normals = has(slot_normal) && has(slot_normal + 1) && has(slot_normal + 2);
    const bool textures = has(slot_texture) && has(slot_texture + 1);
    const bool colours = has(slot_colour) && has(slot_colour + 1) && has(slot_colour + 2);
    mesh_.vertices.reserve(element.count);
    if (normals) mesh_.normals.reserve(element.count);
    if (textures) mesh_.texture_coordinates.reserve(element.count);
    if (colours) mesh_.colours.reserve(element.count);
    std::array<double, slot_count> row{};
    row[slot_colour + 3] = 1;
    for (std::uint64_t i = 0; i < element.count; ++i) {
      rows_.begin_row(element, i);
      for (std::size_t k = 0; k < plan.size(); ++k) read_value(element.properties[k], plan[k], row);
      rows_.end_row();
      mesh_.vertices.push_back({row[0], row[1], row[2]});
      if (normals) mesh_.normals.push_back({row[3], row[4], row[5]});
      if (textures) mesh_.texture_coordinates.push_back({row[6], row[7]});
      if (colours) push_colour(row);
    }
  }

  void read_value(const PlyProperty& property, int slot, std::array<double, slot_count>& row) {
    if (slot == skipped) return skip(property);
    if (slot < slot_normal) {
      static constexpr const char* names[] = {"coordinate x", "coordinate y", "coordinate z"};
      row[slot] = rows_.finite(property.type, names[slot]);
      return;
    }
    row[slot] = rows_.attribute(property.type);
    if (slot >= slot_colour) row[slot] = colour_component(row[slot], property.type);
  }

  /// In [0, 1]: integers are shares of the greatest of their type.
  static double colour_component(double value, PlyType type) {
    if (type == PlyType::uint8) value /= 255;
    if (type == PlyType::uint16) value /= 65535;
    return value > 0 ? std::min(value, 1.0) : 0;
  }

  void push_colour(const std::array<double, slot_count>& row) {
    std::array<float, 4> colour{};
    for (std::size_t i = 0; i < 4; ++i) colour[i] = static_cast<float>(row[slot_colour + i]);
    mesh_.colours.push_back(colour);
  }

  void read_faces(const PlyElement& element, FaceCollector& faces) {
    const auto indices = element.find({"vertex_indices", "vertex_index"});
    if (!indices || !element.properties[*indices].count_type)
      throw InputError(file_ + ": element face lacks the list vertex_indices, expected it");
    const PlyProperty& property = element.properties[*indices];
    mesh_.triangles.reserve(
        std::min(element.count, rows_.rest() / Rows::least_triangle_size(element, property)));
    for (std::uint64_t i = 0; i < element.count; ++i) {
      rows_.begin_row(element, i);
      for (std::size_t k = 0; k < element.properties.size(); ++k) {
        if (k == *indices) {
          read_ring(property);
        } else {
          skip(element.properties[k]);
        }
      }
      rows_.end_row();
      faces.add(ring_);
    }
  }

  std::uint64_t read_list_count(const PlyProperty& property) {
    const std::int64_t count = rows_.integer(*property.count_type, "the count of a list");
    if (count < 0) rows_.fail("expected the count of a list, found a negative one");
    return static_cast<std::uint64_t>(count);
  }

  void read_ring(const PlyProperty& property) {
    const std::uint64_t corners = read_list_count(property);
    ring_.clear();
    for (std::uint64_t k = 0; k < corners; ++k) {
      if (is_integer(property.type)) {
        const std::int64_t index = rows_.integer(property.type, "the index of a vertex");
        if (static_cast<std::uint64_t>(index) >= vertex_count_) fail_index(std::to_string(index));
        ring_.push_back(static_cast<std::uint32_t>(index));
      } else {
        const double index = rows_.finite(property.type, "the index of a vertex");
        if (!(index >= 0 && index < static_cast<double>(vertex_count_)) ||
            index != std::floor(index))
          fail_index(std::to_string(index));
        ring_.push_back(static_cast<std::uint32_t>(index));
      }
    }
  }

  [[noreturn]] void fail_index(const std::string& index) const {
    if (vertex_count_ == 0) rows_.fail("index " + index + " is out of range, there is no vertex");
    rows_.fail("index " + index + " is out of range, expected 0 to " +
               std::to_string(vertex_count_ - 1));
  }

  void skip(const PlyProperty& property) {
    if (!property.count_type) return rows_.skip(property.type);
    const std::uint64_t count = read_list_count(property);
    rows_.skip(property.type, count);
  }

  void skip_rows(const PlyElement& element) {
    for (std::uint64_t i = 0; i < element.count; ++i) {
      rows_.begin_row(element, i);
      for (const PlyProperty& property : element.properties) skip(property);
      rows_.end_row();
    }
  }

  Rows rows_;
  const PlyHeader& header_;
  const std::string& file_;
  bool attributes_;
  std::uint64_t vertex_count_ = 0;
  Mesh mesh_;
  std::vector<std::uint32_t> ring_;
};

template <class Rows>
Mesh read_body(std::string_view text, const PlyHeader& header, const std::string& file,
               bool attributes, Warnings& warnings) {
  Rows rows(text.substr(header.size), file, header);
  return PlyBody<Rows>(std::move(rows), header, file, attributes).read(warnings);
}

}  // namespace

Mesh read_ply(std::span<const std::byte> bytes, const std::string& file, const ReadOptions& options,
              Warnings& warnings) {
  const std::string_view text(reinterpret_cast<const char*>(bytes.data()), bytes.size());
  const PlyHeader header = read_ply_header(text, file);
  switch (header.encoding) {
    case PlyHeader::Encoding::ascii:
      return read_body<AsciiRows>(text, header, file, options.attributes, warnings);
    case PlyHeader::Encoding::little_endian:
      return read_body<BinaryRows<false>>(text, header, file, options.attributes, warnings);
    default:
      return read_body<BinaryRows<true>>(text, header, file, options.attributes, warnings);
  }
}

}  // namespace fathom
