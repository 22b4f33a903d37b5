#include "validation/scenes/simple_camera.h"

namespace fathom::bench {

Camera simple_camera(const ImageSize& size, double focal) {
  Camera camera{.width = size.width, .height = size.height};
  camera.fx = camera.fy = focal * size.height;
  camera.cx = size.width / 2.0;
  camera.cy = size.height / 2.0;
  return camera;
}

}  // namespace fathom::bench
