#pragma once

#include <cstdint>
#include <deque>
#include <span>
#include <vector>

#include "fathom/fast/bins.h"
#include "fathom/mesh/picked_triangles.h"
#include "fathom/scene/triangle_source.h"

namespace fathom::fast {

/// Some triangles of an object of the scene, taken out of where they were sorted into tiles.
struct KeptTriangles {
  /// Which object of the scene.
  std::uint32_t object = 0;
  Mesh mesh;
  /// What the scene calls them.
  std::vector<std::uint32_t> numbers;
};

/// Of triangles that are kept.
struct KeptSize {
  std::uint64_t vertices = 0, triangles = 0;

  [[nodiscard]] bool is_nothing() const { return triangles == 0; }
  /// About what they take in bytes while they are sorted into tiles again: their corners, these in
  /// the image, and the places of triangles in tiles.
  [[nodiscard]] std::uint64_t bytes_in_use() const {
    constexpr std::uint64_t per_place = 24;
    return vertices * (sizeof(MeshPoint) + sizeof(ImageVertex)) +
           triangles * (sizeof(CornerIndices) + sizeof(std::uint32_t) + per_place);
  }
  KeptSize& operator+=(const KeptSize& more) {
    vertices += more.vertices;
    triangles += more.triangles;
    return *this;
  }
};
KeptSize size_of(const KeptTriangles& kept);

/// Takes triangles by their tiles out of the objects that were sorted. These outlive it.
class PickerByTiles {
 public:
  PickerByTiles(const ImageObjects& objects, const std::vector<Bins>& bins,
                const TriangleSource& triangles);
  /// Those that bins have in any of the tiles, each once, object by object.
  std::vector<KeptTriangles> in_tiles(std::span<const std::uint32_t> tiles);

 private:
  void find_numbers(std::span<const std::uint32_t> tiles);
  [[nodiscard]] KeptTriangles picked(std::size_t object, std::span<std::uint32_t> numbers);

  const ImageObjects& objects_;
  const std::vector<Bins>& bins_;
  const TriangleSource& triangles_;
  /// One for each of the objects.
  std::deque<mesh::TrianglePicker> pickers_;
  /// What bins call those that were asked for last, in their order.
  std::vector<std::uint32_t> numbers_;
};

}  // namespace fathom::fast
