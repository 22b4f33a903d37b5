#pragma once

#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "apps/study/study.h"
#include "fathom/image/depth_map.h"

/// Coverage by samples against the exact area `A`.
namespace fathom::studies {

/// How far the shares of a pattern are from the exact areas, over the pixels that are partly
/// covered.
struct PatternError {
  std::string pattern;
  std::size_t samples;
  std::uint64_t partial = 0;       ///< pixels with 0 < A < 1
  std::uint64_t seen_partial = 0;  ///< of these, with 0 < share < 1
  double mean = 0, root_mean_square = 0, greatest = 0;
  /// Σ share − Σ A over them, in pixels.
  double bias = 0;
};

/// Exercise 6: the pixels of an edge that are partly covered, exactly and as samples see it.
struct EdgeSeen {
  double slope;
  std::uint64_t partial = 0;
  std::vector<std::uint64_t> seen;  ///< by 1, 2, 4, 8 samples
  /// Root mean square error of each of edge_patterns.
  std::vector<double> root_mean_square;
};

/// Patterns of 4 and of 16 samples, whose errors along an edge are compared.
inline constexpr const char* edge_patterns[] = {"4", "rotated-grid", "regular:2", "16",
                                                "regular:4"};

struct CoverageBySamples {
  std::vector<PatternError> patterns;
  std::vector<EdgeSeen> edges;
};

/// Channel A of the view: the truth that patterns are held against.
DepthMap exact_coverage(const SceneView& view);

/// Fails    UsageError where no pixel of `exact`, which is exact_coverage(view), is partly covered.
CoverageBySamples measure_coverage_by_samples(const SceneView& view, const DepthMap& exact,
                                              const std::function<void(double)>& tick);

}  // namespace fathom::studies
