#include "fathom/triangle/map_of_camera.h"

#include "fathom/failures/errors.h"

namespace fathom::triangle {

void require_map_of(const Camera& camera, const DepthMap& map) {
  require_valid(map);
  if (map.width == camera.width && map.height == camera.height) return;
  throw InputError("map: its size is " + std::to_string(map.width) + "x" +
                   std::to_string(map.height) + ", expected the camera's, " +
                   std::to_string(camera.width) + "x" + std::to_string(camera.height));
}

}  // namespace fathom::triangle
