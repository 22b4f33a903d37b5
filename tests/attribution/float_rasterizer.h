#pragma once

#include <optional>

#include "fathom/attribution/model/renderer_input.h"
#include "fathom/attribution/model/renderer_model.h"
#include "fathom/attribution/other_map.h"

namespace fathom::test {

/// What is wrong with a renderer, on purpose.
struct Fault {
  double shift_x = 0, shift_y = 0;  ///< of the samples, in pixels
  std::optional<std::uint32_t> missing_triangle;
  bool affine = false;          ///< depth, not window depth, is interpolated linearly
  bool last_of_equals = false;  ///< the depth test lets equals win
  int bias_codes = 0;           ///< of the storage
  double k1 = 0, k2 = 0;        ///< radial distortion of the lens, of rays only
};

/// A rasterizer in binary32 that is what a raster model with a known matrix describes, whole
/// triangles only: for tests to make faulty. Corners to 2⁻⁸ pixel, window depth from a plane per
/// triangle, unorm or binary32.
attribution::OtherMap draw_in_binary32(const attribution::WorldMesh& mesh, const Camera& camera,
                                       const attribution::RendererModel& model,
                                       const Fault& fault = {});

/// Möller and Trumbore's test in binary32, one ray a pixel, brute force.
attribution::OtherMap trace_in_binary32(const attribution::WorldMesh& mesh, const Camera& camera,
                                        const Fault& fault = {});

}  // namespace fathom::test
