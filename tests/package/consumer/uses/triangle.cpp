#include <fathom/triangle/options.h>

bool use_triangle() {
  fathom::RenderStatistics sum, part;
  part.triangles = 3;
  add(sum, part);
  return sum.triangles == 3;
}
