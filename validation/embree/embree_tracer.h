#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "fathom/attribution/world_mesh.h"
#include "fathom/camera/camera.h"

namespace fathom::validation {

/// How rays are handed to Embree, all said to be coherent: 4 × 4 pixels to rtcIntersect16, or
/// 8 × 8 pixels, as an array for each part of a ray, to rtcIntersectNp. Which of the two is faster
/// depends on the scene; rtcIntersect8, rtcIntersect1M and other sizes of block were slower on all.
enum class RayStream { packets, arrays };

struct EmbreeOptions {
  /// RTC_SCENE_FLAG_ROBUST: no ray slips between two triangles.
  bool robust = false;
  /// Threads that build and trace; 0: all.
  int threads = 0;
};

/// A mesh traced by Embree, one ray through each pixel's centre: coordinates rounded to binary32,
/// as Embree takes them.
///
/// Does not  read the mesh again: it may go once this is made.
/// Fails     InputError where Embree does: its message, in one line.
class EmbreeTracer {
 public:
  /// Copies the mesh; nothing is built yet.
  EmbreeTracer(const attribution::WorldMesh& mesh, const EmbreeOptions& options);
  ~EmbreeTracer();
  EmbreeTracer(const EmbreeTracer&) = delete;
  EmbreeTracer& operator=(const EmbreeTracer&) = delete;

  /// Builds the hierarchy over the triangles, anew each time.
  void build();

  /// Planar depths, width × height, rows from the top, infinite where nothing was hit; rays are
  /// made here too. build() comes first.
  void trace(const Camera& camera, RayStream stream, std::vector<float>& depths) const;

  /// "Embree 3.13.5".
  static std::string description();

 private:
  struct Parts;
  std::unique_ptr<Parts> parts_;
};

}  // namespace fathom::validation
