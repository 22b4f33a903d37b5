#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

#include "fathom/camera/camera.h"
#include "fathom/fast/lenses/view_axes.h"
#include "fathom/fast/pixels/surface_values.h"
#include "fathom/lens/direction_words.h"
#include "fathom/rendering/channel_values.h"

namespace fathom::fast {

/// The channels for which binary64 has too few bits, along the rays of a lens, as far as
/// double-words settle them: Zlow, and Z and distance in binary64.
///
/// Method   A window is a pinhole that sees these rays. The depth D in it is that of a pinhole at a
///          point between the samples, known in double-words. At the place (x, y) of a ray,
///          distance = D·√(x² + y² + 1), and Z is D, D·x or D·y with a sign, for the axis of the
///          view that is the camera's z axis.
/// Exact    a value is stored only if its bound settles how the exact number is rounded.
class WideValues {
 public:
  /// `rays` are the window's; both outlive it.
  WideValues(const triangle::SceneRays& rays, const Camera& window, const ViewAxes& axes)
      : frame_(rays), window_(window), axes_(axes) {}

  /// Whether a channel is requested that it writes.
  [[nodiscard]] static bool are_wanted(const rendering::ChannelValues& values) {
    return values.low || values.depth.binary64 || values.distance.binary64;
  }

  /// Begins a tile that has surfaces at places below `end_of_places`.
  void start(std::size_t end_of_places);
  /// Writes these channels at a pixel that sees a triangle, at a place of the tile, along a
  /// direction. False where one of them is not settled: the pixel then has to be written from exact
  /// numbers.
  [[nodiscard]] bool write(std::size_t pixel, std::size_t place, std::uint32_t triangle,
                           const lens::DirectionWords& direction,
                           const rendering::ChannelValues& values);

 private:
  ValueFrame frame_;
  const Camera& window_;
  ViewAxes axes_;
  /// By places; made on first use.
  std::vector<std::optional<SurfaceFacts>> surfaces_;
};

}  // namespace fathom::fast
