#include "validation/peers/built_in_peers.h"

#include "validation/embree/embree_tracer.h"
#include "validation/opengl/opengl_renderer.h"
#include "validation/vtk/drawn_by_vtk.h"

namespace fathom::validation {

using attribution::RayModel;
using attribution::world_mesh;

DrawnMap draw_built_in(const VtkVariant& variant, const ValidationScene& scene) {
  return draw_vtk(world_mesh(scene.scene), scene.camera, variant);
}

DrawnMap draw_built_in(const OpenGlVariant& variant, const ValidationScene& scene) {
  return draw_opengl(world_mesh(scene.scene), scene.camera, variant);
}

DrawnMap draw_built_in(const EmbreeVariant& variant, const ValidationScene& scene) {
  EmbreeTracer tracer(world_mesh(scene.scene), {.robust = variant.robust});
  tracer.build();
  DrawnMap drawn{.version = EmbreeTracer::description()};
  std::vector<float> depths;
  tracer.trace(scene.camera, RayStream::packets, depths, &drawn.map.triangles);
  drawn.map.width = scene.camera.width;
  drawn.map.height = scene.camera.height;
  drawn.map.depths.assign(depths.begin(), depths.end());
  drawn.model = {.name = "ray in binary32", .watertight = false, .kind = RayModel{}};
  return drawn;
}

GreyPicture draw_built_in_colours(const LitScene& scene, VtkShading shading) {
  return draw_vtk_colours(scene, shading);
}

std::vector<int> built_in_samples(Driver driver) {
  return offered_samples(driver);
}

}  // namespace fathom::validation
