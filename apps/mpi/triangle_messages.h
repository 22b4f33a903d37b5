#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "apps/mpi/shared_scene.h"
#include "fathom/fast/some_tiles.h"
#include "fathom/text/file_bytes.h"

namespace fathom::app {

/// What a rank sends to the others: to each the triangles of its part that may touch tiles of that
/// rank, each once, in their order. A message is a list of sections, one for each object:
///
///   object, numbers of vertices and triangles
///   vertices    three binary64 numbers each, as in the mesh
///   triangles   three vertices of the section each
///   numbers     of the triangles in the object's mesh
///   faces       of the triangles in the mesh's file
///
/// Numbers are as they are in memory: all ranks run on machines of one kind.
/// `owners`     the rank of each tile
std::vector<text::Bytes> messages_of(const ScenePart& part, std::span<const TileTouch> touches,
                                     std::span<const int> owners, int ranks);

/// The triangles that a rank has received.
struct ReceivedScene {
  /// All objects of the whole scene, which have those of their triangles that came.
  Scene scene;
  /// The number of each triangle in the whole scene, in ascending order.
  std::vector<std::uint32_t> numbers;
};

/// `messages`   from all ranks, in the order of the triangles that these read. They are used up.
ReceivedScene received_scene(std::vector<text::Bytes> messages, const SharedScene& whole);

}  // namespace fathom::app
