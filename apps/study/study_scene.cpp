#include "apps/study/study_scene.h"

#include <array>
#include <cmath>
#include <limits>
#include <numbers>

#include "apps/study/cell.h"
#include "apps/study/plot.h"
#include "fathom/failures/errors.h"
#include "fathom/render.h"

namespace fathom::studies {
namespace {

/// Of a panel in its cell: the part from s0 to s1 and t0 to t1, moved along the view.
struct PanelPart {
  double s0, s1, t0, t1, moved;
};

/// Two triangles of the plane z = distance/(1 − tilt·s) that fills the cell around `middle` in the
/// image, x/z = middle + s·width, y/z = middle + t·height.
void add_part(Mesh& mesh, double distance, const std::array<double, 2>& middle,
              const PanelPart& part) {
  constexpr double half_width = 0.2, half_height = 0.15, tilt = 0.3;
  const auto at = [&](double s, double t) {
    const double z = distance / (1 - tilt * s);
    return MeshPoint{z * (middle[0] + s * half_width), z * (middle[1] + t * half_height),
                     z + part.moved};
  };
  const auto first = static_cast<std::uint32_t>(mesh.vertices.size());
  for (const MeshPoint& p :
       {at(part.s0, part.t0), at(part.s1, part.t0), at(part.s1, part.t1), at(part.s0, part.t1)}) {
    mesh.vertices.push_back(p);
  }
  mesh.triangles.push_back({first, first + 1, first + 2});
  mesh.triangles.push_back({first, first + 2, first + 3});
  mesh.face_count = mesh.triangles.size();
}

double power_of_ten(double x, bool up) {
  const double exponent = std::log10(x);
  return std::pow(10, up ? std::ceil(exponent) : std::floor(exponent));
}

}  // namespace

SceneView panels_with_decals() {
  SceneView view{"panels with decals", {}, {}};
  Mesh panels, decals;
  for (int i = 0; i < 12; ++i) {
    const double distance = std::pow(400.0, i / 11.0);
    const int column = i % 4, row = i / 4;
    const std::array<double, 2> middle{-0.75 + 0.5 * column, -0.38 + 0.38 * row};
    add_part(panels, distance, middle, {-1, 1, -1, 1, 0});
    add_part(panels, distance, middle, {0, 0.8, -0.8, 0.8, -0.06});
    add_part(decals, distance, middle, {-0.6, 0.6, -0.6, 0.6, -0.01});
  }
  view.scene.meshes = {std::move(panels), std::move(decals)};
  view.scene.objects = {{.mesh = 0, .name = "panels"}, {.mesh = 1, .name = "decals"}};
  Camera& camera = view.camera;
  camera.width = 640;
  camera.height = 360;
  camera.projection.fx = camera.projection.fy = 300;
  camera.projection.cx = 320;
  camera.projection.cy = 180;
  camera.near = 0.01;
  camera.far = 1000;
  return view;
}

SceneView wheel() {
  SceneView view{"wheel", {}, {}};
  Mesh mesh;
  const auto at = [](double radius, double turn) {
    const double angle = (turn + 0.013) * 2 * std::numbers::pi;
    const double x = radius * std::cos(angle), y = radius * std::sin(angle), z = 1 + 0.3 * x;
    return MeshPoint{x * z, y * z, z};
  };
  const auto add = [&](const MeshPoint& a, const MeshPoint& b, const MeshPoint& c) {
    const auto first = static_cast<std::uint32_t>(mesh.vertices.size());
    for (const MeshPoint& p : {a, b, c}) mesh.vertices.push_back(p);
    mesh.triangles.push_back({first, first + 1, first + 2});
  };
  for (int i = 0; i < 24; ++i) {
    const double turn = i / 24.0;
    add({0, 0, 1}, at(0.8, turn), at(0.8, turn + 0.011));
    add(at(0.85, turn), at(0.95, turn), at(0.95, turn + 1 / 24.0));
    add(at(0.85, turn), at(0.95, turn + 1 / 24.0), at(0.85, turn + 1 / 24.0));
  }
  mesh.face_count = mesh.triangles.size();
  view.scene.meshes = {std::move(mesh)};
  view.scene.objects = {{.name = "wheel"}};
  Camera& camera = view.camera;
  camera.width = camera.height = 320;
  camera.projection.fx = camera.projection.fy = 160;
  camera.projection.cx = camera.projection.cy = 160;
  return view;
}

SceneView scene_or_wheel(const StudyOptions& options) {
  SceneView view = options.scene ? *options.scene : wheel();
  if (options.near) view.camera.near = *options.near;
  if (options.far) view.camera.far = *options.far;
  if (const auto fault = find_fault(view.camera)) throw UsageError(*fault);
  return view;
}

DepthMap visible_map(const SceneView& view) {
  return render(view.scene, view.camera, {.channels = {Channel::Z, Channel::id}}).map;
}

Camera with_range(const SceneView& view, const StudyOptions& options) {
  Camera camera = view.camera;
  if (options.near && !(*options.near > 0)) {
    throw UsageError("near = " + text_of(*options.near) + " is not a positive number");
  }
  if (options.near) camera.near = *options.near;
  if (options.far) camera.far = *options.far;
  if (camera.near > 0 && std::isfinite(camera.far)) return camera;
  const DepthMap map = visible_map(view);
  double nearest = std::numeric_limits<double>::infinity(), farthest = 0;
  for (const float z : *map.values<float>("Z")) {
    if (!std::isfinite(z)) continue;
    nearest = std::min(nearest, static_cast<double>(z));
    farthest = std::max(farthest, static_cast<double>(z));
  }
  if (farthest == 0) throw UsageError("the camera sees nothing of the scene");
  if (!(camera.near > 0)) camera.near = power_of_ten(nearest / 20, false);
  if (!std::isfinite(camera.far)) camera.far = power_of_ten(2 * farthest, true);
  return camera;
}

StudyFile picture(const std::string& name, const DepthMap& map, const PreviewOptions& options) {
  return {name + ".png", png_bytes(draw_preview(map, options))};
}

namespace {

using pipeline::Colour;

Colour colour_of(const Mesh& mesh, const CornerIndices& triangle) {
  if (mesh.colours.empty()) return {1, 1, 1};
  const auto& colour = mesh.colours[triangle[0]];
  if (mesh.colours[triangle[1]] != colour || mesh.colours[triangle[2]] != colour)
    throw InputError("a triangle's corners differ in colour; an exact picture takes one for each");
  return {static_cast<double>(colour[0]), static_cast<double>(colour[1]),
          static_cast<double>(colour[2])};
}

/// By the numbers of the triangles.
std::vector<Colour> colours_of(const Scene& scene) {
  std::vector<Colour> colours;
  for (const Object& object : scene.objects) {
    const Mesh& mesh = scene.meshes[object.mesh];
    for (const CornerIndices& triangle : mesh.triangles) {
      colours.push_back(colour_of(mesh, triangle));
    }
  }
  return colours;
}

}  // namespace

pipeline::ColourImage exact_picture(const Scene& scene, const Camera& camera,
                                    const Colour& background) {
  const DeepMap visible = render_deep(scene, camera);
  const std::vector<Colour> colours = colours_of(scene);
  pipeline::ColourImage image{camera.width, camera.height, {}};
  image.pixels.reserve(visible.counts.size());
  auto sample = visible.samples.begin();
  for (const std::uint32_t count : visible.counts) {
    Colour sum{};
    double uncovered = 1;
    const auto add = [&](const Colour& colour, double area) {
      for (std::size_t k = 0; k < 3; ++k) sum[k] += area * colour[k];
    };
    for (const auto end = sample + count; sample != end; ++sample) {
      const auto area = static_cast<double>(sample->area);
      add(colours[sample->id], area);
      uncovered -= area;
    }
    add(background, uncovered);
    image.pixels.push_back(sum);
  }
  return image;
}

}  // namespace fathom::studies
