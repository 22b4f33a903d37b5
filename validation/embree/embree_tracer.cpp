#include "validation/embree/embree_tracer.h"

#include <tbb/global_control.h>

#include <thread>

#include "validation/embree/embree_mesh.h"
#include "validation/embree/trace_image.h"

namespace fathom::validation {

struct EmbreeTracer::Parts {
  bool robust;
  tbb::global_control threads;
  EmbreeMesh mesh;
  RTCScene scene = nullptr;

  Parts(const attribution::WorldMesh& given, const EmbreeOptions& options)
      : robust(options.robust),
        threads(tbb::global_control::max_allowed_parallelism,
                options.threads > 0 ? static_cast<std::size_t>(options.threads)
                                    : std::thread::hardware_concurrency()),
        mesh(given, options.threads) {}
};

EmbreeTracer::EmbreeTracer(const attribution::WorldMesh& mesh, const EmbreeOptions& options)
    : parts_(std::make_unique<Parts>(mesh, options)) {}

EmbreeTracer::~EmbreeTracer() = default;

void EmbreeTracer::build() {
  parts_->scene = parts_->mesh.build(parts_->robust ? RTC_SCENE_FLAG_ROBUST : RTC_SCENE_FLAG_NONE);
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
  return embree_version();
}

}  // namespace fathom::validation
