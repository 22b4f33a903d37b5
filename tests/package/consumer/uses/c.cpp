#include <fathom.h>

#include <cmath>

bool use_c() {
  const double vertices[] = {-9, -9, 4, 9, -9, 4, 0, 9, 4};
  const uint32_t triangles[] = {0, 1, 2};
  fathom_camera camera{8, 8, 0, 8, 8, 4, 4, 0, 0.5, {}, 0, INFINITY, nullptr};
  for (int i = 0; i < 3; ++i) camera.world_to_camera[i][i] = 1;
  fathom_scene* scene = nullptr;
  fathom_map* map = nullptr;
  const bool rendered =
      fathom_scene_new(&scene) == FATHOM_OK &&
      fathom_scene_add(scene, vertices, 3, triangles, 1, nullptr, nullptr, 1) == FATHOM_OK &&
      fathom_render(scene, &camera, "Z", nullptr, &map) == FATHOM_OK;
  const bool right = rendered && fathom_map_float32(map, "Z")[4 * 8 + 4] == 4;
  fathom_map_free(map);
  fathom_scene_free(scene);
  return right;
}
