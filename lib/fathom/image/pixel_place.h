#pragma once

#include <cstddef>
#include <cstdint>
#include <string>

namespace fathom::image {

/// "pixel (3, 5): ", column and row from 0 on, of the value `k` of a channel, as messages begin.
inline std::string place_of_pixel(std::size_t k, std::uint32_t width) {
  return "pixel (" + std::to_string(k % width) + ", " + std::to_string(k / width) + "): ";
}

}  // namespace fathom::image
