#include <fathom/scene/framing.h>
#include <fathom/scene/read_scene.h>

bool use_scene() {
  return fathom::triangle_count(fathom::Scene{}) == 0 &&
         !find_fault(fathom::frame({{-1, -1, -1}, {1, 1, 1}}));
}
