#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <string_view>

#include "fathom/mesh_files/obj/obj_segments.h"

/// The first pass over an OBJ, which counts its statements. Only for .cpp files of this module.
namespace fathom::mesh_files {

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
