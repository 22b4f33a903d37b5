#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "fathom/fast/bins/bins.h"
#include "fathom/scene/triangle_source.h"

namespace fathom::fast {

/// Some triangles of an object of the scene, taken out of where they were sorted into tiles.
struct KeptTriangles {
  /// Which object of the scene.
  std::uint32_t object = 0;
  /// No two vertices are the same point.
  Mesh mesh;
  /// What the scene calls them.
  std::vector<std::uint32_t> numbers;
};

/// Of triangles that are kept.
struct KeptSize {
  std::uint64_t vertices = 0, triangles = 0;

  [[nodiscard]] bool is_nothing() const { return triangles == 0; }
  /// About what they take in bytes while they are put together and sorted into tiles again: their
  /// corners, where these are found, these in the image, and the places of triangles in tiles.
  [[nodiscard]] std::uint64_t bytes_in_use() const {
    constexpr std::uint64_t to_find = 16, per_place = 24;
    return vertices * (sizeof(MeshPoint) + to_find + sizeof(ImageVertex)) +
           triangles * (sizeof(CornerIndices) + sizeof(std::uint32_t) + per_place);
  }
  KeptSize& operator+=(const KeptSize& more) {
    vertices += more.vertices;
    triangles += more.triangles;
    return *this;
  }
};
KeptSize size_of(const KeptTriangles& kept);

/// The triangles that bins have in any of the tiles, each once, object by object; `objects` are
/// those that were sorted into these bins.
std::vector<KeptTriangles> triangles_in_tiles(const ImageObjects& objects,
                                              std::span<const Bins> bins,
                                              std::span<const std::uint32_t> tiles,
                                              const TriangleSource& triangles);

}  // namespace fathom::fast
