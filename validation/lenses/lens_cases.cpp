#include "validation/lenses/lens_cases.h"

#include <Eigen/Geometry>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>
#include <optional>
#include <utility>

#include "fathom/camera_directions.h"
#include "fathom/failures/errors.h"
#include "fathom/geometry/eigen_arrays.h"
#include "fathom/render.h"
#include "validation/scenes/shapes.h"

namespace fathom::validation {
namespace {

using attribution::Truth;
using attribution::WorldMesh;

/// Lengths in widths of the image.
struct NamedLens {
  const char* model;
  double fx, fy;
  std::vector<double> distortion;
};

std::vector<NamedLens> named_lenses() {
  constexpr double turn = 2 * std::numbers::pi;
  return {{"OPENCV", 0.8, 0.8, {-0.25, 0.06, 0.001, -0.0005}},
          {"OPENCV_FISHEYE", 0.3, 0.3, {0.02, -0.005, 0.001, -0.0002}},
          {"UCM", 0.35, 0.35, {0.6}},
          {"EUCM", 0.35, 0.35, {0.62, 1.1}},
          {"DOUBLE_SPHERE", 0.3, 0.3, {-0.2, 0.6}},
          {"FISHEYE_EQUISOLID", 0.25, 0.25, {}},
          {"EQUIRECTANGULAR", 1, 0.5, {}},
          {"CYLINDRICAL", 1, 1 / turn, {}}};
}

/// An equidistant fisheye whose diagonal spans 220°, computed in binary64. What the numbers are
/// matters to nobody: a table is exact.
std::shared_ptr<const DirectionTable> fisheye_table(std::uint32_t width, std::uint32_t height) {
  const double radius = std::hypot(width, height) / 2, reach = 110 * std::numbers::pi / 180;
  std::vector<double> numbers;
  for (std::uint32_t row = 0; row < height; ++row) {
    for (std::uint32_t column = 0; column < width; ++column) {
      const double x = column + 0.5 - width / 2.0, y = row + 0.5 - height / 2.0;
      const double r = std::hypot(x, y), angle = r / radius * reach;
      const double scale = r == 0 ? 0 : std::sin(angle) / r;
      numbers.insert(numbers.end(), {x * scale, y * scale, std::cos(angle)});
    }
  }
  return std::make_shared<DirectionTable>(width, height, std::move(numbers));
}

Camera table_camera(std::uint32_t width, std::uint32_t height) {
  Lens lens{.model = LensModel::table};
  lens.directions = fisheye_table(width, height);
  Camera camera{.width = width, .height = height};
  camera.projection.lens = std::move(lens);
  camera.name = name_of(LensModel::table);
  return camera;
}

Camera camera_of(const NamedLens& named, std::uint32_t width, std::uint32_t height) {
  Camera camera{.width = width, .height = height};
  camera.projection = {.fx = named.fx * width,
                       .fy = named.fy * width,
                       .cx = width / 2.0,
                       .cy = height / 2.0,
                       .lens = lens_of_numbers(named.model, named.distortion)};
  camera.name = named.model;
  return camera;
}

WorldMesh in_camera_frame(const ValidationScene& scene) {
  WorldMesh mesh = attribution::world_mesh(scene.scene);
  if (mesh.triangles.empty()) throw InputError(scene.name + ": the scene has no triangle");
  const auto camera_from_world = geometry::as_matrix(scene.camera.world_to_camera);
  for (auto& p : mesh.points) {
    const Eigen::Vector3d moved = camera_from_world * geometry::as_vector(p).homogeneous();
    p = geometry::as_array(moved.cast<float>().cast<double>());
  }
  return mesh;
}

Scene scene_of(const WorldMesh& world) {
  std::vector<MeshPoint> points;
  for (const auto& [x, y, z] : world.points) points.push_back({x, y, z});
  Mesh mesh;
  mesh.vertices = std::move(points);
  mesh.triangles = world.triangles;
  return bench::as_scene({std::move(mesh)}, "world");
}

Truth truth_of(const Scene& scene, const Camera& camera, WorldMesh mesh) {
  Truth truth{.mesh = std::move(mesh), .camera = camera};
  truth.camera.projection.lens.reset();
  truth.corner_numbers = attribution::corner_numbers(truth.mesh);
  const DepthMap map = render(scene, camera, {.channels = {Channel::distance, Channel::id}}).map;
  const auto& distance = *map.values<float>("distance");
  const auto& id = *map.values<std::uint32_t>("id");
  truth.triangles.assign(id.begin(), id.end());
  truth.depths.assign(distance.begin(), distance.end());
  for (std::size_t i = 0; i < truth.depths.size(); ++i)
    if (id[i] == no_surface) truth.depths[i] = std::numeric_limits<double>::infinity();
  return truth;
}

}  // namespace

std::vector<Camera> lens_cameras(std::uint32_t width, std::uint32_t height) {
  std::vector<Camera> cameras;
  for (const NamedLens& named : named_lenses()) cameras.push_back(camera_of(named, width, height));
  cameras.push_back(table_camera(width, height));
  return cameras;
}

std::vector<std::string> lens_names() {
  std::vector<std::string> names;
  for (const Camera& camera : lens_cameras(2, 2)) names.push_back(camera.name);
  return names;
}

LensCase lens_case(const ValidationScene& scene, const Camera& lens) {
  WorldMesh mesh = in_camera_frame(scene);
  LensCase made{.scene = scene.name, .camera = lens, .world = scene_of(mesh)};
  made.truth = truth_of(made.world, lens, std::move(mesh));
  return made;
}

ValidationScene scene_for_blender(const ValidationScene& scene, const Camera& panorama) {
  WorldMesh mesh = in_camera_frame(scene);
  for (auto& [x, y, z] : mesh.points) {
    y = -y;
    z = -z;
  }
  Camera camera = panorama;
  camera.world_to_camera = {{{1, 0, 0, 0}, {0, -1, 0, 0}, {0, 0, -1, 0}}};
  return {scene.name, scene_of(mesh), camera};
}

RoundedRays rounded_rays(const Camera& camera) {
  const DirectionTable table = directions_of(camera, DirectionRounding::binary32);
  RoundedRays made;
  for (std::uint32_t row = 0; row < camera.height; ++row) {
    for (std::uint32_t column = 0; column < camera.width; ++column) {
      const auto direction = table.at(column, row);
      if (!direction) continue;
      made.rays.push_back({.direction = *direction});
      made.pixels.push_back(std::size_t{row} * camera.width + column);
    }
  }
  return made;
}

}  // namespace fathom::validation
