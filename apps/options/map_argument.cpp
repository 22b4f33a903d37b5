#include "apps/options/map_argument.h"

#include "apps/shell/known_files.h"
#include "apps/shell/max_memory.h"
#include "fathom/image/map_files.h"

namespace fathom::app {
namespace {

MapMemory allowed_memory() {
  MapMemory memory{.allowance = memory_allowance()};
  if (max_memory()) {
    memory.of_small_file.reset();
  } else {
    memory.of_small_file->remedy = "--max-memory SIZE allows more";
  }
  return memory;
}

}  // namespace

DepthMap read_map_argument(const std::string& file) {
  note_input(file);
  return read_map(file, allowed_memory());
}

DepthMap read_map_argument(std::span<const std::byte> bytes, const std::string& file) {
  note_input(file);
  return read_map(bytes, file, allowed_memory());
}

}  // namespace fathom::app
