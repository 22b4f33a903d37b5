#pragma once

#include <cstdint>
#include <span>

#include "fathom/camera/camera.h"
#include "fathom/image/depth_map.h"
#include "fathom/image/sample_pattern.h"
#include "fathom/numeric/ratio.h"
#include "fathom/rendering/options.h"
#include "fathom/scene/triangle_source.h"

namespace fathom {

/// The input of coverage. A view: scene and camera must outlive it.
struct CoverageFrame {
  TriangleSource triangles;
  const Camera& camera;
  Cull cull = Cull::none;
};

/// Channel A at a pixel (specification, section 6): the area of a union, over the triangles in
/// `triangles` that culling keeps: of the parts of the pixel square to which their points with D >
/// 0 and near ≤ D ≤ far project. `triangles` may include triangles that miss the pixel.
///
/// Unit     the pixel's area: in [0, 1]. Column and row are counted from 0 at the top left.
/// Exact    always, by convex_union.h. A triangle with Δ = 0 projects to an empty set. A triangle
///          that reaches behind the camera projects to the set given by its edge functions (section
///          4), which needs no clipping at W = 0.
/// Fails    InputError if the camera or one of the triangles has a fault (find_fault); the rest of
///          the scene is not checked. std::out_of_range if no triangle has the number.
Ratio pixel_coverage(const CoverageFrame& frame, std::span<const std::uint32_t> triangles,
                     std::uint32_t column, std::uint32_t row);

/// That area rounded once to binary32; faster, because a bound mostly settles the rounding.
/// Fails    as pixel_coverage().
float rounded_pixel_coverage(const CoverageFrame& frame, std::span<const std::uint32_t> triangles,
                             std::uint32_t column, std::uint32_t row);

/// Adds the channel `Asampled` (FLOAT) to a map: the fraction of the samples of each pixel at which
/// a triangle counts (specification, sections 4 and 5). `A` as it would be if a pixel consisted of
/// its samples.
///
/// Exact    the fractions are multiples of 1/256 or of fewer parts, and each sample is decided
///          exactly: by bounds first, or for the reference engine by exact numbers alone.
/// Fails    InputError where map, scene or camera has a fault (find_fault), or the map is not of
///          the camera's size; UsageError for a pattern that sample_pattern() does not make.
/// Needs    in `options` the engine, culling and threads with which the map was rendered.
void add_sampled_coverage(DepthMap& map, const TriangleSource& triangles, const Camera& camera,
                          const SamplePattern& pattern, const RenderOptions& options);

}  // namespace fathom
