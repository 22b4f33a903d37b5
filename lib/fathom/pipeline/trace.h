#pragma once

#include <optional>
#include <vector>

#include "fathom/pipeline/fragments/fragment.h"
#include "fathom/pipeline/fragments/shading.h"
#include "fathom/pipeline/geometry/painters_algorithm.h"
#include "fathom/pipeline/output/output_merger.h"

/// One primitive on its way through the pipeline: the input and the output of each stage.
namespace fathom::pipeline {

enum class PrimitiveKind { triangle, line, point };

struct CornerTrace {
  std::array<double, 3> mesh, world, eye;
  std::array<double, 4> clip;
};

/// A corner of the clipped primitive.
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
  /// If the sample is covered: whether the triangle shows the side away from its normals, the light
  /// at the sample, and its colour.
  bool turned = false;
  Light light;
  Colour colour{};
};

/// A fragment after scan conversion and shading, as passed to the output merger.
struct FragmentTrace {
  Pixel pixel;
  double window_z = 0, depth = 0;
  StoredDepth stored;
  Colour colour{};
};

struct PrimitiveTrace {
  PrimitiveKind kind = PrimitiveKind::triangle;
  std::uint32_t number = 0;                ///< in the scene
  std::vector<CornerTrace> corners;        ///< three, two or one, by kind
  std::vector<WindowCornerTrace> polygon;  ///< after clipping; empty if clipped away
  /// The results of the three tests of a triangle; if it was clipped, for the first three of its
  /// remaining corners.
  Facing in_world{}, in_ndc{}, in_window{};
  bool culled = false;
  /// Number of fragments in the viewport and the scissor box, over all parts of the primitive.
  std::uint64_t fragments = 0;
  std::vector<FragmentTrace> fragment_list;  ///< if requested, part by part, row by row
  std::optional<SampleTrace> sample;         ///< of a triangle, at the pixel
  /// The steps of the output merger at the pixel, if requested: for every fragment of the whole
  /// scene, in drawing order, including fragments that fail a test.
  std::vector<MergeStep> merger;
  /// The painter's order of the whole scene, if it is painted and the order was requested.
  PainterTrace painter;
  double near = 0, far = 0;
  Storage storage = Storage::float32;  ///< of the depth buffer
};

/// What to trace in addition to the primitive itself.
struct TraceRequest {
  std::optional<Pixel> pixel;
  bool fragments = false;  ///< the list of fragments
  bool merger = false;     ///< the output merger at the pixel: draws the whole scene there
  bool painter = false;    ///< the painter's order of the whole scene
};

/// Traces a primitive. Triangles are numbered first, then the lines and points of the files, as in
/// the channel id. Lines and points are clipped, divided and drawn as lines and points; they have
/// no facing.
/// Fails    UsageError if there is no such primitive; InputError as render_frame().
PrimitiveTrace trace_primitive(const Scene& scene, const Camera& camera,
                               const PipelineOptions& options, std::uint32_t number,
                               const TraceRequest& request);

/// Traces a triangle, without fragments, output merger and painter's order.
/// Fails    UsageError if no triangle has this number.
PrimitiveTrace trace_triangle(const Scene& scene, const Camera& camera,
                              const PipelineOptions& options, std::uint32_t number,
                              const std::optional<Pixel>& pixel);

}  // namespace fathom::pipeline
