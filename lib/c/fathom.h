/* Fathom for C, and for every language that calls C: exact depth maps of triangle meshes.
 *
 * Handles are opaque; each is freed by the function of its kind, which takes NULL too. Functions that can fail return
 * a fathom_status; then fathom_error() says why, in one line, and nothing is written to what they would have made.
 * No exception leaves this library. Strings are UTF-8.
 *
 * All functions may be called by several threads at the same time, also with the same scene and map, as long as nobody
 * changes or frees these meanwhile. Results never depend on the number of threads.
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

/* The values are the program's exit statuses. */
typedef enum {
  FATHOM_OK = 0,
  FATHOM_USAGE = 2,  /* the request makes no sense */
  FATHOM_INPUT = 3,  /* a file, scene, camera or map cannot be used */
  FATHOM_OUTPUT = 4, /* what cannot be written, or does not fit its format */
  FATHOM_MEMORY = 5, /* there is not enough memory */
  FATHOM_STOPPED = 6 /* fathom_options.progress asked for it */
} fathom_status;

/* Why the last call that failed in this thread did; "" if none has. It stays until the next one fails. */
FATHOM_API const char* fathom_error(void);

/* "0.1.0" */
FATHOM_API const char* fathom_version(void);

/* ------------------------------------------------------------------------------------------------- scenes */

typedef struct fathom_scene fathom_scene;

/* A scene without meshes. */
FATHOM_API fathom_status fathom_scene_new(fathom_scene** scene);
/* Meshes (OBJ, PLY, STL, OFF, glTF) and scene files (JSON), in this order, as one scene. */
FATHOM_API fathom_status fathom_scene_read(const char* const* files, size_t count,
                                           fathom_scene** scene);
FATHOM_API void fathom_scene_free(fathom_scene* scene);

/* Adds a mesh, and an object that places it.
 *
 *   vertices    3 numbers for each vertex, in the mesh's own frame
 *   triangles   3 numbers of vertices for each triangle, from 0
 *   pose        mesh to world, 3 rows of 4 numbers; NULL: the identity
 *   name        of the object; may be NULL
 *   lent        not 0: the arrays are not copied, and stay as they are until the scene is freed
 *
 * FATHOM_USAGE where a count is above 2^32 - 2.
 */
FATHOM_API fathom_status fathom_scene_add(fathom_scene* scene, const double* vertices,
                                          size_t vertex_count, const uint32_t* triangles,
                                          size_t triangle_count, const double* pose,
                                          const char* name, int lent);

/* In all objects. */
FATHOM_API uint64_t fathom_scene_triangle_count(const fathom_scene* scene);

/* The smallest box that holds all triangles, rounded outwards. FATHOM_INPUT where there are none. */
FATHOM_API fathom_status fathom_scene_bounds(const fathom_scene* scene, double lower[3],
                                             double upper[3]);

/* ------------------------------------------------------------------------------------------------ cameras */

/* Every number is the real number that it denotes. See docs/conventions.md. */
typedef struct {
  uint32_t width, height; /* pixels */
  int orthographic;       /* 0: perspective */
  double fx, fy, cx, cy,
      skew; /* pixels; of an orthographic camera fx, fy and skew per scene unit */
  double
      pixel_centre; /* image coordinate of the first pixel's centre: 0.5 (OpenGL) or 0 (OpenCV) */
  double world_to_camera[3][4]; /* x right, y down, z forward */
  double near_depth,
      far_depth; /* the range of planar depth that counts: 0 and INFINITY for all of it */
} fathom_camera;

/* The camera at `eye` that looks at `target` with `up` upwards; the image's height spans `fov` degrees. */
FATHOM_API fathom_status fathom_camera_look_at(const double eye[3], const double target[3],
                                               const double up[3], uint32_t width, uint32_t height,
                                               double fov, fathom_camera* camera);
/* The camera that sees the whole of a scene, in a direction given by degrees; y is up. */
FATHOM_API fathom_status fathom_camera_frame(const fathom_scene* scene, double azimuth,
                                             double elevation, uint32_t width, uint32_t height,
                                             double fov, fathom_camera* camera);
/* The camera of a file with one. */
FATHOM_API fathom_status fathom_camera_read(const char* file, fathom_camera* camera);
/* FATHOM_INPUT where it is no camera. */
FATHOM_API fathom_status fathom_camera_check(const fathom_camera* camera);

/* -------------------------------------------------------------------------------------------------- maps */

typedef struct fathom_map fathom_map;

typedef enum { FATHOM_CULL_NONE = 0, FATHOM_CULL_BACK = 1, FATHOM_CULL_FRONT = 2 } fathom_cull;

typedef struct {
  fathom_cull cull;
  int float64; /* not 0: Z and distance are doubles */
  int threads; /* to work in; 0: all */
  /* Called now and then with the fraction done, from any thread but never from two at once; ends the call with
   * FATHOM_STOPPED where it returns another value than 0. May be NULL. */
  int (*progress)(double done, void* data);
  void* data;
} fathom_options;

/* What no identifier is: id, face, object, material, group, part and label where nothing is seen. */
#define FATHOM_NO_SURFACE UINT32_C(0xFFFFFFFF)
/* material, group, part and label where what is seen has none. */
#define FATHOM_NO_SEGMENT UINT32_C(0xFFFFFFFE)

/* Renders the exact map: every value is the exact number, rounded once.
 *
 *   channels   "Z", or several: "Z,A,id,N"
 *   options    NULL: all of them 0
 */
FATHOM_API fathom_status fathom_render(const fathom_scene* scene, const fathom_camera* camera,
                                       const char* channels, const fathom_options* options,
                                       fathom_map** map);
/* EXR, NPZ, PFM, PNG, NPY or a dense map of COLMAP's; what it is, is told by its content. */
FATHOM_API fathom_status fathom_map_read(const char* file, fathom_map** map);
/* In the format that the suffix names: .exr, .npz and .tif have all channels; .pfm, .png, .npy and .bin (COLMAP's) the
 * one that is named, or, where `channel` is NULL, the only one. A .tif needs an orthographic camera that looks along the
 * world's z axis. */
FATHOM_API fathom_status fathom_map_write(const fathom_map* map, const char* file,
                                          const char* channel);
FATHOM_API void fathom_map_free(fathom_map* map);

FATHOM_API uint32_t fathom_map_width(const fathom_map* map);
FATHOM_API uint32_t fathom_map_height(const fathom_map* map);
/* The name of channel 0, 1, …; NULL beyond the last. N has the channels N.X, N.Y and N.Z; so have Nc and
 * Ns. */
FATHOM_API const char* fathom_map_channel(const fathom_map* map, size_t number);
/* width × height values, row by row from the top, as long as the map is not freed; NULL where there is no channel of
 * this name and type. */
FATHOM_API const float* fathom_map_float32(const fathom_map* map, const char* channel);
FATHOM_API const double* fathom_map_float64(const fathom_map* map, const char* channel);
FATHOM_API const uint32_t* fathom_map_uint32(const fathom_map* map, const char* channel);
FATHOM_API const uint16_t* fathom_map_uint16(const fathom_map* map, const char* channel);
/* What a number in channel "object", "material", "group" or "part" stands for, as long as the map is not freed; NULL
 * where it has no name. */
FATHOM_API const char* fathom_map_name(const fathom_map* map, const char* channel, uint32_t number);
/* What the map carries: "fathom.camera", "fathom.sources", …; NULL where it has no such text. */
FATHOM_API const char* fathom_map_text(const fathom_map* map, const char* name);

/* Computes up to `pixels` pixels of a rendered map again by exact arithmetic alone, and counts those that differ in a
 * bit. `options` are those that it was rendered with. */
FATHOM_API fathom_status fathom_verify(const fathom_map* map, const fathom_scene* scene,
                                       const fathom_camera* camera, const fathom_options* options,
                                       uint64_t pixels, uint64_t* differing);

/* NOLINTEND(readability-identifier-naming) */

#ifdef __cplusplus
}
#endif

#endif
