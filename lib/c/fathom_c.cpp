#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <limits>
#include <map>
#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "fathom/area/areas.h"
#include "fathom/camera/camera_files.h"
#include "fathom/camera/camera_making.h"
#include "fathom/camera/lens.h"
#include "fathom/failures/errors.h"
#include "fathom/image/map_files.h"
#include "fathom/reference/verify.h"
#include "fathom/render.h"
#include "fathom/scene/bounds.h"
#include "fathom/scene/framing.h"
#include "fathom/scene/read_scene.h"
#include "fathom/threads/threads.h"
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

/// A result and the arrays that its pointers lead to.
struct KeptAreas : fathom_areas_result {
  KeptAreas() : fathom_areas_result{} {}

  std::vector<double> of_visible, of_projected, of_fraction, of_lit, of_centroid;
  std::vector<signed char> of_side;
  std::vector<std::uint64_t> of_number;
  std::vector<std::uint32_t> of_object, of_face;
  std::vector<std::string> names;
  std::vector<const char*> of_name;
};

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

AreaOptions options_of(const AreaItems& items, const fathom_area_options* given) {
  AreaOptions options = fathom::options_of(items);
  if (!given) return options;
  const bool known = given->cull == FATHOM_CULL_NONE || given->cull == FATHOM_CULL_BACK ||
                     given->cull == FATHOM_CULL_FRONT;
  require(known, "cull: expected FATHOM_CULL_NONE, FATHOM_CULL_BACK or FATHOM_CULL_FRONT");
  require(given->threads >= 0, "threads: expected at least 0");
  options.cull = given->cull == FATHOM_CULL_BACK    ? Cull::back
                 : given->cull == FATHOM_CULL_FRONT ? Cull::front
                                                    : Cull::none;
  options.threads = given->threads;
  options.alone = given->alone != 0;
  options.centroid = given->lit_centroid != 0 ? AreaCentroid::lit : AreaCentroid::across;
  return options;
}

/// Several directions at the same time, each by one thread.
std::vector<std::vector<LitArea>> areas_of(const Scene& scene, std::span<const double> directions,
                                           AreaOptions options) {
  std::vector<std::vector<LitArea>> areas(directions.size() / 3);
  const int threads = options.threads;
  if (areas.size() > 1) options.threads = 1;
  with_threads(threads, [&] {
    in_parallel(areas.size(), [&](std::size_t i) {
      const double* const d = &directions[3 * i];
      areas[i] = areas_in_direction(scene, {d[0], d[1], d[2]}, options);
    });
  });
  return areas;
}

void add_items(KeptAreas& kept, const AreaItems& items) {
  for (const AreaItem& item : items.items) {
    kept.of_number.push_back(item.number);
    kept.names.push_back(item.name);
    if (item.object) kept.of_object.push_back(*item.object);
    if (item.face) kept.of_face.push_back(*item.face);
  }
  for (const std::string& name : kept.names) kept.of_name.push_back(name.c_str());
}

void add_areas(KeptAreas& kept, const std::vector<LitArea>& areas) {
  constexpr double nan = std::numeric_limits<double>::quiet_NaN();
  for (const LitArea& area : areas) {
    kept.of_visible.push_back(area.visible.value_or(nan));
    kept.of_projected.push_back(area.projected.value_or(nan));
    kept.of_fraction.push_back(area.fraction.value_or(nan));
    kept.of_lit.push_back(area.lit);
    const std::array<double, 3> centre = area.centroid.value_or(std::array{nan, nan, nan});
    kept.of_centroid.insert(kept.of_centroid.end(), centre.begin(), centre.end());
    if (!area.side) continue;
    kept.of_side.push_back(*area.side == LitSide::edge ? 0 : *area.side == LitSide::front ? 1 : -1);
  }
}

/// Points the result to the arrays.
void publish(KeptAreas& kept, std::size_t lights) {
  const auto or_null = [](const auto& values) { return values.empty() ? nullptr : values.data(); };
  kept.lights = lights;
  kept.items = kept.names.size();
  kept.visible = kept.of_visible.data();
  kept.projected = kept.of_projected.data();
  kept.fraction = kept.of_fraction.data();
  kept.lit = kept.of_lit.data();
  kept.centroid = kept.of_centroid.data();
  kept.side = or_null(kept.of_side);
  kept.number = kept.of_number.data();
  kept.object = or_null(kept.of_object);
  kept.face = or_null(kept.of_face);
  kept.name = kept.of_name.data();
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
    // Operations that may fail come first: a scene gets both mesh and object, or neither.
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

fathom_status fathom_areas(const fathom_scene* scene, size_t count, const double* directions,
                           fathom_by by, const fathom_area_options* options,
                           const fathom_areas_result** areas) {
  return status_of([&] {
    require(scene && areas, "scene and areas: NULL");
    require(directions && count > 0, "directions: expected at least one");
    require_count("count", count, 3 * sizeof(double));
    const auto kind = static_cast<std::size_t>(by);
    require(kind < all_area_item_kinds.size(), "by: expected FATHOM_BY_OBJECT, …");
    const AreaItems items = area_items(scene->scene, all_area_item_kinds[kind]);
    const AreaOptions asked = options_of(items, options);
    auto kept = std::make_unique<KeptAreas>();
    add_items(*kept, items);
    for (const std::vector<LitArea>& light :
         areas_of(scene->scene, {directions, 3 * count}, asked)) {
      add_areas(*kept, light);
    }
    publish(*kept, count);
    *areas = kept.release();
  });
}

void fathom_areas_free(const fathom_areas_result* areas) {
  answer_of([&] { delete static_cast<const KeptAreas*>(areas); });
}

}  // extern "C"
