#pragma once

// Constants of the bounds of samples that lie anywhere in a window; their derivations are where
// they are used. validation/proofs/ proves the first, in the file that is named beside it.
namespace fathom::fast::lens_bounds {

/// The extent of a tile is taken to be so much greater in setup_bounds::lane_error, because places
/// are rounded to binary32, too (lens_value).
inline constexpr double lane_extent = 1.25;
/// Errors of places are multiplied by that, which covers the roundings of later bounds.
inline constexpr double place_room = 1 + 0x1p-10;
/// Errors of places beyond it are too great for the bounds of triangles, for the margin of a tile's
/// area and for that of rectangles.
inline constexpr double greatest_error = 0x1p-12;
/// Rectangles around triangles are greater by that and by so much of their coordinates: samples and
/// corners are rounded to binary32.
inline constexpr double rectangle_margin = 0x1p-9, rectangle_rounding = 0x1p-20;

}  // namespace fathom::fast::lens_bounds
