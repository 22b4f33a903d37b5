#include "apps/study/antialiasing/nyquist.h"

#include <algorithm>
#include <cmath>
#include <complex>
#include <numbers>

#include "apps/study/cell.h"
#include "apps/study/pipeline_scenes.h"
#include "fathom/image/pictures/lettering.h"
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

}  // namespace fathom::studies
