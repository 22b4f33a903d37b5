#include "apps/study/pipeline_scenes.h"

#include <fmt/format.h>

#include <cmath>
#include <numbers>
#include <random>
#include <span>

#include "fathom/camera/camera_files.h"
#include "fathom/image/preview.h"
#include "fathom/render_by_pipeline.h"
#include "fathom/scene/read_scene.h"

namespace fathom::studies {

Scene scene_of(std::vector<MeshPoint> vertices, std::vector<CornerIndices> triangles) {
  Scene scene;
  scene.meshes.emplace_back();
  scene.meshes[0].face_count = triangles.size();
  scene.meshes[0].vertices = std::move(vertices);
  scene.meshes[0].triangles = std::move(triangles);
  scene.objects.push_back({.name = "scene"});
  return scene;
}

pipeline::PipelineOptions precise_options() {
  pipeline::PipelineOptions options;
  options.precision = pipeline::Precision::binary64;
  options.subpixel_bits = 16;
  options.shading = pipeline::Shading::none;
  return options;
}

Camera front_camera(std::uint32_t width, std::uint32_t height, double near, double far) {
  Camera camera;
  camera.width = width;
  camera.height = height;
  camera.projection.fx = camera.projection.fy = width;
  camera.projection.cx = width / 2.0;
  camera.projection.cy = height / 2.0;
  camera.near = near;
  camera.far = far;
  return camera;
}

Camera window_camera(std::uint32_t width, std::uint32_t height) {
  Camera camera;
  camera.width = width;
  camera.height = height;
  camera.projection.model = ProjectionModel::orthographic;
  camera.near = 0.125;
  camera.far = 1;
  return camera;
}

void paint_each_triangle(Scene& scene) {
  Mesh painted;
  const Mesh& mesh = scene.meshes[0];
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    const Rgb colour = colour_of_identifier(static_cast<std::uint32_t>(t));
    const auto first = static_cast<std::uint32_t>(painted.vertices.size());
    for (const std::uint32_t v : mesh.triangles[t]) {
      painted.vertices.push_back(mesh.vertices[v]);
      painted.colours.push_back({static_cast<float>(colour[0]) / 255,
                                 static_cast<float>(colour[1]) / 255,
                                 static_cast<float>(colour[2]) / 255, 1});
    }
    painted.triangles.push_back({first, first + 1, first + 2});
  }
  painted.face_count = mesh.face_count;
  scene.meshes[0] = std::move(painted);
}

Scene cyclic_overlap() {
  std::vector<MeshPoint> v;
  std::vector<CornerIndices> t;
  for (int k = 0; k < 3; ++k) {
    const double angle = k * 2 * std::numbers::pi / 3, c = std::cos(angle), s = std::sin(angle);
    const auto first = static_cast<std::uint32_t>(v.size());
    for (const auto& [x, y, z] :
         {std::array{-1.6, -0.6, 4.7}, std::array{1.0, -0.75, 3.5}, std::array{1.0, 0.05, 3.5}})
      v.push_back({c * x - s * y, s * x + c * y, z});
    t.push_back({first, first + 1, first + 2});
  }
  return scene_of(std::move(v), std::move(t));
}

Scene penetration() {
  return scene_of({{-1, -1, 3}, {1, -0.9, 5}, {0.1, 1, 4}, {-1.1, 0.8, 5}, {1, 0.7, 3}, {0, -1, 4}},
                  {{0, 1, 2}, {3, 4, 5}});
}

Scene random_triangles(std::uint32_t count, std::uint64_t seed) {
  std::mt19937_64 random(seed);
  std::uniform_real_distribution<double> place(-2, 2), depth(4, 8), size(-0.4, 0.4);
  std::vector<MeshPoint> v;
  std::vector<CornerIndices> t;
  for (std::uint32_t i = 0; i < count; ++i) {
    const double x = place(random), y = place(random), z = depth(random);
    const auto first = static_cast<std::uint32_t>(v.size());
    for (int k = 0; k < 3; ++k) v.push_back({x + size(random), y + size(random), z + size(random)});
    t.push_back({first, first + 1, first + 2});
  }
  return scene_of(std::move(v), std::move(t));
}

Scene ground(double size, double tile, double height) {
  Scene scene = scene_of(
      {{-size, height, 0.1}, {size, height, 0.1}, {size, height, size}, {-size, height, size}},
      {{0, 1, 2}, {0, 2, 3}});
  for (const MeshPoint& p : scene.meshes[0].vertices)
    scene.meshes[0].texture_coordinates.push_back({p.x / tile, p.z / tile});
  return scene;
}

Scene siemens_star(std::uint32_t points, double radius, double cx, double cy) {
  std::vector<MeshPoint> v{{cx, cy, 0.5}};
  std::vector<CornerIndices> t;
  for (std::uint32_t i = 0; i < points; ++i) {
    const auto first = static_cast<std::uint32_t>(v.size());
    for (const double part : {0.1, 0.6}) {
      const double angle = 2 * std::numbers::pi * (i + part) / points;
      v.push_back({cx + radius * std::cos(angle), cy + radius * std::sin(angle), 0.5});
    }
    t.push_back({0, first, first + 1});
  }
  return scene_of(std::move(v), std::move(t));
}

namespace {

std::string vertex_line(const Mesh& mesh, std::size_t i) {
  const MeshPoint& p = mesh.vertices[i];
  std::string line = fmt::format("v {} {} {}", p.x, p.y, p.z);
  if (!mesh.colours.empty()) {
    // As binary64, which has the same decimals for reading: they are rounded to binary32 only once.
    for (std::size_t k = 0; k < 3; ++k)
      line += fmt::format(" {}", static_cast<double>(mesh.colours[i][k]));
  }
  return line + "\n";
}

}  // namespace

std::string obj_of(const Scene& scene) {
  const Mesh& mesh = scene.meshes.at(0);
  std::string text;
  for (std::size_t i = 0; i < mesh.vertices.size(); ++i) text += vertex_line(mesh, i);
  for (const auto& uv : mesh.texture_coordinates) text += fmt::format("vt {} {}\n", uv[0], uv[1]);
  const bool textured = !mesh.texture_coordinates.empty();
  for (const CornerIndices& t : mesh.triangles) {
    text += "f";
    for (const std::uint32_t i : t)
      text += textured ? fmt::format(" {0}/{0}", i + 1) : fmt::format(" {}", i + 1);
    text += "\n";
  }
  for (const auto& line : mesh.lines) text += fmt::format("l {} {}\n", line[0] + 1, line[1] + 1);
  return text;
}

Scene scene_in(const StudyFile& file) {
  ReadOptions options;
  options.attributes = options.primitives = true;
  options.hash = false;
  Warnings warnings;
  return read_scene(std::as_bytes(std::span(file.content)), file.name, options, warnings);
}

SceneFiles scene_files(const std::string& name, const Scene& scene, const Camera& camera) {
  const StudyFile mesh{name + ".obj", obj_of(scene)};
  const StudyFile seen{name + ".json", to_json(camera) + "\n"};
  return {{name, scene_in(mesh), read_cameras(seen.content, seen.name).at(0)}, {mesh, seen}};
}

RgbImage pipeline_picture(const SceneView& view, const pipeline::PipelineOptions& options) {
  return render_by_pipeline(view.scene, view.camera, options, {}, true).picture;
}

}  // namespace fathom::studies
