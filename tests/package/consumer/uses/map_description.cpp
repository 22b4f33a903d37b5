#include <fathom/map_description.h>

#include "one_triangle.h"

bool use_map_description() {
  fathom::DepthMap map;
  fathom::describe_map(one_triangle(), small_camera(), "mine", map);
  return map.texts.at("fathom.engine") == "mine";
}
