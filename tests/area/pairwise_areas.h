#pragma once

#include <optional>
#include <vector>

#include "fathom/area/surface_pairs.h"
#include "fathom/area/visible_areas.h"

/// Visible areas triangle by triangle: each is cut by every other that may hide a part of it. It
/// shares the polygons of exact lines with visible_areas(), but no parts, sheets or sweeps.
namespace fathom::checks {

/// Exact areas of a triangle.
struct PairwiseAreas {
  Ratio unoccluded;
  /// The areas of the parts that are visible, and of those visible if its object were alone.
  std::vector<Ratio> visible, in_object;
};

/// By the numbers of triangles.
std::vector<PairwiseAreas> pairwise_areas(const CoverageFrame& frame);
/// The same as visible_areas() gives it.
VisibleAreas rounded_pairwise_areas(const Scene& scene, const Camera& camera,
                                    Cull cull = Cull::none);

}  // namespace fathom::checks
