#include <algorithm>
#include <array>
#include <cctype>

#include "fathom/mesh/mesh_faces.h"
#include "fathom/mesh_files/read_mesh.h"
#include "fathom/mesh_files/stl_binary.h"
#include "fathom/numeric/errors.h"
#include "fathom/text/text_cursor.h"

namespace fathom::mesh_files {
using namespace mesh;
using namespace text;

namespace {

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

class AsciiStlReader {
 public:
  AsciiStlReader(std::string_view text, const std::string& file, const ReadOptions& options)
      : cursor_(text, file, {}), file_(file), keep_attributes_(options.attributes) {}

  /// solid NAME, facets, endsolid NAME; again and again.
  Mesh read() {
    reserve();
    while (cursor_.next_line_with_words()) {
      expect_word("solid");
      cursor_.skip_line();
      read_facets();
    }
    mesh_.face_count = mesh_.triangles.size();
    return std::move(mesh_);
  }

 private:
  /// Room for as many corners as there are lines that begin with "vertex".
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

  /// The next word in small letters, on this line or a later one.
  std::string_view next_word() {
    if (!cursor_.next_line_with_words()) cursor_.fail("the file ends, expected endsolid");
    const std::string_view word = cursor_.word();
    const std::size_t size = std::min(word.size(), word_.size());
    std::transform(word.begin(), word.begin() + static_cast<std::ptrdiff_t>(size), word_.begin(),
                   [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
    return {word_.data(), size};
  }

  void expect_word(std::string_view expected) {
    if (next_word() != expected) cursor_.fail("expected '" + std::string(expected) + "'");
  }

  double next_number(const char* what) {
    if (!cursor_.next_line_with_words())
      cursor_.fail(std::string("the file ends, expected ") + what);
    return cursor_.number<double>(what);
  }

  void read_facets() {
    while (true) {
      const std::string_view word = next_word();
      if (word == "endsolid") {
        cursor_.skip_line();
        return;
      }
      if (word != "facet") cursor_.fail("expected 'facet' or 'endsolid'");
      read_facet();
    }
  }

  void read_facet() {
    expect_word("normal");
    std::array<double, 3> normal{};
    for (double& c : normal) c = read_normal_component();
    expect_word("outer");
    expect_word("loop");
    const auto first = static_cast<std::uint32_t>(mesh_.vertices.size());
    for (int k = 0; k < 3; ++k) {
      expect_word("vertex");
      const double x = next_number("coordinate x");
      const double y = next_number("coordinate y");
      const double z = next_number("coordinate z");
      mesh_.vertices.push_back({x, y, z});
    }
    expect_countable(mesh_.vertices.size(), "vertices", file_);
    expect_word("endloop");
    expect_word("endfacet");
    mesh_.triangles.push_back({first, first + 1, first + 2});
    if (!keep_attributes_) return;
    const auto n = static_cast<std::uint32_t>(mesh_.normals.size());
    mesh_.normals.push_back(normal);
    mesh_.normal_triangles.push_back({n, n, n});
  }

  double read_normal_component() {
    if (!cursor_.next_line_with_words()) cursor_.fail("the file ends, expected a normal");
    return cursor_.attribute<double>("a component of the normal");
  }

  TextCursor cursor_;
  const std::string& file_;
  bool keep_attributes_;
  Mesh mesh_;
  std::array<char, 16> word_{};
};

}  // namespace

Mesh read_stl(std::span<const std::byte> bytes, const std::string& file, const ReadOptions& options,
              Warnings& warnings) {
  if (is_binary_stl(bytes, bytes.size()))
    return read_binary(bytes, file, options.attributes, warnings);
  const std::string_view text(reinterpret_cast<const char*>(bytes.data()), bytes.size());
  return AsciiStlReader(text, file, options).read();
}

}  // namespace fathom::mesh_files
