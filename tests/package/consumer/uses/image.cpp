#include <fathom/image/map_files.h>
#include <fathom/image/sample_pattern.h>

bool use_image() {
  return fathom::sample_pattern("4").count() == 4 && fathom::DepthMap{}.find("Z") == nullptr;
}
