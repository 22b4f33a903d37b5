#pragma once

#include <cstddef>
#include <string>
#include <string_view>

namespace fathom::text {

/// The character at the start of a text: its code and how many bytes it takes.
struct Utf8Character {
  /// The code of a byte that begins no character of UTF-8.
  static constexpr char32_t none = 0xFFFFFFFF;

  char32_t code;
  std::size_t size;
};

/// Needs a text that is not empty.
Utf8Character first_character(std::string_view text);

/// A text as UTF-8: itself, or, where it is not, each of its bytes as the character that it is in
/// ISO 8859-1. Texts that differ and are not UTF-8 stay different.
std::string as_utf8(std::string_view text);

// Texts that come from outside (names of files and objects, comments, attributes) as they can be
// shown on a terminal. What could move its cursor, forge a line or turn the direction of writing
// is taken out: the control characters of ASCII and U+0080 to U+009F, the separators of lines and
// paragraphs, and the marks and overrides of direction.

/// A text as it can stand in one line: each such character becomes '?', and each byte that is not
/// part of UTF-8 becomes U+FFFD.
std::string printable(std::string_view text);

/// The same for a text of several lines: line feeds and tabs stay.
std::string printable_lines(std::string_view text);

/// JSON with the same value in which each such character within a string is escaped.
std::string escaped_json(std::string_view json);

}  // namespace fathom::text
