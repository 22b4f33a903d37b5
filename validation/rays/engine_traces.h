#pragma once

#include "validation/rays/ray_engines.h"

/// trace() of each engine.
/// Fails    InputError if Embree is not built in, or fails.
namespace fathom::validation {

EngineAnswers trace_by_embree(const attribution::WorldMesh& mesh, std::span<const Ray> rays,
                              bool robust);
/// "Embree 3.13.5", or that it is not built in.
std::string embree_version_of_rays();
EngineAnswers trace_by_cgal(const attribution::WorldMesh& mesh, std::span<const Ray> rays);

}  // namespace fathom::validation
