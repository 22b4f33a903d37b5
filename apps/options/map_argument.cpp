#include "apps/options/map_argument.h"

#include "apps/shell/known_files.h"
#include "apps/shell/max_memory.h"
#include "fathom/image/map_files.h"

namespace fathom::app {

DepthMap read_map_argument(const std::string& file) {
  note_input(file);
  MapMemory memory{.allowance = memory_allowance()};
  if (max_memory()) {
    memory.of_small_file.reset();
  } else {
    memory.of_small_file->remedy = "--max-memory SIZE allows more";
  }
  return read_map(file, memory);
}

}  // namespace fathom::app
