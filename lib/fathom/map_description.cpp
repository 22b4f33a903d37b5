#include "fathom/map_description.h"

#include <cmath>

#include "fathom/camera/camera_files.h"
#include "fathom/camera/world_from_image.h"
#include "fathom/numeric/standard_arithmetic.h"
#include "fathom/scene/scene_segments.h"
#include "fathom/text/json_text.h"
#include "fathom/triangle/segment_channels.h"

namespace fathom {
using namespace text;

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
  const auto [cx, cy] = principal_point(camera);
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
  const auto [cx, cy] = principal_point(camera);
  map.pixel_aspect_ratio = std::abs(camera.fy / camera.fx);
  map.screen_window_width = camera.width / std::abs(camera.fx);
  map.screen_window_centre = {(camera.width / 2.0 - cx) / camera.fx,
                              (cy - camera.height / 2.0) / camera.fy};
}

std::string sources_as_json(const std::vector<Source>& sources) {
  std::vector<std::string> list;
  for (const Source& source : sources) {
    std::vector<std::string> members{"\"file\":" + json_string(source.path)};
    if (!source.reader.empty()) members.push_back("\"reader\":" + json_string(source.reader));
    members.push_back("\"sha256\":" + json_string(source.sha256));
    list.push_back(joined_in('{', members, '}'));
  }
  return joined_in('[', list, ']');
}

/// The names that the numbers of its channels stand for.
void add_tables(const Scene& scene, DepthMap& map) {
  std::vector<Segmentation> wanted;
  for (const Segmentation by : all_segmentations)
    if (map.find(std::string(description_of(channel_of(by)).name))) wanted.push_back(by);
  if (wanted.empty()) return;
  const SceneSegments segments(scene, wanted);
  for (const Segmentation by : wanted)
    if (!segments.names(by).empty())
      map.tables[std::string(description_of(channel_of(by)).name)] = segments.names(by);
}

}  // namespace

void describe_map(const Scene& scene, const Camera& camera, std::string_view engine,
                  DepthMap& map) {
  const StandardArithmetic standard;
  map.world_to_camera = exr_camera_from_world(camera);
  map.world_to_ndc = exr_ndc_from_world(camera);
  describe_screen_window(camera, map);
  map.world_from_image = world_from_image(camera);
  for (const Object& object : scene.objects) map.object_names.push_back(object.name);
  add_tables(scene, map);
  map.texts["fathom.camera"] = to_json(camera);
  map.texts["fathom.sources"] = sources_as_json(scene.sources);
  map.texts["fathom.engine"] = engine;
}

void add_world_from_image(DepthMap& map, const std::string& name) {
  const StandardArithmetic standard;
  const auto text = map.texts.find("fathom.camera");
  if (text == map.texts.end()) return;
  const std::vector<Camera> cameras = read_cameras(text->second, name + ": fathom.camera");
  if (cameras.size() == 1) map.world_from_image = world_from_image(cameras[0]);
}

MapView view_of(const Camera& camera) {
  const StandardArithmetic standard;
  MapView view;
  view.orthographic = camera.projection == Projection::orthographic;
  view.fx = camera.fx;
  view.fy = camera.fy;
  view.cx = camera.cx;
  view.cy = camera.cy;
  view.skew = camera.skew;
  view.pixel_centre = camera.pixel_centre;
  view.world_to_camera = camera.world_to_camera;
  return view;
}

}  // namespace fathom
