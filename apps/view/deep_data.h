#pragma once

#include <array>
#include <span>
#include <string>
#include <vector>

#include "apps/view/packing.h"
#include "fathom/image/deep_map.h"

namespace fathom::view {

/// Where the samples of each pixel begin, and at last where all of them end.
std::vector<std::size_t> begins_of(const DeepMap& deep);

/// The samples of the pixels of a tile, in the order of the pixels: Z, ZBack, area, A and id.
std::array<std::string, 5> packed_samples(const DeepMap& deep, std::span<const std::size_t> begins,
                                          const TilePlace& tile);

}  // namespace fathom::view
