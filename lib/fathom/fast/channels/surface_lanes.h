#pragma once

#include <array>
#include <cstdint>
#include <span>

#include "fathom/fast/channels/channel_rows.h"
#include "fathom/fast/pixels/surface_values.h"

// The binary64 tier of the properties of visible triangles that channels need, for several
// triangles at once. triangle/certified_surface.h does the same for one triangle and gives the
// proofs.
namespace fathom::fast {

/// Visible triangles of one object: one array for each number.
struct TriangleLanes {
  static constexpr std::size_t most = 8;
  using Numbers = std::array<double, most>;

  /// By corner and coordinate, in the mesh.
  alignas(64) std::array<std::array<Numbers, 3>, 3> corners{};
  /// A sample at which it is visible.
  alignas(64) Numbers u{}, v{};
};

/// A unit normal, padded to four numbers so that it can be loaded at once.
using NormalOfSurface = std::array<float, 4>;

/// Computes the normals of such triangles in the world, or in the camera frame, turned towards the
/// camera. Returns a bit for each lane whose three numbers are settled.
/// Needs    a usable object and a usable world; for the camera frame, usable camera normals.
unsigned round_normals(const TriangleLanes& triangles, const triangle::ObjectRays& object,
                       const ValueFrame& frame, bool in_camera_frame, NormalOfSurface* normals);

/// c + b·v + a·u with a bound on its error.
struct alignas(32) LaneForm {
  double c, b, a, error;
};
/// The forms of WeightForms: the weights of B and of C, and the divisor. Bounds are +∞ if they were
/// not derived for the magnitudes of the corners.
struct LaneForms {
  LaneForm *B, *C, *divisor;
};
/// Needs    a usable object; room for TriangleLanes::most forms from each of the three on.
void make_weight_forms(const TriangleLanes& triangles, const triangle::ObjectRays& object,
                       const triangle::ImageBounds& image, const LaneForms& forms);

/// For each sample of a row, the index of its surface among those that are visible in the tile.
using SurfaceIndices = std::array<std::uint32_t, TileShape::size>;

/// Weights of B and of C at the samples of a row.
void round_weights(const SurfaceRow& row, const SurfaceIndices& indices, const LaneForms& forms,
                   std::array<RoundedValues<float>, 2>& rounded);

/// SurfaceNormals by component: at_A, to_B and to_C, and the bounds on their errors.
struct alignas(32) LaneShadingNormal {
  struct alignas(32) Component {
    double at_A = 0, to_B = 0, to_C = 0, error_A = 0, error_B = 0, error_C = 0;
    std::array<double, 2> unused{};
  };
  std::array<Component, 3> components;
};
/// The result is unknown if `normals` is null.
LaneShadingNormal lane_shading_normal(const SurfaceNormals* normals);

/// Interpolated normals of unit length at the samples of a row; either all three numbers of a
/// sample are settled or none. Like interpolated() and unit() in shading_normals.h.
void round_shading_normals(const SurfaceRow& row, const SurfaceIndices& indices,
                           const LaneForms& forms, const LaneShadingNormal* normals,
                           std::array<RoundedValues<float>, 3>& rounded);

/// The x, y and z of the surfaces' normals.
void take_normals(const SurfaceIndices& indices, std::span<const NormalOfSurface> normals,
                  std::array<MapRow<float>, 3>& taken);

}  // namespace fathom::fast
