#pragma once

#include <array>
#include <cstdint>
#include <map>
#include <string>
#include <string_view>
#include <unordered_map>
#include <vector>

#include "fathom/mesh/segmentation.h"

/// The first pass over an OBJ: counts of its statements, and the lines o, g and usemtl, which name
/// segments. Only for .cpp files of this module.
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

/// How many of each a piece of the file has; sums of them are places.
struct ObjCounts {
  std::uint64_t lines = 0;
  std::uint64_t vertices = 0, textures = 0, normals = 0;
  std::uint64_t short_points = 0;  // of at most two numbers, counted up to the first colour
  std::uint64_t faces = 0, triangles = 0;
  std::uint64_t skipped_faces = 0, not_faces = 0;
  std::uint64_t segments = 0, points = 0, skipped_lines = 0;
  bool polygons = false;  // a face that does not have three corners
  bool colours = false, face_textures = false, face_normals = false;
  std::map<std::string, std::uint64_t> unknown;

  void add(const ObjCounts& other) {
    lines += other.lines;
    vertices += other.vertices;
    textures += other.textures;
    normals += other.normals;
    short_points += other.short_points;
    faces += other.faces;
    triangles += other.triangles;
    skipped_faces += other.skipped_faces;
    not_faces += other.not_faces;
    segments += other.segments;
    points += other.points;
    skipped_lines += other.skipped_lines;
    polygons |= other.polygons;
    colours |= other.colours;
    face_textures |= other.face_textures;
    face_normals |= other.face_normals;
    for (const auto& [keyword, count] : other.unknown) unknown[keyword] += count;
  }

  void add_face(std::uint64_t corners) {
    ++faces;
    polygons |= corners != 3;
    if (corners < 3) ++skipped_faces;
    if (corners > 2) triangles += corners - 2;
  }

  /// A vertex of `words` words; 6 means at least six.
  void add_vertex(int words) {
    ++vertices;
    if (colours) return;
    colours = words >= 6;
    if (words < 3) ++short_points;
  }

  /// No vertex has a z: a drawing in the plane z = 0. Where others have one, it is missing.
  [[nodiscard]] bool in_the_plane() const { return vertices > 0 && short_points == vertices; }
};

/// Counts the statements of a piece of the file, and keeps the lines that name segments, if they
/// are requested.
ObjCounts count_statements(std::string_view text, const std::string& file, char line_end,
                           ObjSegmentLines* segments);

}  // namespace fathom::mesh_files
