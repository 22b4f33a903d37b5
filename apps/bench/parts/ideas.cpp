#include "apps/bench/parts/ideas.h"

#include "fathom/failures/errors.h"

namespace fathom::bench {

const std::vector<std::string>& idea_names() {
  static const std::vector<std::string> names{"lanes", "blocks",  "early-rejection",
                                              "tiles", "threads", "culling"};
  return names;
}

std::vector<Idea> ideas_named(const std::string& name, const PartsScene& scene,
                              const std::vector<int>& thread_counts) {
  if (name == "lanes") return lanes(scene);
  if (name == "blocks") return blocks(scene);
  if (name == "early-rejection") return early_rejection(scene);
  if (name == "tiles") return tiles(scene);
  if (name == "threads") return threads(scene, thread_counts);
  if (name == "culling") return culling(scene);
  throw UsageError("'" + name + "' is no idea");
}

}  // namespace fathom::bench
