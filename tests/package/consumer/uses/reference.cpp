#include <fathom/reference/reference.h>
#include <fathom/reference/verify.h>

#include "one_triangle.h"

bool use_reference() {
  const fathom::Scene scene = one_triangle();
  const fathom::DepthMap map = render_reference(scene, small_camera(), {}).map;
  const auto verification = verify(map, scene, small_camera(), {}, fathom::choose_pixels(4, 4, 16));
  return map.values<float>("Z")->at(0) == 2 && verification.differing == 0;
}
