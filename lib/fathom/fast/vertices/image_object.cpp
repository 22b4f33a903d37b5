#include "fathom/fast/vertices/image_object.h"

#include <algorithm>
#include <iterator>
#include <new>
#include <utility>

#include "fathom/scene/element_checks.h"
#include "fathom/threads/threads.h"

namespace fathom::fast {

namespace {

/// Throws scene::ElementFault if a number is not finite. That is looked at after the work, while
/// the points are in the innermost cache: before it, a twentieth of a map's time would go into
/// waiting for them.
void transform_finite(const VertexTransform& transform, std::span<const MeshPoint> points,
                      ImageVertex* image) {
  constexpr std::size_t part = 512;
  for (std::size_t first = 0; first < points.size(); first += part) {
    const auto some = points.subspan(first, std::min(part, points.size() - first));
    transform(some, image + first);
    if (!scene::all_finite(some)) throw scene::ElementFault();
  }
}

}  // namespace

ImageObject::ImageObject(const Object& object, const Mesh& its_mesh, const Camera& camera,
                         std::uint32_t first_triangle, VertexMemory* where_kept,
                         std::span<const std::uint32_t> numbers)
    : mesh(its_mesh),
      first_number(first_triangle),
      transform(object, camera),
      vertices(where_kept ? where_kept->take(mesh.vertices.size())
                          : std::make_unique_for_overwrite<ImageVertex[]>(mesh.vertices.size())),
      kept(where_kept),
      scene_numbers(numbers.empty() ? nullptr : numbers.data()) {
  constexpr std::size_t part = 4096;
  const std::size_t count = mesh.vertices.size();
  in_parallel((count + part - 1) / part, [&](std::size_t i) {
    const std::size_t first = i * part;
    transform_finite(transform,
                     std::span(mesh.vertices).subspan(first, std::min(part, count - first)),
                     vertices.get() + first);
  });
}

ImageObject::~ImageObject() {
  if (kept) kept->give_back(std::move(vertices), mesh.vertices.size());
}

VertexMemory::Vertices VertexMemory::take(std::size_t count) {
  const auto fits = std::find_if(blocks_.begin(), blocks_.end(),
                                 [&](const Block& block) { return block.count == count; });
  if (fits == blocks_.end()) return std::make_unique_for_overwrite<ImageVertex[]>(count);
  Vertices vertices = std::move(fits->vertices);
  blocks_.erase(fits);
  return vertices;
}

void VertexMemory::give_back(Vertices vertices, std::size_t count) noexcept try {
  blocks_.push_back({std::move(vertices), count});
} catch (const std::bad_alloc&) {
}

const ImageObject& object_of(const ImageObjects& objects, std::uint32_t number) {
  const auto next = std::upper_bound(
      objects.begin(), objects.end(), number,
      [](std::uint32_t n, const ImageObject& object) { return n < object.first_number; });
  return *std::prev(next);
}

}  // namespace fathom::fast
