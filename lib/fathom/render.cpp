#include "fathom/render.h"

#include <cmath>
#include <nlohmann/json.hpp>

#include "fathom/area/deep_pixels.h"
#include "fathom/camera/camera_files.h"
#include "fathom/fast/render_fast.h"
#include "fathom/numeric/errors.h"
#include "fathom/reference/reference.h"
#include "fathom/scene/read_scene.h"

namespace fathom {
using namespace area;

namespace {

using Matrix4 = std::array<double, 16>;

Matrix4 rows(const std::array<std::array<double, 4>, 4>& m) {
  Matrix4 flat;
  for (std::size_t i = 0; i < 16; ++i) flat[i] = m[i / 4][i % 4];
  return flat;
}

/// World to camera as OpenEXR wants it: x right, y up, z forward.
Matrix4 exr_camera_from_world(const Camera& camera) {
  auto [x, y, z] = camera.world_to_camera;
  for (double& component : y) component = -component;
  return rows({x, y, z, {0, 0, 0, 1}});
}

/// World to NDC as OpenEXR wants it: (0, 0) the top left, (1, 1) the bottom right corner of the
/// image after division by the last component. Rounded; for other programs' eyes only, the camera
/// itself stands in fathom.camera.
Matrix4 exr_ndc_from_world(const Camera& camera) {
  const auto& [x, y, z] = camera.world_to_camera;
  const bool perspective = camera.projection == Projection::perspective;
  const double cx = camera.cx + (0.5 - camera.pixel_centre);
  const double cy = camera.cy + (0.5 - camera.pixel_centre);
  std::array<std::array<double, 4>, 4> m{};
  m[3] = perspective ? z : std::array<double, 4>{0, 0, 0, 1};
  for (std::size_t k = 0; k < 4; ++k) {
    m[0][k] = (camera.fx * x[k] + camera.skew * y[k] + cx * m[3][k]) / camera.width;
    m[1][k] = (camera.fy * y[k] + cy * m[3][k]) / camera.height;
    m[2][k] = z[k];
  }
  return rows(m);
}

/// The rectangle on the plane z = 1 (orthographic: the image's extent) that the image shows.
void describe_screen_window(const Camera& camera, DepthMap& map) {
  const double cx = camera.cx + (0.5 - camera.pixel_centre);
  const double cy = camera.cy + (0.5 - camera.pixel_centre);
  map.pixel_aspect_ratio = std::abs(camera.fy / camera.fx);
  map.screen_window_width = camera.width / std::abs(camera.fx);
  map.screen_window_centre = {(camera.width / 2.0 - cx) / camera.fx,
                              (cy - camera.height / 2.0) / camera.fy};
}

std::string sources_as_json(const std::vector<Source>& sources) {
  nlohmann::json list = nlohmann::json::array();
  for (const Source& source : sources) {
    list.push_back({{"file", source.path}, {"sha256", source.sha256}});
  }
  return list.dump(-1, ' ', false, nlohmann::json::error_handler_t::replace);
}

void describe(const Scene& scene, const Camera& camera, const char* engine, DepthMap& map) {
  map.world_to_camera = exr_camera_from_world(camera);
  map.world_to_ndc = exr_ndc_from_world(camera);
  describe_screen_window(camera, map);
  for (const Object& object : scene.objects) map.object_names.push_back(object.name);
  map.texts["fathom.camera"] = to_json(camera);
  map.texts["fathom.sources"] = sources_as_json(scene.sources);
  map.texts["fathom.engine"] = engine;
}

void describe(const Scene& scene, const Camera& camera, const RenderOptions& options,
              DepthMap& map) {
  describe(scene, camera, options.engine == Engine::fast ? "fast" : "reference", map);
  if (options.cull != Cull::none) {
    map.texts["fathom.cull"] = options.cull == Cull::back ? "back" : "front";
  }
}

/// A channel of the pipeline's map. Fails with UsageError where the pipeline has none such.
ImageChannel channel_of(const Scene& scene, const pipeline::PipelineFrame& frame, Channel channel) {
  if (channel == Channel::Z) return {"Z", frame.depth};
  if (channel == Channel::id) return {"id", frame.id};
  if (channel != Channel::face && channel != Channel::object) {
    throw UsageError("--channels: the pipeline gives Z, id, face and object");
  }
  Samples<std::uint32_t> values(frame.id.size(), no_surface);
  for (std::size_t i = 0; i < values.size(); ++i) {
    if (frame.id[i] == no_surface) continue;
    const TriangleOrigin origin = origin_of(scene, frame.id[i]);
    values[i] = channel == Channel::face ? origin.face : origin.object;
  }
  return {channel == Channel::face ? "face" : "object", values};
}

}  // namespace

PipelineRendering render_by_pipeline(const Scene& scene, const Camera& camera,
                                     const pipeline::PipelineOptions& options,
                                     const std::vector<Channel>& channels, bool with_picture) {
  if (const auto fault = find_fault(camera)) throw InputError("camera: " + *fault);
  const pipeline::PipelineFrame frame =
      pipeline::render_frame(scene, camera, options, with_picture);
  PipelineRendering result{{}, {}, frame.statistics, frame.painter, camera};
  result.camera.near = frame.statistics.near;
  result.camera.far = frame.statistics.far;
  result.map.width = camera.width;
  result.map.height = camera.height;
  for (const Channel channel : channels) {
    result.map.channels.push_back(channel_of(scene, frame, channel));
  }
  describe(scene, result.camera, "pipeline", result.map);
  if (with_picture) result.picture = pipeline::to_rgb(frame.picture);
  return result;
}

DepthMap render(const Scene& scene, const Camera& camera, const RenderOptions& options) {
  if (const auto fault = find_fault(camera)) throw InputError("camera: " + *fault);
  DepthMap map = options.engine == Engine::fast ? render_fast(scene, camera, options)
                                                : render_reference(scene, camera, options);
  describe(scene, camera, options, map);
  return map;
}

DepthMap render(const StreamedScene& scene, const Camera& camera, const RenderOptions& options,
                const StreamLimits& limits) {
  if (const auto fault = find_fault(camera)) throw InputError("camera: " + *fault);
  if (options.engine != Engine::fast) {
    throw UsageError("only the fast engine renders a scene that stays in its files");
  }
  DepthMap map = render_streamed(scene, camera, options, limits);
  describe(outline_of(scene), camera, options, map);
  return map;
}

DeepMap render_deep(const Scene& scene, const Camera& camera, const RenderOptions& options) {
  if (const auto fault = find_fault(camera)) throw InputError("camera: " + *fault);
  DeepMap map = visible_in_pixels(scene, camera, options);
  describe(scene, camera, options, map.description);
  map.description.texts.erase("fathom.engine");
  return map;
}

void add_cryptomatte(DepthMap& map, const Scene& scene, const Camera& camera,
                     const RenderOptions& options) {
  std::vector<std::uint32_t> ids;
  for (const Object& object : scene.objects) ids.push_back(cryptomatte_id(object.name));
  const TriangleSource triangles(scene);
  Mattes mattes = mattes_in_pixels(triangles, camera, options, [&](std::uint32_t number) {
    return ids[triangles.origin(number).object];
  });
  mattes.layer = "CryptoObject";
  for (const Object& object : scene.objects) mattes.names.push_back(object.name);
  add_mattes(map, mattes);
}

}  // namespace fathom
