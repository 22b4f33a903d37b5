#include "fathom/fast/rounds/gathered_triangles.h"

#include <utility>

namespace fathom::fast {

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

}  // namespace fathom::fast
