#include "fathom/scene/scene_fault.h"

#include <algorithm>
#include <atomic>
#include <bit>
#include <cstring>
#include <limits>
#include <map>
#include <span>

#include "fathom/mesh/mesh_faces.h"
#include "fathom/numeric/errors.h"
#include "fathom/numeric/standard_arithmetic.h"
#include "fathom/scene/object_fault.h"
#include "fathom/threads/threads.h"

// How to read this file: every list is looked at in parts, by several threads, in a way that
// compilers turn into vector instructions and that only says whether something is wrong. Where it
// is, the list is searched again, slowly, for the first thing to name.
namespace fathom {
using namespace scene;

namespace {

using Fault = std::optional<std::string>;

std::string count_of(std::uint64_t count, const char* what) {
  return std::to_string(count) + " " + what;
}

/// Whether `is_bad` says so of a part of a list.
template <class T, class IsBad>
bool any_part(const std::vector<T>& list, const IsBad& is_bad) {
  constexpr std::size_t part = 1U << 14;
  const std::span<const T> all(list);
  const std::size_t parts = (all.size() + part - 1) / part;
  if (parts <= 1) return is_bad(all);
  std::atomic<bool> found = false;
  in_parallel(parts, [&](std::size_t i) {
    const std::size_t first = i * part;
    if (is_bad(all.subspan(first, std::min(part, all.size() - first)))) found = true;
  });
  return found;
}

/// The elements as numbers, a block at a time: visit(numbers, count).
template <class Number, class T, class Visit>
void for_each_block(std::span<const T> elements, const Visit& visit) {
  static_assert(sizeof(T) % sizeof(Number) == 0 && std::is_trivially_copyable_v<T>);
  constexpr std::size_t block = 64, numbers_each = sizeof(T) / sizeof(Number);
  std::array<Number, block * numbers_each> numbers;
  for (std::size_t first = 0; first < elements.size(); first += block) {
    const std::size_t count = std::min(block, elements.size() - first);
    std::memcpy(numbers.data(), &elements[first], count * sizeof(T));
    visit(numbers, count * numbers_each);
  }
}

/// Whether a number is infinite or NaN: its exponent is the greatest, and adding 1 to it carries
/// into the sign's place.
template <class Real, class T>
bool has_number_that_is_not_finite(std::span<const T> elements) {
  using Bits = std::conditional_t<sizeof(Real) == 8, std::uint64_t, std::uint32_t>;
  constexpr int fraction = std::numeric_limits<Real>::digits - 1;
  constexpr Bits sign = Bits{1} << (8 * sizeof(Real) - 1), one = Bits{1} << fraction;
  Bits carries = 0;
  for_each_block<Bits>(elements, [&](const auto& bits, std::size_t count) {
    for (std::size_t i = 0; i < count; ++i) carries |= (bits[i] & ~sign) + one;
  });
  return (carries & sign) != 0;
}

/// Whether an index is not below `end`, `none` aside where it is allowed.
bool has_index_beyond(std::span<const CornerIndices> triangles, std::uint64_t end, bool none) {
  if (end > no_index) end = no_index;
  std::uint32_t greatest = 0;
  for_each_block<std::uint32_t>(triangles, [&](const auto& indices, std::size_t count) {
    for (std::size_t i = 0; i < count; ++i) {
      const std::uint32_t index = none && indices[i] == no_index ? 0 : indices[i];
      greatest = std::max(greatest, index);
    }
  });
  // An index that is 0 for want of another is none at all where nothing is indexed.
  if (end == 0 && none) {
    return std::any_of(triangles.begin(), triangles.end(), [](const CornerIndices& t) {
      return std::any_of(t.begin(), t.end(), [](std::uint32_t i) { return i != no_index; });
    });
  }
  return !triangles.empty() && greatest >= end;
}

/// The number of the first element of which `is_bad` holds; there is one.
template <class T, class IsBad>
std::uint64_t first_bad(const std::vector<T>& list, const IsBad& is_bad) {
  const auto bad = std::find_if(list.begin(), list.end(),
                                [&](const T& element) { return is_bad(std::span(&element, 1)); });
  return static_cast<std::uint64_t>(bad - list.begin());
}

/// Names the first element of a list of which `is_bad` says so.
template <class T, class IsBad>
Fault find_bad(const std::vector<T>& list, const char* element, const std::string& what,
               const IsBad& is_bad) {
  if (!any_part(list, is_bad)) return std::nullopt;
  return std::string(element) + " " + std::to_string(first_bad(list, is_bad)) + what;
}

template <class Real, class T>
Fault find_not_finite(const std::vector<T>& list, const char* element) {
  return find_bad(list, element, " has a number that is not finite",
                  has_number_that_is_not_finite<Real, T>);
}

Fault find_index_beyond(const std::vector<CornerIndices>& triangles, std::uint64_t end, bool none,
                        const char* element, const char* of) {
  return find_bad(
      triangles, element, ": a corner is beyond the " + count_of(end, of),
      [&](std::span<const CornerIndices> part) { return has_index_beyond(part, end, none); });
}

/// A list that is empty or has one element for each of `count`.
Fault find_wrong_size(std::size_t size, std::uint64_t count, const char* name, const char* each) {
  if (size == 0 || size == count) return std::nullopt;
  return std::string(name) + " has " + count_of(size, "elements") + ", expected one for each of " +
         count_of(count, each);
}

/// An attribute, which is for each vertex, or for the corners of its own triangles.
Fault find_fault_of_attribute(const Mesh& mesh, std::size_t size,
                              const std::vector<CornerIndices>& triangles, const char* name,
                              const char* name_of_triangles) {
  if (triangles.empty()) return find_wrong_size(size, mesh.vertices.size(), name, "vertices");
  if (auto fault =
          find_wrong_size(triangles.size(), mesh.triangles.size(), name_of_triangles, "triangles"))
    return fault;
  return find_index_beyond(triangles, size, true, name_of_triangles, name);
}

Fault find_fault_of_faces(const Mesh& mesh) {
  return find_wrong_size(mesh.face_of_triangle.size(), mesh.triangles.size(), "face_of_triangle",
                         "triangles");
}

Fault find_too_many(std::uint64_t count, const char* what) {
  if (count <= mesh::most_elements) return std::nullopt;
  return count_of(count, what) + " are more than " + std::to_string(mesh::most_elements);
}

Fault find_fault(const Mesh& mesh) {
  Fault fault = find_too_many(mesh.vertices.size(), "vertices");
  if (!fault) fault = find_too_many(mesh.triangles.size(), "triangles");
  if (!fault) fault = find_fault_of_faces(mesh);
  if (!fault) fault = find_not_finite<double>(mesh.vertices, "vertex");
  if (!fault) {
    fault = find_index_beyond(mesh.triangles, mesh.vertices.size(), false, "triangle", "vertices");
  }
  if (!fault) {
    fault = find_fault_of_attribute(mesh, mesh.texture_coordinates.size(), mesh.texture_triangles,
                                    "texture_coordinates", "texture_triangles");
  }
  if (!fault) {
    fault = find_fault_of_attribute(mesh, mesh.normals.size(), mesh.normal_triangles, "normals",
                                    "normal_triangles");
  }
  if (!fault) fault = find_fault_of_attribute(mesh, mesh.colours.size(), {}, "colours", "");
  if (!fault) fault = find_not_finite<double>(mesh.texture_coordinates, "texture_coordinates");
  if (!fault) fault = find_not_finite<double>(mesh.normals, "normals");
  if (!fault) fault = find_not_finite<float>(mesh.colours, "colours");
  return fault;
}

/// The number of a mesh's last face in its file.
std::uint64_t last_face(const Mesh& mesh) {
  if (mesh.triangles.empty()) return 0;
  if (mesh.face_of_triangle.empty()) return mesh.triangles.size() - 1;
  return *std::max_element(mesh.face_of_triangle.begin(), mesh.face_of_triangle.end());
}
std::uint64_t last_face(const TriangleStream& stream) {
  return stream.face_count() == 0 ? 0 : stream.face_count() - 1;
}

const Mesh& mesh_of(const Scene& scene, const Object& object) {
  return scene.meshes[object.mesh];
}
const TriangleStream& mesh_of(const StreamedScene& scene, const Object& object) {
  return *scene.streams[object.mesh];
}

Fault in(const char* what, std::size_t number, const std::string& fault) {
  return std::string(what) + " " + std::to_string(number) + ": " + fault;
}

template <class AnyScene>
Fault find_fault_of_placements(const AnyScene& scene) {
  const WorldFromMesh identity;
  // One mesh may be placed often.
  std::map<std::size_t, std::uint64_t> last_faces;
  for (std::size_t i = 0; i < scene.objects.size(); ++i) {
    const Object& object = scene.objects[i];
    if (object.placed_as_is && object.world_from_mesh.rows != identity.rows)
      return in("object", i, "is placed as it is, but its transform is not the identity");
    if (!last_faces.contains(object.mesh))
      last_faces[object.mesh] = last_face(mesh_of(scene, object));
    if (object.first_face > mesh::most_elements ||
        object.first_face + last_faces[object.mesh] > mesh::most_elements)
      return in("object", i, "a face's number is above " + std::to_string(mesh::most_elements));
  }
  return std::nullopt;
}

std::uint64_t count_of_triangles(const Mesh& mesh) {
  return mesh.triangles.size();
}
std::uint64_t count_of_triangles(const std::unique_ptr<TriangleStream>& stream) {
  return stream->triangle_count();
}

/// `meshes` are what objects index.
template <class Meshes>
Fault find_fault_among(const std::vector<Object>& objects, const Meshes& meshes) {
  Fault fault = find_too_many(objects.size(), "objects");
  std::uint64_t triangles = 0;
  for (std::size_t i = 0; i < objects.size() && !fault; ++i) {
    const std::size_t mesh = objects[i].mesh;
    if (mesh >= meshes.size()) {
      return in("object", i,
                "there is no mesh " + std::to_string(mesh) + " among " +
                    count_of(meshes.size(), "meshes"));
    }
    triangles += count_of_triangles(meshes[mesh]);
    fault = find_too_many(triangles, "triangles in all");
  }
  return fault;
}

}  // namespace

Fault scene::find_fault_of_objects(const Scene& scene) {
  return find_fault_among(scene.objects, scene.meshes);
}

Fault scene::find_fault_of_objects(const StreamedScene& scene) {
  for (std::size_t i = 0; i < scene.streams.size(); ++i)
    if (!scene.streams[i]) return in("mesh", i, "there is no stream");
  return find_fault_among(scene.objects, scene.streams);
}

void scene::require(const Fault& no_fault) {
  if (no_fault) throw InputError("scene: " + *no_fault);
}

Fault find_fault(const Scene& scene) {
  const StandardArithmetic standard;
  if (auto fault = find_fault_of_objects(scene)) return fault;
  for (std::size_t i = 0; i < scene.meshes.size(); ++i)
    if (const auto fault = find_fault(scene.meshes[i])) return in("mesh", i, *fault);
  return find_fault_of_placements(scene);
}

Fault find_fault(const StreamedScene& scene) {
  const StandardArithmetic standard;
  if (auto fault = find_fault_of_objects(scene)) return fault;
  return find_fault_of_placements(scene);
}

void require_valid(const Scene& scene) {
  require(find_fault(scene));
}

void require_valid(const StreamedScene& scene) {
  require(find_fault(scene));
}

void require_valid(const TriangleSource& triangles) {
  if (triangles.scene_) require_valid(*triangles.scene_);
  if (triangles.streamed_) require_valid(*triangles.streamed_);
}

void require_renderable(const TriangleSource& triangles, const Camera& camera) {
  require_valid(camera);
  if (std::uint64_t{camera.width} * camera.height > std::uint64_t{1} << 44) {
    throw InputError("an image of more than 2^44 pixels cannot be rendered");
  }
  require_valid(triangles);
}

}  // namespace fathom
