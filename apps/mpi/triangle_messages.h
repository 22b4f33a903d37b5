#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "fathom/fast/some_tiles.h"
#include "fathom/files/file_bytes.h"
#include "fathom/mesh/mesh.h"

namespace fathom::app {

/// Takes triangles out of a mesh, once or often. The mesh outlives it unchanged.
/// Cost     4 bytes for each vertex, once; then proportional to the triangles taken.
class TrianglePicker {
 public:
  explicit TrianglePicker(const Mesh& mesh) : mesh_(mesh) {}
  /// A mesh of these triangles, in this order, with the vertices that they have; of faces,
  /// attributes and segments nothing.
  [[nodiscard]] Mesh picked(std::span<const std::uint32_t> triangles);

 private:
  const Mesh& mesh_;
  /// For each vertex its place in the mesh that is being made; no_index: none.
  std::vector<std::uint32_t> places_;
};

/// Messages of a rank: each other rank gets the triangles that may touch its tiles, each once, in
/// order. A message is a list of sections, one for each object:
///
///   object, numbers of vertices and triangles
///   vertices    three binary64 numbers each, as in the mesh
///   triangles   three vertices of the section each
///   numbers     of the triangles in the scene
///
/// Numbers have the layout of memory: all ranks run on machines of one kind.
/// `touches`    of tiles of other ranks, in the order of the triangles
/// `owners`     the rank of each tile
std::vector<files::Bytes> messages_of(const std::vector<SomeTriangles>& part,
                                      std::span<const TileTouch> touches,
                                      std::span<const int> owners, int ranks);

/// The triangles that a rank has received, one list for each object, in their order.
/// `messages`   from all ranks, in the order of the triangles that these read. They are used up.
std::vector<SomeTriangles> received_triangles(std::vector<files::Bytes> messages);

}  // namespace fathom::app
