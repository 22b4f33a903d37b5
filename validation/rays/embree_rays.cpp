#include <embree3/rtcore.h>

#include "validation/embree/embree_mesh.h"
#include "validation/rays/ray_engines.h"

namespace fathom::validation {
namespace {

RayHit nearest_of(RTCScene scene, const Ray& ray) {
  RTCIntersectContext context;
  rtcInitIntersectContext(&context);
  RTCRayHit query = query_of(ray.origin, ray.direction);
  rtcIntersect1(scene, &context, &query);
  if (query.hit.primID == RTC_INVALID_GEOMETRY_ID) return {};
  return {query.hit.primID, query.ray.tfar};
}

struct Counting {
  RTCIntersectContext context;
  std::uint32_t count = 0;
};

/// Counts a hit and rejects it, so that Embree goes on. `context` is the first member of Counting.
void count_hit(const RTCFilterFunctionNArguments* hit) {
  ++reinterpret_cast<Counting*>(hit->context)->count;
  *hit->valid = 0;
}

std::uint32_t count_of(RTCScene scene, const Ray& ray) {
  Counting counting;
  rtcInitIntersectContext(&counting.context);
  counting.context.filter = count_hit;
  RTCRayHit query = query_of(ray.origin, ray.direction);
  rtcIntersect1(scene, &counting.context, &query);
  return counting.count;
}

}  // namespace

std::string embree_version_of_rays() {
  return embree_version();
}

EngineAnswers trace_by_embree(const attribution::WorldMesh& mesh, std::span<const Ray> rays,
                              bool robust) {
  EngineAnswers answers;
  EmbreeMesh given(mesh, 1);
  const int flags = robust ? RTC_SCENE_FLAG_ROBUST : RTC_SCENE_FLAG_NONE;
  RTCScene scene = given.build(flags);
  for (const Ray& ray : rays) answers.nearest.push_back(nearest_of(scene, ray));
  scene = given.build(flags | RTC_SCENE_FLAG_CONTEXT_FILTER_FUNCTION);
  for (const Ray& ray : rays) answers.counts.push_back(count_of(scene, ray));
  return answers;
}

}  // namespace fathom::validation
