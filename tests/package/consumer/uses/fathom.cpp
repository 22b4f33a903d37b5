#include <fathom/render.h>
#include <fathom/render_by_pipeline.h>

#include "one_triangle.h"

bool use_fathom() {
  const fathom::Scene scene = one_triangle();
  fathom::RenderOptions options;
  options.channels = {fathom::Channel::id};
  const fathom::DepthMap exact = fathom::render(scene, small_camera(), options).map;
  fathom::Camera camera = small_camera();
  camera.near = 1;
  camera.far = 4;
  const auto drawn = fathom::render_by_pipeline(scene, camera, {}, options.channels, false);
  return *exact.values<std::uint32_t>("id") == *drawn.map.values<std::uint32_t>("id");
}
