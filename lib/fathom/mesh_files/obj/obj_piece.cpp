#include "fathom/mesh_files/obj/obj_piece.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <cmath>

#include "fathom/mesh_files/obj/obj_statements.h"

namespace fathom::mesh_files {
using namespace text;

namespace {

/// Reads one piece of the file into its place in the mesh.
class PieceReader {
 public:
  PieceReader(std::string_view text, const std::string& file, char line_end,
              const ObjCounts& before, const ObjCounts& total, Mesh& mesh)
      : cursor_(text, file, obj_syntax, line_end, before.lines + 1),
        at_(before),
        total_(total),
        ends_with_lf_(line_end == '\n'),
        in_the_plane_(total.in_the_plane()),
        mesh_(mesh) {}

  ObjOddities read() {
    for (; cursor_.next_line_with_words(); cursor_.skip_line()) {
      if (ends_with_lf_ && (read_plain_triangle() || read_plain_vertex())) continue;
      switch (statement_named(cursor_.word())) {
        case Statement::vertex:
          read_vertex();
          break;
        case Statement::texture:
          if (!mesh_.texture_coordinates.empty()) read_texture();
          ++at_.textures;
          break;
        case Statement::normal:
          if (!mesh_.normals.empty()) read_normal();
          ++at_.normals;
          break;
        case Statement::face:
          read_face();
          break;
        case Statement::line:
          if (!mesh_.lines.empty()) read_polyline();
          break;
        case Statement::point:
          if (!mesh_.points.empty()) read_points();
          break;
        default:
          break;
      }
    }
    return odd_;
  }

 private:
  /// False, without any effect, for other lines.
  bool read_plain_triangle() {
    std::array<std::uint32_t, 3> corners;
    if (!mesh_files::read_plain_triangle(cursor_, total_.vertices, corners)) return false;
    add_triangle({corners[0]}, {corners[1]}, {corners[2]});
    ++at_.faces;
    return true;
  }

  bool read_plain_vertex() {
    if (in_the_plane_ || at_.vertices >= total_.vertices) return false;
    std::array<double, 3> p;
    if (!mesh_files::read_plain_vertex(cursor_, p)) return false;
    mesh_.vertices[at_.vertices++] = {p[0], p[1], p[2]};
    return true;
  }

  void expect_line_end(const char* what) {
    if (!cursor_.at_line_end()) cursor_.fail_here(what);
  }

  void read_vertex() {
    // The file is mapped: if another program changes it meanwhile, the counts are wrong.
    if (at_.vertices >= total_.vertices) fail_changed();
    MeshPoint& p = mesh_.vertices[at_.vertices];
    p.x = cursor_.number<double>("coordinate x");
    p.y = cursor_.number<double>("coordinate y");
    if (!in_the_plane_) p.z = cursor_.number<double>("coordinate z");
    if (!cursor_.at_line_end()) read_weight_or_colour(p);
    ++at_.vertices;
  }

  void read_weight_or_colour(MeshPoint& p) {
    std::array<double, 4> more{0, 0, 0, 1};
    std::size_t count = 0;
    bool finite = true;
    for (; !cursor_.at_line_end(); ++count) {
      const double number = cursor_.attribute<double>("a weight or a colour");
      finite = finite && std::isfinite(number);
      if (count < more.size()) more[count] = number;
    }
    if (count == 1) return divide(p, more[0]);
    if (!finite || count == 2 || count > 4) return odd_.colours.note(cursor_.line());
    if (mesh_.colours.empty()) return;
    for (std::size_t i = 0; i < 4; ++i)
      mesh_.colours[at_.vertices][i] = static_cast<float>(std::clamp(more[i], 0.0, 1.0));
  }

  /// The homogeneous point (x, y, z, w): each quotient of two binary64 numbers is rounded once, as
  /// IEEE 754 divides.
  void divide(MeshPoint& p, double w) {
    if (w == 1) return;
    if (!std::isfinite(w)) cursor_.fail("weight w is not finite, expected a finite number");
    if (w == 0) cursor_.fail("a weight w of 0 leaves no point, expected another");
    p = {p.x / w, p.y / w, p.z / w};
    if (!std::isfinite(p.x)) fail_quotient("x/w");
    if (!std::isfinite(p.y)) fail_quotient("y/w");
    if (!std::isfinite(p.z)) fail_quotient("z/w");
    odd_.weights.note(cursor_.line());
  }

  [[noreturn]] void fail_quotient(const char* what) {
    cursor_.fail(std::string(what) + " is too large, expected a finite number");
  }

  void read_texture() {
    if (at_.textures >= total_.textures) fail_changed();
    auto& t = mesh_.texture_coordinates[at_.textures];
    t[0] = cursor_.attribute<double>("texture coordinate u");
    if (!cursor_.at_line_end()) t[1] = cursor_.attribute<double>("texture coordinate v");
    if (!cursor_.at_line_end()) cursor_.attribute<double>("texture coordinate w");
    expect_line_end("expected at most 3 texture coordinates");
  }

  void read_normal() {
    if (at_.normals >= total_.normals) fail_changed();
    for (double& c : mesh_.normals[at_.normals])
      c = cursor_.attribute<double>("a component of the normal");
    expect_line_end("expected 3 components of the normal");
  }

  /// Corners are a, a/b, a//c or a/b/c.
  void read_face() {
    Corner first, last, corner;
    if (!cursor_.at_line_end()) read_corner(first);
    if (!cursor_.at_line_end()) read_corner(last);
    while (!cursor_.at_line_end()) {
      read_corner(corner);
      add_triangle(first, last, corner);
      last = corner;
    }
    ++at_.faces;
  }

  void read_polyline() {
    std::uint32_t last = no_index;
    while (!cursor_.at_line_end()) {
      Corner corner;
      read_corner(corner);
      const std::uint32_t next = corner.vertex;
      if (last != no_index) {
        if (at_.segments >= total_.segments) fail_changed();
        mesh_.lines[at_.segments++] = {last, next};
      }
      last = next;
    }
  }

  void read_points() {
    while (!cursor_.at_line_end()) {
      Corner corner;
      read_corner(corner);
      if (at_.points >= total_.points) fail_changed();
      mesh_.points[at_.points++] = corner.vertex;
    }
  }

  struct Corner {
    std::uint32_t vertex = no_index, texture = no_index, normal = no_index;
  };

  /// Out-parameter on purpose: returning by value caused a store-forwarding stall, 75 % of the time
  /// per corner.
  void read_corner(Corner& corner) {
    corner = {};
    const char* at = cursor_.position();
    corner.vertex = read_vertex_index(at);
    if (at != cursor_.limit() && *at == '/') read_attribute_indices(at, corner);
    if (!cursor_.at_word_end(at)) fail_corner();
    cursor_.move_to(at);
  }

  /// The places of a corner's attributes, from the first '/' on.
  void read_attribute_indices(const char*& at, Corner& corner) {
    ++at;
    const bool skipped = at != cursor_.limit() && *at == '/';
    if (!skipped && !cursor_.at_word_end(at))
      corner.texture = read_attribute_index(at, at_.textures, total_.textures, odd_.textures);
    if (at == cursor_.limit() || *at != '/') return;
    ++at;
    if (!cursor_.at_word_end(at))
      corner.normal = read_attribute_index(at, at_.normals, total_.normals, odd_.normals);
  }

  /// The place of an index, which counts from 1 or, if negative, back from the last of `so_far`;
  /// no_index if it is out of range.
  static std::uint32_t place_of(std::int64_t index, std::uint64_t so_far, std::uint64_t count) {
    if (index > 0 && static_cast<std::uint64_t>(index) <= count)
      return static_cast<std::uint32_t>(index - 1);
    const auto forward = static_cast<std::int64_t>(so_far) + index;
    if (index < 0 && index >= -static_cast<std::int64_t>(so_far))
      return static_cast<std::uint32_t>(forward);
    return no_index;
  }

  /// Reads an index and moves `at` past it.
  std::uint32_t read_vertex_index(const char*& at) {
    std::int64_t index = 0;
    const char* end = TextCursor::parse_integer(at, cursor_.limit(), index);
    if (!end) fail_corner();
    at = end;
    const std::uint32_t place = place_of(index, at_.vertices, total_.vertices);
    if (place == no_index) fail_vertex_index(index);
    return place;
  }

  /// The same for optional parts of a corner: indices out of range are noted, however long they
  /// are.
  std::uint32_t read_attribute_index(const char*& at, std::uint64_t so_far, std::uint64_t count,
                                     Occurrences& missing) {
    std::int64_t index = 0;
    const char* end = TextCursor::parse_integer(at, cursor_.limit(), index);
    if (!end) {
      index = 0;
      end = *at == '-' || *at == '+' ? at + 1 : at;
      const char* digits = end;
      while (end != cursor_.limit() && std::isdigit(static_cast<unsigned char>(*end)) != 0) ++end;
      if (end == digits) fail_corner();
    }
    at = end;
    const std::uint32_t place = place_of(index, so_far, count);
    if (place == no_index) missing.note(cursor_.line());
    return place;
  }

  [[noreturn]] [[gnu::cold]] void fail_vertex_index(std::int64_t index) {
    cursor_.fail("vertex index " + std::to_string(index) + " is out of range, expected 1 to " +
                 std::to_string(total_.vertices) + " or -" + std::to_string(at_.vertices) +
                 " to -1");
  }
  [[noreturn]] void fail_corner() {
    cursor_.fail_here("expected a corner as v, v/vt, v//vn or v/vt/vn");
  }
  [[noreturn]] void fail_changed() { cursor_.fail("the file changed while it was read"); }

  void add_triangle(const Corner& a, const Corner& b, const Corner& c) {
    const std::uint64_t t = at_.triangles++;
    if (t >= total_.triangles) fail_changed();
    mesh_.triangles[t] = {a.vertex, b.vertex, c.vertex};
    if (!mesh_.face_of_triangle.empty())
      mesh_.face_of_triangle[t] = static_cast<std::uint32_t>(at_.faces);
    if (!mesh_.texture_triangles.empty())
      mesh_.texture_triangles[t] = {a.texture, b.texture, c.texture};
    if (!mesh_.normal_triangles.empty()) mesh_.normal_triangles[t] = {a.normal, b.normal, c.normal};
  }

  TextCursor cursor_;
  ObjCounts at_;
  const ObjCounts& total_;
  bool ends_with_lf_, in_the_plane_;
  Mesh& mesh_;
  ObjOddities odd_;
};

}  // namespace

ObjOddities read_obj_piece(std::string_view text, const std::string& file, char line_end,
                           const ObjCounts& before, const ObjCounts& total, Mesh& mesh) {
  return PieceReader(text, file, line_end, before, total, mesh).read();
}

}  // namespace fathom::mesh_files
