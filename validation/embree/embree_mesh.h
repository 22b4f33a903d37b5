#pragma once

#include <embree3/rtcore.h>

#include <array>
#include <string>

#include "fathom/attribution/model/renderer_input.h"

namespace fathom::validation {

/// A mesh in a device of Embree; coordinates are rounded to binary32, which is what Embree takes.
///
/// Does not  read the mesh after construction.
/// Fails     InputError if Embree fails: its message, in one line.
class EmbreeMesh {
 public:
  /// Threads for building; 0: all.
  EmbreeMesh(const attribution::WorldMesh& mesh, int threads);
  EmbreeMesh(const EmbreeMesh&) = delete;
  EmbreeMesh& operator=(const EmbreeMesh&) = delete;
  ~EmbreeMesh();

  /// Builds the hierarchy over the triangles, from scratch each time.
  /// flags  of Embree: RTC_SCENE_FLAG_ROBUST lets no ray slip through between two triangles.
  RTCScene build(int flags);

 private:
  /// `what` was done, for the message.
  void check(const std::string& what) const;

  RTCDevice device_ = nullptr;
  RTCGeometry geometry_ = nullptr;
  RTCScene scene_ = nullptr;
};

/// A ray from t = 0 on, for rtcIntersect1(); its numbers are rounded to binary32. It meets no
/// triangle yet.
RTCRayHit query_of(const std::array<double, 3>& origin, const std::array<double, 3>& direction);

/// "Embree 3.13.5".
std::string embree_version();

}  // namespace fathom::validation
