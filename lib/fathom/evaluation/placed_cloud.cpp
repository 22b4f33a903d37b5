#include "fathom/evaluation/placed_cloud.h"

#include <algorithm>
#include <utility>

#include "fathom/evaluation/box_tree.h"
#include "fathom/failures/errors.h"
#include "fathom/mesh/element_counts.h"
#include "fathom/text/counted.h"
#include "fathom/threads/threads.h"

namespace fathom::evaluation {

PlacedCloud::PlacedCloud(const Scene& scene, long power) : scene_(scene), power_(power) {
  const std::uint64_t count = point_count(scene);
  if (count > mesh::most_elements)
    throw InputError(text::counted(count, "point") + " are more than " +
                     std::to_string(mesh::most_elements));
  points_.resize(count);
  for (const Object& object : scene.objects) {
    const auto& vertices = scene.meshes[object.mesh].vertices;
    const std::uint64_t first = first_numbers_.back();
    first_numbers_.push_back(first + vertices.size());
    parallel_for(std::size_t{0}, vertices.size(),
                 [&](std::size_t i) { points_[first + i] = in_unit(object, vertices[i], power); });
  }
}

WorldPoint PlacedCloud::world(std::uint32_t number) const {
  const auto [object, vertex] = place_of(number);
  const Object& placed = scene_.objects[object];
  return to_world(placed, scene_.meshes[placed.mesh].vertices[vertex]);
}

bool PlacedCloud::are_same(std::uint32_t a, std::uint32_t b) const {
  if (points_[a] != points_[b]) return false;
  const WorldPoint p = world(a), q = world(b);
  return p.x == q.x && p.y == q.y && p.z == q.z;
}

void PlacedCloud::keep(std::vector<std::uint32_t> numbers) {
  for (std::size_t i = 0; i < numbers.size(); ++i) points_[i] = points_[numbers[i]];
  points_.resize(numbers.size());
  points_.shrink_to_fit();
  kept_ = std::move(numbers);
}

PlacedCloud::Place PlacedCloud::place_of(std::uint32_t number) const {
  const std::uint64_t whole = kept_.empty() ? number : kept_[number];
  const auto next = std::upper_bound(first_numbers_.begin(), first_numbers_.end(), whole);
  const auto object = static_cast<std::size_t>(next - first_numbers_.begin()) - 1;
  return {object, static_cast<std::size_t>(whole - first_numbers_[object])};
}

std::uint64_t point_count(const Scene& scene) {
  std::uint64_t count = 0;
  for (const Object& object : scene.objects) {
    if (object.mesh >= scene.meshes.size()) throw InputError("scene: an object names no mesh");
    count += scene.meshes[object.mesh].vertices.size();
  }
  return count;
}

}  // namespace fathom::evaluation
