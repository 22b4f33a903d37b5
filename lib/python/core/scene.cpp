#include <pybind11/stl.h>
#include <pybind11/stl/filesystem.h>

#include <algorithm>
#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <tuple>
#include <vector>

#include "bindings.h"
#include "fathom/failures/errors.h"
#include "fathom/rendering/segment_channels.h"
#include "fathom/scene/bounds.h"
#include "fathom/scene/read_scene.h"
#include "fathom/scene/scene_segments.h"
#include "running.h"
#include "values.h"

namespace py = pybind11;

namespace fathom::python {
namespace {

/// Keeps an array of Python's, and lets go of it in whichever thread the last user ends.
std::shared_ptr<const void> keeper_of(py::object array) {
  return {new py::object(std::move(array)), [](py::object* kept) {
            const py::gil_scoped_acquire hold;
            delete kept;
          }};
}

static_assert(sizeof(MeshPoint) == 3 * sizeof(double));
static_assert(sizeof(CornerIndices) == 3 * sizeof(std::uint32_t));

/// The rows of an array of three columns, where they are.
template <class Row, class Number>
MeshArray<Row> lent_rows(const ContiguousArray<Number>& array) {
  const auto* const first = reinterpret_cast<const Row*>(array.data());
  return MeshArray<Row>::of_lent({first, static_cast<std::size_t>(array.shape(0))},
                                 keeper_of(array));
}

Mesh mesh_of(const ContiguousArray<double>& vertices, const ContiguousArray<std::uint32_t>& faces) {
  Mesh mesh;
  mesh.vertices = lent_rows<MeshPoint>(vertices);
  mesh.triangles = lent_rows<CornerIndices>(faces);
  mesh.face_count = mesh.triangles.size();
  return mesh;
}

using Rows = std::array<std::array<double, 4>, 3>;

WorldFromMesh exact(const Rows& rows) {
  WorldFromMesh transform;
  for (std::size_t i = 0; i < 3; ++i)
    for (std::size_t k = 0; k < 4; ++k) transform.rows[i][k] = Dyadic(rows[i][k]);
  return transform;
}

/// The scene itself where nobody else has it: no call is at work with it, and no array shows its
/// numbers. Else a copy, which takes its place.
Scene& changeable(SharedScene& shared) {
  if (shared.scene.use_count() > 1) shared.scene = std::make_shared<Scene>(*shared.scene);
  return *shared.scene;
}

std::size_t add_mesh(SharedScene& shared, const ContiguousArray<double>& vertices,
                     const ContiguousArray<std::uint32_t>& faces) {
  Scene& scene = changeable(shared);
  scene.meshes.push_back(mesh_of(vertices, faces));
  return scene.meshes.size() - 1;
}

Segmentation segmentation_named(const std::string& channel) {
  for (const Segmentation by : all_segmentations)
    if (description_of(channel_of(by)).name == channel) return by;
  throw UsageError("there are no segments '" + channel + "'");
}

/// The segments of a mesh that add_mesh() has added: a number for each triangle, or one for all.
void set_segments(SharedScene& shared, std::size_t mesh, const std::string& channel,
                  const ContiguousArray<std::uint32_t>& numbers,
                  const std::vector<std::string>& names) {
  const std::span<const std::uint32_t> all(numbers.data(),
                                           static_cast<std::size_t>(numbers.size()));
  changeable(shared).meshes.at(mesh).segments.push_back(
      {segmentation_named(channel), compact_segments({all.begin(), all.end()}), names});
}

/// names[n] is what segment n of the whole scene is called.
std::vector<std::string> names_of(const SharedScene& shared, const std::string& channel) {
  const Segmentation by = segmentation_named(channel);
  return SceneSegments(*shared.scene, {by}).names(by);
}

void add_object(SharedScene& shared, std::size_t mesh, const std::optional<Rows>& pose,
                const std::string& name) {
  Scene& scene = changeable(shared);
  if (scene.sources.empty()) scene.sources.push_back({"(arrays)", "", ""});
  Object object;
  object.mesh = mesh;
  object.name = name;
  if (pose) {
    object.world_from_mesh = exact(*pose);
    object.placed_as_is = false;
  }
  scene.objects.push_back(std::move(object));
}

std::pair<SharedScene, Warnings> read(const std::vector<std::filesystem::path>& files,
                                      const std::string& formats_program, int threads,
                                      bool clouds) {
  ReadOptions options;
  options.clouds = clouds;
  options.threads = threads;
  options.segments = true;
  options.attributes = true;  // normals, for channel Ns
  options.primitives = true;  // lines and points, for fathom.pipeline
  if (!formats_program.empty()) {
    options.formats_program = [&] { return std::filesystem::path(formats_program); };
  }
  Warnings warnings;
  auto scene = run(
      [&](const auto&) { return std::make_shared<Scene>(read_scene(files, options, warnings)); });
  return {SharedScene{std::move(scene)}, std::move(warnings)};
}

template <class Number, class Row>
py::array view_of(const std::shared_ptr<const Scene>& scene, const MeshArray<Row>& rows) {
  const py::capsule owner(new std::shared_ptr<const Scene>(scene), [](void* memory) {
    delete static_cast<std::shared_ptr<const Scene>*>(memory);
  });
  const auto count = static_cast<py::ssize_t>(rows.size());
  py::array_t<Number> array(Shape{count, 3}, reinterpret_cast<const Number*>(rows.data()), owner);
  py::detail::array_proxy(array.ptr())->flags &= ~py::detail::npy_api::NPY_ARRAY_WRITEABLE_;
  return array;
}

template <class T>
std::pair<std::uintptr_t, std::uintptr_t> place_of(const T* first, std::size_t count) {
  const auto begin = reinterpret_cast<std::uintptr_t>(first);
  return {begin, begin + count * sizeof(T)};
}

/// Whether the array lies in memory of the scene's meshes.
bool overlaps(const SharedScene& shared, const py::array& array) {
  const auto [begin, end] = place_of(static_cast<const std::byte*>(array.data()),
                                     static_cast<std::size_t>(array.nbytes()));
  const auto meets = [begin = begin, end = end](const auto& elements) {
    const auto [first, last] = place_of(elements.data(), elements.size());
    return first < end && begin < last;
  };
  const std::vector<Mesh>& meshes = shared.scene->meshes;
  return std::any_of(meshes.begin(), meshes.end(), [&](const Mesh& mesh) {
    return meets(mesh.vertices) || meets(mesh.triangles);
  });
}

using Corner = std::array<double, 3>;

std::optional<std::pair<Corner, Corner>> bounds(const SharedScene& shared) {
  const std::shared_ptr<const Scene> scene = shared.scene;
  const auto box = run([&](const auto&) { return world_bounds(*scene); });
  if (!box) return std::nullopt;
  return std::pair(box->lower, box->upper);
}

std::vector<std::tuple<std::string, std::size_t, std::string>> objects(const SharedScene& shared) {
  std::vector<std::tuple<std::string, std::size_t, std::string>> list;
  list.reserve(shared.scene->objects.size());
  for (const Object& object : shared.scene->objects)
    list.emplace_back(object.name, object.mesh, shared.scene->sources.at(object.source).path);
  return list;
}

std::tuple<std::uint32_t, std::uint32_t, std::uint32_t> origin(const SharedScene& shared,
                                                               std::uint32_t number) {
  const TriangleOrigin origin = origin_of(*shared.scene, number);
  return {origin.object, origin.triangle, origin.face};
}

}  // namespace

void bind_scene(Module& core) {
  Class<SharedScene>(core, "Scene")
      .def(py::init<>())
      .def("add_mesh", &add_mesh)
      .def("set_segments", &set_segments)
      .def("names", &names_of)
      .def("add_object", &add_object)
      .def("objects", &objects)
      .def("origin", &origin)
      .def("bounds", &bounds)
      .def("overlaps", &overlaps)
      .def_property_readonly("mesh_count",
                             [](const SharedScene& shared) { return shared.scene->meshes.size(); })
      .def_property_readonly("object_count",
                             [](const SharedScene& shared) { return shared.scene->objects.size(); })
      .def_property_readonly(
          "triangle_count", [](const SharedScene& shared) { return triangle_count(*shared.scene); })
      .def("vertices",
           [](const SharedScene& shared, std::size_t mesh) {
             return view_of<double>(shared.scene, shared.scene->meshes.at(mesh).vertices);
           })
      .def("faces", [](const SharedScene& shared, std::size_t mesh) {
        return view_of<std::uint32_t>(shared.scene, shared.scene->meshes.at(mesh).triangles);
      });
  core.def("read_scene", &read);
}

}  // namespace fathom::python
