#include "validation/scenes/simple_camera.h"

namespace fathom::bench {

Camera simple_camera(const ImageSize& size, double focal) {
  Camera camera{.width = size.width, .height = size.height};
  camera.projection.fx = camera.projection.fy = focal * size.height;
  camera.projection.cx = size.width / 2.0;
  camera.projection.cy = size.height / 2.0;
  return camera;
}

}  // namespace fathom::bench
