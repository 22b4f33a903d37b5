#include "apps/study/antialiasing/sampling.h"

#include <algorithm>
#include <cmath>
#include <complex>
#include <numbers>

#include "apps/study/antialiasing/methods.h"
#include "apps/study/cell.h"
#include "apps/study/pipeline_scenes.h"
#include "apps/study/plot.h"
#include "apps/study/study_scene.h"
#include "fathom/image/pictures/lettering.h"
#include "fathom/pipeline/render_moving.h"
#include "fathom/pipeline/render_pipeline.h"

namespace fathom::studies {
namespace {

using pipeline::AntialiasMethod;

/// Gratings of all multiples of 1/40 have a whole number of cycles in it.
constexpr int width = 480;

Scene grating(double frequency) {
  std::vector<MeshPoint> v;
  std::vector<CornerIndices> t;
  for (int k = 0; k < frequency * width; ++k) {
    const double x = k / frequency, end = (k + 0.5) / frequency;
    const auto first = static_cast<std::uint32_t>(v.size());
    for (const auto& [px, py] : {std::pair{x, 0.0}, {end, 0.0}, {end, 1.0}, {x, 1.0}})
      v.push_back({px, py, 0.5});
    t.push_back({first, first + 1, first + 2});
    t.push_back({first, first + 2, first + 3});
  }
  return scene_of(std::move(v), std::move(t));
}

std::vector<double> picture_of(double frequency, const pipeline::Antialias& antialias) {
  pipeline::PipelineOptions options = precise_options();
  options.antialias = antialias;
  const auto frame = render_frame(grating(frequency), window_camera(width, 1), options, true);
  std::vector<double> greys;
  for (const pipeline::Colour& c : frame.picture.pixels) greys.push_back(c[0]);
  return greys;
}

/// The amplitude of the wave of `bin` cycles in all of the picture.
double amplitude(const std::vector<double>& greys, int bin) {
  std::complex<double> sum;
  for (int x = 0; x < width; ++x) {
    sum += greys[static_cast<std::size_t>(x)] *
           std::polar(1.0, -2 * std::numbers::pi * (bin * x % width) / width);
  }
  // Half a cycle a pixel is its own mirror image.
  return std::abs(sum) * (2 * bin == width ? 1 : 2) / width;
}

/// What is left after summing up hundreds of rounded terms.
constexpr double noise = 1e-9;

int strongest_bin(const std::vector<double>& greys) {
  int best = 0;
  double strongest = noise;
  for (int bin = 1; bin <= width / 2; ++bin) {
    const double a = amplitude(greys, bin);
    // Of equal ones, up to rounding, the lowest.
    if (a > strongest + noise) strongest = a, best = bin;
  }
  return best;
}

double mean_error(const std::vector<double>& greys, double frequency) {
  double sum = 0;
  for (int x = 0; x < width; ++x) {
    sum += std::abs(greys[static_cast<std::size_t>(x)] - white_part(frequency, x));
  }
  return sum / width;
}

}  // namespace

std::vector<double> grating_samples(double frequency) {
  return picture_of(frequency, {AntialiasMethod::none, 1});
}

double reconstructed(const std::vector<double>& samples, double x) {
  // Of an even number of samples that repeat: each has the weight of Dirichlet's kernel, in which
  // the wave of half a cycle a pixel counts half on either side.
  const auto n = static_cast<double>(samples.size());
  double value = 0;
  for (std::size_t k = 0; k < samples.size(); ++k) {
    const double away = std::numbers::pi * (x - (static_cast<double>(k) + 0.5)), narrow = away / n;
    const double weight =
        std::abs(std::sin(narrow)) < 1e-12 ? 1 : std::sin(away) / (n * std::tan(narrow));
    value += samples[k] * weight;
  }
  return value;
}

std::string grating_name(const GratingSeen& grating) {
  return "grating-" + text_of(grating.frequency, ".3f");
}

RgbImage grating_picture(const GratingSeen& grating) {
  constexpr std::uint32_t pixels = 24, scale = 8, strip = 20, gap = 2, top = 18;
  RgbImage image(pixels * scale, top + 3 * strip + 2 * gap, {255, 255, 255});
  const std::string seen =
      grating.apparent == 0 ? "grey" : "seen as " + text_of(grating.apparent, ".3f");
  image::Lettering().draw(image, 2, 13, text_of(grating.frequency, ".3f") + ": " + seen, 12,
                          {0, 0, 0});
  const std::vector<double> samples = grating_samples(grating.frequency);
  for (std::uint32_t column = 0; column < image.width; ++column) {
    const double x = (column + 0.5) / scale, cycles = x * grating.frequency;
    const double strips[] = {cycles - std::floor(cycles) < 0.5 ? 1.0 : 0.0, samples[column / scale],
                             reconstructed(samples, x)};
    for (std::uint32_t i = 0; i < 3; ++i) {
      const auto grey =
          static_cast<std::uint8_t>(std::lround(255 * std::clamp(strips[i], 0.0, 1.0)));
      for (std::uint32_t row = 0; row < strip; ++row)
        image.at(column, top + i * (strip + gap) + row) = {grey, grey, grey};
    }
  }
  return image;
}

double white_part(double frequency, double x) {
  // White from 0 to y: all whole cycles are white for their first half.
  const auto up_to = [&](double y) {
    const double cycles = y * frequency, whole = std::floor(cycles);
    return (whole / 2 + std::min(cycles - whole, 0.5)) / frequency;
  };
  return up_to(x + 1) - up_to(x);
}

std::vector<GratingSeen> gratings_seen() {
  // Of the bars' fundamental: their grey is ½ + (2/π)·sin + …
  constexpr double full = 2 / std::numbers::pi;
  std::vector<GratingSeen> gratings;
  for (int i = 1; i <= 60; ++i) {
    const double f = i / 40.0;
    const auto one = picture_of(f, {AntialiasMethod::none, 1});
    const auto sixteen = picture_of(f, {AntialiasMethod::ssaa, 4});
    const auto areas = picture_of(f, {AntialiasMethod::area, 1});
    const int bin = strongest_bin(one);
    GratingSeen seen{f, static_cast<double>(bin) / width, 0, 0, 0, 0, 0};
    if (bin > 0) seen.contrast = amplitude(one, bin) / full;
    if (bin > 0) seen.contrast_by_area = amplitude(areas, bin) / full;
    seen.error = mean_error(one, f);
    seen.error_ssaa = mean_error(sixteen, f);
    seen.error_by_area = mean_error(areas, f);
    gratings.push_back(seen);
  }
  return gratings;
}

double nyquist_limit(const std::vector<GratingSeen>& gratings) {
  double limit = 0;
  for (const GratingSeen& g : gratings) {
    if (g.apparent != g.frequency) break;
    limit = g.frequency;
  }
  return limit;
}

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
