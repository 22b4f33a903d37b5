#pragma once

#include <cstdint>
#include <span>

#include "apps/bench/parts/edge_setup.h"
#include "apps/bench/parts/padded_image.h"
#include "apps/bench/parts/pixel_block.h"

/// The textbook's rasterizer: three edge functions at one pixel after the other. Compiled without
/// vector instructions, so that what vectors bring can be measured against it.
namespace fathom::bench {

/// Adds each triangle's weight to the pixels that it covers, testing all pixels of its box, with
/// edge functions over `Number`: float (added to layers of float), double, or integers of 64 bits.
/// Exact    over double and integers; over float where fits_binary32(), and only there.
template <class Number, class Layer>
void add_boxes_one_by_one(std::span<const EdgeSetup> setups, PaddedImage<Layer>& layers);

/// The same over binary64, but first with blocks of 8 × 8 pixels: those outside of an edge are left
/// out, in those inside all three no pixel is tested.
BlockCounts add_blocks_one_by_one(std::span<const EdgeSetup> setups, PaddedImage<double>& layers);

}  // namespace fathom::bench
