#include <fathom/area/visible_areas.h>

#include "one_triangle.h"

bool use_area() {
  const fathom::Scene scene = one_triangle();
  return visible_areas(scene, small_camera(), {}).triangles.at(0).visible == 8;
}
