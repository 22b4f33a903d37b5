#pragma once

#include <cstdint>
#include <functional>
#include <vector>

namespace fathom::attribution {

/// Pixels that touch, corners counting, as indices row by row from the top left; in the order of
/// their first pixels.
std::vector<std::vector<std::size_t>> pixel_groups(std::uint32_t width, std::uint32_t height,
                                                   const std::function<bool(std::size_t)>& is_one);

}  // namespace fathom::attribution
