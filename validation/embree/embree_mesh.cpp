#include "validation/embree/embree_mesh.h"

#include <algorithm>
#include <cstdint>
#include <limits>

#include "fathom/failures/errors.h"

namespace fathom::validation {

EmbreeMesh::EmbreeMesh(const attribution::WorldMesh& mesh, int threads)
    : device_(rtcNewDevice(("threads=" + std::to_string(std::max(0, threads))).c_str())) {
  if (device_ == nullptr) throw InputError("Embree does not start on this machine");
  geometry_ = rtcNewGeometry(device_, RTC_GEOMETRY_TYPE_TRIANGLE);
  auto* points = static_cast<float*>(rtcSetNewGeometryBuffer(geometry_, RTC_BUFFER_TYPE_VERTEX, 0,
                                                             RTC_FORMAT_FLOAT3, 3 * sizeof(float),
                                                             mesh.points.size()));
  auto* corners = static_cast<std::uint32_t*>(
      rtcSetNewGeometryBuffer(geometry_, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3,
                              3 * sizeof(std::uint32_t), mesh.triangles.size()));
  check("copying the mesh");
  for (const auto& p : mesh.points) {
    for (const double coordinate : p) *points++ = static_cast<float>(coordinate);
  }
  for (const CornerIndices& triangle : mesh.triangles) {
    corners = std::copy(triangle.begin(), triangle.end(), corners);
  }
  rtcCommitGeometry(geometry_);
  check("taking the mesh");
}

EmbreeMesh::~EmbreeMesh() {
  if (scene_ != nullptr) rtcReleaseScene(scene_);
  if (geometry_ != nullptr) rtcReleaseGeometry(geometry_);
  rtcReleaseDevice(device_);
}

RTCScene EmbreeMesh::build(int flags) {
  if (scene_ != nullptr) rtcReleaseScene(scene_);
  scene_ = rtcNewScene(device_);
  rtcSetSceneFlags(scene_, static_cast<RTCSceneFlags>(flags));
  rtcAttachGeometry(scene_, geometry_);
  rtcCommitScene(scene_);
  check("building");
  return scene_;
}

void EmbreeMesh::check(const std::string& what) const {
  const RTCError error = rtcGetDeviceError(device_);
  if (error == RTC_ERROR_NONE) return;
  throw InputError(
      "Embree: " + what + " failed: " +
      (error == RTC_ERROR_OUT_OF_MEMORY ? "out of memory" : "error " + std::to_string(error)));
}

RTCRayHit query_of(const std::array<double, 3>& origin, const std::array<double, 3>& direction) {
  RTCRayHit query{};
  query.ray.org_x = static_cast<float>(origin[0]);
  query.ray.org_y = static_cast<float>(origin[1]);
  query.ray.org_z = static_cast<float>(origin[2]);
  query.ray.dir_x = static_cast<float>(direction[0]);
  query.ray.dir_y = static_cast<float>(direction[1]);
  query.ray.dir_z = static_cast<float>(direction[2]);
  query.ray.tfar = std::numeric_limits<float>::infinity();
  query.ray.mask = 0xFFFFFFFF;
  query.hit.geomID = query.hit.primID = RTC_INVALID_GEOMETRY_ID;
  return query;
}

std::string embree_version() {
  return "Embree " RTC_VERSION_STRING;
}

}  // namespace fathom::validation
