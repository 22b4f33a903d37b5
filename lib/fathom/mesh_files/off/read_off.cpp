#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <utility>
#include <vector>

#include "fathom/failures/errors.h"
#include "fathom/mesh/mesh_faces.h"
#include "fathom/mesh_files/occurrences.h"
#include "fathom/mesh_files/off/off_keyword.h"
#include "fathom/mesh_files/read_mesh.h"
#include "fathom/text/counted.h"
#include "fathom/text/text_cursor.h"
#include "fathom/text/text_ends.h"

namespace fathom::mesh_files {
using namespace mesh;
using namespace text;

namespace {

/// The colours of the vertices of an OFF file. Whether its numbers are fractions of 1 or of 255 is
/// decided at the end: they are fractions of 255 if all are integers and any is greater than 1.
class OffColours {
 public:
  using Colour = std::array<float, 4>;
  static constexpr float opaque = std::numeric_limits<float>::quiet_NaN();

  /// Of the vertices in their order, each at most once; alpha may be `opaque`.
  void add(std::uint64_t vertex, const Colour& colour, bool integers) {
    colours_.resize(vertex, none);
    colours_.push_back(colour);
    integers_ = integers_ && integers;
    for (const float c : colour) greatest_ = std::max(greatest_, std::isnan(c) ? 0 : c);
  }

  /// One for each vertex, white where none was given; empty if none was at all.
  std::vector<Colour> finish(std::uint64_t vertices) {
    if (colours_.empty()) return {};
    colours_.resize(vertices, none);
    const float whole = integers_ && greatest_ > 1 ? 255 : 1;
    for (Colour& colour : colours_) {
      if (std::isnan(colour[0])) colour = {whole, whole, whole, whole};
      if (std::isnan(colour[3])) colour[3] = whole;
      for (float& c : colour) c = std::clamp(c / whole, 0.0F, 1.0F);
    }
    return std::move(colours_);
  }

 private:
  static constexpr Colour none{opaque, opaque, opaque, opaque};

  std::vector<Colour> colours_;
  bool integers_ = true;
  float greatest_ = 0;
};

/// The contents of the first word and the counts.
struct OffHeader {
  OffKeyword keyword;
  std::uint64_t vertices = 0, faces = 0;
  /// More words follow on the line of the last count.
  bool goes_on = false;

  [[nodiscard]] bool has_attributes() const {
    return keyword.normals || keyword.colours || keyword.texture;
  }
  /// The number of words of a vertex after its coordinates, without its colour.
  [[nodiscard]] std::uint64_t normal_and_texture_words() const {
    return (keyword.normals ? 3U : 0U) + (keyword.texture ? 2U : 0U);
  }
};

/// Whether each vertex or face has its own line, on which other words may follow, or is a number of
/// words regardless of line ends.
enum class OffLayout { lines, words };

class OffReader {
 public:
  OffReader(TextCursor body, const std::string& file, const OffHeader& header, OffLayout vertices,
            OffLayout faces, bool keep_attributes)
      : cursor_(body),
        file_(file),
        header_(header),
        vertices_(vertices),
        faces_(faces),
        keep_attributes_(keep_attributes) {}

  Mesh read(Warnings& warnings) {
    reserve();
    for (std::uint64_t i = 0; i < header_.vertices; ++i) read_vertex(i);
    if (vertices_ == OffLayout::words && !cursor_.at_line_end() && faces_ == OffLayout::lines)
      cursor_.fail_here("expected the line to end after the vertices");
    FaceCollector faces(mesh_, file_);
    for (std::uint64_t i = 0; i < header_.faces; ++i) read_face(i, faces);
    const bool more = cursor_.next_line_with_words();
    if (more && (vertices_ == OffLayout::words || faces_ == OffLayout::words))
      cursor_.fail_here("expected the file to end");
    Warnings noticed;
    odd_.warn(file_, "vertex has numbers behind x, y, z that are no colour",
              "vertices have numbers behind x, y, z that are no colour", "ignored", noticed);
    if (more)
      noticed.push_back(file_ + ": line " + std::to_string(cursor_.line()) +
                        ": what follows the last face is ignored");
    cut_polygons(mesh_, faces.skipped(), file_, noticed);
    if (keep_attributes_) mesh_.colours = colours_.finish(header_.vertices);
    warnings.insert(warnings.end(), noticed.begin(), noticed.end());
    return std::move(mesh_);
  }

  [[nodiscard]] std::uint64_t line() const { return cursor_.line(); }

 private:
  /// Every vertex takes at least six characters ("0 0 0" and a line end), every face two.
  void reserve() {
    const std::uint64_t rest = cursor_.rest() + 1;
    if (header_.vertices > rest / 6 || header_.faces > (rest - 6 * header_.vertices) / 2)
      throw InputError(file_ + ": " + text::counted(header_.vertices, "vertex", "vertices") +
                       " and " + text::counted(header_.faces, "face") +
                       " are claimed, expected a file long enough for them");
    mesh_.vertices.reserve(header_.vertices);
    mesh_.triangles.reserve(std::min(header_.faces, rest / 8));  // "3 0 1 2" and a line end
    if (!keep_attributes_) return;
    if (header_.keyword.normals) mesh_.normals.reserve(header_.vertices);
    if (header_.keyword.texture) mesh_.texture_coordinates.reserve(header_.vertices);
  }

  void go_to_row(const char* what, std::uint64_t number, std::uint64_t count) {
    if (cursor_.next_line_with_words()) return;
    cursor_.fail("the file ends after " + std::to_string(number) + " of " + std::to_string(count) +
                 " " + what);
  }

  /// Moves to the next word on any line; in a file of lines the cursor checks that it is on this
  /// line.
  void go_to_word(OffLayout layout) {
    if (layout == OffLayout::lines || !cursor_.at_line_end()) return;
    if (!cursor_.next_line_with_words()) cursor_.fail("the file ends");
  }

  double coordinate(const char* what) {
    go_to_word(vertices_);
    return cursor_.number<double>(what);
  }
  double attribute() {
    go_to_word(vertices_);
    return cursor_.attribute<double>("a number behind the point");
  }

  void read_vertex(std::uint64_t i) {
    go_to_row("vertices", i, header_.vertices);
    const double x = coordinate("coordinate x");
    const double y = coordinate("coordinate y");
    const double z = coordinate("coordinate z");
    mesh_.vertices.push_back({x, y, z});
    if (vertices_ == OffLayout::words) {
      read_attributes(i, header_.keyword.colours ? 4 : 0);
    } else if (header_.has_attributes() || !cursor_.at_line_end()) {
      read_rest_of_vertex_line(i);
    }
  }

  /// 3 or 4 words beyond normals and texture coordinates are a colour, even without the keyword.
  /// For lines with any other number of words only the point is used.
  void read_rest_of_vertex_line(std::uint64_t i) {
    TextCursor ahead = cursor_;
    std::uint64_t words = 0;
    while (!ahead.word().empty()) ++words;
    const std::uint64_t other = header_.normal_and_texture_words();
    const bool has_colour = words == other + 3 || words == other + 4;
    if (has_colour || (words == other && !header_.keyword.colours))
      return read_attributes(i, static_cast<std::size_t>(words - other));
    odd_.note(cursor_.line());
    cursor_.skip_line();
    push_attributes({}, {});
  }

  void read_attributes(std::uint64_t i, std::size_t components) {
    std::array<double, 3> normal{};
    std::array<double, 2> st{};
    if (header_.keyword.colours_first) read_colour(i, components);
    if (header_.keyword.normals)
      for (double& c : normal) c = attribute();
    if (!header_.keyword.colours_first) read_colour(i, components);
    if (header_.keyword.texture)
      for (double& c : st) c = attribute();
    push_attributes(normal, st);
  }

  void push_attributes(const std::array<double, 3>& normal, const std::array<double, 2>& st) {
    if (!keep_attributes_) return;
    if (header_.keyword.normals) mesh_.normals.push_back(normal);
    if (header_.keyword.texture) mesh_.texture_coordinates.push_back(st);
  }

  void read_colour(std::uint64_t vertex, std::size_t components) {
    if (components == 0) return;
    OffColours::Colour colour{0, 0, 0, OffColours::opaque};
    bool integers = true, finite = true;
    for (std::size_t k = 0; k < components; ++k) {
      go_to_word(vertices_);
      cursor_.at_line_end();  // to the word itself
      const char* word = cursor_.position();
      colour[k] = cursor_.attribute<float>("a number behind the point");
      finite = finite && std::isfinite(colour[k]);
      integers = integers && std::all_of(word, cursor_.position(), [](char c) {
                   return (c >= '0' && c <= '9') || c == '-' || c == '+';
                 });
    }
    if (!finite) {
      odd_.note(cursor_.line());
    } else if (keep_attributes_) {
      colours_.add(vertex, colour, integers);
    }
  }

  void read_face(std::uint64_t i, FaceCollector& faces) {
    go_to_row("faces", i, header_.faces);
    const std::int64_t corners = cursor_.integer("a number of corners");
    if (corners < 0) cursor_.fail("expected a number of corners, found a negative one");
    // In a stream of words a count may be something else if a word is missing.
    if (corners < 3 && faces_ == OffLayout::words)
      cursor_.fail("expected at least three corners, found " + std::to_string(corners));
    ring_.clear();
    for (std::int64_t k = 0; k < corners; ++k) {
      go_to_word(faces_);
      const std::int64_t index = cursor_.integer("the index of a vertex");
      if (index < 0 || static_cast<std::uint64_t>(index) >= header_.vertices)
        cursor_.fail("index " + std::to_string(index) + " is out of range, expected 0 to " +
                     std::to_string(static_cast<std::int64_t>(header_.vertices) - 1));
      ring_.push_back(static_cast<std::uint32_t>(index));
    }
    faces.add(ring_);
    if (faces_ == OffLayout::lines) cursor_.skip_line();  // a colour may follow
  }

  TextCursor cursor_;
  const std::string& file_;
  const OffHeader& header_;
  OffLayout vertices_, faces_;
  bool keep_attributes_;
  Mesh mesh_;
  OffColours colours_;
  Occurrences odd_;
  std::vector<std::uint32_t> ring_;
};

/// The numbers of vertices and faces, and of edges, which may be missing. The counts may be on
/// lines of their own; then so is the number of edges.
void read_counts(TextCursor& cursor, const std::string& file, OffHeader& header) {
  const auto read = [&](const char* what) {
    if (!cursor.next_line_with_words())
      cursor.fail(std::string("expected ") + what + ", found the end of the file");
    const std::int64_t count = cursor.integer(what);
    if (count < 0) cursor.fail(std::string("expected ") + what + ", found a negative one");
    expect_countable(static_cast<std::uint64_t>(count), "vertices or faces", file);
    return static_cast<std::uint64_t>(count);
  };
  header.vertices = read("a number of vertices");
  const std::uint64_t line = cursor.line();
  header.faces = read("a number of faces");
  if (!cursor.at_line_end()) {
    cursor.integer("a number of edges");
  } else if (cursor.line() != line) {
    TextCursor ahead = cursor;
    const bool single =
        ahead.next_line_with_words() && !ahead.word().empty() && ahead.at_line_end();
    if (single && cursor.next_line_with_words()) cursor.integer("a number of edges");
  }
  header.goes_on = !cursor.at_line_end();
}

OffHeader read_off_header(TextCursor& cursor, const std::string& file) {
  if (!cursor.next_line_with_words()) cursor.fail("expected OFF and the counts, found nothing");
  OffHeader header;
  const char* start = cursor.position();
  const std::string_view word = TextCursor(cursor).word();
  if (const auto keyword = read_off_keyword(word)) {
    header.keyword = *keyword;
    if (keyword->other_dimensions)
      cursor.fail(std::string(word.substr(0, keyword->size)) +
                  " is not supported, expected points of three coordinates");
    cursor.move_to(start + keyword->size);
    if (!cursor.at_line_end() && (*cursor.position() == 'B' || *cursor.position() == 'b'))
      cursor.fail("binary OFF is not supported, expected text");
  } else if (*start < '0' || *start > '9') {
    cursor.fail("expected OFF with any of the prefixes ST, C and N");
  }
  read_counts(cursor, file, header);
  return header;
}

/// Whether there is a line for every vertex and every face, and no other.
bool has_a_line_each(TextCursor body, const OffHeader& header) {
  std::uint64_t lines = 0;
  for (; body.next_line_with_words(); body.skip_line()) ++lines;
  return lines == header.vertices + header.faces;
}

/// Whether there are enough lines, and enough words on each, for a vertex or a face a line.
bool has_line_structure(TextCursor body, const OffHeader& header) {
  const auto words_of_line = [&](std::uint64_t enough) {
    std::uint64_t words = 0;
    while (words < enough && !body.word().empty()) ++words;
    return words;
  };
  for (std::uint64_t i = 0; i < header.vertices; ++i, body.skip_line())
    if (!body.next_line_with_words() || words_of_line(3) < 3) return false;
  for (std::uint64_t i = 0; i < header.faces; ++i, body.skip_line()) {
    if (!body.next_line_with_words()) return false;
    const std::string_view word = body.word();
    std::int64_t corners = 0;
    const char* end = word.data() + word.size();
    if (TextCursor::parse_integer(word.data(), end, corners) != end || corners < 0) return false;
    const auto count = static_cast<std::uint64_t>(corners);
    if (words_of_line(count) < count) return false;
  }
  return true;
}

std::string without_name(const std::string& message, const std::string& file) {
  return message.starts_with(file + ": ") ? message.substr(file.size() + 2) : message;
}

}  // namespace

Mesh read_off(std::string_view bytes, const std::string& file, const ReadOptions& options,
              Warnings& warnings) {
  expect_no_utf16(bytes, file);
  TextCursor cursor(without_padding(bytes), file, {.comments = true, .continuation = false});
  const OffHeader header = read_off_header(cursor, file);
  using enum OffLayout;
  const auto reader_by = [&](OffLayout vertices, OffLayout faces) {
    return OffReader(cursor, file, header, vertices, faces, options.attributes);
  };
  if (header.goes_on) return reader_by(words, words).read(warnings);
  std::string failure;
  try {
    return reader_by(lines, lines).read(warnings);
  } catch (const InputError& by_lines) {
    if (has_line_structure(cursor, header) || has_a_line_each(cursor, header)) throw;
    failure = by_lines.what();
  }
  // The way that gets furthest is the likeliest, and its failure the one to tell.
  std::string other;
  std::uint64_t furthest = 0;
  for (const auto& [vertices, faces] :
       {std::pair{lines, words}, std::pair{words, lines}, std::pair{words, words}}) {
    OffReader reader = reader_by(vertices, faces);
    try {
      return reader.read(warnings);
    } catch (const InputError& by_words) {
      if (reader.line() > furthest) other = without_name(by_words.what(), file);
      furthest = std::max(furthest, reader.line());
    }
  }
  throw InputError(failure +
                   "; nor is the body a stream of as many words as the counts say: " + other);
}

}  // namespace fathom::mesh_files
