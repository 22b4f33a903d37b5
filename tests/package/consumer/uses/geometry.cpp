#include <fathom/geometry/frames.h>

bool use_geometry() {
  return fathom::WorldFromMesh{}({1, 2, 3}).z == fathom::Dyadic(3);
}
