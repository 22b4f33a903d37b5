#pragma once

#include <array>
#include <cstdint>
#include <optional>

#include "fathom/camera/camera.h"
#include "fathom/fast/vertices/vertex.h"
#include "fathom/triangle/double_word_referee.h"
#include "fathom/triangle/projected_triangle.h"

namespace fathom::fast {

/// The depths that count (specification, section 5: D > 0, near ≤ D ≤ far) as a range of q (see
/// ImageVertex), with doubt at its ends: exact q in [inside_least, inside_greatest] certainly
/// counts; q < outside_least or q > outside_greatest certainly does not.
struct DepthRange {
  double inside_least, inside_greatest;
  double outside_least, outside_greatest;

  [[nodiscard]] bool certainly_contains(double q_least, double q_greatest) const {
    return q_least >= inside_least && q_greatest <= inside_greatest;
  }
  [[nodiscard]] bool certainly_misses(double q_least, double q_greatest) const {
    return q_greatest < outside_least || q_least > outside_greatest;
  }
};

DepthRange depth_range(const Camera& camera);

}  // namespace fathom::fast

namespace fathom::triangle {
class Referee;
}

namespace fathom::fast {

/// A triangle ready for sampling: affine functions on the image with bounds on their errors.
///
/// The value of a function at the sample of pixel (i, j) is c + a·x + b·y, summed in any order,
/// with x = i − column, y = j − row. The bounds hold for the samples of the box for which the setup
/// was made and for up to 8 samples beyond it on each side, whether products and sums are fused or
/// not.
struct TriangleSetup {
  std::uint32_t number = 0;
  std::uint32_t column = 0, row = 0;
  /// Edge functions, scaled, positive inside. Their computed and exact values (with the same
  /// scaling) differ by at most edge_error. If all corners lie exactly on the grid of snap_step,
  /// the functions are moved by less than the least positive value that they have at a sample, so
  /// that they are never 0 and their signs follow the top-left rule, without error.
  std::array<double, 3> edge_a, edge_b, edge_c;
  double edge_error = 0;
  /// q (see ImageVertex). Where the triangle covers the sample, its computed and exact values
  /// differ by at most q_error, less 2⁻²⁰ of it as room for the user's roundings; +∞ if unknown.
  double q_a = 0, q_b = 0, q_c = 0;
  double q_error = 0;
};

/// As many triangles as vector lanes work on at once, one array for each number of a setup.
struct SetupBatch {
  static constexpr std::size_t most = 8;
  using Numbers = std::array<double, most>;

  alignas(64) std::array<Numbers, 3> edge_a;
  alignas(64) std::array<Numbers, 3> edge_b;
  alignas(64) std::array<Numbers, 3> edge_c;
  alignas(64) Numbers edge_error;
  alignas(64) Numbers q_a;
  alignas(64) Numbers q_b;
  alignas(64) Numbers q_c;
  alignas(64) Numbers q_error;
  /// The samples that the triangle may cover within the given area; integers.
  alignas(64) Numbers first_column;
  alignas(64) Numbers last_column;
  alignas(64) Numbers first_row;
  alignas(64) Numbers last_row;
  std::array<std::uint32_t, most> number;
  /// A bit for each lane: the box has no sample; the triangle needs exact_setup(); its depths may
  /// leave the range that counts; its corners lie exactly on the grid of snap_step.
  unsigned empty, refused, test_range, snapped;

  [[nodiscard]] PixelBox box(std::size_t lane) const;
  [[nodiscard]] TriangleSetup get(std::size_t lane) const;
  /// `box` becomes the lane's box; the setup must have been made for it.
  void set(std::size_t lane, const TriangleSetup& setup, const PixelBox& box);
};

/// The sign of a triangle's doubled area in the image, which is sign(Δ); nullopt if uncertain.
/// Needs    usable corners.
std::optional<Sign> certified_orientation(const ImageVertex* vertices,
                                          const CornerIndices& triangle);

/// Prepares up to SetupBatch::most triangles (corners index `vertices`) for the samples of `area`.
/// Triangles that have an unusable corner or are too thin for the bounds are refused.
void certified_setups(const ImageVertex* vertices, const CornerIndices* triangles,
                      std::size_t count, const PixelBox& area, const DepthRange& range,
                      SetupBatch& batch);

/// The kind of vector instructions that the vector code of this module uses on this machine, by
/// Highway's name.
const char* vector_target();

/// Sets up a triangle from exact forms; works for every triangle with Δ ≠ 0, even if it reaches
/// behind the camera.
TriangleSetup exact_setup(const triangle::ProjectedTriangle& triangle, bool perspective,
                          const PixelBox& box);
/// The same from double-words, under a perspective camera; nullopt if their bounds do not decide on
/// which side of its plane the camera is, or are far from the bounds of exact numbers.
std::optional<TriangleSetup> wide_setup(const triangle::WideForms& forms, std::uint32_t number,
                                        const PixelBox& box);
/// The same for a numbered triangle, if it has such forms.
std::optional<TriangleSetup> wide_setup(triangle::Referee& referee, std::uint32_t number,
                                        const PixelBox& box);
/// The setup for the samples of a part of the box for which `exact_setup` was made.
TriangleSetup moved_to(const TriangleSetup& exact_setup, const PixelBox& part);

}  // namespace fathom::fast
