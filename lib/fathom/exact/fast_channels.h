#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <vector>

#include "fathom/exact/channels.h"
#include "fathom/exact/fast_rays.h"
#include "fathom/exact/fast_referee.h"
#include "fathom/exact/fast_wide.h"

namespace fathom {

/// A visible surface at a pixel, as a tile knows it. q: see ImageVertex; |q − exact q| ≤ q_error,
/// +∞ or NaN where nothing is known.
struct VisibleSurface {
  std::size_t pixel = 0;  // row · width + column
  std::uint32_t triangle = 0;
  std::uint32_t column = 0, row = 0;
  double q = 0, q_error = 0;
};

/// Writes every channel of the specification, section 6, by certified floating point: a value
/// comes with a proved bound of its error, and is written where all numbers that the bound allows
/// round to the same one. Tiers, each asked where the one before does not settle a value:
///   binary64      from the tile's q (Z, distance, P) or from the triangle (N, bary);
///   double-words  from the triangle; Zlow and binary64 output begin here;
///   constants     depth or a world coordinate is exactly the same at the three corners, or a
///                 value is proved to be exactly 0, or a depth to be a binary32 number, because
///                 its numerator is a multiple of a power of two above its bound;
///   exact         ChannelWriter, that value alone.
/// One for each thread: it remembers the triangles that it was asked about last.
class CertifiedWriter {
 public:
  CertifiedWriter(ChannelWriter& exact, const SceneRays& rays);

  /// Returns what is wrong if the encoding cannot hold the depth. `statistics.rounding` counts
  /// values.
  std::optional<EncodingFault> write(const VisibleSurface& surface, Referee& referee,
                                     RenderStatistics& statistics);

 private:
  /// A triangle remembered, with what was computed of it so far.
  struct Triangle {
    std::uint32_t number = no_surface;
    bool usable = false;
    bool has_weights = false, has_depth = false, has_normal = false;
    std::uint8_t constants_known = 0;  // bit k: constant[k] was looked for
    TriangleOrigin origin;
    const ObjectRays* object = nullptr;
    MeshTriangle corners;
    std::array<float, 3> normal;
    /// World x, y, z and depth, where they are found to be the same at all three corners.
    std::array<std::optional<WordPair>, 4> constant;
    WeightForms<double> weights;
    DepthForms<WordPair> depth;
  };
  class Pixel;

  Triangle& remember(std::uint32_t number);

  ChannelWriter& exact_;
  const ChannelValues values_;
  const SceneRays& rays_;
  const WideArithmetic& wide_;
  ImageBounds image_;
  RaySizes world_sizes_;
  std::vector<Triangle> remembered_;
};

}  // namespace fathom
