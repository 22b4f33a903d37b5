#include "apps/study/course/exercises.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "apps/study/cell.h"
#include "apps/study/pipeline_scenes.h"
#include "apps/study/study_scene.h"
#include "fathom/pipeline/render_pipeline.h"
#include "fathom/pipeline/scan/edge_function.h"
#include "fathom/render.h"
#include "fathom/render_by_pipeline.h"

namespace fathom::studies {
namespace {

using pipeline::PipelineFrame;
using pipeline::PipelineOptions;

/// A rectangle that runs away from the eye, with texture coordinates: a plane texture on two
/// triangles, so that perspective-correct interpolation knows nothing of their diagonal.
Scene oblique_quadrangle() {
  Scene scene = scene_of({{-0.9, 0.7, 2}, {0.9, 0.7, 2}, {0.9, 0.3, 10}, {-0.9, 0.3, 10}},
                         {{0, 1, 2}, {0, 2, 3}});
  scene.meshes[0].texture_coordinates = {{0, 0}, {1, 0}, {1, 1}, {0, 1}};
  scene.meshes[0].colours = {{0, 0, 0, 1}, {1, 0, 0, 1}, {1, 1, 0, 1}, {0, 1, 0, 1}};
  return scene;
}

/// How far interpolated texture coordinates, which are the corners' colours too, are from the exact
/// ones; without a picture.
Checkerboard coordinate_errors(const Scene& scene, const Camera& camera,
                               const PipelineOptions& options) {
  const PipelineFrame coordinates = render_frame(scene, camera, options, true);
  const DepthMap exact = render(scene, camera, {.channels = {Channel::id, Channel::bary}}).map;
  const auto& id = *exact.values<std::uint32_t>("id");
  const auto &b = *exact.values<float>("bary.U"), &c = *exact.values<float>("bary.V");
  Checkerboard result;
  std::size_t count = 0;
  for (std::size_t i = 0; i < id.size(); ++i) {
    if (id[i] == no_surface || coordinates.id[i] != id[i]) continue;
    const auto& t = scene.meshes[0].triangles[id[i]];
    const auto& uv = scene.meshes[0].texture_coordinates;
    double square = 0;
    for (std::size_t k = 0; k < 2; ++k) {
      const double B = static_cast<double>(b[i]), C = static_cast<double>(c[i]);
      const double truth = (1 - B - C) * uv[t[0]][k] + B * uv[t[1]][k] + C * uv[t[2]][k];
      square += std::pow(coordinates.picture.pixels[i][k] - truth, 2);
    }
    ++count;
    result.mean_error += std::sqrt(square);
    result.greatest_error = std::max(result.greatest_error, std::sqrt(square));
  }
  result.mean_error /= static_cast<double>(std::max<std::size_t>(count, 1));
  return result;
}

/// The half plane of exercise 6 is a large triangle; 64 × 64 pixels are looked at.
constexpr std::array<std::array<double, 2>, 3> half_plane{
    {{-100.3, -10.7}, {140.2, 61.4}, {-200, 180}}};
constexpr std::uint32_t half_plane_size = 64;

constexpr double apart = 0.0001;

}  // namespace

// The first to be drawn stays where lines meet: all are at one depth.
SceneFiles eight_lines_files() {
  constexpr double middle = 32.5;
  Scene scene = scene_of({}, {});
  Mesh& mesh = scene.meshes[0];
  for (std::uint32_t k = 0; k < 8; ++k) {
    const double angle = k * std::numbers::pi / 4;
    mesh.vertices.push_back({middle, middle, 0.5});
    mesh.vertices.push_back({middle + static_cast<double>(std::lround(30 * std::cos(angle))),
                             middle - static_cast<double>(std::lround(30 * std::sin(angle))), 0.5});
    const auto share = static_cast<float>(k) / 8;
    mesh.colours.insert(mesh.colours.end(), 2, {share, 0, 1 - share, 1});
    mesh.lines.push_back({2 * k, 2 * k + 1});
  }
  return scene_files("exercise-1", scene, window_camera(65, 65));
}

RgbImage eight_lines(pipeline::WireLine algorithm) {
  PipelineOptions options;
  options.wire_line = algorithm;
  options.background = {1, 1, 1};
  return pipeline_picture(eight_lines_files().view, options);
}

// In binary64, where these are exact: halves of whole numbers below 2^18.
std::array<std::vector<double>, 3> edge_function_values() {
  std::array<std::vector<double>, 3> values;
  const auto triangle = pipeline::edge_functions<double>({{{50, 20}, {200, 150}, {30, 180}}});
  for (std::size_t k = 0; k < 3; ++k)
    for (std::int64_t y = 0; y < 256; ++y)
      for (std::int64_t x = 0; x < 256; ++x)
        values[k].push_back(
            triangle->edges[k].at(pipeline::centre_of<double>(x), pipeline::centre_of<double>(y)));
  return values;
}

RgbImage edge_function_signs() {
  RgbImage image(256, 256);
  const auto values = edge_function_values();
  for (std::size_t k = 0; k < 3; ++k)
    for (std::size_t i = 0; i < image.pixels.size(); ++i) {
      const double e = values[k][i];
      image.pixels[i][k] = e > 0 ? 230 : e < 0 ? 50 : 255;
    }
  return image;
}

SceneFiles fight_files(double distance) {
  const double d = distance, s = distance / 3;
  std::vector<MeshPoint> corners;
  for (const double behind : {0.0, apart})
    for (const auto& [x, y, z] : {std::array{-s, -s, d}, std::array{s, -s, d * 1.2},
                                  std::array{s, s, d * 1.4}, std::array{-s, s, d * 1.2}})
      // Along the view: the same image, a depth more.
      corners.push_back({x * (z + behind) / z, y * (z + behind) / z, z + behind});
  Scene scene = scene_of(corners, {{4, 5, 6}, {4, 6, 7}, {0, 1, 2}, {0, 2, 3}});
  scene.meshes[0].colours.assign(4, {1, 1, 1, 1});
  scene.meshes[0].colours.insert(scene.meshes[0].colours.end(), 4, {0.8F, 0.1F, 0.1F, 1});
  return scene_files("exercise-3-" + text_of(distance), scene, front_camera(96, 96, 0.1, 1000));
}

Fight fight(double distance, Storage storage, pipeline::Precision precision) {
  PipelineOptions options;
  options.precision = precision;
  options.shading = pipeline::Shading::none;
  options.depth_format.storage = storage;
  const SceneView view = fight_files(distance).view;
  const PipelineRendering seen =
      render_by_pipeline(view.scene, view.camera, options, {Channel::id}, true);
  Fight result{seen.picture, 0};
  std::size_t covered = 0, wrong = 0;
  for (const std::uint32_t id : *seen.map.values<std::uint32_t>("id")) {
    covered += id != no_surface;
    wrong += id < 2;
  }
  result.wrong_share =
      static_cast<double>(wrong) / static_cast<double>(std::max<std::size_t>(covered, 1));
  return result;
}

// Its depth grows by 0.2 of the distance over 2/3 of it, along x and along y.
double tilt_of_fight() {
  return std::atan(std::hypot(0.3, 0.3)) * 180 / std::numbers::pi;
}

double steps_of_unorm16() {
  return apart * 65535;
}

SceneFiles checkerboard_files() {
  Scene white = oblique_quadrangle();
  white.meshes[0].colours.clear();
  return scene_files("exercise-4", white, front_camera(256, 192, 0.5, 20));
}

Checkerboard checkerboard(pipeline::Interpolation interpolation) {
  const SceneView view = checkerboard_files().view;
  PipelineOptions options = precise_options();
  options.interpolation = interpolation;
  Checkerboard result = coordinate_errors(oblique_quadrangle(), view.camera, options);
  options.texture = "checker";
  options.filter = pipeline::TextureFilter::nearest;
  options.antialias = {pipeline::AntialiasMethod::ssaa, 3};
  result.picture = pipeline_picture(view, options);
  return result;
}

SceneFiles half_plane_files() {
  const auto corner = [](std::size_t i) {
    return MeshPoint{half_plane[i][0], half_plane[i][1], 0.5};
  };
  return scene_files("exercise-6", scene_of({corner(0), corner(1), corner(2)}, {{0, 1, 2}}),
                     window_camera(half_plane_size, half_plane_size));
}

PartialPixels partial_pixels() {
  const SceneView view = half_plane_files().view;
  const pipeline::ColourImage exact = exact_picture(view.scene, view.camera);
  // Weights of one colour add up to 1 but for roundings of 2^-53.
  const auto is_cut = [](double area) { return area > 1e-12 && area < 1 - 1e-12; };
  PartialPixels result;
  result.exact_picture = pipeline::to_rgb(exact);
  for (const pipeline::Colour& area : exact.pixels) result.exact += is_cut(area[0]);
  for (std::size_t i = 0; i < 4; ++i) {
    PipelineOptions options = precise_options();
    options.antialias = {pipeline::AntialiasMethod::msaa, 1 << i};
    const pipeline::ColourImage seen = render_frame(view.scene, view.camera, options, true).picture;
    for (std::size_t k = 0; k < seen.pixels.size(); ++k) {
      const double share = seen.pixels[k][0], area = exact.pixels[k][0];
      result.counted[i] += share > 0 && share < 1;
      if (is_cut(area)) result.mean_error[i] += std::abs(share - area);
    }
    result.mean_error[i] /= static_cast<double>(result.exact);
    result.pictures[i] = pipeline::to_rgb(seen);
  }
  return result;
}

}  // namespace fathom::studies
