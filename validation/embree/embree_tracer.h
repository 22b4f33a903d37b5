#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "fathom/attribution/model/renderer_input.h"
#include "fathom/camera/camera.h"

namespace fathom::validation {

/// How rays are passed to Embree, always marked as coherent: 4 × 4 pixels to rtcIntersect16, or 8 ×
/// 8 pixels, as an array for each part of a ray, to rtcIntersectNp. Which is faster depends on the
/// scene; rtcIntersect8, rtcIntersect1M and other block sizes were slower on every scene.
enum class RayStream { packets, arrays };

struct EmbreeOptions {
  /// RTC_SCENE_FLAG_ROBUST: no ray slips through between two triangles.
  bool robust = false;
  /// Number of threads for building and tracing; 0: all.
  int threads = 0;
};

/// A mesh traced by Embree, one ray through each pixel's centre; coordinates are rounded to
/// binary32, which is what Embree takes.
///
/// Does not  read the mesh after construction.
/// Fails     InputError if Embree fails: its message, in one line.
class EmbreeTracer {
 public:
  /// Copies the mesh; builds nothing yet.
  EmbreeTracer(const attribution::WorldMesh& mesh, const EmbreeOptions& options);
  ~EmbreeTracer();
  EmbreeTracer(const EmbreeTracer&) = delete;
  EmbreeTracer& operator=(const EmbreeTracer&) = delete;

  /// Builds the hierarchy over the triangles, from scratch each time.
  void build();

  /// Writes planar depths in scene units, width × height, rows from the top, infinite where nothing
  /// was hit. Makes the rays, too. If `triangles` is set, also writes the numbers of the triangles
  /// that were hit, or no_surface.
  /// Needs    build().
  void trace(const Camera& camera, RayStream stream, std::vector<float>& depths,
             std::vector<std::uint32_t>* triangles = nullptr) const;

  /// "Embree 3.13.5".
  static std::string description();

 private:
  struct Parts;
  std::unique_ptr<Parts> parts_;
};

}  // namespace fathom::validation
