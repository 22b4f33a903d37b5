#include "fathom/fast/coverage/kept_triangles.h"

#include <algorithm>

namespace fathom::fast {

KeptSize size_of(const KeptTriangles& kept) {
  return {kept.mesh.vertices.size(), kept.mesh.triangles.size()};
}

PickerByTiles::PickerByTiles(const ImageObjects& objects, const std::vector<Bins>& bins,
                             const TriangleSource& triangles)
    : objects_(objects), bins_(bins), triangles_(triangles) {
  for (const ImageObject& object : objects) pickers_.emplace_back(object.mesh);
}

std::vector<KeptTriangles> PickerByTiles::in_tiles(std::span<const std::uint32_t> tiles) {
  find_numbers(tiles);
  std::vector<KeptTriangles> kept;
  auto next = numbers_.begin();
  for (std::size_t i = 0; i < objects_.size() && next != numbers_.end(); ++i) {
    const auto end = std::lower_bound(next, numbers_.end(), objects_[i].end_number());
    if (next != end) kept.push_back(picked(i, {next, end}));
    next = end;
  }
  return kept;
}

// One after another, bins have triangles of ascending numbers.
void PickerByTiles::find_numbers(std::span<const std::uint32_t> tiles) {
  numbers_.clear();
  for (const Bins& bins : bins_) {
    const auto begin = static_cast<std::ptrdiff_t>(numbers_.size());
    for (const std::uint32_t tile : tiles) {
      for (const Side side : {Side::front, Side::back}) {
        for (const TileEntry& entry : bins.in_tile(tile, side)) numbers_.push_back(entry.number);
      }
    }
    std::sort(numbers_.begin() + begin, numbers_.end());
    numbers_.erase(std::unique(numbers_.begin() + begin, numbers_.end()), numbers_.end());
  }
}

KeptTriangles PickerByTiles::picked(std::size_t object, std::span<std::uint32_t> numbers) {
  const ImageObject& from = objects_[object];
  KeptTriangles kept;
  kept.numbers.reserve(numbers.size());
  for (std::uint32_t& number : numbers) {
    kept.numbers.push_back(from.number_in_scene(number));
    number -= from.first_number;
  }
  kept.object = triangles_.origin(kept.numbers.front()).object;
  kept.mesh = pickers_[object].picked(numbers);
  kept.mesh.face_of_triangle = {};
  return kept;
}

}  // namespace fathom::fast
