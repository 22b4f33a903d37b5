#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "fathom/evaluation/depth_agreement.h"
#include "fathom/evaluation/surface_distances.h"

/// The front door to the evaluation of reconstructed surfaces.
namespace fathom {

/// How a reconstruction compares with the truth.
struct Evaluation {
  /// Of the exact depth maps of all cameras; nothing without cameras, and of point clouds.
  std::optional<DepthAgreement> depth;
  SurfaceComparison surfaces;
};

/// Renders both scenes as each camera sees them and compares the depths, and compares the surfaces
/// or point clouds (compare_surfaces). Culling and threads count for both.
/// Fails    as render() and compare_surfaces()
Evaluation evaluate(const Scene& reconstruction, const Scene& truth,
                    const std::vector<Camera>& cameras,
                    const SurfaceComparisonOptions& options = {},
                    const std::function<void(double)>& progress = {});

/// The table that `fathom evaluate` prints; `options` are those of the evaluation.
std::string to_text(const Evaluation& evaluation, const SurfaceComparisonOptions& options);

}  // namespace fathom
