#include "validation/studies/course/course_pictures.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "fathom/pipeline/grid_samples.h"
#include "fathom/pipeline/scan/edge_function.h"
#include "fathom/pipeline/scan/line.h"
#include "fathom/pipeline/scan/polygon_fill.h"
#include "fathom/render.h"
#include "validation/studies/pipeline_scenes.h"

namespace fathom::studies {
namespace {

using pipeline::Exact;
using pipeline::PipelineFrame;
using pipeline::PipelineOptions;
using pipeline::Pixel;

PipelineOptions precise() {
  PipelineOptions options;
  options.precision = pipeline::Precision::binary64;
  options.subpixel_bits = 16;
  options.shading = pipeline::Shading::none;
  return options;
}

Scene demo_scene(bool far_first) {
  Scene scene = scene_of({{80, 30, 0.3},
                          {30, 200, 0.3},
                          {200, 180, 0.3},
                          {160, 20, 0.6},
                          {100, 220, 0.6},
                          {290, 150, 0.6}},
                         far_first ? std::vector<CornerIndices>{{3, 4, 5}, {0, 1, 2}}
                                   : std::vector<CornerIndices>{{0, 1, 2}, {3, 4, 5}});
  scene.meshes[0].colours = {{1, 0, 0, 1}, {0, 1, 0, 1}, {0, 0, 1, 1},
                             {1, 1, 0, 1}, {0, 1, 1, 1}, {1, 0, 1, 1}};
  return scene;
}

/// A rectangle that runs away from the eye, with texture coordinates: a plane texture on two
/// triangles, so that perspective-correct interpolation knows nothing of their diagonal.
Scene oblique_quadrangle() {
  Scene scene = scene_of({{-0.9, 0.7, 2}, {0.9, 0.7, 2}, {0.9, 0.3, 10}, {-0.9, 0.3, 10}},
                         {{0, 1, 2}, {0, 2, 3}});
  scene.meshes[0].texture_coordinates = {{0, 0}, {1, 0}, {1, 1}, {0, 1}};
  scene.meshes[0].colours = {{0, 0, 0, 1}, {1, 0, 0, 1}, {1, 1, 0, 1}, {0, 1, 0, 1}};
  return scene;
}

/// The half plane of exercise 6 as a large triangle; 64 × 64 pixels are looked at.
constexpr std::array<std::array<double, 2>, 3> half_plane{
    {{-100.3, -10.7}, {140.2, 61.4}, {-200, 180}}};

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
  const Scene scene = oblique_quadrangle();
  const Camera camera = front_camera(256, 192, 0.5, 20);
  PipelineOptions options = precise();
  options.interpolation = interpolation;
  // The colours are the texture coordinates: the picture holds what was interpolated.
  const PipelineFrame coordinates = render_frame(scene, camera, options, true);
  RenderOptions exact_options;
  exact_options.channels = {Channel::id, Channel::bary};
  const DepthMap exact = render(scene, camera, exact_options);
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
  options.texture = "checker";
  options.filter = pipeline::TextureFilter::nearest;
  options.antialias = {pipeline::AntialiasMethod::ssaa, 3};
  Scene white = scene;
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
  Scene scene = scene_of({{half_plane[0][0], half_plane[0][1], 0.5},
                          {half_plane[1][0], half_plane[1][1], 0.5},
                          {half_plane[2][0], half_plane[2][1], 0.5}},
                         {{0, 1, 2}});
  PipelineOptions options = precise();
  options.antialias.method = pipeline::AntialiasMethod::area;
  const PipelineFrame exact = render_frame(scene, window_camera(64, 64), options, true);
  PartialPixels result;
  for (std::int64_t y = 0; y < 64; ++y) {
    for (std::int64_t x = 0; x < 64; ++x) {
      const double area =
          exact.picture.at(static_cast<std::uint32_t>(x), static_cast<std::uint32_t>(y))[0];
      // Weights of one colour add up to 1 but for roundings of 2^-53.
      const bool cut = area > 1e-12 && area < 1 - 1e-12;
      result.exact += cut;
      for (std::size_t i = 0; i < 4; ++i) {
        const auto pattern = pipeline::GridSamples::of(sample_pattern(std::to_string(1 << i)));
        std::size_t covered = 0;
        for (std::size_t k = 0; k < pattern.size(); ++k) {
          const pipeline::GridPoint offset = pattern.at({x, y}, k);
          covered += triangle->covers(pipeline::sample_of({x, y}, offset.x, offset.y));
        }
        result.counted[i] += covered > 0 && covered < pattern.size();
        if (cut)
          result.mean_error[i] +=
              std::abs(static_cast<double>(covered) / static_cast<double>(pattern.size()) - area);
      }
    }
  }
  for (double& error : result.mean_error) error /= static_cast<double>(result.exact);
  return result;
}

Demo demo() {
  const Camera camera = window_camera(320, 240);
  PipelineOptions options = precise();
  options.background = {0.05, 0.05, 0.1};
  const PipelineFrame far_first = render_frame(demo_scene(true), camera, options, true);
  const PipelineFrame near_first = render_frame(demo_scene(false), camera, options, true);
  Demo result{pipeline::to_rgb(far_first.picture)};
  const auto fragments = [&](CornerIndices triangle) {
    Scene scene = demo_scene(true);
    scene.meshes[0].triangles = {triangle};
    return render_frame(scene, camera, options, false).statistics.fragments;
  };
  result.near_fragments = fragments({0, 1, 2});
  result.far_fragments = fragments({3, 4, 5});
  result.union_of_both = static_cast<std::uint64_t>(std::count_if(
      far_first.id.begin(), far_first.id.end(), [](auto id) { return id != no_surface; }));
  result.overlap = result.near_fragments + result.far_fragments - result.union_of_both;
  result.passed_far_first = far_first.statistics.depth_passed;
  result.passed_near_first = near_first.statistics.depth_passed;
  return result;
}

Tables z_buffer_tables() {
  constexpr int columns = 12, rows = 9;
  // Columns of the black triangle and of the grey one, first and last, as in the source.
  constexpr std::array<std::array<int, 2>, rows> black{
      {{5, 5}, {5, 5}, {4, 6}, {4, 7}, {3, 7}, {3, 8}, {2, 8}, {2, 9}, {1, 10}}};
  constexpr std::array<int, rows> grey{12, 11, 8, 6, 4, 6, 8, 9, 11};
  Tables tables;
  for (int y = 0; y < rows; ++y) {
    std::array<double, columns> depth;
    std::array<char, columns> colour;
    for (int x = 0; x < columns; ++x) {
      const bool covered = black[y][0] <= x && x <= black[y][1];
      depth[x] = covered ? 0.5 : 1;
      colour[x] = covered ? 'B' : 'W';
    }
    const auto write = [&](std::vector<std::string>& depths, std::vector<std::string>& colours) {
      std::string d, c;
      for (int x = 0; x < columns; ++x) {
        d += fmt::format("{}{:.3g}", x ? " " : "", depth[x]);
        c += fmt::format("{}{}", x ? " " : "", colour[x]);
      }
      depths.push_back(d);
      colours.push_back(c);
    };
    write(tables.depth_before, tables.colour_before);
    for (int x = grey[y]; x < columns; ++x) {
      const double z = (25 + 10 * (x - 4)) / 100.0;  // nearer on the left
      if (!(z < depth[x])) continue;
      depth[x] = z;
      colour[x] = 'G';
    }
    write(tables.depth_after, tables.colour_after);
  }
  return tables;
}

std::array<RgbImage, 2> curve_twice() {
  const auto filled = [](std::uint32_t size) {
    pipeline::FillPolygon<double> outline(1);
    const int steps = static_cast<int>(size) * 4;
    for (int i = 0; i < steps; ++i) {
      const double t = 2 * std::numbers::pi * i / steps;
      const double r = size * (0.3 + 0.12 * std::cos(3 * t));
      outline[0].push_back({size / 2.0 + r * std::cos(t), size / 2.0 + r * std::sin(t), {}});
    }
    RgbImage image(size, size, {255, 255, 255});
    pipeline::fill_polygon<double>(
        outline, pipeline::FillRule::non_zero, {0, 0, size, size}, [&](const auto& line) {
          for (const auto& span : line.spans)
            for (auto x = span.pixels.x_begin; x < span.pixels.x_end; ++x)
              image.at(static_cast<std::uint32_t>(x), static_cast<std::uint32_t>(line.y)) = {40, 80,
                                                                                             160};
        });
    return image;
  };
  return {filled(48), filled(384)};
}

RgbImage turning_wheel(bool temporal_supersampling) {
  constexpr std::uint32_t size = 96, frames = 8, spokes = 12;
  constexpr double degrees_a_frame = 27;  // almost 30, the distance of two spokes
  const int instants = temporal_supersampling ? 16 : 1;
  RgbImage image(size * frames, size, {255, 255, 255});
  for (std::uint32_t frame = 0; frame < frames; ++frame) {
    for (std::uint32_t y = 0; y < size; ++y) {
      for (std::uint32_t x = 0; x < size; ++x) {
        const double dx = x + 0.5 - size / 2.0, dy = y + 0.5 - size / 2.0;
        if (std::hypot(dx, dy) > size / 2.0 - 2) continue;
        int dark = 0;
        for (int i = 0; i < instants; ++i) {
          const double turn = (frame + static_cast<double>(i) / instants) * degrees_a_frame / 360;
          const double place = (std::atan2(dy, dx) / (2 * std::numbers::pi) - turn + 4) * spokes;
          const bool first = std::fmod(place, spokes) < 0.3;  // one spoke is marked
          dark += std::fmod(place, 1.0) < 0.3 ? (first ? 2 : 1) : 0;
        }
        const double share = std::min(1.0, static_cast<double>(dark) / instants);
        const auto grey = static_cast<std::uint8_t>(std::lround(235 - 200 * share));
        image.at(frame * size + x, y) = {grey, grey, grey};
      }
    }
  }
  return image;
}

}  // namespace fathom::studies
