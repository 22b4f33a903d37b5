/* Renders the triangle (-1, -1, 4), (1, -1, 4), (0, 1, 5) with libfathom: the middle of the image sees its plane,
 * z = 4.5 + y / 2, at y = 0. */
#include <fathom.h>
#include <math.h>
#include <stdio.h>

int main(void) {
  const double vertices[] = {-1, -1, 4, 1, -1, 4, 0, 1, 5};
  const uint32_t triangles[] = {0, 1, 2};
  const fathom_camera camera = {.width = 3,
                                .height = 3,
                                .fx = 1,
                                .fy = 1,
                                .cx = 1.5,
                                .cy = 1.5,
                                .pixel_centre = 0.5,
                                .world_to_camera = {{1, 0, 0, 0}, {0, 1, 0, 0}, {0, 0, 1, 0}},
                                .far_depth = INFINITY};
  fathom_scene* scene = NULL;
  fathom_map* map = NULL;
  const int failed =
      fathom_scene_new(&scene) != FATHOM_OK ||
      fathom_scene_add(scene, vertices, 3, triangles, 1, NULL, NULL, 0) != FATHOM_OK ||
      fathom_render(scene, &camera, "Z", NULL, &map) != FATHOM_OK;
  if (failed) {
    fprintf(stderr, "triangle: error: %s\n", fathom_error());
    return 1;
  }
  const float middle = fathom_map_float32(map, "Z")[4];
  printf("Fathom %s: %.9g\n", fathom_version(), middle);
  fathom_map_free(map);
  fathom_scene_free(scene);
  return middle == 4.5F ? 0 : 1;
}
