#include "validation/rays/ray_engines.h"

#include <CGAL/version.h>
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <array>
#include <utility>

#include "fathom/failures/unknown_name.h"
#include "validation/rays/engine_traces.h"

namespace fathom::validation {
namespace {

constexpr std::array engine_names{std::pair{RayEngine::embree, "embree"},
                                  std::pair{RayEngine::embree_robust, "embree-robust"},
                                  std::pair{RayEngine::cgal, "cgal"}};

}  // namespace

std::string name_of(RayEngine engine) {
  return engine_names.at(static_cast<std::size_t>(engine)).second;
}

std::vector<std::string> ray_engine_names() {
  std::vector<std::string> names;
  for (const auto& [engine, name] : engine_names) names.emplace_back(name);
  return names;
}

RayEngine ray_engine_named(const std::string& name) {
  for (const auto& [engine, known] : engine_names)
    if (name == known) return engine;
  throw UnknownName(fmt::format("there is no ray engine '{}'; there are {}", name,
                                fmt::join(ray_engine_names(), ", ")),
                    name, ray_engine_names());
}

std::string version_of(RayEngine engine) {
  return engine == RayEngine::cgal ? "CGAL " CGAL_VERSION_STR : embree_version_of_rays();
}

EngineAnswers trace(RayEngine engine, const attribution::WorldMesh& mesh,
                    std::span<const Ray> rays) {
  if (engine == RayEngine::cgal) return trace_by_cgal(mesh, rays);
  return trace_by_embree(mesh, rays, engine == RayEngine::embree_robust);
}

}  // namespace fathom::validation
