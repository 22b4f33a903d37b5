#pragma once

#include <array>
#include <cstdint>
#include <optional>

#include "fathom/exact/fast_vertex.h"
#include "fathom/exact/projected_triangle.h"

namespace fathom {

/// A triangle ready for sampling: affine functions on the image with bounds of their errors.
///
/// The value of a function at the sample of pixel (i, j) is (c + b·y) + a·x with x = i − column,
/// y = j − row. The bounds hold for the samples of the box that the setup was made for, with any
/// of the products and sums fused or not.
struct TriangleSetup {
  std::uint32_t number = 0;
  std::uint32_t column = 0, row = 0;
  /// Edge functions, scaled, their inside positive. Computed and exact value (with the same
  /// scaling) differ by at most edge_error.
  std::array<double, 3> edge_a, edge_b, edge_c;
  double edge_error = 0;
  /// q (see ImageVertex). Where the triangle covers the sample, computed and exact value differ by
  /// at most q_error, which leaves out 2⁻²⁰ of itself as room for the user's roundings; +∞: nothing
  /// is known.
  double q_a = 0, q_b = 0, q_c = 0;
  float q_error = 0;
};

/// The sign of a triangle's doubled area in the image, which is sign(Δ); nullopt: not certain.
/// All corners usable.
std::optional<Sign> certified_orientation(const ImageVertex& A, const ImageVertex& B,
                                          const ImageVertex& C);

/// The pixels whose samples the triangle can cover, within a width × height image. All corners
/// usable.
PixelBox sample_box(const ImageVertex& A, const ImageVertex& B, const ImageVertex& C,
                    std::uint32_t width, std::uint32_t height);

/// False where the triangle is too thin for the bounds: then take exact_setup. All corners usable,
/// their orientation certain; `box` not empty.
bool certified_setup(const ImageVertex& A, const ImageVertex& B, const ImageVertex& C,
                     const PixelBox& box, TriangleSetup& setup);

/// From exact forms; works for every triangle with Δ ≠ 0, also one that reaches behind the camera.
TriangleSetup exact_setup(const ProjectedTriangle& triangle, bool perspective, const PixelBox& box);

}  // namespace fathom
