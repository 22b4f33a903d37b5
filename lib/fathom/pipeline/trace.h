#pragma once

#include <optional>

#include "fathom/pipeline/fragments/depth_test.h"
#include "fathom/pipeline/fragments/shading.h"

/// One triangle followed through the pipeline: what enters each stage and what leaves it.
namespace fathom::pipeline {

struct CornerTrace {
  std::array<double, 3> mesh, world, eye;
  std::array<double, 4> clip;
};

/// A corner of what clipping has left.
struct WindowCornerTrace {
  std::array<double, 4> clip;
  std::array<double, 3> ndc, window;
  std::array<double, 2> snapped;
};

/// One sample of the triangle, at the centre of a pixel.
struct SampleTrace {
  std::array<double, 3> edges;  ///< e_A, e_B, e_C in square pixels
  bool covered = false;
  bool drawable = true;                     ///< within the viewport and the scissor box
  std::array<double, 3> weights;            ///< λ
  std::array<double, 3> attribute_weights;  ///< (λ/w)/Σ(λ/w), or λ where interpolation is affine
  double window_z = 0, depth = 0;
  StoredDepth stored;
  /// If it is covered: whether the triangle shows the side away from its normals, the light there,
  /// and the colour.
  bool turned = false;
  Light light;
  Colour colour{};
};

struct TriangleTrace {
  std::array<CornerTrace, 3> corners;
  std::vector<WindowCornerTrace> polygon;  ///< after clipping; empty if nothing is left
  /// The three tests; for triangles that were clipped, of the first three corners that are left.
  Facing in_world{}, in_ndc{}, in_window{};
  bool culled = false;
  /// Number of centres in the viewport and the scissor box that it covers, over all its parts.
  std::uint64_t fragments = 0;
  std::optional<SampleTrace> sample;
  double near = 0, far = 0;
};

/// Fails    UsageError if there is no such triangle; InputError as render_frame().
TriangleTrace trace_triangle(const Scene& scene, const Camera& camera,
                             const PipelineOptions& options, std::uint32_t number,
                             const std::optional<Pixel>& pixel);

}  // namespace fathom::pipeline
