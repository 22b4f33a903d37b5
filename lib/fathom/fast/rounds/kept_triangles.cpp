#include "fathom/fast/rounds/kept_triangles.h"

#include <algorithm>

#include "fathom/fast/rounds/distinct_vertices.h"

namespace fathom::fast {

KeptSize size_of(const KeptTriangles& kept) {
  return {kept.mesh.vertices.size(), kept.mesh.triangles.size()};
}

namespace {

/// What bins call the triangles, in ascending order: one after another, bins have greater numbers.
std::vector<std::uint32_t> numbers_in_tiles(std::span<const Bins> all_bins,
                                            std::span<const std::uint32_t> tiles) {
  std::vector<std::uint32_t> numbers;
  for (const Bins& bins : all_bins) {
    const auto first = static_cast<std::ptrdiff_t>(numbers.size());
    for (const std::uint32_t tile : tiles) {
      for (const Side side : {Side::front, Side::back}) {
        for (const TileEntry& entry : bins.in_tile(tile, side)) numbers.push_back(entry.number);
      }
    }
    std::sort(numbers.begin() + first, numbers.end());
    numbers.erase(std::unique(numbers.begin() + first, numbers.end()), numbers.end());
  }
  return numbers;
}

KeptTriangles triangles_of(const ImageObject& object, std::span<const std::uint32_t> numbers,
                           const TriangleSource& triangles) {
  KeptTriangles kept;
  kept.object = triangles.origin(object.number_in_scene(numbers.front())).object;
  kept.numbers.reserve(numbers.size());
  kept.mesh.triangles.reserve(numbers.size());
  DistinctVertices vertices;
  for (const std::uint32_t number : numbers) {
    kept.numbers.push_back(object.number_in_scene(number));
    CornerIndices corners = object.mesh.triangles[number - object.first_number];
    for (std::uint32_t& corner : corners) {
      corner = vertices.number_of(object.mesh.vertices[corner]);
    }
    kept.mesh.triangles.push_back(corners);
  }
  kept.mesh.vertices = vertices.take();
  return kept;
}

}  // namespace

std::vector<KeptTriangles> triangles_in_tiles(const ImageObjects& objects,
                                              std::span<const Bins> bins,
                                              std::span<const std::uint32_t> tiles,
                                              const TriangleSource& triangles) {
  const std::vector<std::uint32_t> numbers = numbers_in_tiles(bins, tiles);
  std::vector<KeptTriangles> kept;
  for (auto next = numbers.begin(); next != numbers.end();) {
    const ImageObject& object = object_of(objects, *next);
    const auto end = std::lower_bound(next, numbers.end(), object.end_number());
    kept.push_back(triangles_of(object, {next, end}, triangles));
    next = end;
  }
  return kept;
}

}  // namespace fathom::fast
