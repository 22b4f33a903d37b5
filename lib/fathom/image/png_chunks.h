#pragma once

#include <bit>
#include <cstddef>
#include <cstdint>
#include <span>

#include "fathom/files/byte_order.h"

namespace fathom::image {

/// libpng allocates as much for a chunk as its header claims. Walks over the chunks of a PNG
/// (length, type, data, checksum): whether none is longer than what is left of the file.
inline bool chunks_fit(std::span<const std::byte> bytes) {
  constexpr std::size_t signature = 8, around = 12;
  for (std::size_t at = signature; at < bytes.size();) {
    if (bytes.size() - at < around) return false;
    const std::size_t length = load<std::uint32_t>(&bytes[at], std::endian::big);
    if (length > bytes.size() - at - around) return false;
    at += around + length;
  }
  return true;
}

}  // namespace fathom::image
