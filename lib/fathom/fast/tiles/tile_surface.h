#pragma once

#include <bit>
#include <cstdint>

#include "fathom/fast/vertices/vertex.h"
#include "fathom/image/depth_map.h"

namespace fathom::fast {

/// Tag of a surface: its number in the lower half and, read as a whole as a binary64 number, a
/// bound on the error of its q: upper_half() rounds up, so that the lower half can only add to it.
/// A bound of +∞ becomes NaN, for which no comparison holds: nothing is certain.
inline std::uint64_t surface_tag(std::uint32_t number, double q_error) {
  return upper_half(q_error) << 32 | number;
}
/// No surface: an error of almost nothing.
inline constexpr std::uint64_t no_surface_tag = std::uint64_t{0x00100000} << 32 | no_surface;

/// A surface that may be visible in a tile: q as an affine function of the sample's column and row
/// in the tile, c + a·column + b·row, with its tag.
struct alignas(32) TileSurface {
  double c, a, b;
  std::uint64_t tag;

  [[nodiscard]] double q(double column, double row) const { return c + a * column + b * row; }
  [[nodiscard]] double error() const { return std::bit_cast<double>(tag); }
  [[nodiscard]] std::uint32_t number() const { return static_cast<std::uint32_t>(tag); }
};

/// q at a sample in binary32, a bound on its error, and which of the tile's surfaces it is of: as a
/// surface_tag(), with half as many bits for each. The place of a surface is its index.
using LaneTag = std::uint32_t;
inline LaneTag lane_tag(std::uint32_t place, float q_error) {
  return ((std::bit_cast<std::uint32_t>(q_error) >> 16) + 1) << 16 | place;
}
/// No surface: an error of almost nothing, and place 0.
inline constexpr LaneTag no_surface_lane_tag = 0x00800000;

}  // namespace fathom::fast
