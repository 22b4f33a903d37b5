/* The C interface, as a program in C uses it. */
#include <float.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "check.h"
#include "fathom.h"

/* A triangle in the plane z = 4 + x/2, and a camera at the origin. */
static const double vertices[] = {-2, -2, 3, 2, -2, 5, 0, 2, 4};
static const uint32_t triangles[] = {0, 1, 2};
static const fathom_camera camera = {
    64, 48,       0,   40, 40, 32, 24, 0, 0.5, {{1, 0, 0, 0}, {0, 1, 0, 0}, {0, 0, 1, 0}},
    0,  INFINITY, NULL};

static fathom_scene* make_scene(const double* pose, int lent) {
  fathom_scene* scene = NULL;
  CHECK(fathom_scene_new(&scene) == FATHOM_OK);
  CHECK(fathom_scene_add(scene, vertices, 3, triangles, 1, pose, "sheet", lent) == FATHOM_OK);
  return scene;
}

static void every_depth_is_that_of_the_plane(int lent) {
  fathom_scene* scene = make_scene(NULL, lent);
  fathom_map* map = NULL;
  int seen = 0;
  uint32_t x, y;
  CHECK(fathom_render(scene, &camera, "Z,id,N", NULL, &map) == FATHOM_OK);
  CHECK(fathom_map_width(map) == 64 && fathom_map_height(map) == 48);
  const float* const depths = fathom_map_float32(map, "Z");
  const uint32_t* const ids = fathom_map_uint32(map, "id");
  for (y = 0; y < 48; ++y) {
    for (x = 0; x < 64; ++x) {
      const float depth = depths[y * 64 + x];
      CHECK((ids[y * 64 + x] == 0) == (depth < INFINITY));
      if (depth == INFINITY) continue;
      ++seen;
      /* X = z·a, so that z = 4 / (1 − a/2): a quotient of small integers, which binary64 rounds once */
      CHECK(depth == (float)(320.0 / (80.0 - (x + 0.5 - 32))));
    }
  }
  CHECK(seen > 500);
  CHECK(fathom_map_float64(map, "Z") == NULL && fathom_map_float32(map, "id") == NULL);
  CHECK(fathom_map_float32(map, "N.Z") != NULL && fathom_map_uint16(map, "Z") == NULL);
  CHECK(strcmp(fathom_map_channel(map, 0), "Z") == 0 && fathom_map_channel(map, 5) == NULL);
  CHECK(strstr(fathom_map_text(map, "fathom.camera"), "pixel_centre") != NULL);
  CHECK(fathom_map_text(map, "nothing") == NULL);
  fathom_map_free(map);
  fathom_scene_free(scene);
}

static void poses_place_exactly(void) {
  const double pose[] = {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 2};
  fathom_scene* scene = make_scene(pose, 0);
  double lower[3], upper[3];
  CHECK(fathom_scene_bounds(scene, lower, upper) == FATHOM_OK);
  CHECK(lower[2] == 5 && upper[2] == 7 && fathom_scene_triangle_count(scene) == 1);
  fathom_scene_free(scene);
}

static void files_keep_every_bit(const char* mesh, const char* folder) {
  fathom_scene* scene = NULL;
  fathom_camera view;
  fathom_map *map = NULL, *again = NULL;
  fathom_options options = {FATHOM_CULL_BACK, 0, 1, NULL, NULL};
  uint64_t differing = 7;
  char file[4096];
  CHECK(fathom_scene_read(&mesh, 1, &scene) == FATHOM_OK);
  CHECK(fathom_camera_frame(scene, 35, 25, 80, 60, 40, &view) == FATHOM_OK);
  CHECK(fathom_camera_check(&view) == FATHOM_OK);
  CHECK(fathom_render(scene, &view, "Z,A", &options, &map) == FATHOM_OK);
  CHECK(fathom_verify(map, scene, &view, &options, 300, &differing) == FATHOM_OK && differing == 0);
  snprintf(file, sizeof file, "%s/c.exr", folder);
  CHECK(fathom_map_write(map, file, NULL) == FATHOM_OK);
  CHECK(fathom_map_read(file, &again) == FATHOM_OK);
  CHECK(memcmp(fathom_map_float32(map, "Z"), fathom_map_float32(again, "Z"),
               80 * 60 * sizeof(float)) == 0);
  snprintf(file, sizeof file, "%s/c.npy", folder);
  CHECK(fathom_map_write(map, file, "A") == FATHOM_OK);
  CHECK(fathom_map_write(map, file, NULL) == FATHOM_USAGE);
  snprintf(file, sizeof file, "%s/c.jpg", folder);
  CHECK(fathom_map_write(map, file, NULL) == FATHOM_USAGE);
  snprintf(file, sizeof file, "%s/none/c.exr", folder);
  CHECK(fathom_map_write(map, file, NULL) == FATHOM_OUTPUT);
  fathom_map_free(map);
  fathom_map_free(again);
  fathom_scene_free(scene);
}

static int stop(double done, void* data) {
  ++*(int*)data;
  return done >= 0;
}

static void progress_can_stop_it(void) {
  fathom_scene* scene = make_scene(NULL, 1);
  int calls = 0;
  fathom_map* map = NULL;
  fathom_options options = {FATHOM_CULL_NONE, 1, 0, stop, NULL};
  options.data = &calls;
  CHECK(fathom_render(scene, &camera, "Z", &options, &map) == FATHOM_STOPPED && map == NULL &&
        calls > 0);
  options.progress = NULL;
  CHECK(fathom_render(scene, &camera, "Z", &options, &map) == FATHOM_OK);
  CHECK(fathom_map_float64(map, "Z") != NULL);
  fathom_map_free(map);
  fathom_scene_free(scene);
}

/* Counts whose bytes are few, or none, once they have overflowed; none of them may be read. */
static void counts_that_overflow_are_refused(void) {
  const size_t counts[] = {(size_t)-1, SIZE_MAX / 24 + 1, SIZE_MAX / 12 + 1, SIZE_MAX / 3 + 1,
                           (size_t)UINT32_MAX};
  size_t i;
  int lent;
  for (i = 0; i < sizeof counts / sizeof counts[0]; ++i) {
    for (lent = 0; lent < 2; ++lent) {
      fathom_scene* scene = make_scene(NULL, 0);
      CHECK(fathom_scene_add(scene, vertices, counts[i], triangles, 1, NULL, NULL, lent) ==
                FATHOM_USAGE &&
            strstr(fathom_error(), "vertex_count: expected at most 4294967294") != NULL);
      CHECK(fathom_scene_add(scene, vertices, 3, triangles, counts[i], NULL, NULL, lent) ==
                FATHOM_USAGE &&
            strstr(fathom_error(), "triangle_count: expected at most 4294967294") != NULL);
      CHECK(fathom_scene_triangle_count(scene) == 1);
      fathom_scene_free(scene);
    }
  }
}

static void failures_say_why(void) {
  fathom_scene* scene = make_scene(NULL, 0);
  fathom_scene* other = NULL;
  fathom_map* map = NULL;
  fathom_camera bad = camera;
  const double here[] = {0, 0, 0}, nan_vertex[] = {NAN, 0, 0, 1, 0, 0, 0, 1, 0};
  const uint32_t beyond[] = {0, 1, 3};
  const char* none = "none.obj";
  bad.fx = 0;
  CHECK(fathom_camera_check(&bad) == FATHOM_INPUT && strstr(fathom_error(), "fx") != NULL);
  CHECK(fathom_render(scene, &bad, "Z", NULL, &map) == FATHOM_INPUT && map == NULL);
  CHECK(fathom_render(scene, &camera, "Z,Y", NULL, &map) == FATHOM_USAGE &&
        strstr(fathom_error(), "'Y'") != NULL);
  CHECK(fathom_render(scene, &camera, "", NULL, &map) == FATHOM_USAGE);
  CHECK(fathom_render(NULL, &camera, "Z", NULL, &map) == FATHOM_USAGE);
  CHECK(fathom_render(scene, NULL, "Z", NULL, &map) == FATHOM_USAGE);
  CHECK(fathom_render(scene, &camera, NULL, NULL, &map) == FATHOM_USAGE);
  CHECK(fathom_camera_look_at(here, here, here, 4, 4, 40, &bad) == FATHOM_USAGE);
  CHECK(fathom_scene_read(&none, 1, &other) == FATHOM_INPUT && other == NULL);
  CHECK(strstr(fathom_error(), "none.obj") != NULL && strchr(fathom_error(), '\n') == NULL);
  CHECK(fathom_map_read("none.exr", &map) == FATHOM_INPUT && map == NULL);
  CHECK(fathom_scene_add(scene, nan_vertex, 3, triangles, 1, NULL, NULL, 0) == FATHOM_OK);
  CHECK(fathom_render(scene, &camera, "Z", NULL, &map) == FATHOM_INPUT &&
        strstr(fathom_error(), "finite") != NULL);
  fathom_scene_free(scene);
  scene = make_scene(NULL, 0);
  CHECK(fathom_scene_add(scene, vertices, 3, beyond, 1, NULL, NULL, 1) == FATHOM_OK);
  CHECK(fathom_render(scene, &camera, "Z", NULL, &map) == FATHOM_INPUT && map == NULL);
  CHECK(fathom_scene_add(scene, NULL, 3, beyond, 1, NULL, NULL, 1) == FATHOM_USAGE);
  fathom_scene_free(scene);
  counts_that_overflow_are_refused();
  fathom_scene_free(NULL);
  fathom_map_free(NULL);
}

/* A triangle of a material, and one of none. */
static void numbers_have_names(const char* folder) {
  char path[4096];
  const char* mesh = path;
  fathom_scene* scene = NULL;
  fathom_map* map = NULL;
  size_t i, named = 0, unnamed = 0;
  snprintf(path, sizeof path, "%s/fathom_c_names.obj", folder);
  FILE* const file = fopen(path, "w");
  CHECK(file != NULL);
  fputs(
      "v -2 -2 4\nv 2 -2 4\nv 0 2 4\nv 9 9 9\nf 1 2 3\nv -2 -2 3\nv 0 -2 3\nv -1 2 3\n"
      "o lid\nusemtl dark oak\nf 5 6 7\n",
      file);
  fclose(file);
  CHECK(fathom_scene_read(&mesh, 1, &scene) == FATHOM_OK);
  CHECK(fathom_render(scene, &camera, "material,part,object,id", NULL, &map) == FATHOM_OK);
  const uint32_t* const ids = fathom_map_uint32(map, "id");
  const uint32_t* const materials = fathom_map_uint32(map, "material");
  for (i = 0; i < 64 * 48; ++i) {
    const uint32_t truth = ids[i] == 1 ? 0 : ids[i] == 0 ? FATHOM_NO_SEGMENT : FATHOM_NO_SURFACE;
    CHECK(materials[i] == truth);
    named += ids[i] == 1;
    unnamed += ids[i] == 0;
  }
  CHECK(named > 50 && unnamed > 50);
  CHECK(strcmp(fathom_map_name(map, "material", 0), "dark oak") == 0);
  CHECK(strcmp(fathom_map_name(map, "part", 0), "lid") == 0);
  CHECK(strcmp(fathom_map_name(map, "object", 0), "fathom_c_names") == 0);
  CHECK(fathom_map_name(map, "material", 1) == NULL && fathom_map_name(map, "id", 0) == NULL);
  CHECK(fathom_map_name(NULL, "material", 0) == NULL && fathom_map_name(map, NULL, 0) == NULL);
  fathom_map_free(map);
  fathom_scene_free(scene);
  remove(path);
}

/* The depth of the plane where SIMPLE_RADIAL sees it, whose direction is found by iteration. */
static double bent_depth(double u, double v, double k) {
  const double xd = (u - 32) / 40, yd = (v - 24) / 40;
  double x = xd, y = yd;
  int i;
  for (i = 0; i < 100; ++i) {
    const double factor = 1 + k * (x * x + y * y);
    x = xd / factor;
    y = yd / factor;
  }
  return 4 / (1 - x / 2);
}

static void a_lens_bends_rays(void) {
  const double k = -0.1;
  fathom_scene* scene = make_scene(NULL, 0);
  fathom_camera bent = camera;
  fathom_map* map = NULL;
  uint32_t x, y;
  int seen = 0;
  CHECK(fathom_lens_new("SIMPLE_RADIAL", &k, 1, INFINITY, &bent.lens) == FATHOM_OK);
  CHECK(fathom_camera_check(&bent) == FATHOM_OK);
  CHECK(fathom_render(scene, &bent, "Z,valid", NULL, &map) == FATHOM_OK);
  const float* const depths = fathom_map_float32(map, "Z");
  for (y = 0; y < 48; ++y) {
    for (x = 0; x < 64; ++x) {
      const float depth = depths[y * 64 + x];
      if (depth == INFINITY) continue;
      ++seen;
      CHECK(fabs(depth - bent_depth(x + 0.5, y + 0.5, k)) < 4 * FLT_EPSILON * depth);
      CHECK(fathom_map_uint32(map, "valid")[y * 64 + x] == 1);
    }
  }
  CHECK(seen > 500);
  CHECK(strstr(fathom_map_text(map, "fathom.camera"), "SIMPLE_RADIAL") != NULL);
  fathom_map_free(map);
  fathom_lens_free(bent.lens);
  fathom_scene_free(scene);
}

static void lenses_come_from_files(const char* folder) {
  char path[4096];
  fathom_camera view;
  size_t count = 0;
  snprintf(path, sizeof path, "%s/fathom_c_lens.json", folder);
  FILE* const file = fopen(path, "w");
  CHECK(file != NULL);
  fputs(
      "{\"width\": 8, \"height\": 6, \"model\": \"OPENCV\", \"fx\": 8, \"fy\": 8, \"cx\": 4, "
      "\"cy\": 3, \"k1\": -0.25, \"p2\": 0.5, \"max_radius\": 0.75, \"pixel_centre\": 0.5, "
      "\"world_to_camera\": [[1, 0, 0, 0], [0, 1, 0, 0], [0, 0, 1, 0]]}",
      file);
  fclose(file);
  CHECK(fathom_camera_read(path, &view) == FATHOM_OK);
  CHECK(strcmp(fathom_lens_model(view.lens), "OPENCV") == 0);
  const double* const numbers = fathom_lens_distortion(view.lens, &count);
  CHECK(count == 4 && numbers[0] == -0.25 && numbers[1] == 0 && numbers[3] == 0.5);
  CHECK(fathom_lens_distortion(view.lens, NULL) == numbers);
  CHECK(fathom_lens_max_radius(view.lens) == 0.75);
  fathom_lens_free(view.lens);
  CHECK(fathom_lens_distortion(NULL, &count) == NULL && count == 0);
  CHECK(fathom_lens_model(NULL) == NULL && fathom_lens_max_radius(NULL) == INFINITY);
  fathom_lens_free(NULL);
  remove(path);
}

static void lenses_are_refused(void) {
  const double numbers[] = {0.1, 0.2, 0.3, NAN};
  fathom_scene* scene = make_scene(NULL, 0);
  fathom_camera bent = camera;
  fathom_lens* lens = NULL;
  fathom_map* map = NULL;
  uint64_t differing = 7;
  CHECK(fathom_lens_new("OPENC", numbers, 4, INFINITY, &lens) == FATHOM_USAGE &&
        strstr(fathom_error(), "did you mean 'OPENCV'?") != NULL);
  CHECK(fathom_lens_new("OPENCV", numbers, 3, INFINITY, &lens) == FATHOM_USAGE &&
        strstr(fathom_error(), "found 3 numbers, OPENCV has 4") != NULL);
  CHECK(fathom_lens_new("OPENCV", numbers, SIZE_MAX, INFINITY, &lens) == FATHOM_USAGE);
  CHECK(fathom_lens_new("OPENCV", numbers, 4, INFINITY, &lens) == FATHOM_USAGE &&
        strstr(fathom_error(), "p2") != NULL);
  CHECK(fathom_lens_new("RADIAL", numbers, 2, 0, &lens) == FATHOM_USAGE &&
        strstr(fathom_error(), "max_radius") != NULL);
  CHECK(fathom_lens_new(NULL, numbers, 2, INFINITY, &lens) == FATHOM_USAGE);
  CHECK(fathom_lens_new("RADIAL", NULL, 2, INFINITY, &lens) == FATHOM_USAGE);
  CHECK(fathom_lens_new("RADIAL", numbers, 2, INFINITY, NULL) == FATHOM_USAGE && lens == NULL);
  CHECK(fathom_lens_new("RADIAL", numbers, 2, INFINITY, &lens) == FATHOM_OK);
  bent.lens = lens;
  CHECK(fathom_render(scene, &bent, "Z,A", NULL, &map) == FATHOM_USAGE &&
        strstr(fathom_error(), "the lens RADIAL: channel A") != NULL && map == NULL);
  CHECK(fathom_render(scene, &bent, "Z", NULL, &map) == FATHOM_OK);
  CHECK(fathom_verify(map, scene, &bent, NULL, 9, &differing) == FATHOM_OK && differing == 0);
  bent.fy = 41;
  CHECK(fathom_camera_check(&bent) == FATHOM_INPUT &&
        strstr(fathom_error(), "RADIAL has one focal length") != NULL);
  fathom_map_free(map);
  fathom_lens_free(lens);
  fathom_scene_free(scene);
}

/* A square of 4 at z = 1 hides half of a rectangle of 8 at z = 0. */
static void areas_are_exact(void) {
  static const double plates[] = {0, 0, 1, 2, 0, 1, 2, 2, 1, 0, 2, 1,
                                  0, 0, 0, 4, 0, 0, 4, 2, 0, 0, 2, 0};
  static const uint32_t corners[] = {0, 1, 2, 0, 2, 3};
  const double directions[] = {0, 0, 5, 0, 0, -1, 1, 0, 0, 3, 0, 4};
  fathom_area_options options = {FATHOM_CULL_NONE, 1, 1, 0};
  const fathom_areas_result* areas = NULL;
  fathom_scene* scene = NULL;
  CHECK(fathom_scene_new(&scene) == FATHOM_OK);
  CHECK(fathom_scene_add(scene, plates, 4, corners, 2, NULL, "upper", 0) == FATHOM_OK);
  CHECK(fathom_scene_add(scene, plates + 12, 4, corners, 2, NULL, "lower", 0) == FATHOM_OK);
  CHECK(fathom_areas(scene, 4, directions, FATHOM_BY_OBJECT, &options, &areas) == FATHOM_OK);
  CHECK(areas->lights == 4 && areas->items == 2 && strcmp(areas->name[1], "lower") == 0);
  CHECK(areas->visible[0] == 4 && areas->visible[1] == 4 && areas->fraction[1] == 0.5);
  CHECK(areas->centroid[3] == 3 && areas->centroid[4] == 1 && areas->centroid[5] == 0);
  CHECK(areas->visible[2] == 0 && areas->fraction[2] == 0 && areas->fraction[3] == 1);
  CHECK(isnan(areas->centroid[6]) && areas->lit[3] == 8);
  CHECK(areas->projected[4] == 0 && isnan(areas->fraction[4]));
  CHECK(areas->projected[7] == 6.4 && areas->visible[7] == 4.4);
  CHECK(areas->side == NULL && areas->object == NULL && areas->number[1] == 1);
  fathom_areas_free(areas);
  CHECK(fathom_areas(scene, 1, directions, FATHOM_BY_TRIANGLE, NULL, &areas) == FATHOM_OK);
  CHECK(areas->items == 4 && areas->side[0] == 1 && areas->object[2] == 1 && areas->face[3] == 1);
  fathom_areas_free(areas);
  fathom_areas_free(NULL);
  fathom_scene_free(scene);
}

static void areas_are_refused(void) {
  const double zero[] = {0, 0, 1, 0, 0, 0};
  fathom_area_options options = {FATHOM_CULL_NONE, -1, 0, 0};
  const fathom_areas_result* areas = NULL;
  fathom_scene* scene = make_scene(NULL, 0);
  CHECK(fathom_areas(scene, 2, zero, FATHOM_BY_OBJECT, NULL, &areas) == FATHOM_USAGE &&
        strstr(fathom_error(), "direction") != NULL && areas == NULL);
  CHECK(fathom_areas(scene, 1, zero, (fathom_by)7, NULL, &areas) == FATHOM_USAGE);
  CHECK(fathom_areas(scene, 1, zero, FATHOM_BY_OBJECT, &options, &areas) == FATHOM_USAGE &&
        strstr(fathom_error(), "threads") != NULL);
  CHECK(fathom_areas(scene, 0, zero, FATHOM_BY_OBJECT, NULL, &areas) == FATHOM_USAGE);
  CHECK(fathom_areas(scene, SIZE_MAX, zero, FATHOM_BY_OBJECT, NULL, &areas) == FATHOM_USAGE);
  CHECK(fathom_areas(NULL, 1, zero, FATHOM_BY_OBJECT, NULL, &areas) == FATHOM_USAGE);
  CHECK(fathom_areas(scene, 1, NULL, FATHOM_BY_OBJECT, NULL, &areas) == FATHOM_USAGE);
  CHECK(fathom_areas(scene, 1, zero, FATHOM_BY_OBJECT, NULL, NULL) == FATHOM_USAGE);
  fathom_scene_free(scene);
}

int main(int count, char** arguments) {
  if (count != 3) {
    fprintf(stderr, "usage: fathom_c_test MESH FOLDER\n");
    return 2;
  }
  CHECK(strcmp(fathom_error(), "") == 0 && strlen(fathom_version()) >= 5);
  every_depth_is_that_of_the_plane(0);
  every_depth_is_that_of_the_plane(1);
  poses_place_exactly();
  files_keep_every_bit(arguments[1], arguments[2]);
  numbers_have_names(arguments[2]);
  progress_can_stop_it();
  failures_say_why();
  a_lens_bends_rays();
  lenses_come_from_files(arguments[2]);
  lenses_are_refused();
  areas_are_exact();
  areas_are_refused();
  if (failures == 0) puts("all is well");
  return failures == 0 ? 0 : 1;
}
