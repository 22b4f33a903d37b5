#include <fathom/depth_format/depth_format.h>

bool use_depth_format() {
  return fathom::mapping_named("reversed") == fathom::Mapping::reversed;
}
