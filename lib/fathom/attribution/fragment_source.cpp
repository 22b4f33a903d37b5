#include "fathom/attribution/fragment_source.h"

#include <variant>

namespace fathom::attribution {
namespace {

struct Sources {
  const WorldMesh& mesh;
  const Camera& camera;
  const SamplePosition& sample;

  std::unique_ptr<FragmentSource> operator()(const RasterModel& model) const {
    return raster_fragments(mesh, camera, sample, model);
  }
  std::unique_ptr<FragmentSource> operator()(const RayModel& model) const {
    return ray_fragments(mesh, camera, sample, model);
  }
};

}  // namespace

std::unique_ptr<FragmentSource> fragments(const WorldMesh& mesh, const Camera& camera,
                                          const RendererModel& model) {
  return std::visit(Sources{mesh, camera, model.sample}, model.kind);
}

}  // namespace fathom::attribution
