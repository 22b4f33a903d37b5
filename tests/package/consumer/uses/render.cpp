#include <fathom/render.h>

#include "one_triangle.h"

bool use_render() {
  return fathom::render(one_triangle(), small_camera()).map.values<float>("Z")->at(0) == 2;
}
