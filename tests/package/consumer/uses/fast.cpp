#include <fathom/fast/render_fast.h>

#include "one_triangle.h"

bool use_fast() {
  return render_fast(one_triangle(), small_camera(), {}).map.values<float>("Z")->at(0) == 2;
}
