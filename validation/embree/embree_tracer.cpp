#include "validation/embree/embree_tracer.h"

#include <embree3/rtcore.h>
#include <tbb/global_control.h>

#include <algorithm>
#include <thread>

#include "fathom/failures/errors.h"
#include "validation/embree/trace_image.h"

namespace fathom::validation {

using attribution::WorldMesh;

struct EmbreeTracer::Parts {
  EmbreeOptions options;
  tbb::global_control threads;
  RTCDevice device = nullptr;
  RTCGeometry geometry = nullptr;
  RTCScene scene = nullptr;

  explicit Parts(const EmbreeOptions& given)
      : options(given),
        threads(tbb::global_control::max_allowed_parallelism,
                given.threads > 0 ? static_cast<std::size_t>(given.threads)
                                  : std::thread::hardware_concurrency()),
        device(rtcNewDevice(("threads=" + std::to_string(std::max(0, given.threads))).c_str())) {
    if (device == nullptr) throw InputError("Embree does not start on this machine");
  }
  ~Parts() {
    if (scene != nullptr) rtcReleaseScene(scene);
    if (geometry != nullptr) rtcReleaseGeometry(geometry);
    rtcReleaseDevice(device);
  }
  Parts(const Parts&) = delete;
  Parts& operator=(const Parts&) = delete;

  void check(const std::string& what) const {
    const RTCError error = rtcGetDeviceError(device);
    if (error == RTC_ERROR_NONE) return;
    throw InputError(
        "Embree: " + what + " failed: " +
        (error == RTC_ERROR_OUT_OF_MEMORY ? "out of memory" : "error " + std::to_string(error)));
  }
};

EmbreeTracer::EmbreeTracer(const WorldMesh& mesh, const EmbreeOptions& options)
    : parts_(std::make_unique<Parts>(options)) {
  parts_->geometry = rtcNewGeometry(parts_->device, RTC_GEOMETRY_TYPE_TRIANGLE);
  auto* points = static_cast<float*>(
      rtcSetNewGeometryBuffer(parts_->geometry, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3,
                              3 * sizeof(float), mesh.points.size()));
  auto* corners = static_cast<std::uint32_t*>(
      rtcSetNewGeometryBuffer(parts_->geometry, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3,
                              3 * sizeof(std::uint32_t), mesh.triangles.size()));
  parts_->check("copying the mesh");
  for (const auto& p : mesh.points) {
    for (const double coordinate : p) *points++ = static_cast<float>(coordinate);
  }
  for (const CornerIndices& triangle : mesh.triangles) {
    corners = std::copy(triangle.begin(), triangle.end(), corners);
  }
  rtcCommitGeometry(parts_->geometry);
  parts_->check("taking the mesh");
}

EmbreeTracer::~EmbreeTracer() = default;

void EmbreeTracer::build() {
  if (parts_->scene != nullptr) rtcReleaseScene(parts_->scene);
  parts_->scene = rtcNewScene(parts_->device);
  rtcSetSceneFlags(parts_->scene,
                   parts_->options.robust ? RTC_SCENE_FLAG_ROBUST : RTC_SCENE_FLAG_NONE);
  rtcAttachGeometry(parts_->scene, parts_->geometry);
  rtcCommitScene(parts_->scene);
  parts_->check("building");
}

void EmbreeTracer::trace(const Camera& camera, RayStream stream, std::vector<float>& depths,
                         std::vector<std::uint32_t>* triangles) const {
  const Binary32View view = binary32_view(camera);
  depths.resize(std::size_t{view.width} * view.height);
  if (triangles != nullptr) triangles->resize(depths.size());
  trace_image(parts_->scene, view, stream,
              {depths.data(), triangles != nullptr ? triangles->data() : nullptr});
}

std::string EmbreeTracer::description() {
  return "Embree " RTC_VERSION_STRING;
}

}  // namespace fathom::validation
