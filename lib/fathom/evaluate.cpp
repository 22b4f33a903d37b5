#include "fathom/evaluate.h"

#include <functional>

#include "fathom/fast/render_memory.h"
#include "fathom/numeric/standard_arithmetic.h"
#include "fathom/render.h"

namespace fathom {
namespace {

/// Reports a part of the work, from `first` to `last` of the whole.
std::function<void(double)> part_of(const std::function<void(double)>& progress, double first,
                                    double last) {
  if (!progress) return {};
  return [&progress, first, last](double share) { progress(first + share * (last - first)); };
}

DepthAgreement compare_depths(const Scene& reconstruction, const Scene& truth,
                              const std::vector<Camera>& cameras,
                              const SurfaceComparisonOptions& options,
                              const std::function<void(double)>& progress, double end) {
  RenderMemory of_truth, of_reconstruction;
  RenderOptions rendering;
  rendering.cull = options.cull;
  rendering.threads = options.threads;
  DepthAgreementSum sum;
  Rendered true_map, map;
  const double step = end / (2 * static_cast<double>(cameras.size()));
  double done = 0;
  for (const Camera& camera : cameras) {
    render_into(true_map, truth, camera, rendering,
                {.kept = &of_truth, .progress = part_of(progress, done, done + step)});
    render_into(
        map, reconstruction, camera, rendering,
        {.kept = &of_reconstruction, .progress = part_of(progress, done + step, done + 2 * step)});
    sum.add(true_map.map, map.map);
    done += 2 * step;
  }
  return sum.result();
}

}  // namespace

Evaluation evaluate(const Scene& reconstruction, const Scene& truth,
                    const std::vector<Camera>& cameras, const SurfaceComparisonOptions& options,
                    const std::function<void(double)>& progress) {
  const StandardArithmetic standard;
  require_meaningful(options);
  require_comparable(reconstruction, truth, cameras, options);
  const bool has_depths = !cameras.empty() && !is_cloud(reconstruction) && !is_cloud(truth);
  const double depths_end = has_depths ? 0.5 : 0;
  Evaluation evaluation;
  if (has_depths)
    evaluation.depth =
        compare_depths(reconstruction, truth, cameras, options, progress, depths_end);
  evaluation.surfaces =
      compare_surfaces(reconstruction, truth, cameras, options, part_of(progress, depths_end, 1));
  return evaluation;
}

}  // namespace fathom
