#include <fathom/depth_buffer/depth_buffer.h>

bool use_depth_buffer() {
  fathom::Camera camera;
  camera.near = 1;
  camera.far = 2;
  const auto format =
      fathom::depth_format_of(camera, fathom::Mapping::standard, fathom::Storage::unorm16);
  return format.far == 2;
}
