#include <pybind11/stl.h>

#include <functional>
#include <limits>

#include "arrays.h"
#include "bindings.h"
#include "exact.h"
#include "fathom/area/visible_areas.h"
#include "fathom/reference/probe.h"
#include "fathom/reference/verify.h"
#include "fathom/render.h"
#include "maps.h"
#include "running.h"
#include "scene.h"

namespace py = pybind11;

namespace fathom::python {
namespace {

Cull cull_named(const std::string& name) {
  return name == "back" ? Cull::back : name == "front" ? Cull::front : Cull::none;
}

/// What counts of the options where areas are asked for.
RenderOptions options_of(const std::string& cull, int threads,
                         const std::function<void(double)>& progress) {
  RenderOptions options;
  options.cull = cull_named(cull);
  options.threads = threads;
  options.progress = progress;
  return options;
}

py::list probe_pixel(const SharedScene& shared, const Camera& camera, std::uint32_t x,
                     std::uint32_t y, const std::string& cull) {
  const std::shared_ptr<const Scene> scene = shared.scene;
  const auto found =
      run([&](const auto&) { return probe(*scene, camera, x, y, cull_named(cull)); });
  py::list list;
  for (const CoveringTriangle& each : found) {
    const auto signs = each.edge_signs;
    list.append(
        py::make_tuple(each.number, each.origin.object, each.origin.triangle, each.origin.face,
                       each.front_facing, parts_of(each.depth), each.counts,
                       py::make_tuple(static_cast<int>(signs[0]), static_cast<int>(signs[1]),
                                      static_cast<int>(signs[2]))));
  }
  return list;
}

py::tuple columns(const std::vector<VisibleArea>& areas) {
  Samples<double> visible(areas.size()), unoccluded(areas.size()), ratio(areas.size());
  for (std::size_t i = 0; i < areas.size(); ++i) {
    visible[i] = areas[i].visible;
    unoccluded[i] = areas[i].unoccluded;
    ratio[i] = areas[i].ratio.value_or(std::numeric_limits<double>::quiet_NaN());
  }
  const Shape shape{static_cast<py::ssize_t>(areas.size())};
  return py::make_tuple(array_of(std::move(visible), shape), array_of(std::move(unoccluded), shape),
                        array_of(std::move(ratio), shape));
}

py::tuple visible(const SharedScene& shared, const Camera& camera, const std::string& cull,
                  int threads) {
  const std::shared_ptr<const Scene> scene = shared.scene;
  const VisibleAreas areas = run([&](const auto& progress) {
    return visible_areas(*scene, camera, options_of(cull, threads, progress));
  });
  return py::make_tuple(columns(areas.triangles), columns(areas.objects));
}

/// Samples by column, and where those of each pixel begin.
py::dict deep(const SharedScene& shared, const Camera& camera, const std::string& cull,
              int threads) {
  const std::shared_ptr<const Scene> scene = shared.scene;
  const DeepMap map = run([&](const auto& progress) {
    return render_deep(*scene, camera, options_of(cull, threads, progress));
  });
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
  return result;
}

py::tuple verify_map(const SharedMap& map, const SharedScene& shared, const Camera& camera,
                     const RenderOptions& asked, std::uint64_t count) {
  const std::shared_ptr<const Scene> scene = shared.scene;
  const Verification found = run([&](const auto& progress) {
    RenderOptions options = asked;
    options.progress = progress;
    return verify(*map, *scene, camera, options, choose_pixels(camera.width, camera.height, count));
  });
  py::object first = py::none();
  if (found.first) {
    first = py::make_tuple(found.first->x, found.first->y, found.first->channel, found.first->found,
                           found.first->expected);
  }
  return py::make_tuple(found.verified, found.differing, first);
}

}  // namespace

void bind_questions(py::module_& core) {
  core.def("probe", &probe_pixel);
  core.def("visible", &visible);
  core.def("deep", &deep);
  core.def("verify", &verify_map);
}

}  // namespace fathom::python
