/* For LD_PRELOAD: sets the mask of every ray before Embree sees it. Debian's Open3D 0.16.1 sets masks to 0, and Debian's
 * Embree, which compares masks, then meets nothing. See open3d_rays.py. */
#include <dlfcn.h>
#include <embree3/rtcore.h>

typedef void (*intersect)(RTCScene, struct RTCIntersectContext*, struct RTCRayHit*, unsigned int,
                          size_t);

void rtcIntersect1M(RTCScene scene, struct RTCIntersectContext* context, struct RTCRayHit* rays,
                    unsigned int count, size_t stride) {
  const intersect real = (intersect)dlsym(dlopen("libembree3.so.3", RTLD_NOW), "rtcIntersect1M");
  for (unsigned int i = 0; i < count; ++i)
    ((struct RTCRayHit*)((char*)rays + i * stride))->ray.mask = 0xFFFFFFFF;
  real(scene, context, rays, count, stride);
}
