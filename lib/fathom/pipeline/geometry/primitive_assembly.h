#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "fathom/pipeline/options.h"
#include "fathom/scene/scene.h"

/// First stage: joins the vertices of the mesh to primitives.
namespace fathom::pipeline {

/// A corner of a triangle in the frame of its mesh.
struct InputVertex {
  MeshPoint position;
  std::array<double, 3> normal{0, 0, 0};
  std::array<double, 2> uv{0, 0};
  std::array<double, 3> colour{1, 1, 1};
};

struct InputTriangle {
  std::uint32_t number = 0;  ///< in the scene
  std::uint32_t object = 0;
  std::array<InputVertex, 3> corners;
};

/// A line of a file, or a point, whose two ends are the same.
struct InputLine {
  std::uint32_t number = 0;  ///< in the scene, counted on after all triangles
  std::uint32_t object = 0;
  std::array<InputVertex, 2> ends;
};

/// Joins indices to primitives: points by ones, lines by twos, triangles by threes; leftover
/// indices at the end are dropped, as graphics interfaces do.
template <std::size_t corners>
std::vector<std::array<std::uint32_t, corners>> assemble(
    const std::vector<std::uint32_t>& indices) {
  std::vector<std::array<std::uint32_t, corners>> primitives(indices.size() / corners);
  for (std::size_t i = 0; i < primitives.size(); ++i)
    for (std::size_t k = 0; k < corners; ++k) primitives[i][k] = indices[i * corners + k];
  return primitives;
}

/// The triangles of an object. Normals that do not come from the mesh are the sums of the area
/// vectors of the triangles at a vertex or a place, scaled to unit length, on the front side.
std::vector<InputTriangle> assemble_triangles(const Scene& scene, std::uint32_t object,
                                              std::uint32_t first_number, FrontFace front_face,
                                              NormalSource normals = NormalSource::file);

/// The lines of an object, and its points, numbered in this order. They have no normals and no
/// texture coordinates.
std::vector<InputLine> assemble_lines(const Scene& scene, std::uint32_t object,
                                      std::uint32_t first_number);
std::vector<InputLine> assemble_points(const Scene& scene, std::uint32_t object,
                                       std::uint32_t first_number);
/// Whether the scene has a line or a point.
bool has_lines_or_points(const Scene& scene);

/// Whether every corner of every object has texture coordinates.
bool has_texture_coordinates(const Scene& scene);

}  // namespace fathom::pipeline
