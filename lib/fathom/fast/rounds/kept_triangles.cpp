#include "fathom/fast/rounds/kept_triangles.h"

#include <algorithm>
#include <array>
#include <bit>
#include <map>
#include <utility>

namespace fathom::fast {
namespace {

using PointBits = std::array<std::uint64_t, 3>;

PointBits bits_of(const MeshPoint& point) {
  return {std::bit_cast<std::uint64_t>(point.x), std::bit_cast<std::uint64_t>(point.y),
          std::bit_cast<std::uint64_t>(point.z)};
}

/// Short numbers differ only in their upper bits, which are mixed into the lower bits too.
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

KeptSize size_of(const KeptTriangles& kept) {
  return {kept.mesh.vertices.size(), kept.mesh.triangles.size()};
}

namespace {

/// The numbers of the triangles in the bins, in ascending order: consecutive bins have ascending
/// numbers.
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

GatheredTriangles::Part& GatheredTriangles::part_for(std::uint32_t object, std::size_t vertices) {
  Part*& part = part_of_[object];
  if (!part || part->vertices.size() + vertices > no_index) {
    part = &parts_.emplace_back();
    part->triangles.object = object;
  }
  return *part;
}

void GatheredTriangles::reserve(std::uint32_t object, const KeptSize& more) {
  auto& [kept, vertices] = part_for(object, 0);
  vertices.reserve(vertices.size() + more.vertices);
  kept.mesh.triangles.reserve(kept.mesh.triangles.size() + more.triangles);
  kept.numbers.reserve(kept.numbers.size() + more.triangles);
}

void GatheredTriangles::add(const KeptTriangles& more) {
  auto& [kept, vertices] = part_for(more.object, more.mesh.vertices.size());
  std::vector<std::uint32_t> numbers;
  numbers.reserve(more.mesh.vertices.size());
  for (const MeshPoint& point : more.mesh.vertices) numbers.push_back(vertices.number_of(point));
  std::vector<CornerIndices>& triangles = kept.mesh.triangles.own();
  for (const auto& [a, b, c] : more.mesh.triangles) {
    triangles.push_back({numbers[a], numbers[b], numbers[c]});
  }
  kept.numbers.insert(kept.numbers.end(), more.numbers.begin(), more.numbers.end());
}

void GatheredTriangles::take(std::vector<KeptTriangles>& kept) {
  std::map<std::uint32_t, KeptSize> sizes;
  for (const KeptTriangles& some : kept) sizes[some.object] += size_of(some);
  for (const auto& [object, size] : sizes) reserve(object, size);
  for (KeptTriangles& some : kept) add(std::exchange(some, {}));
  kept.clear();
}

void GatheredTriangles::sort(std::uint32_t parts, const TriangleSource& triangles,
                             const FastFrame& frame, FastWorkers& workers) {
  std::uint32_t count = 0;
  for (auto& [kept, vertices] : parts_) {
    kept.mesh.vertices = vertices.take();
    objects_.emplace_back(triangles.objects()[kept.object], kept.mesh, frame.camera, count, nullptr,
                          kept.numbers);
    count = objects_.back().end_number();
  }
  bins_ = sort_into_tiles(objects_, 0, count, parts, frame, workers);
}

namespace {

/// The elements of a mesh array or of a vector as bytes.
template <class Array>
files::ByteView bytes_of(const Array& array) {
  return std::as_bytes(std::span(array.data(), array.size()));
}

/// Fills an array from a file; returns where it ends there.
template <class T>
std::uint64_t read_array(const files::SpillFile& file, std::uint64_t offset, std::vector<T>& array,
                         std::size_t count) {
  array.resize(count);
  file.read(offset, std::as_writable_bytes(std::span(array)));
  return offset + count * sizeof(T);
}

}  // namespace

void SpilledTriangles::add(std::size_t bucket, std::span<const KeptTriangles> kept) {
  for (const KeptTriangles& some : kept) {
    files::Bytes bytes;
    bytes.reserve(bytes_of(some.mesh.vertices).size() + bytes_of(some.mesh.triangles).size() +
                  bytes_of(some.numbers).size());
    files::append(bytes, bytes_of(some.mesh.vertices));
    files::append(bytes, bytes_of(some.mesh.triangles));
    files::append(bytes, bytes_of(some.numbers));
    buckets_[bucket].push_back({file_.append(bytes), some.object,
                                static_cast<std::uint32_t>(some.mesh.vertices.size()),
                                static_cast<std::uint32_t>(some.mesh.triangles.size())});
  }
}

KeptTriangles SpilledTriangles::read(const Block& block) const {
  KeptTriangles kept;
  kept.object = block.object;
  std::uint64_t next = block.offset;
  next = read_array(file_, next, kept.mesh.vertices.own(), block.vertices);
  next = read_array(file_, next, kept.mesh.triangles.own(), block.triangles);
  read_array(file_, next, kept.numbers, block.triangles);
  return kept;
}

KeptSize SpilledTriangles::size_of_bucket(std::size_t bucket) const {
  KeptSize size;
  for (const Block& block : buckets_[bucket]) size += {block.vertices, block.triangles};
  return size;
}

void SpilledTriangles::gather(std::size_t bucket, GatheredTriangles& to) const {
  std::map<std::uint32_t, KeptSize> sizes;
  for (const Block& block : buckets_[bucket]) {
    sizes[block.object] += {block.vertices, block.triangles};
  }
  for (const auto& [object, size] : sizes) to.reserve(object, size);
  for_each(bucket, [&](const KeptTriangles& kept) { to.add(kept); });
}

}  // namespace fathom::fast
