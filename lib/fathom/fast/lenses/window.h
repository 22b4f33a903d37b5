#pragma once

#include <cstdint>

#include "fathom/fast/lenses/places.h"
#include "fathom/fast/setup/setup.h"
#include "fathom/geometry/frames.h"
#include "fathom/numeric/standard_arithmetic.h"

// Constants of the bounds of samples that lie anywhere in a window; their derivations are where
// they are used. validation/proofs/ proves each, in the file that is named beside it.
namespace fathom::fast::lens_bounds {

/// The extent of a tile is taken to be so much greater in setup_bounds::lane_error, because places
/// are rounded to binary32, too (lens_value).
inline constexpr double lane_extent = 1.25;
/// What the sum of a place and a shift may err by (lens_window).
inline constexpr double window_rounding = 0x1p15 * unit_roundoff<double>;
/// A view's box of places is greater by so much of its coordinates than the exact one (lens_range).
inline constexpr double range_room = 0x1p-29;
/// Errors of places are multiplied by that, which covers the roundings of later bounds
/// (lens_moved_q).
inline constexpr double place_room = 1 + 0x1p-10;
/// Errors of places beyond it are too great for the bounds of triangles, for the margin of a tile's
/// area and for that of rectangles.
inline constexpr double greatest_error = 0x1p-12;
/// Rectangles around triangles are greater by that and by so much of their coordinates: samples and
/// corners are rounded to binary32 (lens_rectangle).
inline constexpr double rectangle_margin = 0x1p-9, rectangle_rounding = 0x1p-20;

}  // namespace fathom::fast::lens_bounds

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
