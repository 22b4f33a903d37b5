#pragma once

#include <array>
#include <cstddef>

#include "fathom/fast/bins/tile_shape.h"
#include "fathom/lens/stage.h"

namespace fathom::fast {

/// Numbers for the search of S(m) = y in vectors.
struct StageForLanes {
  explicit StageForLanes(const lens::StageNumbers<double>& stage);

  static constexpr std::size_t most = 7;
  std::array<double, most> numerator{}, denominator{}, before{};
  std::size_t numerator_count, denominator_count, before_count;
  double p1, p2, s1, s2, s3, s4;
};

/// The map from samples to y in binary64: (n_x/z, n_y/z), each of the three
/// g₀·(u − centre_u) + g₁·(v − centre_v) + g₂.
struct PlaneForLanes {
  double centre_u = 0, centre_v = 0;
  std::array<std::array<double, 3>, 3> g{};
  /// Whether z is 1 everywhere.
  bool is_affine = true;
};

/// Samples of one block, cell by cell as in a tile.
struct BlockSamples {
  static constexpr std::size_t count = std::size_t{TileShape::block} * TileShape::block;
  using Numbers = std::array<double, count>;
  /// m, and |S(m) − y| by binary64's arithmetic; NaN where the search failed.
  alignas(64) Numbers x, y, residual;
  /// Around all of them.
  double left, right, top, bottom;
  /// The greatest residual; +∞ where the search failed at a sample.
  double greatest_residual;
};

/// Searches m for the samples of a block of pixels, by Newton's method from a point m₀ with
/// S(m₀) near y of its centre. Nothing is proved but what the residuals say.
void search_block(const StageForLanes& stage, const PlaneForLanes& plane, double first_column,
                  double first_row, double x, double y, BlockSamples& samples);

}  // namespace fathom::fast
