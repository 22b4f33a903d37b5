#include <fathom/rendering/rendered.h>

bool use_rendering() {
  fathom::RenderStatistics sum, part;
  part.culled_triangles = 3;
  add(sum, part);
  return sum.culled_triangles == 3;
}
