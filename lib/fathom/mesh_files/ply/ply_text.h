#pragma once

#include <cstdint>
#include <string>
#include <string_view>

#include "fathom/failures/errors.h"
#include "fathom/mesh_files/ply/ply_header.h"
#include "fathom/text/text_cursor.h"

namespace fathom::mesh_files {

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
      : cursor_(body, file, {}, text::TextCursor::line_end_of(body), header.lines + 1),
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
    return text::TextCursor::parse_integer(word.data(), last, number) == last ? label_from(number)
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

  text::TextCursor cursor_, start_;
  /// In the whole body.
  std::uint64_t rows_ = 0;
  const std::string& file_;
  /// The fault of the first row that is not a line; empty while rows are lines.
  std::string break_;
};

}  // namespace fathom::mesh_files
