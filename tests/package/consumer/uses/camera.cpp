#include <fathom/camera/camera_making.h>

bool use_camera() {
  return !find_fault(fathom::look_at({0, 0, 5}, {0, 0, 0}, {0, 1, 0}));
}
