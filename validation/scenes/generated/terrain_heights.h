#pragma once

#include <array>
#include <cstddef>

namespace fathom::bench {

/// A landscape over the unit square: heights within ±greatest_height, a sum of random values at the
/// points of five lattices, blended between them. The same on every machine: sums and products of
/// binary64 numbers, no library function.
inline constexpr double greatest_height = 0.125;

/// The heights along a line of one z, in [0, 1]. Along x they cost little, since what a lattice has
/// between two of its points is kept.
class TerrainHeights {
 public:
  explicit TerrainHeights(double z);
  /// At x in [0, 1]. It does not depend on where one has been before.
  double at(double x);

 private:
  static constexpr std::size_t octaves = 5;
  struct Cell {
    double number = -1;
    double left = 0, step = 0;
  };
  double z_;
  std::array<Cell, octaves> cells_;
};

}  // namespace fathom::bench
