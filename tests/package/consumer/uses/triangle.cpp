#include <fathom/triangle/options.h>

bool use_triangle() {
  fathom::RenderStatistics sum, part;
  part.culled_triangles = 3;
  add(sum, part);
  return sum.culled_triangles == 3;
}
