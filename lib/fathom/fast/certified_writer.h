#pragma once

#include <array>
#include <cstdint>
#include <optional>

#include "fathom/fast/channel_rows.h"
#include "fathom/triangle/channels.h"
#include "fathom/triangle/double_word_surface.h"
#include "fathom/triangle/rays.h"
#include "fathom/triangle/recent_triangles.h"
#include "fathom/triangle/referee.h"

namespace fathom {

/// A visible surface at a pixel.
struct VisibleSurface {
  std::size_t pixel = 0;  // row · width + column
  std::uint32_t triangle = 0;
  ImagePoint sample;
};

/// A row of a tile, as far as surfaces are visible in it.
struct VisibleRow {
  SurfaceRow lanes;
  /// A bit for each sample that shows a surface.
  std::uint64_t surface = 0;
  std::size_t first_pixel = 0;  // row · width + column, of the first sample

  [[nodiscard]] VisibleSurface at(std::size_t k) const {
    return {first_pixel + k,
            static_cast<std::uint32_t>(lanes.tags[k]),
            {lanes.first_u + static_cast<double>(k), lanes.v}};
  }
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

  /// Returns what is wrong if the encoding cannot hold a depth, of the first such pixel.
  /// `statistics.rounding` counts values.
  std::optional<EncodingFault> write(const VisibleRow& row, Referee& referee,
                                     RenderStatistics& statistics);

 private:
  /// A triangle remembered, with what was computed of it so far.
  struct Triangle {
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
  struct Open;

  /// id, face and object.
  void write_origins(const VisibleRow& row) const;
  /// The normal is the same at all pixels of a triangle.
  void write_normals(const VisibleRow& row, Referee& referee, RenderStatistics& statistics);
  /// Writes what follows from number and q; returns what is left.
  Open write_settled(const VisibleRow& row, RenderStatistics& statistics) const;
  std::uint64_t write_encoded(const VisibleRow& row, const EncodedValues& values, bool distance,
                              RenderStatistics& statistics) const;

  Triangle& remember(std::uint32_t number);

  ChannelWriter& exact_;
  const ChannelValues values_;
  const SceneRays& rays_;
  const WideArithmetic& wide_;
  ImageBounds image_;
  RaySizes world_sizes_;
  /// Whether a channel was asked for that is not written by rows.
  bool each_pixel_;
  RecentTriangles<Triangle, 512> remembered_;
};

}  // namespace fathom
