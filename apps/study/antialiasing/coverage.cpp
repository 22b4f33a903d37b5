#include "apps/study/antialiasing/coverage.h"

#include <algorithm>
#include <cmath>

#include "fathom/area/coverage.h"
#include "fathom/failures/errors.h"
#include "fathom/render.h"

namespace fathom::studies {
namespace {

constexpr const char* patterns[] = {
    "1",  "2",         "4",          "rotated-grid", "regular:2",  "jittered:2", "8",
    "16", "regular:4", "jittered:4", "regular:8",    "jittered:8", "regular:16", "jittered:16"};

PatternError measure(const SceneView& view, const DepthMap& exact, const std::string& name) {
  const SamplePattern pattern = sample_pattern(name);
  DepthMap map = exact;
  add_sampled_coverage(map, view.scene, view.camera, pattern, {});
  const auto& A = *map.values<float>("A");
  const auto& shares = *map.values<float>("Asampled");
  PatternError row{name, pattern.count()};
  for (std::size_t i = 0; i < A.size(); ++i) {
    if (!(A[i] > 0 && A[i] < 1)) continue;
    const double error = static_cast<double>(shares[i]) - static_cast<double>(A[i]);
    ++row.partial;
    row.seen_partial += shares[i] > 0 && shares[i] < 1 ? 1 : 0;
    row.mean += std::abs(error);
    row.root_mean_square += error * error;
    row.greatest = std::max(row.greatest, std::abs(error));
    row.bias += error;
  }
  if (row.partial > 0) {
    row.mean /= static_cast<double>(row.partial);
    row.root_mean_square = std::sqrt(row.root_mean_square / static_cast<double>(row.partial));
  }
  return row;
}

/// A half-plane over 64×64 pixels whose edge rises by `slope` over one pixel.
SceneView edge_of(double slope) {
  SceneView view{"edge", {}, {}};
  Mesh mesh;
  mesh.vertices = {
      {-32, 200, 1}, {96, 200, 1}, {96, 32.3 - 64 * slope, 1}, {-32, 32.3 + 64 * slope, 1}};
  mesh.triangles = {{0, 1, 2}, {0, 2, 3}};
  mesh.face_count = 2;
  view.scene.meshes = {std::move(mesh)};
  view.scene.objects = {{.name = "edge"}};
  view.camera.width = view.camera.height = 64;
  view.camera.projection.model = ProjectionModel::orthographic;
  return view;
}

std::vector<EdgeSeen> measure_edges() {
  std::vector<EdgeSeen> edges;
  for (const double slope : {0.0, 0.03, 0.07, 0.13, 0.29, 0.53, 0.71, 1.0}) {
    const SceneView view = edge_of(slope);
    const DepthMap exact = exact_coverage(view);
    EdgeSeen edge{slope, 0, {}, {}};
    for (const char* pattern : {"1", "2", "4", "8"}) {
      const PatternError row = measure(view, exact, pattern);
      edge.partial = row.partial;
      edge.seen.push_back(row.seen_partial);
    }
    for (const char* pattern : edge_patterns) {
      edge.root_mean_square.push_back(measure(view, exact, pattern).root_mean_square);
    }
    edges.push_back(edge);
  }
  return edges;
}

}  // namespace

DepthMap exact_coverage(const SceneView& view) {
  return render(view.scene, view.camera, {.channels = {Channel::A}}).map;
}

CoverageBySamples measure_coverage_by_samples(const SceneView& view, const DepthMap& exact,
                                              const std::function<void(double)>& tick) {
  CoverageBySamples measured;
  for (const char* pattern : patterns) {
    measured.patterns.push_back(measure(view, exact, pattern));
    if (measured.patterns[0].partial == 0) throw UsageError("no pixel is partly covered");
    tick(static_cast<double>(measured.patterns.size()) / static_cast<double>(std::size(patterns)));
  }
  measured.edges = measure_edges();
  return measured;
}

}  // namespace fathom::studies
