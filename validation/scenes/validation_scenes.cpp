#include "validation/scenes/validation_scenes.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "fathom/attribution/model/renderer_input.h"
#include "fathom/camera/camera_making.h"
#include "fathom/failures/errors.h"
#include "fathom/scene/framing.h"
#include "fathom/scene/read_scene.h"
#include "validation/scenes/scenes.h"
#include "validation/scenes/shapes.h"

namespace fathom::validation {
namespace {

using attribution::clip_range;
using attribution::ClipRange;
using attribution::world_mesh;
using attribution::WorldMesh;
using bench::ImageSize;
using bench::simple_camera;

Scene read(const std::string& file) {
  Warnings warnings;
  return read_scene({std::string(FATHOM_DATA_DIR "/") + file}, {.threads = 1, .hash = false},
                    warnings);
}

ValidationScene framed(const std::string& name, Scene scene, const ImageSize& size,
                       ProjectionModel model = ProjectionModel::perspective) {
  const Camera camera =
      frame_scene(scene, {}, {.width = size.width, .height = size.height, .model = model});
  return {name, std::move(scene), camera};
}

/// A rectangle of two triangles through four corners.
void add_sheet(Mesh& mesh, const std::array<std::array<double, 3>, 4>& corners) {
  const auto first = static_cast<std::uint32_t>(mesh.vertices.size());
  for (const auto& [x, y, z] : corners) mesh.vertices.push_back({x, y, z});
  mesh.triangles.push_back({first, first + 1, first + 2});
  mesh.triangles.push_back({first, first + 2, first + 3});
}

/// A rectangle [x0, x1] × [y0, y1] of the plane z = distance + tilt·x.
void add_tilted(Mesh& mesh, double x0, double x1, double y0, double y1, double distance,
                double tilt) {
  const auto z = [&](double x) { return distance + tilt * x; };
  add_sheet(mesh, {{{x0, y0, z(x0)}, {x1, y0, z(x1)}, {x1, y1, z(x1)}, {x0, y1, z(x0)}}});
}

ValidationScene slivers(const ImageSize& size) {
  Mesh mesh;
  constexpr int count = 400;
  mesh.vertices.push_back({0.013, -0.017, 2});
  for (int i = 0; i <= count; ++i) {
    const double angle = 2 * std::numbers::pi * i / count;
    mesh.vertices.push_back(
        {0.7 * std::cos(angle), 0.7 * std::sin(angle), 2 + 0.4 * std::sin(5 * angle)});
  }
  for (std::uint32_t i = 1; i <= count; i += 2) mesh.triangles.push_back({0, i, i + 1});
  add_tilted(mesh, -2, 2, -2, 2, 4, 0.25);
  return {"slivers", bench::as_scene({mesh}, "slivers"), simple_camera(size)};
}

/// Pairs side by side: the second sheet of each is 10⁻⁴ of the distance behind the first.
ValidationScene sheets(const ImageSize& size) {
  Mesh mesh;
  const double distances[] = {1, 3, 10, 30, 100, 300};
  for (int i = 0; i < 6; ++i) {
    const double d = distances[i], left = -0.36 + 0.12 * i;
    add_tilted(mesh, left * d, (left + 0.11) * d, -0.3 * d, 0.2 * d, d, 0.3);
    add_tilted(mesh, (left + 0.01) * d, (left + 0.12) * d, -0.2 * d, 0.3 * d, d * (1 + 1e-4), 0.3);
  }
  return {"sheets", bench::as_scene({mesh}, "sheets"), simple_camera(size)};
}

ValidationScene utm(const ImageSize& size) {
  const Scene scene = read("scenes/hard/utm-terrain.obj");
  const WorldMesh mesh = world_mesh(scene);
  double low = INFINITY;
  for (const auto& p : mesh.points) low = std::min(low, p[2]);
  const Camera camera =
      look_at({500010.5, 4649770.25, low + 60}, {500026.123, 4649802.22, low + 10}, {0, 0, 1},
              {.width = size.width, .height = size.height, .vertical_fov = 50});
  return {"utm", scene, camera};
}

/// Spheres of radius 0.2·d at distances d = 0.002, 0.02, … 8000; near 10⁻³, far 10⁴.
ValidationScene range(const ImageSize& size) {
  std::vector<Mesh> meshes;
  double distance = 0.002;
  for (int i = 0; i < 7; ++i, distance *= 10) {
    const double column = -0.42 + 0.14 * i, row = i % 2 == 0 ? -0.12 : 0.12;
    meshes.push_back(
        bench::sphere(400, {column * distance, row * distance, distance}, 0.12 * distance));
  }
  Mesh wall;
  add_tilted(wall, -9000, 9000, -9000, 9000, 8000, 0.1);
  meshes.push_back(wall);
  ValidationScene made{"range", bench::as_scene(meshes, "range"), simple_camera(size, 1.0)};
  made.camera.near = 1e-3;
  made.camera.far = 1e4;
  return made;
}

ValidationScene calibrated(const ImageSize& size) {
  ValidationScene made = framed("calibrated", read("meshes/spot.obj"), size);
  made.camera.projection.fy *= 1.07;
  made.camera.projection.skew = 0.06 * made.camera.projection.fx;
  made.camera.projection.cx += 0.0712 * size.width;
  made.camera.projection.cy -= 0.0531 * size.height;
  made.camera.projection.pixel_centre = 0;
  return made;
}

ValidationScene soup(const ImageSize& size) {
  const Camera camera = simple_camera(size);
  return {"soup", bench::as_scene({bench::soup(5000, 20, camera)}, "soup"), camera};
}

ValidationScene from_bench(const std::string& name, const std::string& bench_name,
                           const ImageSize& size) {
  bench::BenchScene made = bench::make_scene(bench_name, size.width, size.height);
  return {name, std::move(made.scene), made.camera};
}

/// Whatever the near plane would be, floor and ceiling reach through it.
ValidationScene room(const ImageSize& size) {
  ValidationScene made = from_bench("room", "room", size);
  made.camera.near = 0.05;
  made.camera.far = 20;
  return made;
}

/// A bumpy sheet with a corner on the ray of every pixel, exactly: all numbers have few bits.
ValidationScene vertices(const ImageSize& size) {
  Camera camera{.width = size.width, .height = size.height};
  camera.projection.fx = camera.projection.fy = 256;
  camera.projection.cx = size.width / 2.0;
  camera.projection.cy = size.height / 2.0;
  Mesh mesh;
  std::uint32_t seed = 1;
  for (std::uint32_t row = 0; row < size.height; ++row) {
    for (std::uint32_t column = 0; column < size.width; ++column) {
      seed = 1664525 * seed + 1013904223;
      const double z = 2 + (seed >> 20) / 8192.0;  // times 319/2: 24 bits
      mesh.vertices.push_back({(column + 0.5 - camera.projection.cx) / 256 * z,
                               (row + 0.5 - camera.projection.cy) / 256 * z, z});
    }
  }
  for (std::uint32_t row = 0; row + 1 < size.height; ++row) {
    for (std::uint32_t column = 0; column + 1 < size.width; ++column) {
      const std::uint32_t a = row * size.width + column, c = a + size.width;
      mesh.triangles.push_back({a, a + 1, c});
      mesh.triangles.push_back({a + 1, c + 1, c});
    }
  }
  return {"vertices", bench::as_scene({mesh}, "vertices"), camera};
}

ValidationScene coplanar(const ImageSize& size) {
  return {"coplanar", read("scenes/hard/coplanar-overlaps.obj"), simple_camera(size, 0.8)};
}

using Make = ValidationScene (*)(const ImageSize&);
struct Named {
  const char* name;
  Make make;
};
constexpr Named makers[] = {
    {"sphere", [](const ImageSize& s) { return from_bench("sphere", "sphere-5k", s); }},
    {"spot", [](const ImageSize& s) { return framed("spot", read("meshes/spot.obj"), s); }},
    {"teapot", [](const ImageSize& s) { return framed("teapot", read("meshes/teapot.obj"), s); }},
    {"dense", [](const ImageSize& s) { return from_bench("dense", "sphere-200k", s); }},
    {"slivers", slivers},
    {"coplanar", coplanar},
    {"sheets", sheets},
    {"grid", [](const ImageSize& s) { return from_bench("grid", "grid-aligned", s); }},
    {"vertices", vertices},
    {"room", room},
    {"utm", utm},
    {"range", range},
    {"orthographic",
     [](const ImageSize& s) {
       return framed("orthographic", read("meshes/teapot.obj"), s, ProjectionModel::orthographic);
     }},
    {"calibrated", calibrated},
    {"soup", soup}};

}  // namespace

std::vector<std::string> scene_names() {
  std::vector<std::string> names;
  for (const Named& named : makers) names.emplace_back(named.name);
  return names;
}

bool is_scene_name(const std::string& name) {
  return std::any_of(std::begin(makers), std::end(makers),
                     [&](const Named& named) { return named.name == name; });
}

Camera with_clip_planes(const Scene& scene, Camera camera) {
  const ClipRange range = clip_range(world_mesh(scene), camera);
  camera.near = range.near;
  camera.far = range.far;
  return camera;
}

ValidationScene make_validation_scene(const std::string& name, std::uint32_t width,
                                      std::uint32_t height) {
  for (const Named& named : makers) {
    if (named.name != name) continue;
    ValidationScene made = named.make({width, height});
    made.camera = with_clip_planes(made.scene, made.camera);
    return made;
  }
  throw UsageError("there is no scene '" + name + "'");
}

}  // namespace fathom::validation
