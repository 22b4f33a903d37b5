#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "fathom/mesh/mesh.h"

namespace fathom::app {

/// Takes triangles out of a mesh, once or often. The mesh outlives it unchanged.
/// Cost     of the first time, 4 bytes for each vertex; else that of what is taken.
class TrianglePicker {
 public:
  explicit TrianglePicker(const Mesh& mesh) : mesh_(mesh) {}
  /// A mesh of these triangles, in this order, with the vertices that they have; of faces, attributes
  /// and segments nothing.
  [[nodiscard]] Mesh picked(std::span<const std::uint32_t> triangles);

 private:
  const Mesh& mesh_;
  /// For each vertex its place in the mesh that is being made; no_index: none.
  std::vector<std::uint32_t> places_;
};

}  // namespace fathom::app
