#include <cstdint>
#include <string>
#include <string_view>

#include "fathom/failures/errors.h"
#include "fathom/memory/huge_pages.h"
#include "fathom/mesh_files/ply/ply_body.h"
#include "fathom/mesh_files/ply/ply_header.h"
#include "fathom/mesh_files/read_mesh.h"
#include "fathom/text/text_cursor.h"
#include "fathom/text/text_ends.h"

namespace fathom::mesh_files {
using namespace mesh;
using namespace text;

namespace {

/// The values of a PLY body that is text.
///
/// Rows are lines, as in nearly all files. A file with another number of lines than rows may be a
/// stream of words with arbitrary line ends, which is how other programs read all files. It must
/// then have exactly as many words as the header claims, and no face of fewer than three corners.
/// So a missing or extra value in a file of lines is a failure at its place, and is not compensated
/// by the next row.
class PlyTextRows {
 public:
  PlyTextRows(std::string_view body, const std::string& file, const PlyHeader& header)
      : cursor_(body, file, {}, TextCursor::line_end_of(body), header.lines + 1),
        start_(cursor_),
        file_(file) {
    for (const PlyElement& element : header.elements)
      if (!element.properties.empty()) rows_ += element.count;
  }

  static std::uint64_t least_row_size(const PlyElement& element) {
    return 2 * element.properties.size();  // a digit and what separates it from the next
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
    if (!cursor_.at_line_end() && break_.empty()) note_long_row();
  }

  /// The corners of a face that has been read: in a stream of words, where a count may be something
  /// else if a word is missing, there are three.
  void expect_face(std::size_t corners) const {
    if (corners < 3 && !break_.empty())
      fail("expected a face of at least three corners, found " + std::to_string(corners));
  }

  /// A coordinate: rounded once to the type that the file declares.
  double finite(PlyType type, const char* what) {
    go_to_word(what);
    if (type == PlyType::float64) return cursor_.number<double>(what);
    if (type == PlyType::float32) return static_cast<double>(cursor_.number<float>(what));
    return static_cast<double>(integer(type, what));
  }
  double attribute(PlyType type) {
    go_to_word("a number");
    if (type == PlyType::float64) return cursor_.attribute<double>("a number");
    if (type == PlyType::float32) return static_cast<double>(cursor_.attribute<float>("a number"));
    return static_cast<double>(integer(type, "an integer"));
  }
  std::int64_t integer(PlyType type, const char* what) {
    go_to_word(what);
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
  /// A label; `unsegmented` if the word is not a label, because a mesh does not need labels.
  std::uint32_t label(PlyType) {
    go_to_word("a value");
    const std::string_view word = cursor_.word();
    const char* const last = word.data() + word.size();
    std::int64_t number = 0;
    return TextCursor::parse_integer(word.data(), last, number) == last ? label_from(number)
                                                                        : unsegmented;
  }
  void skip(PlyType) {
    go_to_word("a value");
    cursor_.word();
  }
  void skip(PlyType type, std::uint64_t count) {
    for (std::uint64_t i = 0; i < count; ++i) skip(type);
  }
  /// Only for binary rows.
  [[nodiscard]] static std::uint64_t position() { return 0; }

  /// Whether something follows the last row.
  /// Fails    InputError if the rows are no lines.
  [[nodiscard]] bool has_more() {
    const bool more = cursor_.next_line_with_words();
    if (more && !break_.empty()) fail("there are more words");
    return more;
  }
  /// The message of a failure, with the place from where the rows are no lines.
  [[nodiscard]] std::string explained(const std::string& message) const {
    if (break_.empty()) return message;
    const std::string name = file_ + ": ";
    return break_ + "; nor is the body a stream of as many words as the header says: " +
           (message.starts_with(name) ? message.substr(name.size()) : message);
  }
  [[nodiscard]] std::string place() const { return "line " + std::to_string(cursor_.line()); }
  [[noreturn]] void fail(const std::string& message) const { cursor_.fail(message); }

 private:
  void go_to_word(const char* what) {
    if (cursor_.at_line_end()) go_to_next_line(what);
  }
  void go_to_next_line(const char* what);
  void note_long_row();
  /// The first row that is no line.
  void note_break(const std::string& message);

  TextCursor cursor_, start_;
  /// The number of rows in the whole body.
  std::uint64_t rows_ = 0;
  const std::string& file_;
  /// The fault of the first row that is not a line; empty while rows are lines.
  std::string break_;
};

void PlyTextRows::note_break(const std::string& message) {
  std::uint64_t lines = 0;
  for (TextCursor line = start_; line.next_line_with_words(); line.skip_line()) ++lines;
  if (lines == rows_) throw InputError(message);
  break_ = message;
}

void PlyTextRows::go_to_next_line(const char* what) {
  if (break_.empty())
    note_break(file_ + ": " + place() + ": expected " + what + ", found the end of the line");
  if (!cursor_.next_line_with_words()) cursor_.fail("the file ends");
}

void PlyTextRows::note_long_row() {
  std::string message;
  try {
    TextCursor(cursor_).fail_here("expected the line to end");
  } catch (const InputError& failure) {
    message = failure.what();
  }
  note_break(message);
}

/// Collects vertices and faces in a mesh.
class MeshSink {
 public:
  MeshSink(const std::string& file, bool primitives)
      : faces_(mesh_, file), primitives_(primitives) {}

  template <class Has, class Rows>
  void begin_vertices(const PlyElement& element, const Has& has, const Rows&) {
    normals_ = has(slot_normal) && has(slot_normal + 1) && has(slot_normal + 2);
    textures_ = has(slot_texture) && has(slot_texture + 1);
    colours_ = has(slot_colour) && has(slot_colour + 1) && has(slot_colour + 2);
    memory::reserve_large(mesh_.vertices, element.count);
    if (normals_) memory::reserve_large(mesh_.normals, element.count);
    if (textures_) memory::reserve_large(mesh_.texture_coordinates, element.count);
    if (colours_) memory::reserve_large(mesh_.colours, element.count);
    vertices_have_labels_ = has(slot_label);
    if (vertices_have_labels_) vertex_labels_.reserve(element.count);
  }

  void vertex(const PlyVertex& row) {
    mesh_.vertices.push_back({row[0], row[1], row[2]});
    if (normals_) mesh_.normals.push_back({row[3], row[4], row[5]});
    if (textures_) mesh_.texture_coordinates.push_back({row[6], row[7]});
    if (colours_) push_colour(row);
    if (vertices_have_labels_)
      vertex_labels_.push_back(static_cast<std::uint32_t>(row[slot_label]));
  }

  template <class Rows>
  void begin_faces(const PlyElement&, const PlyFaceColumns& columns, std::uint64_t most,
                   const Rows&) {
    memory::reserve_large(mesh_.triangles, most);
    faces_have_labels_ = columns.label.has_value();
    if (faces_have_labels_) labels_.reserve(most);
  }

  template <class Rows>
  void face(const PlyFace& face, const Rows&) {
    // Strips before the faces have none.
    if (faces_have_labels_) labels_.resize(mesh_.triangles.size(), unsegmented);
    faces_.add(face.ring);
    if (faces_have_labels_) labels_.resize(mesh_.triangles.size(), face.label);
  }

  void triangle(const CornerIndices& corners) { faces_.add(corners); }

  void begin_strips(const PlyElement&, std::size_t) {}
  template <class Rows>
  void strip_corner(const PlyStrip&, std::uint64_t, const Rows&) {}
  void strip_triangle(const CornerIndices& corners) { faces_.add(corners); }

  [[nodiscard]] bool wants_edges() const { return primitives_; }
  void edge(const std::array<std::uint32_t, 2>& ends) { mesh_.lines.push_back(ends); }

  Mesh finish(const std::string& file, Warnings& warnings) {
    cut_polygons(mesh_, faces_.skipped(), file, warnings);
    if (faces_have_labels_) labels_.resize(mesh_.triangles.size(), unsegmented);
    // Of the triangles into which a face is cut, each has its own corners.
    if (vertices_have_labels_) take_labels_of_corners();
    if (!labels_.empty())
      mesh_.segments.push_back({Segmentation::label, compact_segments(std::move(labels_)), {}});
    return std::move(mesh_);
  }

 private:
  void take_labels_of_corners() {
    labels_.reserve(mesh_.triangles.size());
    for (const auto& [a, b, c] : std::as_const(mesh_.triangles))
      labels_.push_back(common_label(vertex_labels_[a], vertex_labels_[b], vertex_labels_[c]));
  }

  void push_colour(const PlyVertex& row) {
    std::array<float, 4> colour{};
    for (std::size_t i = 0; i < 4; ++i) colour[i] = static_cast<float>(row[slot_colour + i]);
    mesh_.colours.push_back(colour);
  }

  Mesh mesh_;
  FaceCollector faces_;
  bool primitives_;
  bool normals_ = false, textures_ = false, colours_ = false;
  bool faces_have_labels_ = false, vertices_have_labels_ = false;
  /// Of the vertices, and of the triangles, where they have any.
  std::vector<std::uint32_t> vertex_labels_, labels_;
};

template <class Rows>
Mesh read_body(std::string_view text, const PlyHeader& header, const std::string& file,
               const ReadOptions& options, Warnings& warnings) {
  MeshSink sink(file, options.primitives);
  const PlyLabels labels = options.segments ? find_ply_labels(header, file, warnings) : PlyLabels();
  Rows rows(text.substr(header.size), file, header);
  PlyBody<Rows, MeshSink>(std::move(rows), header, file, options.attributes, labels, sink)
      .read(warnings);
  return sink.finish(file, warnings);
}

}  // namespace

Mesh read_ply(std::span<const std::byte> bytes, const std::string& file, const ReadOptions& options,
              Warnings& warnings) {
  const std::string_view text(reinterpret_cast<const char*>(bytes.data()), bytes.size());
  expect_no_utf16(text, file);
  const PlyHeader header = read_ply_header(text, file, warnings);
  switch (header.encoding) {
    case PlyHeader::Encoding::ascii:
      return read_body<PlyTextRows>(without_padding(text), header, file, options, warnings);
    case PlyHeader::Encoding::little_endian:
      return read_body<BinaryRows<false>>(text, header, file, options, warnings);
    default:
      return read_body<BinaryRows<true>>(text, header, file, options, warnings);
  }
}

}  // namespace fathom::mesh_files
