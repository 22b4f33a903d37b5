#include "fathom/fast/coverage/gathered_triangles.h"

#include <utility>

namespace fathom::fast {

KeptTriangles& GatheredTriangles::part_for(std::uint32_t object, std::size_t vertices) {
  KeptTriangles*& part = part_of_[object];
  if (!part || part->mesh.vertices.size() + vertices > no_index) {
    part = &parts_.emplace_back();
    part->object = object;
  }
  return *part;
}

void GatheredTriangles::reserve(std::uint32_t object, const KeptSize& more) {
  KeptTriangles& part = part_for(object, 0);
  part.mesh.vertices.reserve(part.mesh.vertices.size() + more.vertices);
  part.mesh.triangles.reserve(part.mesh.triangles.size() + more.triangles);
  part.numbers.reserve(part.numbers.size() + more.triangles);
}

void GatheredTriangles::add(const KeptTriangles& kept) {
  KeptTriangles& part = part_for(kept.object, kept.mesh.vertices.size());
  const auto first_vertex = static_cast<std::uint32_t>(part.mesh.vertices.size());
  part.mesh.vertices.append(kept.mesh.vertices.begin(), kept.mesh.vertices.end());
  std::vector<CornerIndices>& triangles = part.mesh.triangles.own();
  for (CornerIndices corners : kept.mesh.triangles) {
    for (std::uint32_t& corner : corners) corner += first_vertex;
    triangles.push_back(corners);
  }
  part.numbers.insert(part.numbers.end(), kept.numbers.begin(), kept.numbers.end());
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
  for (const KeptTriangles& part : parts_) {
    objects_.emplace_back(triangles.objects()[part.object], part.mesh, frame.camera, count, nullptr,
                          part.numbers);
    count = objects_.back().end_number();
  }
  bins_ = sort_into_tiles(objects_, 0, count, parts, frame, workers);
}

}  // namespace fathom::fast
