#include <fathom/rays/cast.h>

#include <array>

#include "one_triangle.h"

bool use_rays() {
  const fathom::Scene scene = one_triangle();
  const std::array rays{fathom::Ray{{1, 1, 0}, {0, 0, 1}}};
  return fathom::cast(fathom::RayScene(scene), rays).front() == fathom::RayHit{0, 2};
}
