// What each pixel shows of every surface: deep maps, and Cryptomatte.

#include <pybind11/stl.h>
#include <pybind11/stl/filesystem.h>

#include <memory>
#include <optional>
#include <utility>

#include "bindings.h"
#include "fathom/image/deep_map.h"
#include "fathom/image/map_files.h"
#include "fathom/render.h"
#include "running.h"
#include "values.h"

namespace py = pybind11;

namespace fathom::python {
namespace {

/// Samples by column, where those of each pixel begin, and the rest of the map.
py::tuple arrays_of(DeepMap map) {
  const std::size_t count = map.samples.size();
  Samples<float> front(count), back(count), area(count), alpha(count);
  Samples<std::uint32_t> id(count);
  for (std::size_t i = 0; i < count; ++i) {
    front[i] = map.samples[i].Z;
    back[i] = map.samples[i].ZBack;
    area[i] = map.samples[i].area;
    alpha[i] = map.samples[i].A;
    id[i] = map.samples[i].id;
  }
  Samples<std::uint64_t> offsets(map.counts.size() + 1);
  for (std::size_t i = 0; i < map.counts.size(); ++i) offsets[i + 1] = offsets[i] + map.counts[i];
  const Shape shape{static_cast<py::ssize_t>(count)};
  py::dict result;
  result["Z"] = array_of(std::move(front), shape);
  result["ZBack"] = array_of(std::move(back), shape);
  result["area"] = array_of(std::move(area), shape);
  result["A"] = array_of(std::move(alpha), shape);
  result["id"] = array_of(std::move(id), shape);
  const auto offset_count = static_cast<py::ssize_t>(offsets.size());
  result["offsets"] = array_of(std::move(offsets), {offset_count});
  return py::make_tuple(result, std::make_shared<DepthMap>(std::move(map.description)));
}

py::tuple deep(const SharedScene& shared, const Camera& camera, const std::string& cull,
               int threads) {
  const std::shared_ptr<const Scene> scene = shared.scene;
  return arrays_of(run([&](const auto& progress) {
    return render_deep(*scene, camera, options_of(cull, threads), {}, progress);
  }));
}

/// Python has made sure that the arrays fit each other.
DeepMap deep_map_of(const DepthMap& description, const ContiguousArray<float>& front,
                    const ContiguousArray<float>& back, const ContiguousArray<float>& area,
                    const ContiguousArray<float>& alpha, const ContiguousArray<std::uint32_t>& id,
                    const ContiguousArray<std::uint32_t>& counts) {
  DeepMap map;
  map.description = description;
  map.counts.assign(counts.data(), counts.data() + counts.size());
  map.samples.resize(static_cast<std::size_t>(front.size()));
  for (std::size_t i = 0; i < map.samples.size(); ++i)
    map.samples[i] = {front.data()[i], back.data()[i], id.data()[i], area.data()[i],
                      alpha.data()[i]};
  return map;
}

/// The channels and texts of the layer, in a map that has nothing else.
SharedMap cryptomatte(const SharedScene& shared, const Camera& camera, const std::string& cull,
                      int threads) {
  const std::shared_ptr<const Scene> scene = shared.scene;
  auto map = std::make_shared<DepthMap>();
  map->width = camera.width;
  map->height = camera.height;
  run([&](const auto& progress) {
    add_cryptomatte(*map, *scene, camera, options_of(cull, threads), std::nullopt, progress);
  });
  return map;
}

}  // namespace

void bind_deep(Module& core) {
  core.def("deep", &deep);
  core.def("read_deep", [](const std::filesystem::path& path) {
    return arrays_of(run([&](const auto&) { return read_deep_map(path); }));
  });
  core.def("write_deep",
           [](const SharedMap& description, const ContiguousArray<float>& front,
              const ContiguousArray<float>& back, const ContiguousArray<float>& area,
              const ContiguousArray<float>& alpha, const ContiguousArray<std::uint32_t>& id,
              const ContiguousArray<std::uint32_t>& counts, const std::filesystem::path& path,
              const std::string& compression, int threads) {
             const DeepMap map = deep_map_of(*description, front, back, area, alpha, id, counts);
             const Compression stored = named_value("compression", all_compressions, compression);
             run([&](const auto&) { write_deep_map(map, path, stored, threads); });
           });
  core.def("cryptomatte", &cryptomatte);
}

}  // namespace fathom::python
