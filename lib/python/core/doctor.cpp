// The extension module _doctor, which fathom.doctor loads when it is called. Its answers are the
// texts of the command.

#include <pybind11/stl.h>

#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "apps/doctor/data_set.h"
#include "apps/doctor/diagnosis.h"
#include "bindings.h"
#include "entry_points.h"
#include "running.h"

namespace py = pybind11;

namespace fathom::python {
namespace {

using doctor::Diagnosis;
using doctor::View;

View view_of(const Camera& camera, const SharedMap& map, double png_scale) {
  return {camera, doctor::depth_image(*map, "depths", png_scale)};
}

Diagnosis examine(const SharedScene& shared, const std::vector<Camera>& cameras,
                  const std::vector<SharedMap>& maps, double png_scale, int threads) {
  const std::shared_ptr<const Scene> scene = shared.scene;
  return run([&](const auto& progress) {
    std::vector<View> views;
    for (std::size_t i = 0; i < maps.size(); ++i)
      views.push_back(view_of(cameras[i], maps[i], png_scale));
    doctor::require_depths(views);
    doctor::DataSet data(*scene, std::move(views), threads);
    return doctor::diagnose(data, progress);
  });
}

Camera corrected_camera(const Diagnosis& found, const Camera& camera, const SharedMap& map) {
  return doctor::corrected_camera(view_of(camera, map, 1), found);
}

SharedMap corrected_map(const Diagnosis& found, const Camera& camera, const SharedMap& map,
                        double png_scale) {
  return run([&](const auto&) {
    return std::make_shared<DepthMap>(
        doctor::corrected_map(view_of(camera, map, png_scale), found));
  });
}

}  // namespace
}  // namespace fathom::python

PYBIND11_MODULE(_doctor, module) {
  using namespace fathom::python;
  module.doc() = "What fathom.doctor calls.";
  Module core(module);
  end_work_at_exit(core);
  Class<Diagnosis>(core, "Diagnosis")
      .def("json", &fathom::doctor::to_json)
      .def("text", &fathom::doctor::to_text)
      .def("corrected_camera", &corrected_camera)
      .def("corrected_map", &corrected_map);
  core.def("examine", &examine);
}
