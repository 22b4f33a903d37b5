#pragma once

#include <optional>
#include <vector>

#include "fathom/pipeline/fragments/fragment.h"
#include "fathom/pipeline/fragments/shading.h"
#include "fathom/pipeline/geometry/painters_algorithm.h"
#include "fathom/pipeline/output/output_merger.h"

/// One primitive followed through the pipeline: what enters each stage and what leaves it.
namespace fathom::pipeline {

enum class PrimitiveKind { triangle, line, point };

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

/// A fragment as scan conversion and shading make it, on its way to the output merger.
struct FragmentTrace {
  Pixel pixel;
  double window_z = 0, depth = 0;
  StoredDepth stored;
  Colour colour{};
};

struct PrimitiveTrace {
  PrimitiveKind kind = PrimitiveKind::triangle;
  std::uint32_t number = 0;                ///< in the scene
  std::vector<CornerTrace> corners;        ///< three, two or one
  std::vector<WindowCornerTrace> polygon;  ///< after clipping; empty if nothing is left
  /// Of triangles: the three tests; for those that were clipped, of the first three corners that
  /// are left.
  Facing in_world{}, in_ndc{}, in_window{};
  bool culled = false;
  /// Number of fragments in the viewport and the scissor box, over all parts of the primitive.
  std::uint64_t fragments = 0;
  std::vector<FragmentTrace> fragment_list;  ///< if it was asked for, part by part, row by row
  std::optional<SampleTrace> sample;         ///< of a triangle, at the pixel
  /// What the output merger did at the pixel, fragment by fragment of the whole scene, in drawing
  /// order, if it was asked for. Those that fail a test are among them.
  std::vector<MergeStep> merger;
  /// Of the whole scene, if it is painted and was asked for.
  PainterTrace painter;
  double near = 0, far = 0;
  Storage storage = Storage::float32;  ///< of the depth buffer
};

/// What a trace looks at besides the primitive itself.
struct TraceRequest {
  std::optional<Pixel> pixel;
  bool fragments = false;  ///< the list of fragments
  bool merger = false;     ///< the output merger at the pixel: draws the whole scene there
  bool painter = false;    ///< the painter's order of the whole scene
};

/// Follows a primitive: triangles are numbered first, then the lines and points of the files, as in
/// the channel id. Lines and points are clipped, divided and drawn as such; they face no side.
/// Fails    UsageError if there is no such primitive; InputError as render_frame().
PrimitiveTrace trace_primitive(const Scene& scene, const Camera& camera,
                               const PipelineOptions& options, std::uint32_t number,
                               const TraceRequest& request);

/// The same of a triangle, without fragments, output merger and painter's order.
/// Fails    UsageError if the number is not that of a triangle.
PrimitiveTrace trace_triangle(const Scene& scene, const Camera& camera,
                              const PipelineOptions& options, std::uint32_t number,
                              const std::optional<Pixel>& pixel);

}  // namespace fathom::pipeline
