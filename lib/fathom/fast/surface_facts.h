#pragma once

#include <array>
#include <cstdint>
#include <optional>

#include "fathom/triangle/certified_surface.h"
#include "fathom/triangle/double_word_surface.h"
#include "fathom/triangle/rays.h"

namespace fathom::fast {

/// What the values of all surfaces are computed with.
struct ValueFrame {
  explicit ValueFrame(const triangle::SceneRays& its_rays);

  const triangle::SceneRays& rays;
  const triangle::WideArithmetic& wide;
  triangle::ImageBounds image;
  triangle::RaySizes world_sizes;
};

/// A triangle that is visible, with what was found out about it so far. Functions that find out more
/// keep it here.
struct SurfaceFacts {
  /// False where a number is of a magnitude for which no bound was derived: nothing but exact numbers
  /// will do.
  bool usable = false;
  TriangleOrigin origin;
  const triangle::ObjectRays* object = nullptr;
  triangle::MeshTriangle corners;

  std::optional<triangle::WeightForms<double>> weights;
  std::optional<triangle::DepthForms<WordPair>> depth;
  /// The normal as it is written.
  std::optional<std::array<float, 3>> normal;
  /// World x, y, z and depth, where they are found to be the same at all three corners; bit k of
  /// constants_known: constants[k] was looked for.
  std::array<std::optional<WordPair>, 4> constants;
  std::uint8_t constants_known = 0;
};

/// A triangle of the scene of which nothing more is known.
SurfaceFacts surface_facts(std::uint32_t number, const ValueFrame& frame);

const triangle::WeightForms<double>& weights_of(SurfaceFacts& t, const ValueFrame& frame);
const triangle::DepthForms<WordPair>& depth_of(SurfaceFacts& t, const ValueFrame& frame);

/// World coordinate k, or the depth (3), where it is the same number at all corners and found to be
/// so.
const std::optional<WordPair>& constant_of(SurfaceFacts& t, std::size_t k);

}  // namespace fathom::fast
