#pragma once

#include <array>
#include <cstdint>
#include <string_view>

#include "fathom/mesh_files/obj/obj_counts.h"
#include "fathom/text/text_cursor.h"

/// Keywords of OBJ lines, and the plainest lines: vertices and faces that have no comment, are not
/// joined to another line and end with an LF, like most lines of a large file. Counting them takes
/// a third of the time of general lines, because words are skipped several characters at a time;
/// reading them is as simple. Only for .cpp files of this module.
namespace fathom::mesh_files {

inline constexpr text::TextCursor::Syntax obj_syntax{.comments = true, .continuation = true};
enum class Statement { vertex, texture, normal, face, line, point, segment, ignored, unknown };

/// Nearly all keywords are one letter long: these are distinguished first, without comparing
/// strings.
inline Statement statement_named(char keyword) {
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

inline Statement statement_named(std::string_view keyword) {
  if (keyword.size() == 1) return statement_named(keyword[0]);
  if (keyword == "vt") return Statement::texture;
  if (keyword == "vn") return Statement::normal;
  if (keyword == "usemtl") return Statement::segment;
  for (const std::string_view known : {"mtllib", "usemap", "maplib", "mg", "lod", "bevel",
                                       "c_interp", "d_interp", "shadow_obj", "trace_obj"})
    if (keyword == known) return Statement::ignored;
  return Statement::unknown;
}

/// What their characters are.
enum class Plain : std::uint8_t { other, number, slash, blank, line_end };

inline constexpr std::array<Plain, 256> plain_characters = [] {
  std::array<Plain, 256> kinds{};
  for (const unsigned char c :
       {'0', '1', '2', '3', '4', '5', '6', '7', '8', '9', '+', '-', '.', 'e'})
    kinds[c] = Plain::number;
  for (const unsigned char c : {' ', '\t', '\r'}) kinds[c] = Plain::blank;
  kinds['/'] = Plain::slash;
  kinds['\n'] = Plain::line_end;
  return kinds;
}();

inline Plain plain_kind(const char* at, const char* last) {
  return at == last ? Plain::other : plain_characters[static_cast<unsigned char>(*at)];
}

/// Moves `at` behind the number at `at`; false if there is no number.
template <char least, char greatest>
[[gnu::always_inline]] inline bool skip_word(const char*& at, const char* last) {
  if (plain_kind(at, last) != Plain::number) return false;
  while (plain_kind(at, last) == Plain::number) text::skip_characters<least, greatest>(++at, last);
  return true;
}

[[gnu::always_inline]] inline void skip_blanks(const char*& at, const char* last) {
  while (plain_kind(at, last) == Plain::blank) ++at;
}

/// Counts the words from `at` on. Returns the end of the line; null if the line is not plain.
inline const char* count_plain_vertex(const char* at, const char* last, ObjCounts& counts) {
  int words = 0;
  for (skip_blanks(at, last); plain_kind(at, last) != Plain::line_end; ++words) {
    if (!skip_word<'*', '9'>(at, last)) return nullptr;
    skip_blanks(at, last);
  }
  counts.add_vertex(words);
  return at;
}

/// The same of the corners of a face.
inline const char* count_plain_face(const char* at, const char* last, ObjCounts& counts) {
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

/// Counts the statement at the cursor if it is a vertex or a face on a plain line, and moves to the
/// end of the line. False, and nothing happens, where it is not.
inline bool count_plain_line(text::TextCursor& cursor, ObjCounts& counts) {
  const char* const at = cursor.position() + 1;
  const char* const last = cursor.limit();
  const char keyword = at[-1];
  if ((keyword != 'v' && keyword != 'f') || plain_kind(at, last) != Plain::blank) return false;
  const char* const end =
      keyword == 'v' ? count_plain_vertex(at, last, counts) : count_plain_face(at, last, counts);
  if (end != nullptr) cursor.move_to(end);
  return end != nullptr;
}

/// Where the words begin that follow the keyword and one blank; null if another statement
/// stands.
inline const char* plain_words_after(char keyword, const text::TextCursor& cursor) {
  const char* const at = cursor.position();
  return cursor.rest() > 2 && at[0] == keyword && at[1] == ' ' ? at + 2 : nullptr;
}

/// Whether word `k` of three ends at `at`, as in nearly all files: by one blank, or by the line
/// end. Then `at` is behind the blank.
inline bool ends_plain_word(std::size_t k, const char*& at, const char* last) {
  if (at == last || *at != (k < 2 ? ' ' : '\n')) return false;
  at += k < 2 ? 1 : 0;
  return true;
}

/// Reads "f 1 2 3", with indices of so many vertices, as places of the corners. False for other
/// lines; then the cursor does not move.
inline bool read_plain_triangle(text::TextCursor& cursor, std::uint64_t vertices,
                                std::array<std::uint32_t, 3>& corners) {
  const char* at = plain_words_after('f', cursor);
  if (!at) return false;
  for (std::size_t k = 0; k < 3; ++k) {
    constexpr std::size_t most_digits = 18;
    const text::DigitRun index = text::read_digits(at, cursor.limit());
    const std::uint64_t place = index.number - 1;  // of 0: the greatest number
    if (index.count == 0 || index.count > most_digits || place >= vertices) return false;
    if (!ends_plain_word(k, at, cursor.limit())) return false;
    corners[k] = static_cast<std::uint32_t>(place);
  }
  cursor.move_to(at);
  return true;
}

/// The same of "v 0.1 0.2 0.3".
inline bool read_plain_vertex(text::TextCursor& cursor, std::array<double, 3>& coordinates) {
  const char* at = plain_words_after('v', cursor);
  if (!at) return false;
  for (std::size_t k = 0; k < 3; ++k) {
    const auto number = text::parse_decimal<double>(at, cursor.limit());
    at = number.end;
    if (number.fault != text::DecimalFault::none || !ends_plain_word(k, at, cursor.limit()))
      return false;
    coordinates[k] = number.value;
  }
  cursor.move_to(at);
  return true;
}

}  // namespace fathom::mesh_files
