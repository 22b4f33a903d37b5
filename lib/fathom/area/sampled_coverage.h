#pragma once

#include "fathom/camera/camera.h"
#include "fathom/image/depth_map.h"
#include "fathom/image/sample_pattern.h"
#include "fathom/rendering/options.h"
#include "fathom/scene/triangle_source.h"

namespace fathom {

/// Adds the channel `Asampled` (FLOAT) to a map: the fraction of the samples of each pixel at which
/// a triangle counts (specification, sections 4 and 5). What `A` would be if a pixel consisted of
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
