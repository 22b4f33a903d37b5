/* The functions of the C interface for rays, as a program in C uses them. */
#include <math.h>
#include <stddef.h>
#include <stdio.h>
#include <string.h>

#include "check.h"
#include "fathom.h"

/* The cube from 0 to 2, whose front faces look outwards, and a square behind it, at x = 4. */
static const double corners[] = {0, 0, 0, 0, 0, 2, 0, 2, 0, 0, 2, 2,
                                 2, 0, 0, 2, 0, 2, 2, 2, 0, 2, 2, 2};
static const uint32_t sides[] = {0, 1, 3, 0, 3, 2, 4, 6, 7, 4, 7, 5, 0, 4, 5, 0, 5, 1,
                                 2, 3, 7, 2, 7, 6, 0, 2, 6, 0, 6, 4, 1, 5, 7, 1, 7, 3};
static const double square[] = {4, 0, 0, 4, 2, 0, 4, 2, 2, 4, 0, 2};
static const uint32_t halves[] = {0, 1, 2, 0, 2, 3};

static fathom_scene* make_scene(void) {
  fathom_scene* scene = NULL;
  CHECK(fathom_scene_new(&scene) == FATHOM_OK);
  CHECK(fathom_scene_add(scene, corners, 8, sides, 12, NULL, "cube", 1) == FATHOM_OK);
  CHECK(fathom_scene_add(scene, square, 4, halves, 2, NULL, "square", 1) == FATHOM_OK);
  return scene;
}

static fathom_rays* prepare(const fathom_scene* scene) {
  fathom_rays* rays = NULL;
  CHECK(fathom_rays_new(scene, 0, &rays) == FATHOM_OK);
  return rays;
}

/* The first ray lies in the diagonals of two sides of the cube and of the square, the second meets
 * nothing, the third comes from within. */
static const double origins[] = {-1, 1, 1, -1, 3, 1, 1, 0.5, 1};
static const double directions[] = {2, 0, 0, 2, 0, 0, 0.5, 0, 0};
static const fathom_ray_array three = {3, origins, directions, 0, 0};

static void nearest_hits(const fathom_rays* rays) {
  double t[3], distance[3], position[9], barycentric[6], normal[9];
  uint32_t triangle[3], object[3], face[3];
  const fathom_hit_arrays all = {triangle, t,      distance, position, barycentric,
                                 normal,   object, face,     0};
  CHECK(fathom_cast(rays, &three, NULL, &all) == FATHOM_OK);
  CHECK(t[0] == 0.5 && t[1] == INFINITY && t[2] == 2);
  CHECK(distance[0] == 1 && distance[1] == INFINITY && distance[2] == 1);
  CHECK(triangle[0] < 2 && triangle[1] == FATHOM_NO_SURFACE && triangle[2] / 2 == 1);
  CHECK(object[0] == 0 && object[1] == FATHOM_NO_SURFACE && face[2] == triangle[2]);
  CHECK(position[0] == 0 && position[1] == 1 && position[2] == 1 && isnan(position[3]));
  CHECK(normal[0] == -1 && normal[3] == 0 && normal[6] == -1 && isnan(barycentric[3]));
  CHECK(barycentric[0] == 0.5 || barycentric[1] == 0.5);
}

/* The caller's own structures: unaligned numbers between others. */
#pragma pack(push, 1)
typedef struct {
  char name;
  double place[3];
  float weight;
  double towards[3];
} own_ray;
typedef struct {
  uint32_t triangle;
  double t;
  char mark;
  double normal[3];
} own_hit;
#pragma pack(pop)

static void strides_leave_gaps(const fathom_rays* rays) {
  own_ray own[3];
  own_hit hits[3];
  fathom_ray_array given = {3, NULL, NULL, sizeof(own_ray), sizeof(own_ray)};
  fathom_hit_arrays to = {0};
  size_t i;
  memset(hits, 'x', sizeof hits);
  for (i = 0; i < 3; ++i) {
    memcpy(own[i].place, origins + 3 * i, sizeof own[i].place);
    memcpy(own[i].towards, directions + 3 * i, sizeof own[i].towards);
  }
  given.origins = (const double*)(const void*)((const char*)own + offsetof(own_ray, place));
  given.directions = (const double*)(const void*)((const char*)own + offsetof(own_ray, towards));
  to.triangle = (uint32_t*)(void*)((char*)hits + offsetof(own_hit, triangle));
  to.t = (double*)(void*)((char*)hits + offsetof(own_hit, t));
  to.normal = (double*)(void*)((char*)hits + offsetof(own_hit, normal));
  to.stride = sizeof(own_hit);
  CHECK(fathom_cast(rays, &given, NULL, &to) == FATHOM_OK);
  CHECK(hits[0].t == 0.5 && hits[1].t == INFINITY && hits[2].t == 2 && hits[1].mark == 'x');
  CHECK(hits[1].triangle == FATHOM_NO_SURFACE && hits[2].normal[0] == -1 && hits[2].mark == 'x');
}

static void segments_and_culling(const fathom_rays* rays) {
  const fathom_cast_options to_front = {0, 0.5, 0, FATHOM_CULL_NONE, 1};
  const fathom_cast_options before_front = {0, 0.5, 1, FATHOM_CULL_NONE, 1};
  const fathom_cast_options backs = {0, INFINITY, 0, FATHOM_CULL_FRONT, 0};
  uint8_t occluded[3];
  uint32_t counts[3];
  CHECK(fathom_occluded(rays, &three, NULL, occluded) == FATHOM_OK);
  CHECK(occluded[0] == 1 && occluded[1] == 0 && occluded[2] == 1);
  CHECK(fathom_occluded(rays, &three, &to_front, occluded) == FATHOM_OK);
  CHECK(occluded[0] == 1 && occluded[2] == 0);
  CHECK(fathom_occluded(rays, &three, &before_front, occluded) == FATHOM_OK && occluded[0] == 0);
  CHECK(fathom_count_hits(rays, &three, NULL, counts) == FATHOM_OK);
  CHECK(counts[0] == 3 && counts[1] == 0 && counts[2] == 2);
  CHECK(fathom_count_hits(rays, &three, &backs, counts) == FATHOM_OK && counts[0] < 3);
}

static void every_hit(const fathom_rays* rays) {
  fathom_hits* hits = NULL;
  double t[5], distance[5];
  uint32_t object[5];
  fathom_hit_arrays to = {0};
  to.t = t;
  to.distance = distance;
  to.object = object;
  CHECK(fathom_all_hits(rays, &three, NULL, &hits) == FATHOM_OK);
  CHECK(fathom_hits_count(hits) == 5);
  const uint64_t* const splits = fathom_hits_splits(hits);
  CHECK(splits[0] == 0 && splits[1] == 3 && splits[2] == 3 && splits[3] == 5);
  CHECK(fathom_hits_values(hits, &to) == FATHOM_OK);
  CHECK(t[0] == 0.5 && t[1] == 1.5 && t[2] == 2.5 && t[3] == 2 && t[4] == 6);
  CHECK(distance[2] == 5 && distance[4] == 3);
  CHECK(object[1] == 0 && object[2] == 1 && object[4] == 1);
  fathom_hits_free(hits);
  fathom_hits_free(NULL);
  CHECK(fathom_hits_count(NULL) == 0 && fathom_hits_splits(NULL) == NULL);
}

static void inside(const fathom_rays* rays) {
  const double points[] = {1, 1, 1, 7, -1, 3, 1, 7, 5, 1, 1, 7};
  uint8_t found[3] = {9, 9, 9};
  CHECK(fathom_contains(rays, points, 3, 4 * sizeof(double), 0, found) == FATHOM_OK);
  CHECK(found[0] == 1 && found[1] == 0 && found[2] == 0);
  CHECK(fathom_contains(rays, NULL, 0, 0, 0, NULL) == FATHOM_OK);
}

static void failures_say_why(const fathom_scene* scene, const fathom_rays* rays) {
  const double none[] = {0, 0, 0}, nan_origin[] = {0, NAN, 0}, along_x[] = {1, 0, 0};
  const fathom_ray_array no_direction = {1, none, none, 0, 0};
  const fathom_ray_array no_origin = {1, nan_origin, along_x, 0, 0};
  const fathom_ray_array missing = {1, NULL, along_x, 0, 0};
  const fathom_ray_array too_many = {(size_t)-1, none, along_x, 0, 0};
  const fathom_ray_array empty = {0, NULL, NULL, 0, 0};
  const fathom_cast_options backwards = {2, 1, 0, FATHOM_CULL_NONE, 0};
  const fathom_cast_options negative = {0, 1, 0, FATHOM_CULL_NONE, -1};
  double t = 7;
  fathom_hit_arrays to = {0};
  fathom_rays* other = NULL;
  fathom_hits* hits = NULL;
  fathom_scene* faulty = NULL;
  to.t = &t;
  CHECK(fathom_cast(rays, &no_direction, NULL, &to) == FATHOM_INPUT &&
        strcmp(fathom_error(), "ray 0: its direction is 0") == 0);
  CHECK(fathom_cast(rays, &no_origin, NULL, &to) == FATHOM_INPUT &&
        strcmp(fathom_error(), "ray 0: its origin is not finite") == 0);
  CHECK(fathom_cast(rays, &missing, NULL, &to) == FATHOM_USAGE);
  CHECK(fathom_cast(rays, &too_many, NULL, &to) == FATHOM_USAGE &&
        strstr(fathom_error(), "count: expected at most") != NULL);
  CHECK(fathom_cast(rays, &three, &backwards, &to) == FATHOM_USAGE &&
        strstr(fathom_error(), "t_min") != NULL);
  CHECK(fathom_cast(rays, &three, &negative, &to) == FATHOM_USAGE);
  CHECK(fathom_cast(NULL, &three, NULL, &to) == FATHOM_USAGE);
  CHECK(fathom_cast(rays, NULL, NULL, &to) == FATHOM_USAGE);
  CHECK(fathom_cast(rays, &three, NULL, NULL) == FATHOM_USAGE);
  CHECK(fathom_all_hits(rays, &no_direction, NULL, &hits) == FATHOM_INPUT && hits == NULL);
  CHECK(fathom_hits_values(NULL, &to) == FATHOM_USAGE);
  CHECK(t == 7);
  CHECK(fathom_cast(rays, &empty, NULL, &to) == FATHOM_OK && t == 7);
  CHECK(fathom_rays_new(NULL, 0, &other) == FATHOM_USAGE);
  CHECK(fathom_rays_new(scene, 0, NULL) == FATHOM_USAGE);
  CHECK(fathom_rays_new(scene, -1, &other) == FATHOM_USAGE);
  CHECK(fathom_scene_new(&faulty) == FATHOM_OK);
  CHECK(fathom_scene_add(faulty, corners, 3, sides, 1, NULL, NULL, 1) == FATHOM_OK);
  CHECK(fathom_rays_new(faulty, 0, &other) == FATHOM_INPUT && other == NULL);
  fathom_scene_free(faulty);
  fathom_rays_free(NULL);
}

int main(void) {
  fathom_scene* const scene = make_scene();
  fathom_rays* const rays = prepare(scene);
  nearest_hits(rays);
  strides_leave_gaps(rays);
  segments_and_culling(rays);
  every_hit(rays);
  inside(rays);
  failures_say_why(scene, rays);
  fathom_rays_free(rays);
  fathom_scene_free(scene);
  if (failures == 0) puts("all is well");
  return failures == 0 ? 0 : 1;
}
