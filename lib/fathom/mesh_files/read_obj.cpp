#include <algorithm>
#include <cctype>
#include <cmath>
#include <cstdint>
#include <map>

#include "fathom/mesh/mesh_faces.h"
#include "fathom/mesh_files/obj_segments.h"
#include "fathom/mesh_files/occurrences.h"
#include "fathom/mesh_files/read_mesh.h"
#include "fathom/mesh_files/reserve_large.h"
#include "fathom/numeric/errors.h"
#include "fathom/text/counted.h"
#include "fathom/text/printable.h"
#include "fathom/text/text_chunks.h"
#include "fathom/text/text_cursor.h"
#include "fathom/text/text_ends.h"

/// Read in two passes over pieces of the file, each in parallel: first count what each piece has,
/// so that the place of everything is known; then read every piece into its place.
namespace fathom::mesh_files {
using namespace mesh;
using namespace text;

namespace {

constexpr TextCursor::Syntax obj_syntax{.comments = true, .continuation = true};
constexpr std::size_t chunk_size = std::size_t{1} << 20;

enum class Statement { vertex, texture, normal, face, line, point, segment, ignored, unknown };

/// Nearly all keywords are one letter long: they are told apart first, without comparing strings.
Statement statement_named(char keyword) {
  switch (keyword) {
    case 'v':
      return Statement::vertex;
    case 'f':
      return Statement::face;
    case 'o':
    case 'g':
      return Statement::segment;
    case 's':
      return Statement::ignored;
    case 'l':
      return Statement::line;
    case 'p':
      return Statement::point;
    default:
      return Statement::unknown;
  }
}

Statement statement_named(std::string_view keyword) {
  if (keyword.size() == 1) return statement_named(keyword[0]);
  if (keyword == "vt") return Statement::texture;
  if (keyword == "vn") return Statement::normal;
  if (keyword == "usemtl") return Statement::segment;
  for (const std::string_view known : {"mtllib", "usemap", "maplib", "mg", "lod", "bevel",
                                       "c_interp", "d_interp", "shadow_obj", "trace_obj"})
    if (keyword == known) return Statement::ignored;
  return Statement::unknown;
}

/// How many of each a piece of the file has; sums of them are places.
struct ObjCounts {
  std::uint64_t lines = 0;
  std::uint64_t vertices = 0, textures = 0, normals = 0;
  std::uint64_t short_points = 0;  // of at most two numbers, counted up to the first colour
  std::uint64_t faces = 0, triangles = 0;
  std::uint64_t skipped_faces = 0, not_faces = 0;
  std::uint64_t segments = 0, points = 0, skipped_lines = 0;
  bool polygons = false;  // a face that does not have three corners
  bool colours = false, face_textures = false, face_normals = false;
  std::map<std::string, std::uint64_t> unknown;

  void add(const ObjCounts& other) {
    lines += other.lines;
    vertices += other.vertices;
    textures += other.textures;
    normals += other.normals;
    short_points += other.short_points;
    faces += other.faces;
    triangles += other.triangles;
    skipped_faces += other.skipped_faces;
    not_faces += other.not_faces;
    segments += other.segments;
    points += other.points;
    skipped_lines += other.skipped_lines;
    polygons |= other.polygons;
    colours |= other.colours;
    face_textures |= other.face_textures;
    face_normals |= other.face_normals;
    for (const auto& [keyword, count] : other.unknown) unknown[keyword] += count;
  }

  void add_face(std::uint64_t corners) {
    ++faces;
    polygons |= corners != 3;
    if (corners < 3) ++skipped_faces;
    if (corners > 2) triangles += corners - 2;
  }

  /// Of so many words, or at least six.
  void add_vertex(int words) {
    ++vertices;
    if (colours) return;
    colours = words >= 6;
    if (words < 3) ++short_points;
  }

  /// No vertex has a z: a drawing in the plane z = 0. Where others have one, it is missing.
  [[nodiscard]] bool in_the_plane() const { return vertices > 0 && short_points == vertices; }
};

/// What a piece of the file has that cannot be used or is not usual, though its geometry is clear.
struct ObjOddities {
  Occurrences textures, normals, colours, weights;

  void add(const ObjOddities& later) {
    textures.add(later.textures);
    normals.add(later.normals);
    colours.add(later.colours);
    weights.add(later.weights);
  }
};

/// A keyword as it can be shown in a one-line warning.
std::string shown(std::string_view keyword) {
  return printable(std::string(keyword.substr(0, 20)));
}

void count_face(TextCursor& cursor, ObjCounts& counts) {
  std::uint64_t corners = 0;
  for (std::string_view word = cursor.word(); !word.empty(); word = cursor.word(), ++corners) {
    const auto slash = std::find(word.begin(), word.end(), '/');
    if (slash == word.end()) continue;
    const auto second = std::find(slash + 1, word.end(), '/');
    counts.face_normals |= second != word.end();
    counts.face_textures |= second != slash + 1 && slash + 1 != word.end();
  }
  counts.add_face(corners);
}

std::uint64_t count_words(TextCursor& cursor) {
  std::uint64_t words = 0;
  while (!cursor.word().empty()) ++words;
  return words;
}

/// What the plainest lines of vertices and faces consist of: they have no comment and are not joined to
/// another line.
enum class Plain : std::uint8_t { other, number, slash, blank, line_end };

constexpr std::array<Plain, 256> plain_characters = [] {
  std::array<Plain, 256> kinds{};
  for (const unsigned char c :
       {'0', '1', '2', '3', '4', '5', '6', '7', '8', '9', '+', '-', '.', 'e'})
    kinds[c] = Plain::number;
  for (const unsigned char c : {' ', '\t', '\r'}) kinds[c] = Plain::blank;
  kinds['/'] = Plain::slash;
  kinds['\n'] = Plain::line_end;
  return kinds;
}();

Plain plain_kind(const char* at, const char* last) {
  return at == last ? Plain::other : plain_characters[static_cast<unsigned char>(*at)];
}

/// Moves `at` behind the word there, of a number; false where there is none.
template <char least, char greatest>
[[gnu::always_inline]] inline bool skip_word(const char*& at, const char* last) {
  if (plain_kind(at, last) != Plain::number) return false;
  while (plain_kind(at, last) == Plain::number) skip_characters<least, greatest>(++at, last);
  return true;
}

[[gnu::always_inline]] inline void skip_blanks(const char*& at, const char* last) {
  while (plain_kind(at, last) == Plain::blank) ++at;
}

/// Counts the words from `at` on. The end of the line; null where it is not plain.
const char* count_plain_vertex(const char* at, const char* last, ObjCounts& counts) {
  int words = 0;
  for (skip_blanks(at, last); plain_kind(at, last) != Plain::line_end; ++words) {
    if (!skip_word<'*', '9'>(at, last)) return nullptr;
    skip_blanks(at, last);
  }
  counts.add_vertex(words);
  return at;
}

/// The same of the corners of a face.
const char* count_plain_face(const char* at, const char* last, ObjCounts& counts) {
  std::uint64_t corners = 0;
  bool textures = false, normals = false;
  const auto skip_index = [&] { return skip_word<'0', '9'>(at, last); };
  const auto skip_slash = [&] {
    const bool is_slash = plain_kind(at, last) == Plain::slash;
    at += is_slash ? 1 : 0;
    return is_slash;
  };
  for (skip_blanks(at, last); plain_kind(at, last) != Plain::line_end; ++corners) {
    if (!skip_index()) return nullptr;
    if (skip_slash()) {
      textures |= skip_index();
      if (skip_slash()) {
        normals = true;
        skip_index();
      }
    }
    skip_blanks(at, last);
  }
  counts.face_textures |= textures;
  counts.face_normals |= normals;
  counts.add_face(corners);
  return at;
}

/// Counts the statement at the cursor if it is a vertex or a face on a plain line, as most of a large file
/// are, in a third of the time that it takes to look for all that a line may have, and moves to the end
/// of the line, an LF. False, and nothing happens, where it is not.
bool count_plain_line(TextCursor& cursor, ObjCounts& counts) {
  const char* const at = cursor.position() + 1;
  const char* const last = cursor.limit();
  const char keyword = at[-1];
  if ((keyword != 'v' && keyword != 'f') || plain_kind(at, last) != Plain::blank) return false;
  const char* const end =
      keyword == 'v' ? count_plain_vertex(at, last, counts) : count_plain_face(at, last, counts);
  if (end != nullptr) cursor.move_to(end);
  return end != nullptr;
}

/// Counts what a piece of the file has, and keeps the lines that name segments, where these are
/// wanted.
ObjCounts count_statements(std::string_view text, const std::string& file, char line_end,
                           ObjSegmentLines* segments) {
  ObjCounts counts;
  // Different unknown keywords beyond this number are lumped together.
  constexpr std::size_t most_keywords = 8;
  TextCursor cursor(text, file, obj_syntax, line_end, 0);
  for (; cursor.next_line_with_words(); cursor.skip_line()) {
    if (line_end == '\n' && count_plain_line(cursor, counts)) continue;
    const std::string_view keyword = cursor.word();
    switch (statement_named(keyword)) {
      case Statement::vertex: {
        int words = 0;
        while (words < 6 && !counts.colours && !cursor.word().empty()) ++words;
        counts.add_vertex(words);
        break;
      }
      case Statement::texture:
        ++counts.textures;
        break;
      case Statement::normal:
        ++counts.normals;
        break;
      case Statement::face:
        count_face(cursor, counts);
        break;
      case Statement::segment:
        if (segments)
          segments->add({obj_segmentation(keyword), cursor.rest_of_line(), counts.triangles});
        break;
      case Statement::ignored:
        break;
      case Statement::line: {
        ++counts.not_faces;
        const std::uint64_t corners = count_words(cursor);
        if (corners < 2) ++counts.skipped_lines;
        if (corners > 1) counts.segments += corners - 1;
        break;
      }
      case Statement::point:
        ++counts.not_faces;
        counts.points += count_words(cursor);
        break;
      case Statement::unknown:
        ++counts.unknown[counts.unknown.size() < most_keywords ? shown(keyword) : "…"];
        break;
    }
  }
  counts.lines = cursor.line();
  return counts;
}

/// Reads one piece of the file into its place in the mesh.
class ObjChunk {
 public:
  /// `before` counts what comes before the piece, `total` what the file has.
  ObjChunk(std::string_view text, const std::string& file, char line_end, const ObjCounts& before,
           const ObjCounts& total, Mesh& mesh)
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
  /// Where the words begin that follow the keyword and one blank; null where another statement stands.
  [[nodiscard]] const char* words_after(char keyword) const {
    const char* const at = cursor_.position();
    return cursor_.rest() > 2 && at[0] == keyword && at[1] == ' ' ? at + 2 : nullptr;
  }

  /// Whether word `k` of three ends at `at`, as in nearly all files: by one blank, or by the line end.
  /// Then `at` is behind the blank.
  bool ends_plain_word(std::size_t k, const char*& at) const {
    if (at == cursor_.limit() || *at != (k < 2 ? ' ' : '\n')) return false;
    at += k < 2 ? 1 : 0;
    return true;
  }

  /// "f 1 2 3", with indices in range. False where the line is another one: then nothing happens.
  bool read_plain_triangle() {
    const char* at = words_after('f');
    if (!at) return false;
    std::array<Corner, 3> corners;
    for (std::size_t k = 0; k < 3; ++k) {
      constexpr std::size_t most_digits = 18;
      const DigitRun index = read_digits(at, cursor_.limit());
      const std::uint64_t place = index.number - 1;  // of 0: the greatest number
      if (index.count == 0 || index.count > most_digits || place >= total_.vertices) return false;
      if (!ends_plain_word(k, at)) return false;
      corners[k].vertex = static_cast<std::uint32_t>(place);
    }
    add_triangle(corners[0], corners[1], corners[2]);
    ++at_.faces;
    cursor_.move_to(at);
    return true;
  }

  /// The same of "v 0.1 0.2 0.3".
  bool read_plain_vertex() {
    const char* at = words_after('v');
    if (!at || in_the_plane_ || at_.vertices >= total_.vertices) return false;
    std::array<double, 3> numbers{};
    for (std::size_t k = 0; k < 3; ++k) {
      const auto number = parse_decimal<double>(at, cursor_.limit());
      at = number.end;
      if (number.fault != DecimalFault::none || !ends_plain_word(k, at)) return false;
      numbers[k] = number.value;
    }
    mesh_.vertices[at_.vertices++] = {numbers[0], numbers[1], numbers[2]};
    cursor_.move_to(at);
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

  /// Into `corner`: as a result its parts would be written, read together and wait for each other,
  /// three quarters of the time that a corner takes.
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

  /// The place that an index means, from 1 or, if negative, back from the last of `so_far`;
  /// no_index if there is none.
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

  /// The same for what a corner can do without: an index of nothing is noted, however long it is.
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

void make_room(const ObjCounts& total, const ReadOptions& options, const std::string& file,
               Mesh& mesh) {
  expect_countable(total.vertices, "vertices", file);
  expect_countable(total.textures, "texture coordinates", file);
  expect_countable(total.normals, "normals", file);
  expect_countable(total.triangles, "triangles", file);
  expect_countable(total.faces, "faces", file);
  mesh.face_count = total.faces;
  resize_large(mesh.vertices, total.vertices);
  resize_large(mesh.triangles, total.triangles);
  if (total.polygons) resize_large(mesh.face_of_triangle, total.triangles);
  if (options.primitives) {
    expect_countable(total.segments, "segments of lines", file);
    expect_countable(total.points, "points", file);
    mesh.lines.resize(total.segments);
    mesh.points.resize(total.points);
  }
  if (!options.attributes) return;
  if (total.colours) mesh.colours.assign(total.vertices, {1, 1, 1, 1});
  resize_large(mesh.texture_coordinates, total.textures);
  resize_large(mesh.normals, total.normals);
  if (total.face_textures && total.textures > 0)
    resize_large(mesh.texture_triangles, total.triangles);
  if (total.face_normals && total.normals > 0) resize_large(mesh.normal_triangles, total.triangles);
  // If no face refers to them they belong to nobody; without indices, those of the vertices would
  // be used.
  if (!total.face_textures) mesh.texture_coordinates.clear();
  if (!total.face_normals) mesh.normals.clear();
}

/// By materials, groups and parts, where the file has any.
std::vector<TriangleSegments> segments_of(const std::vector<ObjSegmentLines>& pieces,
                                          const std::vector<ObjCounts>& before) {
  std::vector<TriangleSegments> result;
  for (const Segmentation by : {Segmentation::material, Segmentation::group, Segmentation::part}) {
    ObjSegments segments(by);
    for (std::size_t i = 0; i < pieces.size(); ++i)
      segments.add(pieces[i].lines(), before[i].triangles);
    TriangleSegments all = segments.finish(before.back().triangles);
    if (!all.names.empty()) result.push_back(std::move(all));
  }
  return result;
}

void warn(const ObjCounts& total, const ObjOddities& odd, const ReadOptions& options,
          const std::string& file, Warnings& warnings) {
  if (total.in_the_plane())
    warnings.push_back(file + ": its " +
                       text::counted(total.vertices, "vertex has two coordinates",
                                     "vertices have two coordinates") +
                       ": read with z = 0");
  odd.weights.warn(file, "vertex has a weight w other than 1",
                   "vertices have a weight w other than 1", "read as x/w, y/w, z/w", warnings);
  odd.colours.warn(file,
                   "vertex has numbers behind x, y, z that are neither a weight nor a colour of 3 "
                   "or 4 finite components",
                   "vertices have numbers behind x, y, z that are neither a weight nor a colour of "
                   "3 or 4 finite components",
                   "ignored", warnings);
  odd.textures.warn(file, "corner names a texture coordinate that is not in the file",
                    "corners name a texture coordinate that is not in the file", "they have none",
                    warnings);
  odd.normals.warn(file, "corner names a normal that is not in the file",
                   "corners name a normal that is not in the file", "they have none", warnings);
  if (options.primitives && total.skipped_lines > 0)
    warnings.push_back(file + ": " + std::to_string(total.skipped_lines) +
                       (total.skipped_lines == 1 ? " line of fewer than two corners is skipped"
                                                 : " lines of fewer than two corners are skipped"));
  if (!options.primitives && total.not_faces > 0)
    warnings.push_back(file + ": " + std::to_string(total.not_faces) +
                       " lines and points (l, p) are ignored");
  for (const auto& [keyword, count] : total.unknown)
    warnings.push_back(file + ": unknown keyword '" + keyword + "' on " + std::to_string(count) +
                       (count == 1 ? " line: ignored" : " lines: ignored"));
}

}  // namespace

Mesh read_obj(std::string_view bytes, const std::string& file, const ReadOptions& options,
              Warnings& warnings) {
  expect_no_utf16(bytes, file);
  const std::string_view text = without_padding(bytes);
  const char line_end = TextCursor::line_end_of(text);
  const std::vector<std::string_view> chunks =
      cut_into_chunks(TextCursor::without_mark(text), line_end, chunk_size);

  // before[i] counts what comes before piece i.
  std::vector<ObjCounts> before(chunks.size() + 1);
  std::vector<ObjSegmentLines> segments(options.segments ? chunks.size() : 0);
  for_each_chunk(chunks.size(), options.threads, [&](std::size_t i) {
    before[i + 1] =
        count_statements(chunks[i], file, line_end, options.segments ? &segments[i] : nullptr);
  });
  for (std::size_t i = 1; i < before.size(); ++i) {
    ObjCounts sum = before[i - 1];
    sum.add(before[i]);
    before[i] = std::move(sum);
  }
  const ObjCounts& total = before.back();

  if (total.vertices + total.faces == 0 && !total.unknown.empty())
    throw InputError(file + ": holds neither vertices nor faces, expected an OBJ file");
  Mesh mesh;
  make_room(total, options, file, mesh);
  mesh.segments = segments_of(segments, before);
  std::vector<ObjOddities> odd(chunks.size());
  for_each_chunk(chunks.size(), options.threads, [&](std::size_t i) {
    odd[i] = ObjChunk(chunks[i], file, line_end, before[i], total, mesh).read();
  });
  ObjOddities all;
  for (const ObjOddities& of_piece : odd) all.add(of_piece);
  warn(total, all, options, file, warnings);
  cut_polygons(mesh, total.skipped_faces, file, warnings);
  return mesh;
}

}  // namespace fathom::mesh_files
