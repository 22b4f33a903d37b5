#include <pybind11/stl.h>

#include <algorithm>

#include "bindings.h"
#include "fathom/evaluate.h"
#include "fathom/rendering/options.h"
#include "running.h"
#include "values.h"

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

/// (N, 3) positions and (N,) distances.
py::tuple arrays_of(const std::vector<MeasuredPoint>& points) {
  Samples<double> positions(3 * points.size()), distances(points.size());
  for (std::size_t i = 0; i < points.size(); ++i) {
    std::copy(points[i].at.begin(), points[i].at.end(), positions.begin() + 3 * i);
    distances[i] = points[i].distance;
  }
  const auto count = static_cast<py::ssize_t>(points.size());
  return py::make_tuple(array_of(std::move(positions), {count, 3}),
                        array_of(std::move(distances), {count}));
}

/// The fields of evaluation.Distances, in order.
py::tuple tuple_of(const SurfaceDistances& d, bool keep_points) {
  const py::tuple arrays =
      keep_points ? arrays_of(d.measured) : py::make_tuple(py::none(), py::none());
  return py::make_tuple(d.points, d.seen, d.mean, d.rms, d.median, d.p90, d.p99, d.max,
                        py::tuple(py::cast(d.shares)), arrays[0], arrays[1], d.cloud_points,
                        d.outliers);
}

py::tuple evaluate_scenes(const SharedScene& made, const SharedScene& real,
                          const std::vector<Camera>& cameras, const std::vector<double>& within,
                          std::uint32_t points, std::optional<double> density,
                          std::optional<double> truth_density, std::optional<double> max_distance,
                          bool keep_points, const std::string& cull, int threads) {
  const std::shared_ptr<const Scene> reconstruction = made.scene, truth = real.scene;
  SurfaceComparisonOptions options;
  options.points = points;
  options.within = within;
  options.density = density;
  options.truth_density = truth_density;
  options.max_distance = max_distance;
  options.keep_points = keep_points;
  options.cull = named_value("cull", all_culls, cull);
  options.threads = threads;
  const Evaluation found = run([&](const auto& progress) {
    return evaluate(*reconstruction, *truth, cameras, options, progress);
  });
  return py::make_tuple(tuple_of(found.depth), tuple_of(found.surfaces.accuracy, keep_points),
                        tuple_of(found.surfaces.completeness, keep_points),
                        py::tuple(py::cast(found.surfaces.f_scores)), found.surfaces.overall,
                        to_text(found, options));
}

}  // namespace

void bind_evaluation(Module& core) {
  core.def("evaluate", &evaluate_scenes);
}

}  // namespace fathom::python
