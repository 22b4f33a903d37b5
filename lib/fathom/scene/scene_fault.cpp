#include "fathom/scene/scene_fault.h"

#include <algorithm>
#include <atomic>
#include <map>
#include <span>

#include "fathom/failures/errors.h"
#include "fathom/mesh/mesh_faces.h"
#include "fathom/numeric/standard_arithmetic.h"
#include "fathom/scene/element_checks.h"
#include "fathom/text/counted.h"
#include "fathom/threads/threads.h"

// How to read this file: several threads check the parts of every list, in a form that compilers
// turn into vector instructions and that only finds out whether there is a fault. If there is, the
// list is searched again, slowly, for the first fault to name.
namespace fathom {
using namespace scene;

namespace {

using Fault = std::optional<std::string>;

/// `what` in the plural.
std::string count_of(std::uint64_t count, const std::string& what) {
  if (what == "vertices") return text::counted(count, "vertex", what);
  if (what == "meshes") return text::counted(count, "mesh", what);
  return text::counted(count, what.substr(0, what.size() - 1), what);
}

/// Whether `is_good` holds for all parts of a list.
template <class T, class IsGood>
bool all_parts(std::span<const T> all, const IsGood& is_good) {
  constexpr std::size_t part = 1U << 14;
  const std::size_t parts = (all.size() + part - 1) / part;
  if (parts <= 1) return is_good(all);
  std::atomic<bool> all_good = true;
  in_parallel(parts, [&](std::size_t i) {
    const std::size_t first = i * part;
    if (!is_good(all.subspan(first, std::min(part, all.size() - first)))) all_good = false;
  });
  return all_good;
}

/// Whether every index is below `end` or none.
bool all_below_or_none(std::span<const CornerIndices> triangles, std::uint64_t end) {
  bool all = true;
  for (const CornerIndices& triangle : triangles)
    for (const std::uint32_t index : triangle) all = all && (index < end || index == no_index);
  return all;
}

/// Names the first element of a list for which `is_good` does not hold.
template <class T, class IsGood>
Fault find_bad(std::span<const T> list, const char* element, const std::string& what,
               const IsGood& is_good) {
  if (all_parts(list, is_good)) return std::nullopt;
  const auto bad = std::find_if_not(list.begin(), list.end(),
                                    [&](const T& each) { return is_good(std::span(&each, 1)); });
  return std::string(element) + " " + std::to_string(bad - list.begin()) + what;
}

template <class Real, class List>
Fault find_not_finite(const List& list, const char* element) {
  using T = typename List::value_type;
  return find_bad(std::span<const T>(list), element, " has a number that is not finite",
                  all_finite<Real, T>);
}

/// Names the first triangle whose index is out of range; `is_good` decides whether no_index is
/// allowed.
template <class IsGood>
Fault find_index_beyond(std::span<const CornerIndices> triangles, std::uint64_t end,
                        const char* element, const char* of, const IsGood& is_good) {
  return find_bad(triangles, element, ": a corner is beyond the " + count_of(end, of),
                  [&](std::span<const CornerIndices> part) { return is_good(part, end); });
}

/// A list that is empty or has one element for each of `count`.
Fault find_wrong_size(std::size_t size, std::uint64_t count, const char* name, const char* each) {
  if (size == 0 || size == count) return std::nullopt;
  return std::string(name) + " has " + count_of(size, "elements") + ", expected one for each of " +
         count_of(count, each);
}

/// An attribute of the vertices, or of the corners of its own triangles.
Fault find_fault_of_attribute(const Mesh& mesh, std::size_t size,
                              std::span<const CornerIndices> triangles, const char* name,
                              const char* name_of_triangles) {
  if (triangles.empty()) return find_wrong_size(size, mesh.vertices.size(), name, "vertices");
  if (auto fault =
          find_wrong_size(triangles.size(), mesh.triangles.size(), name_of_triangles, "triangles"))
    return fault;
  return find_index_beyond(triangles, size, name_of_triangles, name, all_below_or_none);
}

Fault find_fault_of_faces(const Mesh& mesh) {
  return find_wrong_size(mesh.face_of_triangle.size(), mesh.triangles.size(), "face_of_triangle",
                         "triangles");
}

Fault find_too_many(std::uint64_t count, const char* what) {
  if (count <= mesh::most_elements) return std::nullopt;
  return count_of(count, what) + " are more than " + std::to_string(mesh::most_elements);
}

Fault find_fault_of_attributes(const Mesh& mesh) {
  Fault fault =
      find_fault_of_attribute(mesh, mesh.texture_coordinates.size(), mesh.texture_triangles,
                              "texture_coordinates", "texture_triangles");
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

const char* name_of(Segmentation by) {
  switch (by) {
    case Segmentation::material:
      return "materials";
    case Segmentation::group:
      return "groups";
    case Segmentation::part:
      return "parts";
    case Segmentation::label:
      break;
  }
  return "labels";
}

/// Numbers must be one for each of `triangles` triangles, or a single one for all.
Fault find_fault_of_segments(const TriangleSegments& segments, std::size_t triangles) {
  const char* const name = name_of(segments.by);
  const bool are_labels = segments.by == Segmentation::label;
  if (are_labels && !segments.names.empty()) return "labels are numbers, they have no names";
  if (segments.numbers.size() != 1)
    if (auto fault = find_wrong_size(segments.numbers.size(), triangles, name, "triangles"))
      return fault;
  const std::uint64_t end = are_labels ? unsegmented : segments.names.size();
  const auto are_below = [end](std::span<const std::uint32_t> numbers) {
    return std::ranges::all_of(
        numbers, [&](std::uint32_t number) { return number < end || number == unsegmented; });
  };
  const std::string what = are_labels ? ": the label is above " + std::to_string(unsegmented)
                                      : ": its number is beyond the " + count_of(end, name);
  return find_bad(std::span<const std::uint32_t>(segments.numbers), "triangle", what, are_below);
}

Fault find_fault_of_segments(const Mesh& mesh) {
  for (const TriangleSegments& segments : mesh.segments) {
    if (mesh.segments_by(segments.by) != &segments)
      return std::string(name_of(segments.by)) + " are there twice";
    if (auto fault = find_fault_of_segments(segments, mesh.triangles.size())) return fault;
  }
  return std::nullopt;
}

Fault find_fault_but_elements(const Mesh& mesh) {
  Fault fault = find_too_many(mesh.vertices.size(), "vertices");
  if (!fault) fault = find_too_many(mesh.triangles.size(), "triangles");
  if (!fault) fault = find_fault_of_faces(mesh);
  if (!fault) fault = find_fault_of_segments(mesh);
  if (!fault) fault = find_fault_of_attributes(mesh);
  return fault;
}

Fault find_fault_of_elements(const Mesh& mesh) {
  if (auto fault = find_not_finite<double>(mesh.vertices, "vertex")) return fault;
  if (auto fault = find_index_beyond(mesh.triangles, mesh.vertices.size(), "triangle", "vertices",
                                     all_below))
    return fault;
  const auto is_vertex = [&](std::uint32_t index) { return index < mesh.vertices.size(); };
  const auto fault_of = [&](const char* element) {
    return std::string(element) + " is beyond the " + count_of(mesh.vertices.size(), "vertices");
  };
  for (const auto& [a, b] : mesh.lines)
    if (!is_vertex(a) || !is_vertex(b)) return fault_of("the end of a line");
  if (!std::ranges::all_of(mesh.points, is_vertex)) return fault_of("a point");
  return std::nullopt;
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
    if (auto fault = find_fault(object.world_from_mesh)) return in("object", i, *fault);
    if (object.segments && object.segments->label.value_or(0) > unsegmented)
      return in("object", i, "the label is above " + std::to_string(unsegmented));
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

Fault find_fault_of_draw_states(const Scene& scene) {
  const auto& states = scene.draw_states;
  if (auto fault = find_wrong_size(states.size(), scene.objects.size(), "the list of draw states",
                                   "objects"))
    return fault;
  for (std::size_t i = 0; i < states.size(); ++i)
    if (const auto fault = find_fault(states[i])) return in("object", i, *fault);
  return std::nullopt;
}

/// Also checks the vertices and triangles of the meshes for which `looked_at` holds.
Fault find_fault(const Scene& scene, const std::vector<bool>& looked_at) {
  if (auto fault = find_fault_of_objects(scene)) return fault;
  for (std::size_t i = 0; i < scene.meshes.size(); ++i) {
    Fault fault = find_fault_but_elements(scene.meshes[i]);
    if (!fault && looked_at[i]) fault = find_fault_of_elements(scene.meshes[i]);
    if (fault) return in("mesh", i, *fault);
  }
  if (auto fault = find_fault_of_draw_states(scene)) return fault;
  return find_fault_of_placements(scene);
}

void require_camera(const Camera& camera) {
  require_valid(camera);
  if (std::uint64_t{camera.width} * camera.height > most_pixels_of_image) throw image_too_large();
}

}  // namespace

InputError image_too_large() {
  return InputError("an image of " + std::string(too_many_pixels) + " cannot be rendered");
}

bool scene::all_below(std::span<const CornerIndices> triangles, std::uint64_t end) {
  if (end == 0) return triangles.empty();
  // Compared as signed numbers, because every processor can compare several of these at a time.
  const auto place = [](std::uint32_t index) {
    return static_cast<std::int32_t>(index ^ 0x80000000U);
  };
  const std::int32_t last =
      place(static_cast<std::uint32_t>(std::min<std::uint64_t>(end, no_index) - 1));
  const std::size_t count = 3 * triangles.size();
  std::int32_t beyond = 0;
  for (std::size_t i = 0; i < count; ++i) {
    beyond |= place(number_at<std::uint32_t>(triangles, i)) > last ? -1 : 0;
  }
  return beyond == 0;
}

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
  return find_fault(scene, std::vector<bool>(scene.meshes.size(), true));
}

Fault find_fault(const StreamedScene& scene) {
  const StandardArithmetic standard;
  if (auto fault = find_fault_of_objects(scene)) return fault;
  return find_fault_of_placements(scene);
}

void require_valid(const TriangleSource& triangles, LookAtElements when) {
  if (triangles.streamed_scene()) return require(find_fault(*triangles.streamed_scene()));
  const StandardArithmetic standard;
  const Scene& scene = *triangles.scene();
  std::vector<bool> looked_at(scene.meshes.size(), true);
  if (when == LookAtElements::later)
    for (const Object& object : scene.objects) looked_at[object.mesh] = false;
  require(find_fault(scene, looked_at));
}

void require_renderable(const TriangleSource& triangles, const Camera& camera,
                        LookAtElements when) {
  require_camera(camera);
  require_straight(camera);
  require_valid(triangles, when);
}

void require_renderable_by_rays(const TriangleSource& triangles, const Camera& camera,
                                LookAtElements when) {
  require_camera(camera);
  require_valid(triangles, when);
}

void scene::fail_of_elements(const TriangleSource& triangles) {
  require_valid(triangles);
  throw InputError("scene: a file has changed since it was opened");
}

}  // namespace fathom
