#include <pybind11/stl.h>

#include "bindings.h"
#include "fathom/evaluate.h"
#include "render_options.h"
#include "running.h"
#include "scene.h"

namespace py = pybind11;

namespace fathom::python {
namespace {

/// The fields of evaluation.Depth, in order.
py::object tuple_of(const std::optional<DepthAgreement>& depth) {
  if (!depth) return py::none();
  const DepthMetrics& m = depth->metrics;
  return py::make_tuple(depth->views, depth->both, depth->only_truth, depth->only_reconstruction,
                        m.mae, m.rmse, m.rmse_log, m.abs_rel, m.sq_rel, m.delta_1, m.delta_2,
                        m.delta_3, depth->l1_of_all_pixels, depth->l1_of_truth_pixels,
                        depth->views_of_truth);
}

/// The fields of evaluation.Distances, in order.
py::tuple tuple_of(const SurfaceDistances& d) {
  return py::make_tuple(d.points, d.seen, d.mean, d.rms, d.median, d.p90, d.p99, d.max,
                        py::tuple(py::cast(d.shares)));
}

py::tuple evaluate_scenes(const SharedScene& made, const SharedScene& real,
                          const std::vector<Camera>& cameras, const std::vector<double>& within,
                          std::uint32_t points, const std::string& cull, int threads) {
  const std::shared_ptr<const Scene> reconstruction = made.scene, truth = real.scene;
  SurfaceComparisonOptions options;
  options.points = points;
  options.within = within;
  options.cull = cull_named(cull);
  options.threads = threads;
  const Evaluation found = run([&](const auto& progress) {
    options.progress = progress;
    return evaluate(*reconstruction, *truth, cameras, options);
  });
  return py::make_tuple(tuple_of(found.depth), tuple_of(found.surfaces.accuracy),
                        tuple_of(found.surfaces.completeness),
                        py::tuple(py::cast(found.surfaces.f_scores)));
}

}  // namespace

void bind_evaluation(py::module_& core) {
  core.def("evaluate", &evaluate_scenes);
}

}  // namespace fathom::python
