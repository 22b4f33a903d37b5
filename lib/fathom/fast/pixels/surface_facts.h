#pragma once

#include <array>
#include <cstdint>
#include <optional>

#include "fathom/triangle/certified_surface.h"
#include "fathom/triangle/double_word_surface.h"
#include "fathom/triangle/rays.h"

namespace fathom::fast {

/// What the values of all surfaces are computed from.
struct ValueFrame {
  explicit ValueFrame(const triangle::SceneRays& its_rays);

  const triangle::SceneRays& rays;
  const triangle::WideArithmetic& wide;
  triangle::ImageBounds image;
  triangle::RaySizes world_sizes;
};

/// The normals of a triangle's corners in the world, as they are interpolated: that of A, and what
/// those of B and C have beyond it.
struct SurfaceNormals {
  Vector<Certified<double>> at_A, to_B, to_C;
};

/// A visible triangle, with what has been found out about it so far. Functions that find out more
/// keep it here.
struct SurfaceFacts {
  /// False if a number has a magnitude for which no bound was derived: only exact numbers will do.
  bool usable = false;
  TriangleOrigin origin;
  const triangle::ObjectRays* object = nullptr;
  triangle::MeshTriangle corners;

  std::optional<triangle::WeightForms<double>> weights;
  std::optional<triangle::DepthForms<WordPair>> depth;
  /// The normals as they are written, in the world and in the camera frame.
  std::optional<std::array<float, 3>> normal, camera_normal;
  std::optional<SurfaceNormals> corner_normals;
  /// Exponents of powers of two of which the components of these are multiples.
  std::optional<std::array<long, 3>> normal_bits;
  /// World x, y, z and depth, if they are found to be the same at all three corners; bit k of
  /// constants_known: constants[k] was looked for.
  std::array<std::optional<WordPair>, 4> constants;
  std::uint8_t constants_known = 0;
};

/// A triangle of the scene about which nothing more is known yet.
SurfaceFacts surface_facts(std::uint32_t number, const ValueFrame& frame);

const triangle::WeightForms<double>& weights_of(SurfaceFacts& t, const ValueFrame& frame);
const triangle::DepthForms<WordPair>& depth_of(SurfaceFacts& t, const ValueFrame& frame);

/// World coordinate k, or the depth (3), if it is found to be the same number at all corners.
const std::optional<WordPair>& constant_of(SurfaceFacts& t, std::size_t k);

}  // namespace fathom::fast
