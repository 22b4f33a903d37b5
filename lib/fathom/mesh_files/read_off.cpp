#include <algorithm>

#include "fathom/mesh/mesh_faces.h"
#include "fathom/mesh_files/read_mesh.h"
#include "fathom/numeric/errors.h"
#include "fathom/text/text_cursor.h"

namespace fathom::mesh_files {
using namespace mesh;
using namespace text;

namespace {

/// What the first word and the counts say.
struct OffHeader {
  bool normals = false, colours = false, texture = false;
  std::uint64_t vertices = 0, faces = 0;
};

class OffReader {
 public:
  OffReader(std::string_view text, const std::string& file, const ReadOptions& options)
      : cursor_(text, file, {.comments = true, .continuation = false}),
        file_(file),
        keep_attributes_(options.attributes) {}

  Mesh read(Warnings& warnings) {
    read_header();
    reserve();
    for (std::uint64_t i = 0; i < header_.vertices; ++i) read_vertex(i);
    FaceCollector faces(mesh_, file_);
    for (std::uint64_t i = 0; i < header_.faces; ++i) read_face(i, faces);
    if (cursor_.next_line_with_words())
      warnings.push_back(file_ + ": line " + std::to_string(cursor_.line()) +
                         ": what follows the last face is ignored");
    cut_polygons(mesh_, faces.skipped(), file_, warnings);
    return std::move(mesh_);
  }

 private:
  void read_header() {
    if (!cursor_.next_line_with_words()) cursor_.fail("expected OFF and the counts, found nothing");
    const char first = *cursor_.position();
    if (first < '0' || first > '9' ||
        (cursor_.rest() > 1 && first == '4' && cursor_.position()[1] == 'O'))
      read_keyword();
    header_.vertices = read_count("a number of vertices");
    header_.faces = read_count("a number of faces");
    if (!cursor_.at_line_end()) cursor_.integer("a number of edges");
    expect_line_end("the counts");
  }

  void read_keyword() {
    const std::string_view keyword = cursor_.word();
    std::string_view rest = keyword;
    const auto take = [&](std::string_view prefix) {
      const bool found = rest.starts_with(prefix);
      if (found) rest.remove_prefix(prefix.size());
      return found;
    };
    header_.texture = take("ST");
    header_.colours = take("C");
    header_.normals = take("N");
    if (rest == "4OFF" || rest == "nOFF" || rest == "4nOFF")
      cursor_.fail(std::string(keyword) +
                   " is not supported, expected points of three coordinates");
    if (rest != "OFF") cursor_.fail("expected OFF with any of the prefixes ST, C and N");
    if (!cursor_.at_line_end() && *cursor_.position() == 'B')
      cursor_.fail("binary OFF is not supported, expected text");
  }

  std::uint64_t read_count(const char* what) {
    if (!cursor_.next_line_with_words())
      cursor_.fail(std::string("expected ") + what + ", found the end of the file");
    const std::int64_t count = cursor_.integer(what);
    if (count < 0) cursor_.fail(std::string("expected ") + what + ", found a negative one");
    expect_countable(static_cast<std::uint64_t>(count), "vertices or faces", file_);
    return static_cast<std::uint64_t>(count);
  }

  /// Every vertex takes at least six characters ("0 0 0" and a line end), every face two.
  void reserve() {
    const std::uint64_t rest = cursor_.rest() + 1;
    if (header_.vertices > rest / 6 || header_.faces > (rest - 6 * header_.vertices) / 2)
      throw InputError(file_ + ": " + std::to_string(header_.vertices) + " vertices and " +
                       std::to_string(header_.faces) +
                       " faces are claimed, expected a file long enough for them");
    mesh_.vertices.reserve(header_.vertices);
    mesh_.triangles.reserve(std::min(header_.faces, rest / 8));  // "3 0 1 2" and a line end
    if (!keep_attributes_) return;
    if (header_.normals) mesh_.normals.reserve(header_.vertices);
    if (header_.colours) mesh_.colours.reserve(header_.vertices);
    if (header_.texture) mesh_.texture_coordinates.reserve(header_.vertices);
  }

  void go_to_row(const char* what, std::uint64_t number, std::uint64_t count) {
    if (cursor_.next_line_with_words()) return;
    cursor_.fail("the file ends after " + std::to_string(number) + " of " + std::to_string(count) +
                 " " + what);
  }

  void expect_line_end(const char* what) {
    if (!cursor_.at_line_end())
      cursor_.fail_here(std::string("expected the line to end after ") + what);
  }

  void read_vertex(std::uint64_t i) {
    go_to_row("vertices", i, header_.vertices);
    const double x = cursor_.number<double>("coordinate x");
    const double y = cursor_.number<double>("coordinate y");
    const double z = cursor_.number<double>("coordinate z");
    mesh_.vertices.push_back({x, y, z});
    if (header_.normals) {
      std::array<double, 3> normal{};
      for (double& c : normal) c = cursor_.attribute<double>("a component of the normal");
      if (keep_attributes_) mesh_.normals.push_back(normal);
    }
    if (header_.colours) read_colour();
    if (header_.texture) {
      std::array<double, 2> st{};
      for (double& c : st) c = cursor_.attribute<double>("a texture coordinate");
      if (keep_attributes_) mesh_.texture_coordinates.push_back(st);
    }
    expect_line_end("the vertex");
  }

  /// Three or four components: floats in [0, 1], or integers in [0, 255] where no component has a
  /// point.
  void read_colour() {
    std::array<float, 4> colour{0, 0, 0, 1};
    bool integers = true;
    int components = 0;
    for (; components < 4; ++components) {
      const bool enough = components == 3;
      if (enough && !one_more_before_texture()) break;
      const char* first = cursor_.position();
      colour[components] = cursor_.number<float>("a component of the colour");
      integers = integers && std::find(first, cursor_.position(), '.') == cursor_.position();
    }
    for (int i = 0; i < components; ++i) {
      if (integers) colour[i] /= 255;
      colour[i] = std::clamp(colour[i], 0.0F, 1.0F);
    }
    if (keep_attributes_) mesh_.colours.push_back(colour);
  }

  /// After three components: whether a fourth stands before the texture coordinates, if any.
  bool one_more_before_texture() {
    TextCursor ahead = cursor_;
    std::size_t words = 0;
    while (!ahead.word().empty()) ++words;
    return words > (header_.texture ? 2U : 0U);
  }

  void read_face(std::uint64_t i, FaceCollector& faces) {
    go_to_row("faces", i, header_.faces);
    const std::int64_t corners = cursor_.integer("a number of corners");
    if (corners < 0) cursor_.fail("expected a number of corners, found a negative one");
    ring_.clear();
    for (std::int64_t k = 0; k < corners; ++k) {
      const std::int64_t index = cursor_.integer("the index of a vertex");
      if (index < 0 || static_cast<std::uint64_t>(index) >= header_.vertices)
        cursor_.fail("index " + std::to_string(index) + " is out of range, expected 0 to " +
                     std::to_string(static_cast<std::int64_t>(header_.vertices) - 1));
      ring_.push_back(static_cast<std::uint32_t>(index));
    }
    faces.add(ring_);
    cursor_.skip_line();  // a colour may follow
  }

  TextCursor cursor_;
  const std::string& file_;
  bool keep_attributes_;
  OffHeader header_;
  Mesh mesh_;
  std::vector<std::uint32_t> ring_;
};

}  // namespace

Mesh read_off(std::string_view text, const std::string& file, const ReadOptions& options,
              Warnings& warnings) {
  return OffReader(text, file, options).read(warnings);
}

}  // namespace fathom::mesh_files
