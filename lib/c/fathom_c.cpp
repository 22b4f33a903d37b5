#include <algorithm>
#include <cmath>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <limits>
#include <map>
#include <memory>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "fathom/camera/camera_files.h"
#include "fathom/camera/camera_making.h"
#include "fathom/camera/lens_numbers.h"
#include "fathom/failures/errors.h"
#include "fathom/image/map_files.h"
#include "fathom/reference/verify.h"
#include "fathom/render.h"
#include "fathom/scene/bounds.h"
#include "fathom/scene/framing.h"
#include "fathom/scene/read_scene.h"
#include "lib/c/calls.h"
#include "lib/c/fathom.h"

using namespace fathom;
using namespace fathom::c;

struct fathom_map {
  explicit fathom_map(DepthMap given) : map(std::move(given)), texts(texts_of(map)) {}
  DepthMap map;
  std::map<std::string, std::string> texts;
};

struct fathom_lens {
  Lens lens;
  std::string model;
};

namespace {

Camera camera_of(const fathom_camera* given) {
  require(given, "camera: NULL");
  Camera camera;
  camera.width = given->width;
  camera.height = given->height;
  camera.projection.model =
      given->orthographic ? ProjectionModel::orthographic : ProjectionModel::perspective;
  camera.projection.fx = given->fx;
  camera.projection.fy = given->fy;
  camera.projection.cx = given->cx;
  camera.projection.cy = given->cy;
  camera.projection.skew = given->skew;
  camera.projection.pixel_centre = given->pixel_centre;
  for (std::size_t i = 0; i < 3; ++i)
    std::copy_n(given->world_to_camera[i], 4, camera.world_to_camera[i].begin());
  camera.near = given->near_depth;
  camera.far = given->far_depth;
  if (given->lens) camera.projection.lens = given->lens->lens;
  return camera;
}

std::unique_ptr<fathom_lens> handle_of(const Lens& lens) {
  return std::make_unique<fathom_lens>(fathom_lens{lens, std::string(name_of(lens.model))});
}

/// All but the lens, which the camera is left without.
void give(const Camera& camera, fathom_camera* given) {
  require(given, "camera: NULL");
  given->width = camera.width;
  given->height = camera.height;
  given->orthographic = is_orthographic(camera.projection);
  given->fx = camera.projection.fx;
  given->fy = camera.projection.fy;
  given->cx = camera.projection.cx;
  given->cy = camera.projection.cy;
  given->skew = camera.projection.skew;
  given->pixel_centre = camera.projection.pixel_centre;
  for (std::size_t i = 0; i < 3; ++i)
    std::copy_n(camera.world_to_camera[i].begin(), 4, given->world_to_camera[i]);
  given->near_depth = camera.near;
  given->far_depth = camera.far;
  given->lens = nullptr;
}

LensChoice lens_of(std::uint32_t width, std::uint32_t height, double fov) {
  LensChoice lens;
  lens.width = width;
  lens.height = height;
  lens.vertical_fov = fov;
  return lens;
}

RenderOptions options_of(const fathom_options* given) {
  RenderOptions options;
  if (!given) return options;
  options.cull = cull_of(given->cull);
  if (given->float64) options.depth_encoding.type = StoredType::binary64;
  options.threads = given->threads;
  return options;
}

std::function<void(double)> progress_of(const fathom_options* given) {
  if (!given || !given->progress) return {};
  return [given](double done) {
    if (given->progress(done, given->data) != 0) throw Stopped();
  };
}

std::vector<Channel> channels_of(const char* names) {
  require(names, "channels: NULL");
  std::vector<Channel> channels;
  const std::string list(names);
  for (std::size_t first = 0; first <= list.size();) {
    const std::size_t end = std::min(list.find(',', first), list.size());
    const std::string name = list.substr(first, end - first);
    const auto channel = channel_named(name);
    if (!channel)
      throw UsageError("channels: there is no '" + name + "', expected some of " + channel_names());
    channels.push_back(*channel);
    first = end + 1;
  }
  return channels;
}

/// The channels of a map that engines render: to compute it again.
std::vector<Channel> channels_of(const DepthMap& map) {
  std::vector<Channel> channels;
  for (const ChannelDescription& each : channel_table)
    if (map.find(part_names(each.channel).front())) channels.push_back(each.channel);
  return channels;
}

Mesh mesh_of(const double* vertices, std::size_t vertex_count, const std::uint32_t* triangles,
             std::size_t triangle_count, bool lent) {
  const auto* const points = reinterpret_cast<const MeshPoint*>(vertices);
  const auto* const corners = reinterpret_cast<const CornerIndices*>(triangles);
  Mesh mesh;
  if (lent) {
    mesh.vertices = MeshArray<MeshPoint>::of_lent({points, vertex_count}, nullptr);
    mesh.triangles = MeshArray<CornerIndices>::of_lent({corners, triangle_count}, nullptr);
  } else {
    mesh.vertices.assign(points, points + vertex_count);
    mesh.triangles.assign(corners, corners + triangle_count);
  }
  mesh.face_count = triangle_count;
  return mesh;
}

template <class T>
const T* values_of(const fathom_map* map, const char* channel) {
  if (!map || !channel) return nullptr;
  const Samples<T>* values = map->map.values<T>(channel);
  return values ? values->data() : nullptr;
}

}  // namespace

extern "C" {

const char* fathom_error(void) {
  return answer_of([] { return error_of_thread().c_str(); });
}

const char* fathom_version(void) {
  return answer_of([] { return FATHOM_VERSION; });
}

fathom_status fathom_scene_new(fathom_scene** scene) {
  return status_of([&] {
    require(scene, "scene: NULL");
    *scene = std::make_unique<fathom_scene>().release();
  });
}

fathom_status fathom_scene_read(const char* const* files, size_t count, fathom_scene** scene) {
  return status_of([&] {
    require(scene && files && count > 0,
            "files: expected at least one, and where to put the scene");
    std::vector<std::filesystem::path> paths;
    for (std::size_t i = 0; i < count; ++i) {
      require(files[i], "files: NULL");
      paths.emplace_back(files[i]);
    }
    Warnings warnings;
    auto read = std::make_unique<fathom_scene>();
    ReadOptions options;
    options.segments = true;
    options.attributes = true;  // normals, for channel Ns
    read->scene = read_scene(paths, options, warnings);
    *scene = read.release();
  });
}

void fathom_scene_free(fathom_scene* scene) {
  answer_of([&] { delete scene; });
}

fathom_status fathom_scene_add(fathom_scene* scene, const double* vertices, size_t vertex_count,
                               const uint32_t* triangles, size_t triangle_count, const double* pose,
                               const char* name, int lent) {
  return status_of([&] {
    require(scene, "scene: NULL");
    require((vertices || vertex_count == 0) && (triangles || triangle_count == 0),
            "vertices and triangles: NULL");
    require_count("vertex_count", vertex_count, sizeof(MeshPoint));
    require_count("triangle_count", triangle_count, sizeof(CornerIndices));
    Object object;
    object.mesh = scene->scene.meshes.size();
    object.name = name ? name : "object " + std::to_string(scene->scene.objects.size());
    if (pose) {
      object.placed_as_is = false;
      for (std::size_t i = 0; i < 12; ++i) {
        require(std::isfinite(pose[i]), "pose: expected finite numbers");
        object.world_from_mesh.rows[i / 4][i % 4] = Dyadic(pose[i]);
      }
    }
    Mesh mesh = mesh_of(vertices, vertex_count, triangles, triangle_count, lent != 0);
    Scene& target = scene->scene;
    if (target.sources.empty()) target.sources.push_back({"(arrays)", "", ""});
    // What may fail comes first: a scene has a mesh with its object, or neither.
    target.objects.reserve(target.objects.size() + 1);
    target.meshes.push_back(std::move(mesh));
    target.objects.push_back(std::move(object));
  });
}

uint64_t fathom_scene_triangle_count(const fathom_scene* scene) {
  std::uint64_t count = 0;
  status_of([&] { count = scene ? triangle_count(scene->scene) : 0; });
  return count;
}

fathom_status fathom_scene_bounds(const fathom_scene* scene, double lower[3], double upper[3]) {
  return status_of([&] {
    require(scene && lower && upper, "scene, lower and upper: NULL");
    const auto bounds = world_bounds(scene->scene);
    if (!bounds) throw InputError("scene: it has no triangle");
    std::copy_n(bounds->lower.begin(), 3, lower);
    std::copy_n(bounds->upper.begin(), 3, upper);
  });
}

fathom_status fathom_lens_new(const char* model, const double* distortion, size_t count,
                              double max_radius, fathom_lens** lens) {
  return status_of([&] {
    require(model && lens, "model and lens: NULL");
    require(distortion || count == 0, "distortion: NULL");
    *lens = handle_of(lens_of_numbers(model, {distortion, count}, max_radius)).release();
  });
}

void fathom_lens_free(fathom_lens* lens) {
  answer_of([&] { delete lens; });
}

const char* fathom_lens_model(const fathom_lens* lens) {
  return answer_of([&] { return lens ? lens->model.c_str() : nullptr; });
}

const double* fathom_lens_distortion(const fathom_lens* lens, size_t* count) {
  return answer_of([&] {
    if (count) *count = lens ? entry_of(lens->lens.model).distortion.size() : 0;
    return lens ? lens->lens.distortion.data() : nullptr;
  });
}

double fathom_lens_max_radius(const fathom_lens* lens) {
  constexpr double infinity = std::numeric_limits<double>::infinity();
  return answer_of([&] { return lens ? lens->lens.max_radius : infinity; });
}

fathom_status fathom_camera_look_at(const double eye[3], const double target[3], const double up[3],
                                    uint32_t width, uint32_t height, double fov,
                                    fathom_camera* camera) {
  return status_of([&] {
    require(eye && target && up, "eye, target and up: NULL");
    const auto point = [](const double* p) { return Vector3{p[0], p[1], p[2]}; };
    give(look_at(point(eye), point(target), point(up), lens_of(width, height, fov)), camera);
  });
}

fathom_status fathom_camera_frame(const fathom_scene* scene, double azimuth, double elevation,
                                  uint32_t width, uint32_t height, double fov,
                                  fathom_camera* camera) {
  return status_of([&] {
    require(scene, "scene: NULL");
    give(frame_scene(scene->scene, View{azimuth, elevation}, lens_of(width, height, fov)), camera);
  });
}

fathom_status fathom_camera_read(const char* file, fathom_camera* camera) {
  return status_of([&] {
    require(file, "file: NULL");
    const std::vector<Camera> cameras = read_cameras(std::filesystem::path(file));
    if (cameras.size() != 1) throw InputError(std::string(file) + ": expected one camera");
    const auto& lens = cameras.front().projection.lens;
    std::unique_ptr<fathom_lens> handle = lens ? handle_of(*lens) : nullptr;
    give(cameras.front(), camera);
    camera->lens = handle.release();
  });
}

fathom_status fathom_camera_check(const fathom_camera* camera) {
  return status_of([&] { require_valid(camera_of(camera)); });
}

fathom_status fathom_render(const fathom_scene* scene, const fathom_camera* camera,
                            const char* channels, const fathom_options* options, fathom_map** map) {
  return status_of([&] {
    require(scene && map, "scene and map: NULL");
    RenderOptions asked = options_of(options);
    asked.channels = channels_of(channels);
    Rendered rendered =
        render(scene->scene, camera_of(camera), asked, {.progress = progress_of(options)});
    *map = std::make_unique<fathom_map>(std::move(rendered.map)).release();
  });
}

fathom_status fathom_map_read(const char* file, fathom_map** map) {
  return status_of([&] {
    require(file && map, "file and map: NULL");
    *map = std::make_unique<fathom_map>(read_map(std::filesystem::path(file))).release();
  });
}

fathom_status fathom_map_write(const fathom_map* map, const char* file, const char* channel) {
  return status_of([&] {
    require(map && file, "map and file: NULL");
    const MapFormat format = require_map_format(file);
    WriteOptions options;
    if (channel) options.channel = channel;
    write_map(map->map, file, format, options);
  });
}

void fathom_map_free(fathom_map* map) {
  answer_of([&] { delete map; });
}

uint32_t fathom_map_width(const fathom_map* map) {
  return answer_of([&] { return map ? map->map.width : 0; });
}

uint32_t fathom_map_height(const fathom_map* map) {
  return answer_of([&] { return map ? map->map.height : 0; });
}

const char* fathom_map_channel(const fathom_map* map, size_t number) {
  return answer_of([&]() -> const char* {
    if (!map || number >= map->map.channels.size()) return nullptr;
    return map->map.channels[number].name.c_str();
  });
}

const float* fathom_map_float32(const fathom_map* map, const char* channel) {
  return answer_of([&] { return values_of<float>(map, channel); });
}

const double* fathom_map_float64(const fathom_map* map, const char* channel) {
  return answer_of([&] { return values_of<double>(map, channel); });
}

const uint32_t* fathom_map_uint32(const fathom_map* map, const char* channel) {
  return answer_of([&] { return values_of<std::uint32_t>(map, channel); });
}

const uint16_t* fathom_map_uint16(const fathom_map* map, const char* channel) {
  return answer_of([&] { return values_of<std::uint16_t>(map, channel); });
}

const char* fathom_map_name(const fathom_map* map, const char* channel, uint32_t number) {
  return answer_of([&]() -> const char* {
    if (!map || !channel) return nullptr;
    const auto found = map->map.tables.find(channel);
    const bool of_objects = std::string_view(channel) == "object";
    if (!of_objects && found == map->map.tables.end()) return nullptr;
    const std::vector<std::string>& names = of_objects ? map->map.object_names : found->second;
    return number < names.size() ? names[number].c_str() : nullptr;
  });
}

const char* fathom_map_text(const fathom_map* map, const char* name) {
  return answer_of([&]() -> const char* {
    if (!map || !name) return nullptr;
    const auto found = map->texts.find(name);
    return found == map->texts.end() ? nullptr : found->second.c_str();
  });
}

fathom_status fathom_verify(const fathom_map* map, const fathom_scene* scene,
                            const fathom_camera* camera, const fathom_options* options,
                            uint64_t pixels, uint64_t* differing) {
  return status_of([&] {
    require(map && scene && differing, "map, scene and differing: NULL");
    RenderOptions asked = options_of(options);
    asked.channels = channels_of(map->map);
    const Camera view = camera_of(camera);
    require_valid(view);
    *differing = verify(map->map, scene->scene, view, asked,
                        choose_pixels(view.width, view.height, pixels), progress_of(options))
                     .differing;
  });
}

}  // extern "C"
