#pragma once

#include "fathom/fast/pixels/shading_normals.h"
#include "fathom/fast/pixels/surface_values.h"
#include "fathom/rendering/rendered.h"
#include "fathom/triangle/channels.h"
#include "fathom/triangle/referee.h"

namespace fathom::fast {

/// A visible surface at a pixel.
struct VisibleSurface {
  std::size_t pixel = 0;  // MapLayout
  std::uint32_t triangle = 0;
  ImagePoint sample;
};

/// The destination of values, and the exact writer for values that no bound settles.
struct WriterTarget {
  const rendering::ChannelValues& values;
  triangle::ChannelWriter& exact;
  triangle::Referee& referee;
  /// `rounding` counts values.
  RenderStatistics& statistics;
};

/// Writes the values of one pixel that the rows of channel_rows.h, surface_lanes.h and wide_rows.h
/// leave open.
class PixelWriter {
 public:
  PixelWriter(const VisibleSurface& surface, SurfaceFacts& facts, const ValueFrame& frame,
              const WriterTarget& target)
      : surface_(surface),
        facts_(facts),
        frame_(frame),
        target_(target),
        values_(facts, frame, surface.sample) {}

  /// The normal of the surface, in the world or in the camera frame, from any one of its pixels.
  const std::array<float, 3>& normal();
  const std::array<float, 3>& camera_normal();
  void write_shading_normal(ShadingNormals& normals);
  void write_position(std::size_t k);
  void write_barycentric(std::size_t k);
  void write_low_part();
  std::optional<triangle::EncodingFault> write_depth();
  std::optional<triangle::EncodingFault> write_distance();

 private:
  const triangle::ProjectedTriangle& projected() {
    return target_.referee.projected(surface_.triangle);
  }
  /// Each returns false, and writes and counts nothing, if no bound settles the value.
  bool settle_position(std::size_t k);
  bool settle_barycentric(std::size_t k);
  bool settle_low_part();
  bool settle_depth(const rendering::EncodedValues& values);
  bool settle_distance();
  bool settle_normal(std::array<float, 3>& normal);
  bool settle_camera_normal(std::array<float, 3>& normal);
  /// From components in binary64, and a function that gives them in double-words.
  template <class Wide>
  bool settle_components(const Vector<Certified<double>>& narrow, const Wide& make_wide,
                         std::array<float, 3>& normal);
  bool settle_shading_normal(ShadingNormals& normals);
  /// Makes a component exactly 0 that is, where that can be proved.
  void settle_zero(Certified<double>& component, std::size_t i, ShadingNormals& normals);

  void count_narrow() { ++target_.statistics.rounding.interval; }
  void count_wide() {
    ++target_.statistics.rounding.interval;
    ++target_.statistics.double_word_roundings;
  }
  void count_exact() { ++target_.statistics.rounding.exact; }

  const VisibleSurface& surface_;
  SurfaceFacts& facts_;
  const ValueFrame& frame_;
  const WriterTarget& target_;
  SurfaceValues values_;
};

}  // namespace fathom::fast
