#pragma once

#include <cstddef>
#include <optional>
#include <string_view>

namespace fathom::mesh_files {

/// The first word of an OFF file: OFF with any of the prefixes ST, C, N, 4 and n, in capitals or
/// entirely in small letters.
struct OffKeyword {
  bool normals = false, colours = false, texture = false;
  /// The colours of vertices come before their normals: the prefixes were NC, as MeshLab writes
  /// them, and not CN.
  bool colours_first = false;
  /// Points of four coordinates, or of any number.
  bool other_dimensions = false;
  /// The length of the keyword. Its word may go on with the first count ("OFF8 6 12").
  std::size_t size = 0;
};

/// nullopt if the word is something else.
std::optional<OffKeyword> read_off_keyword(std::string_view word);

}  // namespace fathom::mesh_files
