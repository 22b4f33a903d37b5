#include <fathom/render_by_pipeline.h>

#include "one_triangle.h"

bool use_render_by_pipeline() {
  fathom::Camera camera = small_camera();
  camera.near = 1;
  camera.far = 4;
  const fathom::PipelineRendering rendering =
      fathom::render_by_pipeline(one_triangle(), camera, {}, {fathom::Channel::id}, false);
  return rendering.map.values<std::uint32_t>("id")->at(0) == 0;
}
