#pragma once

#include <cstdint>
#include <string>

#include "fathom/image/map_files.h"

namespace fathom::image {

/// Refuses a map of this size before anything is allocated for it.
/// `bytes_per_pixel` is what the map will hold, and what its decoder needs besides.
/// Fails    InputError "NAME: an image of 20000×20000 pixels needs 1.6 GB; …".
void require_map_memory(std::uint32_t width, std::uint32_t height, std::uint64_t bytes_per_pixel,
                        std::uint64_t file_bytes, const MapMemory& memory, const std::string& name);

}  // namespace fathom::image
