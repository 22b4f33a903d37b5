#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "fathom/geometry/frames.h"
#include "fathom/mesh/mesh_array.h"
#include "fathom/mesh/segmentation.h"

namespace fathom {

/// "No texture coordinate (or normal) at this corner."
inline constexpr std::uint32_t no_index = 0xFFFFFFFF;

using CornerIndices = std::array<std::uint32_t, 3>;

/// A list of triangles numbered from 0 in file order, degenerate ones included (specification,
/// section 3). Readers check that every coordinate is finite and every index in range, so engines
/// need not. Not in it: a transform (see Object), topology, what materials look like.
struct Mesh {
  /// One point per vertex, in the file's own frame and unit.
  MeshArray<MeshPoint> vertices;
  /// Three indices into `vertices` per triangle; at most 2³² − 2 triangles.
  MeshArray<CornerIndices> triangles;
  /// For each triangle the number of the face of its file that it comes from, counted from 0 over
  /// all faces, including skipped ones. Empty if triangle t is face t.
  std::vector<std::uint32_t> face_of_triangle;
  /// The number of faces in the file, including skipped ones.
  std::uint64_t face_count = 0;

  /// Lines and points of the file, as indices into `vertices`, if requested
  /// (ReadOptions::primitives). They have no area: only the pipeline draws them.
  std::vector<std::array<std::uint32_t, 2>> lines;
  std::vector<std::uint32_t> points;

  /// Optional attributes as in the file; empty if the file has none.
  std::vector<std::array<double, 2>> texture_coordinates;
  std::vector<std::array<double, 3>> normals;
  /// Linear or not, as in the file; components in [0, 1].
  std::vector<std::array<float, 4>> colours;
  /// For each triangle, indices of its corners into the lists above (no_index if a corner has
  /// none). Empty if an attribute is given per vertex, so that the indices of `triangles` apply.
  MeshArray<CornerIndices> texture_triangles;
  MeshArray<CornerIndices> normal_triangles;

  /// At most one for each Segmentation, if the file has them and they were requested
  /// (ReadOptions::segments).
  std::vector<TriangleSegments> segments;

  /// Whether there is nothing to draw.
  [[nodiscard]] bool is_empty() const {
    return triangles.empty() && lines.empty() && points.empty();
  }
  [[nodiscard]] std::uint32_t face_of(std::uint32_t triangle) const {
    return face_of_triangle.empty() ? triangle : face_of_triangle[triangle];
  }
  /// nullptr if the mesh has no such segments.
  [[nodiscard]] const TriangleSegments* segments_by(Segmentation by) const {
    for (const TriangleSegments& each : segments)
      if (each.by == by) return &each;
    return nullptr;
  }
};

}  // namespace fathom
