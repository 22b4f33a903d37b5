#pragma once

#include <array>

#include "fathom/depth_format/encode.h"

/// A graphics pipeline's computation of a depth before it is stored: matrices, transform, division
/// and interpolation in binary32, each operation rounded (specification, section 9). Every source
/// of error can be switched off and is then computed exactly. So a study can separate the sources;
/// with all of them off the model is ideal.
///
/// Depth is along the view, z forward, as in Direct3D and Vulkan; OpenGL's z, which points
/// backward, only changes signs, which do not affect rounding to nearest.
namespace fathom {

/// Which steps round to binary32 after every operation; `storage` rounds to the depth format.
struct PipelineRounding {
  bool matrix = true;         ///< entries of the matrices, and the products that make them
  bool transform = true;      ///< products and sums of matrix times vector
  bool division = true;       ///< z_clip / w_clip, and OpenGL's step from [−1, 1] to [0, 1]
  bool interpolation = true;  ///< between the window depths of vertices
  bool storage = true;
};

/// The third row of a view matrix: depth = x·row[0] + y·row[1] + z·row[2] + row[3].
using ViewRow = std::array<double, 4>;
inline constexpr ViewRow identity_view{0, 0, 1, 0};

struct PipelineModel {
  /// standard, reversed, infinite, reversed-infinite or opengl.
  DepthFormat format;
  ViewRow view = identity_view;
  /// Whether view and projection are first multiplied into one matrix, or applied one by one.
  bool premultiplied = false;
  PipelineRounding rounding;
};

/// A vertex in the world, in scene units, binary32 as in a vertex buffer.
using Vertex = std::array<float, 3>;

/// The vertex's depth: the view applied exactly, its entries not rounded.
Ratio exact_depth(const PipelineModel& model, const Vertex& vertex);

/// The window depth of a vertex, in [0, 1] between near and far. A binary32 number if division
/// rounds.
/// Fails    UsageError if the mapping is not a projection, or a number exceeds binary32's range.
Ratio window_depth(const PipelineModel& model, const Vertex& vertex);

/// The window depth at a point between vertices a and b whose image lies a fraction t of the way
/// from a's image to b's: z_a + t·(z_b − z_a), with t rounded if interpolation rounds.
Ratio interpolated_window_depth(const PipelineModel& model, const Vertex& a, const Vertex& b,
                                const Ratio& t);

/// The stored value of a window depth, limited to [0, 1]: a number that can be compared with other
/// numbers of the same model, in the order of the window depths.
Ratio stored_number(const PipelineModel& model, const Ratio& window_depth);

}  // namespace fathom
