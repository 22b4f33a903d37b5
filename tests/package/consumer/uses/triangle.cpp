#include <fathom/rendering/options.h>

// The room has no header for users; its target brings the options.
bool use_triangle() {
  return fathom::name_of(fathom::Engine::fast) == "fast";
}
