#pragma once

#include <cstdint>
#include <span>

#include "fathom/camera/camera.h"
#include "fathom/numeric/ratio.h"
#include "fathom/scene/triangle_source.h"
#include "fathom/triangle/options.h"

namespace fathom {

/// What coverage is of. A view: scene and camera must stay.
struct CoverageFrame {
  TriangleSource triangles;
  const Camera& camera;
  Cull cull = Cull::none;
};

/// Channel A at a pixel (specification, section 6): the area of the union, over those of
/// `triangles` that culling keeps, of the part of the pixel square that their points with D > 0 and
/// near ≤ D ≤ far project to. In [0, 1]. Triangles that miss the pixel may be among them.
///
/// Exact    always, by convex_union.h. A triangle with Δ = 0 projects to nothing; one that reaches
///          behind the camera projects to what its edge functions say (section 4), which needs no
///          clipping at W = 0.
/// Needs    a camera without fault; numbers of triangles of the scene.
Ratio pixel_coverage(const CoverageFrame& frame, std::span<const std::uint32_t> triangles,
                     std::uint32_t column, std::uint32_t row);

/// That area rounded once to binary32; faster, for a bound mostly settles the rounding.
float rounded_pixel_coverage(const CoverageFrame& frame, std::span<const std::uint32_t> triangles,
                             std::uint32_t column, std::uint32_t row);

}  // namespace fathom
