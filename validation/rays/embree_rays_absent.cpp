#include "validation/peers/not_built_in.h"
#include "validation/rays/ray_engines.h"

namespace fathom::validation {

std::string embree_version_of_rays() {
  return "Embree (not built in)";
}

EngineAnswers trace_by_embree(const attribution::WorldMesh& /*mesh*/, std::span<const Ray> /*rays*/,
                              bool /*robust*/) {
  refuse_absent("Embree");
}

}  // namespace fathom::validation
