#include <fathom/pipeline/render_pipeline.h>

#include "one_triangle.h"

bool use_pipeline() {
  return fathom::pipeline::render_frame(one_triangle(), small_camera(), {}, false).depth.size() ==
         16;
}
