#include <pybind11/stl.h>

#include <algorithm>
#include <limits>

#include "bindings.h"
#include "fathom/area/visible_areas.h"
#include "fathom/drawing/drawing.h"
#include "fathom/reference/pixel_hits.h"
#include "fathom/reference/probe.h"
#include "fathom/reference/verify.h"
#include "fathom/render.h"
#include "fathom/rendering/options.h"
#include "running.h"
#include "values.h"

namespace py = pybind11;

namespace fathom::python {
namespace {

py::list probe_pixel(const SharedScene& shared, const Camera& camera, std::uint32_t x,
                     std::uint32_t y, const std::string& cull) {
  const std::shared_ptr<const Scene> scene = shared.scene;
  const auto found = run([&](const auto& progress) {
    return probe(*scene, camera, x, y, named_value("cull", all_culls, cull), progress);
  });
  py::list list;
  for (const CoveringTriangle& each : found) {
    const auto signs = each.edge_signs;
    list.append(
        py::make_tuple(each.number, each.origin.object, each.origin.triangle, each.origin.face,
                       each.front_facing, parts_of(each.depth), each.counts,
                       py::make_tuple(static_cast<int>(signs[0]), static_cast<int>(signs[1]),
                                      static_cast<int>(signs[2])),
                       py::make_tuple(each.facing_decided_by(), each.edge_decided_by(0),
                                      each.edge_decided_by(1), each.edge_decided_by(2))));
  }
  return list;
}

/// Of a whole image: where the hits of each pixel begin, triangles and depths.
py::tuple hits_of_image(const SharedScene& shared, const Camera& camera, const std::string& cull,
                        int threads) {
  const std::shared_ptr<const Scene> scene = shared.scene;
  PixelHits found = run([&](const auto& progress) {
    return hits_of_pixels(*scene, camera, named_value("cull", all_culls, cull), threads, progress);
  });
  std::vector<std::uint32_t> triangles(found.hits.size());
  std::ranges::transform(found.hits, triangles.begin(), &PixelHit::triangle);
  std::vector<double> depths(found.hits.size());
  std::ranges::transform(found.hits, depths.begin(), &PixelHit::depth);
  return py::make_tuple(array_of(std::move(found.splits)), array_of(std::move(triangles)),
                        array_of(std::move(depths)));
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
    return visible_areas(*scene, camera, options_of(cull, threads), progress);
  });
  return py::make_tuple(columns(areas.triangles), columns(areas.objects));
}

py::bytes draw_scene(const SharedScene& shared, const Camera& camera, const std::string& edges,
                     double crease_angle, double stroke, const std::string& cull, int threads,
                     bool as_pdf) {
  const std::shared_ptr<const Scene> scene = shared.scene;
  const EdgeOptions options{named_value("edges", all_edge_selections, edges), crease_angle,
                            named_value("cull", all_culls, cull), threads};
  const std::string file = run([&](const auto& progress) {
    const Drawing drawing = draw(*scene, camera, options, progress);
    return as_pdf ? pdf_of(drawing, {stroke}) : svg_of(drawing, {stroke});
  });
  return file;
}

py::tuple verify_map(const SharedMap& map, const SharedScene& shared, const Camera& camera,
                     const RenderOptions& asked, std::uint64_t count) {
  const std::shared_ptr<const Scene> scene = shared.scene;
  const Verification found = run([&](const auto& progress) {
    return verify(*map, *scene, camera, asked, choose_pixels(camera.width, camera.height, count),
                  progress);
  });
  py::object first = py::none();
  if (found.first) {
    first = py::make_tuple(found.first->x, found.first->y, found.first->channel, found.first->found,
                           found.first->expected);
  }
  return py::make_tuple(found.verified, found.differing, first);
}

}  // namespace

void bind_questions(Module& core) {
  core.def("probe", &probe_pixel);
  core.def("hits_of_pixels", &hits_of_image);
  core.def("visible", &visible);
  core.def("draw", &draw_scene);
  core.attr("edge_selections") = names_of(all_edge_selections);
  core.def("verify", &verify_map);
}

}  // namespace fathom::python
