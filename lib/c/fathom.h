/* Fathom for C, and for every language that calls C: exact depth maps of triangle meshes.
 *
 * Handles are opaque. Each kind of handle has a function that frees it and accepts NULL. Functions
 * that can fail return a fathom_status; after a failure fathom_error() returns the reason in one
 * line, and outputs are not written. No exception leaves this library. Strings are UTF-8.
 *
 * Several threads may call all functions at the same time, also with the same scene and map, as
 * long as no thread changes or frees these meanwhile. Results never depend on the number of
 * threads.
 */
#ifndef FATHOM_H
#define FATHOM_H

#include <stddef.h>
#include <stdint.h>

#if defined(__GNUC__)
#define FATHOM_API __attribute__((visibility("default")))
#else
#define FATHOM_API
#endif

#ifdef __cplusplus
extern "C" {
#endif

/* NOLINTBEGIN(readability-identifier-naming): C has no namespaces, but prefixes. */

/* 0 to 4 and 70 mean the same as the exit statuses of the program. */
typedef enum {
  FATHOM_OK = 0,
  FATHOM_USAGE = 2,    /* arguments are invalid or contradict each other */
  FATHOM_INPUT = 3,    /* a file, scene, camera or map cannot be used */
  FATHOM_OUTPUT = 4,   /* a file cannot be written, or a value does not fit its format */
  FATHOM_MEMORY = 5,   /* out of memory */
  FATHOM_STOPPED = 6,  /* stopped by fathom_options.progress */
  FATHOM_INTERNAL = 70 /* an error in Fathom; please report it */
} fathom_status;

/* The reason of this thread's last failed call; "" before the first failure. Valid until the next
 * failure. */
FATHOM_API const char* fathom_error(void);

/* Version, for example "0.1.0". */
FATHOM_API const char* fathom_version(void);

/* -------------------------------------------------------------------------------------- scenes */

typedef struct fathom_scene fathom_scene;

/* Makes a scene without meshes. */
FATHOM_API fathom_status fathom_scene_new(fathom_scene** scene);
/* Reads meshes (OBJ, PLY, STL, OFF, glTF) and scene files (JSON) into one scene, in the given
 * order. */
FATHOM_API fathom_status fathom_scene_read(const char* const* files, size_t count,
                                           fathom_scene** scene);
/* Frees a scene; NULL is allowed. */
FATHOM_API void fathom_scene_free(fathom_scene* scene);

/* Adds a mesh, and an object that places it.
 *
 *   vertices    3 numbers for each vertex, in the mesh's own frame
 *   triangles   3 vertex numbers for each triangle, from 0
 *   pose        mesh to world, 3 rows of 4 numbers; NULL: the identity
 *   name        name of the object; may be NULL
 *   lent        not 0: the arrays are not copied; keep them unchanged until the scene is freed
 *
 * Fails with FATHOM_USAGE if a count is above 2^32 - 2.
 */
FATHOM_API fathom_status fathom_scene_add(fathom_scene* scene, const double* vertices,
                                          size_t vertex_count, const uint32_t* triangles,
                                          size_t triangle_count, const double* pose,
                                          const char* name, int lent);

/* Number of triangles in all objects. */
FATHOM_API uint64_t fathom_scene_triangle_count(const fathom_scene* scene);

/* The smallest box that contains all triangles, in the world, rounded outwards. FATHOM_INPUT
 * without triangles. */
FATHOM_API fathom_status fathom_scene_bounds(const fathom_scene* scene, double lower[3],
                                             double upper[3]);

/* ------------------------------------------------------------------------------------- cameras */

/* A lens that bends rays: a model with its numbers of distortion. See docs/lenses.md. */
typedef struct fathom_lens fathom_lens;

/* Every number is exact: it means the real number that it denotes. See docs/conventions.md. Set
 * the members that you do not need to 0, as `fathom_camera camera = {0};` does. */
typedef struct {
  uint32_t width, height; /* pixels */
  int orthographic;       /* 0: perspective */
  /* pixels; for an orthographic camera fx, fy and skew are per scene unit */
  double fx, fy, cx, cy, skew;
  /* image coordinate of the first pixel's centre: 0.5 (OpenGL) or 0 (OpenCV) */
  double pixel_centre;
  double world_to_camera[3][4]; /* x right, y down, z forward */
  /* range of planar depths that are rendered, in scene units; 0 and INFINITY: all */
  double near_depth, far_depth;
  /* NULL: the camera has no lens. The camera does not own its lens. fathom_camera_read() makes a
   * lens, which you free; all other functions set NULL. */
  fathom_lens* lens;
} fathom_camera;

/* Makes a lens for the member `lens` of cameras. One lens serves any number of cameras.
 *
 *   model        "SIMPLE_RADIAL", "OPENCV", "OPENCV_14", … (docs/lenses.md)
 *   distortion   the model's numbers of distortion in their order; may be NULL if count is 0
 *   count        how many; OPENCV_14 has 4, 5, 8, 12 or 14
 *   max_radius   where the lens ends; INFINITY: where its model does
 *
 * Models with one focal length need cameras with fx = fy and skew = 0. For panoramas fx is w, the
 * pixels of a full turn; for EQUIRECTANGULAR fy is h, the pixels from pole to pole. FATHOM_USAGE
 * for an unknown model, another count and a number that is not finite.
 */
FATHOM_API fathom_status fathom_lens_new(const char* model, const double* distortion, size_t count,
                                         double max_radius, fathom_lens** lens);
/* Frees a lens; NULL is allowed. */
FATHOM_API void fathom_lens_free(fathom_lens* lens);
/* The lens's model, valid until the lens is freed; NULL if `lens` is NULL. */
FATHOM_API const char* fathom_lens_model(const fathom_lens* lens);
/* The model's numbers of distortion, valid until the lens is freed; NULL if `lens` is NULL.
 * `count`, which may be NULL, receives their number. */
FATHOM_API const double* fathom_lens_distortion(const fathom_lens* lens, size_t* count);
/* Where the lens ends; INFINITY if `lens` is NULL. */
FATHOM_API double fathom_lens_max_radius(const fathom_lens* lens);

/* Makes a camera at `eye` that looks at `target`, with `up` upwards in the image. `fov` is the
 * vertical field of view in degrees. */
FATHOM_API fathom_status fathom_camera_look_at(const double eye[3], const double target[3],
                                               const double up[3], uint32_t width, uint32_t height,
                                               double fov, fathom_camera* camera);
/* Makes a camera that sees the whole scene, from a direction in degrees; y is up. */
FATHOM_API fathom_status fathom_camera_frame(const fathom_scene* scene, double azimuth,
                                             double elevation, uint32_t width, uint32_t height,
                                             double fov, fathom_camera* camera);
/* Reads a camera file with one camera. If it has a lens, free camera->lens with
 * fathom_lens_free(). */
FATHOM_API fathom_status fathom_camera_read(const char* file, fathom_camera* camera);
/* Checks a camera. FATHOM_INPUT if it is invalid. */
FATHOM_API fathom_status fathom_camera_check(const fathom_camera* camera);

/* ---------------------------------------------------------------------------------------- maps */

typedef struct fathom_map fathom_map;

typedef enum { FATHOM_CULL_NONE = 0, FATHOM_CULL_BACK = 1, FATHOM_CULL_FRONT = 2 } fathom_cull;

typedef struct {
  fathom_cull cull;
  int float64; /* not 0: Z and distance are doubles */
  int threads; /* number of threads; 0: all */
  /* Called from time to time with the fraction done, from any thread, but never from two at once.
   * If it does not return 0, the call ends with FATHOM_STOPPED. May be NULL. */
  int (*progress)(double done, void* data);
  void* data;
} fathom_options;

/* The value of id, face, object, material, group, part and label without a surface. */
#define FATHOM_NO_SURFACE UINT32_C(0xFFFFFFFF)
/* The value of material, group, part and label if the visible triangle has no name or label. */
#define FATHOM_NO_SEGMENT UINT32_C(0xFFFFFFFE)

/* Renders the exact map: every value is the exact number, rounded once.
 *
 *   channels   one channel or several, as "Z" or "Z,A,id,N": Z, A, Zlow, distance, id, face,
 *              object, material, group, part, label, N, P, bary, Nc, Ns, valid
 *              (docs/reference/channels.md)
 *   options    NULL: all options are 0
 */
FATHOM_API fathom_status fathom_render(const fathom_scene* scene, const fathom_camera* camera,
                                       const char* channels, const fathom_options* options,
                                       fathom_map** map);
/* Reads EXR, NPZ, PFM, PNG, NPY or a dense map of COLMAP, by content, not by suffix. */
FATHOM_API fathom_status fathom_map_read(const char* file, fathom_map** map);
/* Writes a map; the suffix selects the format. .exr, .npz and .tif contain all channels. .pfm,
 * .png, .npy and .bin (COLMAP) contain `channel` or, if it is NULL, the map's only channel. A .tif
 * needs an orthographic camera that looks along the world's z axis. */
FATHOM_API fathom_status fathom_map_write(const fathom_map* map, const char* file,
                                          const char* channel);
/* Frees a map; NULL is allowed. */
FATHOM_API void fathom_map_free(fathom_map* map);

/* Pixels in a row. */
FATHOM_API uint32_t fathom_map_width(const fathom_map* map);
/* Rows of pixels. */
FATHOM_API uint32_t fathom_map_height(const fathom_map* map);
/* Name of channel 0, 1, …; NULL after the last. N consists of the channels N.X, N.Y and N.Z,
 * likewise Nc and Ns. */
FATHOM_API const char* fathom_map_channel(const fathom_map* map, size_t number);
/* width × height values, row by row from the top, valid until the map is freed; NULL if the map has
 * no channel of this name and type. */
FATHOM_API const float* fathom_map_float32(const fathom_map* map, const char* channel);
/* Like fathom_map_float32(). */
FATHOM_API const double* fathom_map_float64(const fathom_map* map, const char* channel);
/* Like fathom_map_float32(). */
FATHOM_API const uint32_t* fathom_map_uint32(const fathom_map* map, const char* channel);
/* Like fathom_map_float32(). */
FATHOM_API const uint16_t* fathom_map_uint16(const fathom_map* map, const char* channel);
/* The name behind a number of channel "object", "material", "group" or "part", valid until the map
 * is freed; NULL without a name. */
FATHOM_API const char* fathom_map_name(const fathom_map* map, const char* channel, uint32_t number);
/* A text of the map: "fathom.camera", "fathom.sources", …; NULL if the map has no such text. */
FATHOM_API const char* fathom_map_text(const fathom_map* map, const char* name);

/* Computes up to `pixels` pixels of a rendered map again, only with exact arithmetic, and counts
 * the pixels that differ in a bit. Pass the `options` of the render. FATHOM_USAGE for a camera with
 * a lens, whose maps are made with exact arithmetic. */
FATHOM_API fathom_status fathom_verify(const fathom_map* map, const fathom_scene* scene,
                                       const fathom_camera* camera, const fathom_options* options,
                                       uint64_t pixels, uint64_t* differing);

/* ---------------------------------------------------------------------------------------- rays */

/* A scene that is prepared for rays. */
typedef struct fathom_rays fathom_rays;

/* Prepares a scene for rays, with `threads` threads (0: all). Keep the scene unchanged until the
 * rays are freed. FATHOM_INPUT if the scene has a fault. */
FATHOM_API fathom_status fathom_rays_new(const fathom_scene* scene, int threads,
                                         fathom_rays** rays);
/* Frees prepared rays; NULL is allowed. */
FATHOM_API void fathom_rays_free(fathom_rays* rays);

/* Rays in your memory: the points origin + t * direction. Numbers are taken exactly. */
typedef struct {
  size_t count;
  const double* origins;    /* 3 numbers for each ray */
  const double* directions; /* 3 numbers for each ray, not all 0; t counts their lengths */
  /* Bytes from each ray to the next; 0: the numbers have no gaps. */
  size_t origin_stride, direction_stride;
} fathom_ray_array;

/* Which hits count. NULL instead of this: all with t >= 0. */
typedef struct {
  double t_min, t_max; /* hits count if t_min <= t <= t_max; INFINITY and -INFINITY are allowed */
  int open;            /* not 0: hits count if t_min < t < t_max */
  fathom_cull cull;    /* a face is a front face if its normal points against the ray */
  int threads;         /* number of threads; 0: all */
} fathom_cast_options;

/* Where the values of hits are written, each the exact number rounded once; NULL: not wanted.
 * Without a hit, triangle, object and face are FATHOM_NO_SURFACE, t and distance INFINITY, position
 * and barycentric NAN, and normal 0. triangle and t are fast; distance, position, barycentric and
 * normal take about 10 us for each hit. */
typedef struct {
  uint32_t* triangle;  /* its number in the scene */
  double* t;           /* in lengths of the direction */
  double* distance;    /* t times the length of the direction */
  double* position;    /* 3 numbers: origin + t * direction */
  double* barycentric; /* 2 numbers: the weights of the second and third corner */
  double* normal;      /* 3 numbers: the unit normal, turned against the ray */
  uint32_t* object;
  uint32_t* face; /* the number of the face in its file or array */
  size_t stride;  /* bytes from each hit to the next, in all arrays; 0: the arrays have no gaps */
} fathom_hit_arrays;

/* Finds the nearest hit of each ray: the least t, among equals the lowest triangle number. Every
 * decision is exact: no ray passes between two triangles that share an edge, and no ray meets both
 * there (docs/rays.md). FATHOM_INPUT if a number of a ray is not finite or a direction is 0. */
FATHOM_API fathom_status fathom_cast(const fathom_rays* rays, const fathom_ray_array* given,
                                     const fathom_cast_options* options,
                                     const fathom_hit_arrays* hits);
/* Writes 1 for each ray that has a hit, else 0. */
FATHOM_API fathom_status fathom_occluded(const fathom_rays* rays, const fathom_ray_array* given,
                                         const fathom_cast_options* options, uint8_t* occluded);
/* Writes the number of hits of each ray. */
FATHOM_API fathom_status fathom_count_hits(const fathom_rays* rays, const fathom_ray_array* given,
                                           const fathom_cast_options* options, uint32_t* counts);

/* All hits of several rays. */
typedef struct fathom_hits fathom_hits;

/* Finds every hit of each ray, by t, then by triangle number. Keep the rays until the hits are
 * freed. */
FATHOM_API fathom_status fathom_all_hits(const fathom_rays* rays, const fathom_ray_array* given,
                                         const fathom_cast_options* options, fathom_hits** hits);
/* Frees hits; NULL is allowed. */
FATHOM_API void fathom_hits_free(fathom_hits* hits);
/* Number of hits of all rays. */
FATHOM_API uint64_t fathom_hits_count(const fathom_hits* hits);
/* One number more than there are rays, valid until the hits are freed: the hits of ray i are those
 * from splits[i] to splits[i + 1], without the last. */
FATHOM_API const uint64_t* fathom_hits_splits(const fathom_hits* hits);
/* Writes the values of all hits. */
FATHOM_API fathom_status fathom_hits_values(const fathom_hits* hits,
                                            const fathom_hit_arrays* values);

/* Writes 1 for each point that is inside a closed surface, else 0: the surface winds around it. The
 * points have 3 numbers each and `stride` bytes from each to the next, 0: no gaps. */
FATHOM_API fathom_status fathom_contains(const fathom_rays* rays, const double* points,
                                         size_t count, size_t stride, int threads, uint8_t* inside);

/* --------------------------------------------------------------------------------------- areas */

/* The items that are measured together. */
typedef enum {
  FATHOM_BY_OBJECT = 0,
  FATHOM_BY_FACE = 1,
  FATHOM_BY_TRIANGLE = 2,
  FATHOM_BY_MATERIAL = 3,
  FATHOM_BY_GROUP = 4,
  FATHOM_BY_PART = 5,
  FATHOM_BY_LABEL = 6
} fathom_by;

/* The areas of items under lights. The arrays have a value for each light and each item, one light
 * after the other: visible[i * items + j] is item j under light i. NAN: not defined. Every number
 * is exact and rounded once. Frame: the world; unit: scene units. */
typedef struct {
  size_t lights, items;
  const double* visible;   /* area across the direction */
  const double* projected; /* the same with everything else removed; of items other than triangles
                            * NAN without fathom_area_options.alone */
  const double* fraction;  /* visible / projected */
  const double* lit;       /* visible area, measured on the surface */
  const double* centroid;  /* 3 numbers each: of what is visible, on the surface */
  const signed char* side; /* of triangles: 1 front, -1 back, 0 seen edge on; NULL otherwise */
  const uint64_t* number;  /* of each item: of a triangle in the scene, of a face in its file */
  const uint32_t* object;  /* of triangles and faces, their objects and faces; NULL otherwise */
  const uint32_t* face;
  const char* const* name; /* of each item: UTF-8, never NULL */
} fathom_areas_result;

typedef struct {
  fathom_cull cull;
  int threads;      /* number of threads; 0: all */
  int alone;        /* not 0: measures each item with everything else removed, too */
  int lit_centroid; /* not 0: weighs the centroids of groups by `lit` instead of `visible` */
} fathom_area_options;

/* Measures what is visible from directions, as from a distant sun, or against a wind
 * (docs/coverage.md).
 *
 *   directions   3 numbers for each, towards the light; of any length, but not 0
 *   options      NULL: all options are 0
 *   areas        receives the result; free it with fathom_areas_free()
 *
 * FATHOM_USAGE for a direction that is 0 or not finite.
 */
FATHOM_API fathom_status fathom_areas(const fathom_scene* scene, size_t count,
                                      const double* directions, fathom_by by,
                                      const fathom_area_options* options,
                                      const fathom_areas_result** areas);
/* Frees a result and its arrays; NULL is allowed. */
FATHOM_API void fathom_areas_free(const fathom_areas_result* areas);

/* NOLINTEND(readability-identifier-naming) */

#ifdef __cplusplus
}
#endif

#endif
