#pragma once

#include "fathom/fast/surface_values.h"
#include "fathom/triangle/channels.h"
#include "fathom/triangle/referee.h"

namespace fathom::fast {

/// A visible surface at a pixel.
struct VisibleSurface {
  std::size_t pixel = 0;  // row · width + column
  std::uint32_t triangle = 0;
  ImagePoint sample;
};

/// What is written to, and who computes exactly what no bound settles.
struct WriterTarget {
  const triangle::ChannelValues& values;
  triangle::ChannelWriter& exact;
  triangle::Referee& referee;
  /// `rounding` counts values.
  RenderStatistics& statistics;
};

/// Writes the channels of one pixel: what the binary64 tier of channel_rows.h did not settle, or does
/// not know.
class PixelWriter {
 public:
  PixelWriter(const VisibleSurface& surface, SurfaceFacts& facts, const ValueFrame& frame,
              const WriterTarget& target)
      : surface_(surface),
        facts_(facts),
        frame_(frame),
        target_(target),
        values_(facts, frame, surface.sample) {}

  /// The normal of the surface, at whichever of its pixels.
  const std::array<float, 3>& normal();
  void write_position(std::size_t k);
  void write_barycentric(std::size_t k);
  void write_low_part();
  std::optional<triangle::EncodingFault> write_depth();
  std::optional<triangle::EncodingFault> write_distance();

 private:
  const triangle::ProjectedTriangle& projected() {
    return target_.referee.projected(surface_.triangle);
  }
  /// Each of them: false, and nothing is written or counted, where no bound settles the value.
  bool settle_position(std::size_t k);
  bool settle_barycentric(std::size_t k);
  bool settle_low_part();
  bool settle_depth(const triangle::EncodedValues& values);
  bool settle_distance();
  bool settle_normal(std::array<float, 3>& normal);

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
