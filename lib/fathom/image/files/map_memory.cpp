#include "fathom/image/files/map_memory.h"

namespace fathom::image {

void require_map_memory(std::uint32_t width, std::uint32_t height, std::uint64_t bytes_per_pixel,
                        std::uint64_t file_bytes, const MapMemory& memory,
                        const std::string& name) {
  const std::string what =
      name + ": an image of " + std::to_string(width) + "×" + std::to_string(height) + " pixels";
  const double needed = 1.0 * width * height * static_cast<double>(bytes_per_pixel);
  require_memory(what, needed, memory.allowance);
  if (memory.of_small_file && needed > MapMemory::usual_ratio * static_cast<double>(file_bytes)) {
    require_memory(what, needed, *memory.of_small_file);
  }
}

}  // namespace fathom::image
