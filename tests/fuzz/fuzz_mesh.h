#pragma once

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <string_view>

#include "fathom/failures/errors.h"
#include "fathom/mesh/mesh_faces.h"
#include "fathom/mesh_files/read_mesh.h"

namespace fathom::fuzz {

using namespace mesh;
using namespace mesh_files;

/// Ends the program unless the mesh keeps what Mesh promises.
inline void check(const Mesh& mesh) {
  const auto require = [](bool kept) {
    if (!kept) std::abort();
  };
  for (const MeshPoint& p : mesh.vertices)
    require(std::isfinite(p.x) && std::isfinite(p.y) && std::isfinite(p.z));
  for (const CornerIndices& t : mesh.triangles)
    for (const std::uint32_t i : t) require(i < mesh.vertices.size());
  for (const auto& line : mesh.lines)
    for (const std::uint32_t i : line) require(i < mesh.vertices.size());
  for (const std::uint32_t i : mesh.points) require(i < mesh.vertices.size());
  const auto require_indices = [&](const auto& triangles, std::size_t count) {
    require(triangles.empty() || triangles.size() == mesh.triangles.size());
    for (const CornerIndices& t : triangles)
      for (const std::uint32_t i : t) require(i == no_index || i < count);
  };
  require_indices(mesh.texture_triangles, mesh.texture_coordinates.size());
  require_indices(mesh.normal_triangles, mesh.normals.size());
  for (const TriangleSegments& segments : mesh.segments) {
    require(mesh.segments_by(segments.by) == &segments);
    require(segments.numbers.size() == 1 || segments.numbers.size() == mesh.triangles.size());
    const std::size_t end =
        segments.by == Segmentation::label ? unsegmented : segments.names.size();
    for (const std::uint32_t number : segments.numbers)
      require(number == unsegmented || number < end);
  }
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t)
    require(mesh.face_of(static_cast<std::uint32_t>(t)) < mesh.face_count);
}

/// Reads `bytes` with `read(options, warnings)`: a valid mesh or an InputError, nothing else.
template <class Read>
int one_input(const Read& read) {
  for (const bool all : {false, true}) {
    try {
      Warnings warnings;
      check(read(ReadOptions{.format = {},
                             .threads = 1,
                             .attributes = all,
                             .primitives = all,
                             .segments = all,
                             .hash = false},
                 warnings));
    } catch (const InputError&) {
    }
  }
  return 0;
}

inline std::string_view text_of(const std::uint8_t* data, std::size_t size) {
  return {reinterpret_cast<const char*>(data), size};
}

}  // namespace fathom::fuzz
