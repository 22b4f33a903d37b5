#pragma once

#include <cstdint>

#include "fathom/fast/lenses/places.h"
#include "fathom/fast/setup/depth_range.h"
#include "fathom/geometry/pixel_box.h"

namespace fathom::fast {

/// A camera with straight edges that stands where a camera with a lens stands, and sees the rays of
/// one of its views: an image of the view's plane at distance 1 by powers of two. What the fast
/// engine knows of straight edges holds in it; the samples of the lens lie anywhere in it.
struct Window {
  /// Needs    usable places.
  Window(const Camera& camera, const Places::View& view);

  Camera camera;
  ViewAxes axes;
  /// The q that count in the window. Of a lens whose near and far bound ray distances, those that
  /// count at all its samples, and those that count at none.
  DepthRange range;
};

/// The samples of a tile in a window, from the centre of a pixel on: (x·scale_x + shift_x, …).
struct TileInWindow {
  TileInWindow() = default;
  TileInWindow(const Window& window, const Places::OfTile& places);

  /// The pixels of the window in which the samples lie; all where they are not certain.
  PixelBox area;
  /// Whether the error is so small that the bounds of triangles are known. Otherwise all triangles
  /// are set up from exact numbers.
  bool is_certain = true;
  double scale_x = 1, scale_y = 1, shift_x = 0, shift_y = 0;
  /// A bound on the errors of both.
  double error = 0;

  [[nodiscard]] double x(double place) const { return place * scale_x + shift_x; }
  [[nodiscard]] double y(double place) const { return place * scale_y + shift_y; }
};

}  // namespace fathom::fast
