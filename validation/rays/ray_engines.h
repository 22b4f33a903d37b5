#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "fathom/attribution/model/renderer_input.h"
#include "fathom/rays/ray.h"

/// Other programs' answers to rays.
namespace fathom::validation {

/// - embree: Embree with its default settings
/// - embree-robust: with RTC_SCENE_FLAG_ROBUST
/// - cgal: CGAL's AABB_tree over its kernel of exact numbers
enum class RayEngine { embree, embree_robust, cgal };

std::string name_of(RayEngine engine);
std::vector<std::string> ray_engine_names();
/// Fails    UnknownName
RayEngine ray_engine_named(const std::string& name);
/// "Embree 3.13.5".
std::string version_of(RayEngine engine);

/// For each ray, in their order.
struct EngineAnswers {
  /// The nearest hit. t is in lengths of the direction; +∞ if there is no hit.
  std::vector<RayHit> nearest;
  /// How many triangles the ray meets, as reported by the engine.
  std::vector<std::uint32_t> counts;
};

/// Traces the rays one by one in one thread, without a hint that they are coherent.
/// Needs    a mesh and rays of binary32 numbers.
EngineAnswers trace(RayEngine engine, const attribution::WorldMesh& mesh,
                    std::span<const Ray> rays);

// trace() of each engine.
// Fails    InputError if Embree is not built in, or fails.

EngineAnswers trace_by_embree(const attribution::WorldMesh& mesh, std::span<const Ray> rays,
                              bool robust);
/// "Embree 3.13.5", or that it is not built in.
std::string embree_version_of_rays();
EngineAnswers trace_by_cgal(const attribution::WorldMesh& mesh, std::span<const Ray> rays);

}  // namespace fathom::validation
