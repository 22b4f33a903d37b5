#pragma once

#include <cstdint>
#include <vector>

#include "fathom/scene/scene.h"

namespace fathom::fast {

/// Vertices of a mesh that is put together, of which no two are the same point, bit for bit. Files
/// that have three vertices for each triangle become meshes of a sixth as many, and edges between
/// triangles are seen to be that by the numbers of their ends.
class DistinctVertices {
 public:
  void reserve(std::size_t count);
  [[nodiscard]] std::size_t size() const { return vertices_.size(); }
  /// Adds a point unless it is there; its number.
  std::uint32_t number_of(const MeshPoint& point);
  /// All of them, by their numbers; none is left here.
  std::vector<MeshPoint> take();

 private:
  void grow_slots(std::size_t vertices);
  /// The slot of a point, or where it would be.
  [[nodiscard]] std::size_t slot_of(const MeshPoint& point) const;

  std::vector<MeshPoint> vertices_;
  /// Numbers, at least half of them none; a power of two.
  std::vector<std::uint32_t> slots_;
};

}  // namespace fathom::fast
