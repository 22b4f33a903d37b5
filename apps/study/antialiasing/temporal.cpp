#include "apps/study/antialiasing/temporal.h"

#include <algorithm>
#include <cmath>
#include <complex>
#include <numbers>

#include "apps/study/antialiasing/methods.h"
#include "apps/study/drawn_files.h"
#include "apps/study/exact_picture.h"
#include "apps/study/pipeline_scenes.h"
#include "fathom/pipeline/render_moving.h"

namespace fathom::studies {
namespace {

using pipeline::AntialiasMethod;
using pipeline::ColourImage;

constexpr double pi = std::numbers::pi;
constexpr std::uint32_t spokes = 12, wheel_size = 96;
constexpr double middle = wheel_size / 2.0, degrees_between_spokes = 360.0 / spokes;

pipeline::PipelineOptions options_of(AntialiasMethod method, int count) {
  pipeline::PipelineOptions options = precise_options();
  options.antialias = {method, count};
  return options;
}

WorldFromMesh turned(double degrees) {
  const double c = std::cos(degrees * pi / 180), s = std::sin(degrees * pi / 180);
  WorldFromMesh m;
  m.rows[0] = {c, -s, 0.0, middle - c * middle + s * middle};
  m.rows[1] = {s, c, 0.0, middle - s * middle - c * middle};
  return m;
}

/// A keyframe for each degree: between two of them spokes become shorter by less than 4·10⁻⁵.
Motion turning(double degrees) {
  ObjectMotion motion{"scene", {}};
  const int steps = std::max(1, static_cast<int>(std::ceil(degrees)));
  for (int i = 0; i <= steps; ++i)
    motion.keyframes.push_back({static_cast<double>(i) / steps, turned(degrees * i / steps)});
  return {{motion}};
}

/// Half of each twelfth of a turn is white.
Scene wheel_of_spokes() {
  std::vector<MeshPoint> v{{middle, middle, 0.5}};
  std::vector<CornerIndices> t;
  for (std::uint32_t i = 0; i < spokes; ++i) {
    const auto first = static_cast<std::uint32_t>(v.size());
    for (const double part : {0.1, 0.6}) {
      const double angle = 2 * pi * (i + part) / spokes;
      v.push_back({middle + 46 * std::cos(angle), middle + 46 * std::sin(angle), 0.5});
    }
    t.push_back({0, first, first + 1});
  }
  return scene_of(std::move(v), std::move(t));
}

/// The wave of as many cycles a turn as there are spokes, on circles around the middle.
std::complex<double> wave_of_spokes(const ColourImage& image) {
  std::complex<double> sum;
  constexpr int angles = 1440;
  int count = 0;
  for (double radius = 20; radius <= 40; radius += 0.5) {
    for (int i = 0; i < angles; ++i, ++count) {
      const double angle = 2 * pi * i / angles;
      const double grey = pipeline::between(image, middle - 0.5 + radius * std::cos(angle),
                                            middle - 0.5 + radius * std::sin(angle))[0];
      sum += grey * std::polar(1.0, -angle * spokes);
    }
  }
  return sum / static_cast<double>(count);
}

ColourImage wheel_at(MovingScene& scene, double time) {
  return render_frame(scene.at(time), window_camera(wheel_size, wheel_size),
                      options_of(AntialiasMethod::none, 1), true)
      .picture;
}

/// Of the motion to the next picture, with the shutter open all the time.
ColourImage wheel_in_motion(MovingScene& scene) {
  return render_moving(scene, window_camera(wheel_size, wheel_size),
                       options_of(AntialiasMethod::temporal, 64), {0, 1}, true)
      .picture;
}

double sinc(double x) {
  return x == 0 ? 1 : std::abs(std::sin(pi * x) / (pi * x));
}

/// The square from 2 to 4 moves by 3 to the right: the way along which a place is covered.
constexpr double way = 3;
double covered_way(double place) {
  return std::max(0.0, std::min(way, place - 2) - std::max(0.0, place - 4));
}

Motion along(double distance) {
  ObjectMotion motion{"scene", {{0, {}}, {1, {}}}};
  motion.keyframes[1].world_from_placed.rows[0][3] = distance;
  return {{motion}};
}

}  // namespace

// A turn by a delays the wave of n cycles by n·a, of which whole cycles cannot be told.
WheelSeen wheel_seen(double rate) {
  MovingScene scene(wheel_of_spokes(), turning(rate));
  const std::complex<double> before = wave_of_spokes(wheel_at(scene, 0)),
                             after = wave_of_spokes(wheel_at(scene, 1));
  WheelSeen seen{};
  seen.rate = rate;
  seen.apparent = -std::arg(after / before) * 180 / pi / spokes;
  seen.alias = rate - degrees_between_spokes * std::ceil(rate / degrees_between_spokes - 0.5);
  seen.contrast = std::abs(wave_of_spokes(wheel_in_motion(scene)) / before);
  seen.sinc = sinc(rate / degrees_between_spokes);
  return seen;
}

// The integral at a centre is the way along which it is covered; over a pixel that way is linear
// between whole numbers.
TimeError time_error(int pictures) {
  constexpr std::uint32_t width = 10;
  MovingScene scene(
      scene_of({{2, 0, 0.5}, {4, 0, 0.5}, {4, 1, 0.5}, {2, 1, 0.5}}, {{0, 1, 2}, {0, 2, 3}}),
      along(way));
  const auto picture = [&](AntialiasMethod method) {
    return render_moving(scene, window_camera(width, 1), options_of(method, pictures), {0, 1}, true)
        .picture;
  };
  const ColourImage centres = picture(AntialiasMethod::temporal);
  const ColourImage areas = picture(AntialiasMethod::temporal_area);
  TimeError error{pictures, 0, 0};
  for (std::uint32_t x = 0; x < width; ++x) {
    const double at_centre = covered_way(x + 0.5) / way;
    const double over_pixel = (covered_way(x) + covered_way(x + 1)) / 2 / way;
    error.centres += std::abs(centres.at(x, 0)[0] - at_centre) / width;
    error.areas += std::abs(areas.at(x, 0)[0] - over_pixel) / width;
  }
  return error;
}

HistoryError history_error(double step) {
  constexpr int pictures = 16;
  const double distance = step * (pictures - 1);
  const Camera camera = window_camera(128, 128);
  // It ends in the middle of the picture.
  MovingScene scene(siemens_star(36, 48, 64.3 - distance, 63.8), along(distance));
  const ColourImage truth = exact_picture(scene.at(1), camera);
  const auto taa = [&](bool reprojected, bool clamped) {
    return error_of(render_moving(scene, camera, options_of(AntialiasMethod::taa, pictures), {0, 1},
                                  true, {reprojected, clamped})
                        .picture,
                    truth)
        .mean;
  };
  const ColourImage none =
      render_frame(scene.at(1), camera, options_of(AntialiasMethod::none, 1), true).picture;
  return {step,
          error_of(none, truth).mean,
          taa(true, true),
          taa(true, false),
          taa(false, true),
          taa(false, false)};
}

TemporalStudy measure_temporal(const std::function<void(double)>& tick) {
  TemporalStudy study;
  for (const double rate : {3.0, 9.0, 15.0, 21.0, 27.0, 30.0, 33.0, 45.0, 57.0, 63.0}) {
    study.wheels.push_back(wheel_seen(rate));
    tick(0.07 * static_cast<double>(study.wheels.size()));
  }
  for (const int n : {1, 2, 4, 8, 16, 32, 64, 128, 256}) study.times.push_back(time_error(n));
  for (const double step : {0.0, 0.25, 0.5, 0.7, 1.0, 1.7, 2.0})
    study.histories.push_back(history_error(step));
  tick(0.9);
  MovingScene scene(wheel_of_spokes(), turning(27));
  study.pictures.push_back(picture_file("wheel-sharp", pipeline::to_rgb(wheel_at(scene, 0)), 3));
  study.pictures.push_back(picture_file("wheel-next", pipeline::to_rgb(wheel_at(scene, 1)), 3));
  study.pictures.push_back(
      picture_file("wheel-shutter", pipeline::to_rgb(wheel_in_motion(scene)), 3));
  tick(1);
  return study;
}

}  // namespace fathom::studies
