#pragma once

#include <functional>
#include <optional>
#include <vector>

#include "fathom/camera/camera.h"
#include "fathom/rendering/options.h"
#include "fathom/scene/triangle_source.h"

namespace fathom {

/// Areas within the image rectangle, in pixels, each exact number rounded once to binary64.
struct VisibleArea {
  /// The area where it is the visible one.
  double visible = 0;
  /// The area where it would be visible if there were nothing else.
  double unoccluded = 0;
  /// visible / unoccluded, of the exact areas; nothing if there is no unoccluded area.
  std::optional<double> ratio;
};

/// Visible and unoccluded areas (specification, section 8) by the numbers of triangles and of
/// objects. An object's visible area is the sum of its triangles' visible areas; its unoccluded
/// area is that sum with the triangles of all other objects removed.
struct VisibleAreas {
  std::vector<VisibleArea> triangles, objects;
};

/// Computed from the triangles' outlines as a whole, not pixel by pixel: the size of the image does
/// not matter. Of the options, only culling and threads matter.
/// Exact    every area, and the ratio of exact areas; each rounded once.
/// Fails    InputError where scene or camera has a fault (find_fault).
VisibleAreas visible_areas(const TriangleSource& triangles, const Camera& camera,
                           const RenderOptions& options,
                           const std::function<void(double)>& progress = {});

}  // namespace fathom
