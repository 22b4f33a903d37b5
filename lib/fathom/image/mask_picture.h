#pragma once

#include <cstdint>
#include <filesystem>
#include <span>

namespace fathom {

/// Writes a mask as a PNG of one 8-bit grey channel, 255 where the mask is not 0 and else 0, as the data
/// sets of BOP have in mask/ and mask_visib/. The same mask gives the same bytes.
///   mask    height × width values, row by row from the top
/// Fails    InputError if the mask has no pixel, or not as many as the size says, or the size is above
///          2^31 − 1; OutputError, "PATH: why", if it cannot be written.
void write_mask(std::span<const std::uint8_t> mask, std::uint32_t width, std::uint32_t height,
                const std::filesystem::path& path);

}  // namespace fathom
