#include <fathom/camera_directions.h>

#include "one_triangle.h"

bool use_camera_directions() {
  fathom::Camera camera = small_camera();
  camera.projection.model = fathom::ProjectionModel::perspective;
  const auto table = fathom::directions_of(camera);
  return table.width() == camera.width && table.height() == camera.height;
}
