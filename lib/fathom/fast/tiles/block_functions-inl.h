// A function over the blocks of a tile. Included once for every kind of vector instructions, by the
// files that foreach_target.h compiles for each.
#if defined(FATHOM_FAST_BLOCK_FUNCTIONS_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef FATHOM_FAST_BLOCK_FUNCTIONS_INL_H
#undef FATHOM_FAST_BLOCK_FUNCTIONS_INL_H
#else
#define FATHOM_FAST_BLOCK_FUNCTIONS_INL_H
#endif

#include <hwy/highway.h>

#include <array>

#include "fathom/fast/bins/tile_shape.h"
#include "fathom/fast/lanes/lanes-inl.h"
#include "fathom/fast/tiles/lane_batch-inl.h"

HWY_BEFORE_NAMESPACE();
namespace fathom::fast::HWY_NAMESPACE {
namespace {

/// A function at the samples of the blocks of a tile where it is greatest and least: for a column
/// of blocks its value without b·y, and y from the top of a row of blocks.
struct BlockFunction {
  using Numbers = std::array<float, TileShape::blocks_of_row>;
  alignas(32) Numbers greatest;
  alignas(32) Numbers least;
  float b;
  float greatest_y, least_y;
};

HWY_INLINE void make_block_function(float a, float b, float c, float first_column,
                                    BlockFunction& f) {
  const DF8 d;
  const auto at = [&](float x, std::size_t part) HWY_ATTR {
    const auto left = hn::MulAdd(counting_lanes(d, static_cast<float>(part)), hn::Set(d, block),
                                 hn::Set(d, x - first_column));
    return hn::MulAdd(hn::Set(d, a), left, hn::Set(d, c));
  };
  constexpr float side = block - 1;
  for (std::size_t part = 0; part < TileShape::blocks_of_row; part += hn::Lanes(d)) {
    hn::Store(at(a > 0 ? side : 0, part), d, f.greatest.data() + part);
    hn::Store(at(a > 0 ? 0 : side, part), d, f.least.data() + part);
  }
  f.b = b;
  f.greatest_y = b > 0 ? side : 0;
  f.least_y = side - f.greatest_y;
}

}  // namespace
}  // namespace fathom::fast::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();
#endif
