#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <string_view>
#include <unordered_map>
#include <vector>

#include "fathom/mesh/segmentation.h"

/// The lines o, g and usemtl of an OBJ, which name segments. Only for .cpp files of this module.
namespace fathom::mesh_files {

/// A line that gives the triangles after it a name.
struct ObjSegmentLine {
  Segmentation by;
  /// The text after the keyword, unchanged.
  std::string_view rest;
  /// How many triangles come before it in its piece of the file.
  std::uint64_t triangle;
};

/// The lines of a piece of the file, except lines that are followed by another line of the same
/// segmentation without a triangle in between.
class ObjSegmentLines {
 public:
  void add(const ObjSegmentLine& line);
  [[nodiscard]] const std::vector<ObjSegmentLine>& lines() const { return lines_; }

 private:
  std::vector<ObjSegmentLine> lines_;
  /// One more than the place of the last line of each segmentation.
  std::array<std::size_t, all_segmentations.size()> last_{};
};

/// The segmentation that a keyword belongs to; label of none.
Segmentation obj_segmentation(std::string_view keyword);

/// Makes segments of lines, one segmentation at a time.
///
/// A name is the text after the keyword, without the blanks around it: it may contain blanks and
/// '#', and several groups of a `g` are one name. Bytes that are not UTF-8 are taken for ISO
/// 8859-1. `g` without a name means the group `default`. `o` and `usemtl` without a name end the
/// segment; triangles before the first line have no segment.
class ObjSegments {
 public:
  explicit ObjSegments(Segmentation by) : segments_{by, {}, {}} {}

  /// The lines of the next piece, which `triangles_before` triangles precede.
  void add(const std::vector<ObjSegmentLine>& lines, std::uint64_t triangles_before);
  /// The segments of a mesh of `triangles` triangles; without numbers if no triangle has a name.
  TriangleSegments finish(std::uint64_t triangles);

 private:
  /// Triangles up to `end` that have one number.
  struct Run {
    std::uint32_t end, number;
  };
  void end_run(std::uint64_t triangle);
  std::uint32_t number_of(std::string_view rest);

  TriangleSegments segments_;
  std::vector<Run> runs_;
  std::string_view rest_;
  bool has_begun_ = false;
  std::uint64_t begin_ = 0;
  std::unordered_map<std::string, std::uint32_t> numbers_;
};

}  // namespace fathom::mesh_files
