#pragma once

#include <cstdint>
#include <nlohmann/json_fwd.hpp>
#include <string>

#include "apps/view/page.h"
#include "fathom/threads/threads.h"

namespace fathom::view {

inline constexpr std::uint32_t tile_size = 512;

/// Writes the planes of a map as script elements and returns the data that the page needs: size,
/// levels, camera of straight rays, directions, and of each channel its name, type, drawing, names
/// and mask. Level n has every 2ⁿ-th pixel. A tile is the element `PREFIX-PLANE-LEVEL-NUMBER`;
/// planes are `c0`, `c1`, … of channels and `k0`, … of masks. The samples of a deep map are the
/// planes `d0` to `d4`, in the order of pixels within each tile of level 0: Z, ZBack, area, A and
/// id.
nlohmann::json write_planes(const ViewedMap& viewed, const std::string& prefix, const Sink& sink,
                            Progress& progress);

/// How many tiles the channels of a map have, of all levels, and the samples of a deep map: so many
/// parts write_planes() reports.
std::uint64_t count_tiles(const ViewedMap& viewed);

}  // namespace fathom::view
