#include "fathom/scene/triangle_source.h"

#include <algorithm>
#include <cmath>
#include <future>
#include <stdexcept>
#include <string>

#include "fathom/failures/errors.h"
#include "fathom/scene/element_checks.h"
#include "fathom/threads/meanwhile.h"

namespace fathom {

TriangleSource::TriangleSource(const Scene& scene) : scene_(&scene) {
  scene::require(scene::find_fault_of_objects(scene));
  for (const Object& object : scene.objects) {
    first_numbers_.push_back(count() + scene.meshes[object.mesh].triangles.size());
  }
}

TriangleSource::TriangleSource(const StreamedScene& scene) : streamed_(&scene) {
  scene::require(scene::find_fault_of_objects(scene));
  for (const Object& object : scene.objects) {
    first_numbers_.push_back(count() + scene.streams[object.mesh]->triangle_count());
  }
}

namespace {

std::uint32_t face_of(const Mesh& mesh, std::uint32_t triangle) {
  if (!mesh.face_of_triangle.empty() && mesh.face_of_triangle.size() != mesh.triangles.size()) {
    throw InputError("scene: face_of_triangle has not one element for each triangle");
  }
  return mesh.face_of(triangle);
}

/// A corner as an index into the vertices, which the scene's maker may have got wrong.
const MeshPoint& corner_of(const Mesh& mesh, std::uint32_t vertex) {
  if (vertex >= mesh.vertices.size()) {
    throw InputError("scene: there is no vertex " + std::to_string(vertex) + " among " +
                     std::to_string(mesh.vertices.size()));
  }
  const MeshPoint& point = mesh.vertices[vertex];
  if (!std::isfinite(point.x) || !std::isfinite(point.y) || !std::isfinite(point.z)) {
    throw InputError("scene: vertex " + std::to_string(vertex) +
                     " has a number that is not finite");
  }
  return point;
}

}  // namespace

TriangleSource::Place TriangleSource::place_of(std::uint32_t number) const {
  if (number >= count()) throw std::out_of_range("there is no triangle " + std::to_string(number));
  const auto after = std::upper_bound(first_numbers_.begin(), first_numbers_.end(), number);
  // An object without triangles shares its first number with the next: the last of them has it.
  const auto object = static_cast<std::size_t>(after - first_numbers_.begin()) - 1;
  return {static_cast<std::uint32_t>(object),
          static_cast<std::uint32_t>(number - first_numbers_[object])};
}

TriangleOrigin TriangleSource::origin(std::uint32_t number) const {
  const Place place = place_of(number);
  const Object& object = objects()[place.object];
  const std::uint32_t face = scene_ ? face_of(scene_->meshes[object.mesh], place.triangle)
                                    : stream(place.object).face_of(place.triangle);
  return {place.object, place.triangle, static_cast<std::uint32_t>(object.first_face + face)};
}

TriangleSource::Triangle TriangleSource::triangle(std::uint32_t number) const {
  const Place place = place_of(number);
  const Object& object = objects()[place.object];
  Triangle result{{place.object, place.triangle, 0}, {}};
  if (scene_) {
    const Mesh& mesh = scene_->meshes[object.mesh];
    for (std::size_t i = 0; i < 3; ++i) {
      result.corners[i] = corner_of(mesh, mesh.triangles[place.triangle][i]);
    }
    result.origin.face =
        static_cast<std::uint32_t>(object.first_face + face_of(mesh, place.triangle));
  } else {
    const TriangleStream::Triangle read = stream(place.object).triangle(place.triangle);
    result.corners = read.corners;
    result.origin.face = static_cast<std::uint32_t>(object.first_face + read.face);
  }
  return result;
}

std::uint32_t TriangleSource::label(const TriangleOrigin& origin) const {
  return streamed_ ? stream(origin.object).label_of(origin.triangle) : unsegmented;
}

std::array<WorldPoint, 3> TriangleSource::world_corners(std::uint32_t number) const {
  const Triangle mesh_triangle = triangle(number);
  const Object& object = objects()[mesh_triangle.origin.object];
  std::array<WorldPoint, 3> world;
  for (std::size_t i = 0; i < 3; ++i) world[i] = to_world(object, mesh_triangle.corners[i]);
  return world;
}

namespace {

/// Calls visit(chunk) for the chunks of a file that are wanted, reading the next one meanwhile, or
/// then, where the system gives no thread for it.
template <class Wanted, class Visit>
void for_each_chunk(const TriangleStream& stream, std::uint32_t triangles, const Wanted& wanted,
                    const Visit& visit) {
  const std::uint64_t end = stream.triangle_count();
  /// Begins to read the first requested chunk from `first` on; the result is not valid if there is
  /// no such chunk.
  const auto read = [&](std::uint64_t first) -> std::future<TriangleChunk> {
    while (first < end && !wanted(static_cast<std::uint32_t>(first))) first += triangles;
    if (first >= end) return {};
    return meanwhile([&stream, first, triangles] {
      return stream.read(static_cast<std::uint32_t>(first), triangles);
    });
  };
  std::future<TriangleChunk> next = read(0);
  while (next.valid()) {
    const TriangleChunk chunk = next.get();
    next = read(std::uint64_t{chunk.first} + triangles);
    visit(chunk);
  }
}

}  // namespace

void TriangleSource::for_each_part(std::uint32_t triangles_of_file,
                                   const std::function<void(const Part&)>& visit,
                                   const std::function<bool(std::uint32_t)>& wanted) const {
  for (std::uint32_t i = 0; i < objects().size(); ++i) {
    const Object& object = objects()[i];
    const auto first = static_cast<std::uint32_t>(first_numbers_[i]);
    if (streamed_) {
      for_each_chunk(
          stream(i), triangles_of_file,
          [&](std::uint32_t number) { return wanted(first + number); },
          [&](const TriangleChunk& chunk) {
            visit({object, chunk.mesh, first + chunk.first});
          });
    } else if (wanted(first)) {
      visit({object, scene_->meshes[object.mesh], first});
    }
  }
}

}  // namespace fathom
