#pragma once

#include <string>
#include <string_view>

/// Texts that come from outside (names of files and objects, comments, attributes) as they can be
/// shown on a terminal. What could move its cursor, forge a line or turn the direction of writing
/// is taken out: the control characters of ASCII and U+0080 to U+009F, the separators of lines and
/// paragraphs, and the marks and overrides of direction.
namespace fathom::text {

/// A text as it can stand in one line: each such character becomes '?', and each byte that is not
/// part of UTF-8 becomes U+FFFD.
std::string printable(std::string_view text);

/// The same for a text of several lines: line feeds and tabs stay.
std::string printable_lines(std::string_view text);

/// JSON with the same value in which each such character within a string is escaped.
std::string escaped_json(std::string_view json);

}  // namespace fathom::text
