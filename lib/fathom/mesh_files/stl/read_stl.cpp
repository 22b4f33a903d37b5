#include <algorithm>
#include <array>
#include <limits>

#include "fathom/mesh/mesh_faces.h"
#include "fathom/mesh_files/occurrences.h"
#include "fathom/mesh_files/read_mesh.h"
#include "fathom/mesh_files/stl/stl_binary.h"
#include "fathom/text/ascii.h"
#include "fathom/text/text_cursor.h"
#include "fathom/text/text_ends.h"

namespace fathom::mesh_files {
using namespace mesh;
using namespace text;

namespace {

class AsciiStlReader {
 public:
  AsciiStlReader(std::string_view text, const std::string& file, const ReadOptions& options)
      : cursor_(text, file, {.comments = true, .continuation = false}),
        file_(file),
        keep_attributes_(options.attributes) {}

  /// solid NAME, facets, endsolid NAME; repeated.
  Mesh read(Warnings& warnings) {
    reserve();
    while (go_to_word()) read_statement(next_word("endsolid"));
    if (inside_) warnings.push_back(file_ + ": the file ends without endsolid");
    odd_normals_.warn(file_, "facet has no normal of three numbers",
                      "facets have no normal of three numbers", "ignored", warnings);
    mesh_.face_count = mesh_.triangles.size();
    return std::move(mesh_);
  }

 private:
  /// Reserves room for as many corners as there are lines that begin with "vertex".
  void reserve() {
    TextCursor ahead = cursor_;
    std::uint64_t corners = 0;
    for (; ahead.next_line_with_words(); ahead.skip_line())
      if (*ahead.position() == 'v' || *ahead.position() == 'V') ++corners;
    expect_countable(corners, "vertices", file_);
    mesh_.vertices.reserve(corners);
    mesh_.triangles.reserve(corners / 3);
    if (!keep_attributes_) return;
    mesh_.normals.reserve(corners / 3);
    mesh_.normal_triangles.reserve(corners / 3);
  }

  /// Moves to the next word that is not in a comment, on this line or a later one; false at the
  /// end.
  bool go_to_word() {
    while (cursor_.next_line_with_words()) {
      const char* at = cursor_.position();
      const bool comment = *at == ';' || (cursor_.rest() > 1 && at[0] == '/' && at[1] == '/');
      if (!comment) return true;
      cursor_.skip_line();
    }
    return false;
  }

  /// The next word in small letters; `expected` is for the message at the end of the file.
  std::string_view next_word(const char* expected) {
    if (!go_to_word()) cursor_.fail(std::string("the file ends, expected '") + expected + "'");
    const std::string_view word = cursor_.word();
    const std::size_t size = std::min(word.size(), word_.size());
    std::transform(word.begin(), word.begin() + static_cast<std::ptrdiff_t>(size), word_.begin(),
                   small_letter);
    return {word_.data(), size};
  }

  void expect_word(const char* expected) {
    if (next_word(expected) != expected) cursor_.fail(std::string("expected '") + expected + "'");
  }

  /// "endloop" or "end loop".
  void expect_end(const char* expected) {
    std::string_view word = next_word(expected), wanted(expected);
    if (word == "end") {
      word = next_word(expected);
      wanted.remove_prefix(3);
    }
    if (word != wanted) cursor_.fail(std::string("expected '") + expected + "'");
  }

  double next_number(const char* what) {
    if (!cursor_.next_line_with_words())
      cursor_.fail(std::string("the file ends, expected ") + what);
    return cursor_.number<double>(what);
  }

  /// A solid may begin before the last one ended, and a facet without a solid.
  void read_statement(std::string_view word) {
    if (word == "facet") {
      inside_ = true;
      return read_facet();
    }
    if (word == "solid") {
      inside_ = true;
    } else if (inside_ && word == "endsolid") {
      inside_ = false;
    } else if (inside_ && word == "end") {
      expect_word("solid");
      inside_ = false;
    } else {
      cursor_.fail(inside_ ? "expected 'facet' or 'endsolid'" : "expected 'solid' or 'facet'");
    }
    cursor_.skip_line();  // any name
  }

  void read_facet() {
    const std::array<double, 3> normal = read_normal();
    std::string_view word = next_word("outer loop");
    if (word == "outer") word = next_word("loop");
    if (word != "loop" && word != "outerloop") cursor_.fail("expected 'outer loop'");
    const auto first = static_cast<std::uint32_t>(mesh_.vertices.size());
    for (int k = 0; k < 3; ++k) {
      expect_word("vertex");
      const double x = next_number("coordinate x");
      const double y = next_number("coordinate y");
      const double z = next_number("coordinate z");
      mesh_.vertices.push_back({x, y, z});
    }
    expect_countable(mesh_.vertices.size(), "vertices", file_);
    expect_end("endloop");
    expect_end("endfacet");
    mesh_.triangles.push_back({first, first + 1, first + 2});
    if (!keep_attributes_) return;
    const auto n = static_cast<std::uint32_t>(mesh_.normals.size());
    mesh_.normals.push_back(normal);
    mesh_.normal_triangles.push_back({n, n, n});
  }

  /// "normal" and three numbers, which are not needed: the corners define the facet.
  std::array<double, 3> read_normal() {
    const std::uint64_t line = cursor_.line();
    const TextCursor before = cursor_;
    std::array<double, 3> normal{};
    if (next_word("outer loop") != "normal") {
      cursor_ = before;
    } else if (read_components(normal)) {
      return normal;
    }
    odd_normals_.note(line);
    constexpr double none = std::numeric_limits<double>::quiet_NaN();
    return {none, none, none};
  }

  /// Whether there are three numbers before the loop; other words in their places are skipped.
  bool read_components(std::array<double, 3>& normal) {
    bool numbers = true;
    for (double& c : normal) {
      if (!go_to_word()) return false;
      if (const auto number = cursor_.optional_attribute<double>()) {
        c = *number;
        continue;
      }
      numbers = false;
      const char first = *cursor_.position();
      if (first == 'o' || first == 'O' || first == 'l' || first == 'L') return false;
      cursor_.word();
    }
    return numbers;
  }

  TextCursor cursor_;
  const std::string& file_;
  bool keep_attributes_;
  bool inside_ = false;  // a solid
  Mesh mesh_;
  Occurrences odd_normals_;
  std::array<char, 16> word_{};
};

Mesh read_binary(std::span<const std::byte> bytes, const std::string& file, bool attributes,
                 Warnings& warnings) {
  const std::uint64_t count = count_binary_stl(bytes, bytes.size(), file, warnings);
  expect_countable(3 * count, "vertices", file);
  Mesh mesh;
  mesh.face_count = count;
  mesh.vertices.resize(3 * count);
  mesh.triangles.resize(count);
  if (attributes) mesh.normals.resize(count), mesh.normal_triangles.resize(count);
  for (std::uint32_t t = 0; t < count; ++t) {
    const std::byte* record = bytes.data() + stl_header_size + stl_triangle_size * t;
    const std::array<float, 12> values = read_stl_triangle(record, t, file);
    for (std::uint32_t k = 0; k < 3; ++k) {
      const float* p = &values[3 + 3 * k];
      mesh.vertices[3 * t + k] = {p[0], p[1], p[2]};
      mesh.triangles[t][k] = 3 * t + k;
    }
    if (!attributes) continue;
    mesh.normals[t] = {values[0], values[1], values[2]};
    mesh.normal_triangles[t] = {t, t, t};
  }
  return mesh;
}

}  // namespace

Mesh read_stl(std::span<const std::byte> bytes, const std::string& file, const ReadOptions& options,
              Warnings& warnings) {
  const std::string_view text(reinterpret_cast<const char*>(bytes.data()), bytes.size());
  if (is_binary_stl(bytes, bytes.size())) {
    if (!is_binary_stl_by_size(bytes, bytes.size())) expect_no_utf16(text, file);
    return read_binary(bytes, file, options.attributes, warnings);
  }
  return AsciiStlReader(without_padding(text), file, options).read(warnings);
}

}  // namespace fathom::mesh_files
