#include "validation/studies/course/exercises.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "fathom/pipeline/rasterization/grid_samples.h"
#include "fathom/pipeline/scan/edge_function.h"
#include "fathom/pipeline/scan/line.h"
#include "fathom/render.h"
#include "validation/studies/exact_picture.h"
#include "validation/studies/pipeline_scenes.h"

namespace fathom::studies {
namespace {

using pipeline::Exact;
using pipeline::PipelineFrame;
using pipeline::PipelineOptions;
using pipeline::Pixel;

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
  const DepthMap exact = render(scene, camera, {.channels = {Channel::id, Channel::bary}});
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

/// The half plane of exercise 6 as a large triangle; 64 × 64 pixels are looked at.
constexpr std::array<std::array<double, 2>, 3> half_plane{
    {{-100.3, -10.7}, {140.2, 61.4}, {-200, 180}}};
constexpr std::uint32_t half_plane_size = 64;

/// Its area in every pixel, as white.
pipeline::ColourImage exact_half_plane() {
  const auto corner = [](std::size_t i) {
    return MeshPoint{half_plane[i][0], half_plane[i][1], 0.5};
  };
  return exact_picture(scene_of({corner(0), corner(1), corner(2)}, {{0, 1, 2}}),
                       window_camera(half_plane_size, half_plane_size));
}

/// The share of a pixel's samples that a triangle covers.
double covered_share(const pipeline::GridTriangle& triangle, const Pixel& pixel, int samples) {
  const auto pattern = pipeline::GridSamples::of(sample_pattern(std::to_string(samples)));
  std::size_t covered = 0;
  for (std::size_t k = 0; k < pattern.size(); ++k) {
    const pipeline::GridPoint offset = pattern.at(pixel, k);
    covered += triangle.covers(pipeline::sample_of(pixel, offset.x, offset.y));
  }
  return static_cast<double>(covered) / static_cast<double>(pattern.size());
}

}  // namespace

RgbImage eight_lines() {
  RgbImage image(65, 65, {255, 255, 255});
  for (int k = 0; k < 8; ++k) {
    const double angle = k * std::numbers::pi / 4;
    const pipeline::LineEnds ends{32, 32, 32 + std::lround(30 * std::cos(angle)),
                                  32 - std::lround(30 * std::sin(angle))};
    pipeline::bresenham_line(ends, {0, 0, 65, 65}, [&](const Pixel& p, std::int64_t) {
      image.at(static_cast<std::uint32_t>(p.x), static_cast<std::uint32_t>(p.y)) = {
          static_cast<std::uint8_t>(30 * k), 0, static_cast<std::uint8_t>(240 - 30 * k)};
    });
  }
  return image;
}

RgbImage edge_function_signs() {
  RgbImage image(256, 256);
  const auto triangle = pipeline::edge_functions<Exact>(
      {{{Exact(50), Exact(20)}, {Exact(200), Exact(150)}, {Exact(30), Exact(180)}}});
  for (std::uint32_t y = 0; y < 256; ++y)
    for (std::uint32_t x = 0; x < 256; ++x)
      for (std::size_t k = 0; k < 3; ++k) {
        const Exact e =
            triangle->edges[k].at(pipeline::centre_of<Exact>(x), pipeline::centre_of<Exact>(y));
        image.at(x, y)[k] = e > 0 ? 230 : e < 0 ? 50 : 255;
      }
  return image;
}

Fight fight(double distance, Storage storage) {
  const double d = distance, s = distance / 3;
  std::vector<MeshPoint> corners;
  for (const double behind : {0.0, 0.0001})
    for (const auto& [x, y, z] : {std::array{-s, -s, d}, std::array{s, -s, d * 1.2},
                                  std::array{s, s, d * 1.4}, std::array{-s, s, d * 1.2}})
      // Along the view: the same image, a depth more.
      corners.push_back({x * (z + behind) / z, y * (z + behind) / z, z + behind});
  const Scene scene = scene_of(corners, {{4, 5, 6}, {4, 6, 7}, {0, 1, 2}, {0, 2, 3}});
  PipelineOptions options;  // binary32, as graphics processors compute
  options.depth_format.storage = storage;
  const PipelineFrame frame = render_frame(scene, front_camera(96, 96, 0.1, 1000), options, false);
  Fight result{RgbImage(96, 96), 0};
  std::size_t seen = 0, wrong = 0;
  for (std::size_t i = 0; i < frame.id.size(); ++i) {
    if (frame.id[i] == no_surface) continue;
    ++seen;
    const bool far_wins = frame.id[i] < 2;
    wrong += far_wins;
    result.picture.pixels[i] = far_wins ? Rgb{200, 30, 30} : Rgb{255, 255, 255};
  }
  result.wrong_share =
      static_cast<double>(wrong) / static_cast<double>(std::max<std::size_t>(seen, 1));
  return result;
}

Checkerboard checkerboard(pipeline::Interpolation interpolation) {
  const Camera camera = front_camera(256, 192, 0.5, 20);
  PipelineOptions options = precise_options();
  options.interpolation = interpolation;
  Checkerboard result = coordinate_errors(oblique_quadrangle(), camera, options);
  options.texture = "checker";
  options.filter = pipeline::TextureFilter::nearest;
  options.antialias = {pipeline::AntialiasMethod::ssaa, 3};
  Scene white = oblique_quadrangle();
  white.meshes[0].colours.clear();
  result.picture = pipeline::to_rgb(render_frame(white, camera, options, true).picture);
  return result;
}

RgbImage cube(pipeline::Shading shading) {
  std::vector<MeshPoint> v;
  const double a = 0.6, ca = std::cos(a), sa = std::sin(a), e = 0.5, ce = std::cos(e),
               se = std::sin(e);
  for (int i = 0; i < 8; ++i) {
    const double x = i & 1 ? 1 : -1, y = i & 2 ? 1 : -1, z = i & 4 ? 1 : -1;
    const double x1 = ca * x + sa * z, z1 = -sa * x + ca * z;
    v.push_back({x1, ce * y + se * z1, -se * y + ce * z1 + 5});
  }
  const Scene scene = scene_of(v, {{0, 2, 3},
                                   {0, 3, 1},
                                   {4, 5, 7},
                                   {4, 7, 6},
                                   {0, 4, 6},
                                   {0, 6, 2},
                                   {1, 3, 7},
                                   {1, 7, 5},
                                   {0, 1, 5},
                                   {0, 5, 4},
                                   {2, 6, 7},
                                   {2, 7, 3}});
  PipelineOptions options;
  options.shading = shading;
  options.background = {0.1, 0.1, 0.15};
  return pipeline::to_rgb(
      render_frame(scene, front_camera(160, 160, 1, 20), options, true).picture);
}

PartialPixels partial_pixels() {
  std::array<pipeline::GridPoint, 3> corners;
  for (std::size_t k = 0; k < 3; ++k)
    corners[k] = pipeline::snap(half_plane[k][0], half_plane[k][1], 16);
  const auto triangle = pipeline::GridTriangle::of(corners);
  const pipeline::ColourImage exact = exact_half_plane();
  PartialPixels result;
  for (std::int64_t y = 0; y < half_plane_size; ++y) {
    for (std::int64_t x = 0; x < half_plane_size; ++x) {
      const double area = exact.at(static_cast<std::uint32_t>(x), static_cast<std::uint32_t>(y))[0];
      // Weights of one colour add up to 1 but for roundings of 2^-53.
      const bool cut = area > 1e-12 && area < 1 - 1e-12;
      result.exact += cut;
      for (std::size_t i = 0; i < 4; ++i) {
        const double share = covered_share(*triangle, {x, y}, 1 << i);
        result.counted[i] += share > 0 && share < 1;
        if (cut) result.mean_error[i] += std::abs(share - area);
      }
    }
  }
  for (double& error : result.mean_error) error /= static_cast<double>(result.exact);
  return result;
}

}  // namespace fathom::studies
