#include "fathom/fast/rounds/distinct_vertices.h"

#include <array>
#include <bit>
#include <utility>

namespace fathom::fast {
namespace {

using PointBits = std::array<std::uint64_t, 3>;

PointBits bits_of(const MeshPoint& point) {
  return {std::bit_cast<std::uint64_t>(point.x), std::bit_cast<std::uint64_t>(point.y),
          std::bit_cast<std::uint64_t>(point.z)};
}

/// Short numbers differ in their upper bits alone: these reach the lower ones, too.
std::uint64_t hash_of(const MeshPoint& point) {
  std::uint64_t hash = 0;
  for (const std::uint64_t bits : bits_of(point)) {
    hash = (hash ^ bits) * 0x9E3779B97F4A7C15;
    hash ^= hash >> 29;
  }
  hash *= 0xBF58476D1CE4E5B9;
  return hash ^ hash >> 32;
}

}  // namespace

void DistinctVertices::reserve(std::size_t count) {
  vertices_.reserve(count);
  grow_slots(count);
}

void DistinctVertices::grow_slots(std::size_t vertices) {
  const std::size_t needed = std::bit_ceil(2 * vertices + 16);
  if (needed <= slots_.size()) return;
  slots_.assign(needed, no_index);
  for (std::uint32_t number = 0; number < vertices_.size(); ++number) {
    slots_[slot_of(vertices_[number])] = number;
  }
}

std::size_t DistinctVertices::slot_of(const MeshPoint& point) const {
  const std::size_t mask = slots_.size() - 1;
  for (std::size_t i = hash_of(point) & mask;; i = (i + 1) & mask) {
    if (slots_[i] == no_index || bits_of(vertices_[slots_[i]]) == bits_of(point)) return i;
  }
}

std::uint32_t DistinctVertices::number_of(const MeshPoint& point) {
  grow_slots(vertices_.size() + 1);
  std::uint32_t& number = slots_[slot_of(point)];
  if (number == no_index) {
    number = static_cast<std::uint32_t>(vertices_.size());
    vertices_.push_back(point);
  }
  return number;
}

std::vector<MeshPoint> DistinctVertices::take() {
  slots_ = std::vector<std::uint32_t>();  // {} would keep its memory
  return std::exchange(vertices_, {});
}

}  // namespace fathom::fast
