#include "validation/scenes/generated/terrain_heights.h"

#include <cstdint>

#include "validation/scenes/made/random.h"

namespace fathom::bench {
namespace {

struct Octave {
  /// Cells of the lattice along a side of the square.
  double cells;
  double height;
};

/// The sum of the heights leaves room below greatest_height for what rounding may add.
constexpr std::array<Octave, 5> all_octaves{
    {{5, 0.06}, {11, 0.03}, {23, 0.015}, {47, 0.0075}, {97, 0.004}}};

double smooth(double t) {
  return t * t * (3 - 2 * t);
}

/// In [−1, 1).
double height_at(std::size_t octave, std::uint64_t x, std::uint64_t z) {
  const std::uint64_t bits = scattered((std::uint64_t{octave} << 32) + (x << 16) + z);
  return static_cast<double>(bits >> 11) * 0x1p-52 - 1;
}

/// The part of a number that is at least 0 before the point.
double whole(double value) {
  return static_cast<double>(static_cast<std::int32_t>(value));
}

}  // namespace

TerrainHeights::TerrainHeights(double z) : z_(z) {}

double TerrainHeights::at(double x) {
  static_assert(all_octaves.size() == octaves);
  double height = 0;
  for (std::size_t k = 0; k < octaves; ++k) {
    const Octave& octave = all_octaves[k];
    Cell& cell = cells_[k];
    const double position = x * octave.cells, number = whole(position);
    if (cell.number != number) {
      const double along_z = z_ * octave.cells, row = whole(along_z), t = smooth(along_z - row);
      const auto at_side = [&](double column) {
        const auto i = static_cast<std::uint64_t>(column), j = static_cast<std::uint64_t>(row);
        const double far = height_at(k, i, j), near = height_at(k, i, j + 1);
        return octave.height * (far + (near - far) * t);
      };
      const double left = at_side(number);
      cell = {number, left, at_side(number + 1) - left};
    }
    height += cell.left + cell.step * smooth(position - number);
  }
  return height;
}

}  // namespace fathom::bench
