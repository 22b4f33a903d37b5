#pragma once

#include <string_view>

#include "fathom/text/text_cursor.h"

/// What lines of an OBJ begin with. For this room's .cpp files only.
namespace fathom::mesh_files {

inline constexpr text::TextCursor::Syntax obj_syntax{.comments = true, .continuation = true};
enum class Statement { vertex, texture, normal, face, line, point, segment, ignored, unknown };

/// Nearly all keywords are one letter long: they are told apart first, without comparing strings.
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

}  // namespace fathom::mesh_files
