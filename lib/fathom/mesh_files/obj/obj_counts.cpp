#include "fathom/mesh_files/obj/obj_counts.h"

#include <algorithm>

#include "fathom/mesh_files/obj/obj_statements.h"
#include "fathom/text/printable.h"

namespace fathom::mesh_files {
using namespace text;
namespace {

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

}  // namespace

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

}  // namespace fathom::mesh_files
