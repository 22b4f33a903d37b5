#pragma once

#include <cstdint>
#include <string>

#include "fathom/failures/errors.h"
#include "fathom/files/file_bytes.h"
#include "fathom/text/counted.h"

namespace fathom::image {

/// Refuses what follows the header of a file, a "PFM file", unless it is as long as its pixels.
/// Fails    InputError.
inline void require_raw_pixels(files::ByteView data, std::uint32_t width, std::uint32_t height,
                               std::size_t pixel_bytes, const std::string& file,
                               const std::string& name) {
  const std::uint64_t pixels = std::uint64_t{width} * height;
  if (data.size() / pixel_bytes == pixels && data.size() % pixel_bytes == 0) return;
  throw InputError(name + ": truncated or overlong " + file + ": expected " +
                   std::to_string(width) + "×" + std::to_string(height) + " pixels of " +
                   text::counted(pixel_bytes, "byte") + ", found " +
                   text::counted(data.size(), "byte"));
}

}  // namespace fathom::image
