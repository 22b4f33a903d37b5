#include "fathom/attribution/pixels/statistics.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <utility>

namespace fathom::attribution {
namespace {

double median(std::vector<double>& values) {
  if (values.empty()) return 0;
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

void set_images(const std::vector<PixelResult>& pixels, Attribution& result) {
  const std::size_t count = pixels.size();
  result.classes.resize(count);
  result.least.assign(count, std::numeric_limits<float>::quiet_NaN());
  result.greatest = result.least;
  result.absent.resize(count);
  result.alone.resize(count);
  for (std::size_t i = 0; i < count; ++i) {
    const PixelResult& p = pixels[i];
    result.classes[i] = p.pixel_class;
    result.absent[i] = p.absent;
    result.alone[i] = p.alone ? 1 : 0;
    ++result.counts[static_cast<std::size_t>(p.pixel_class)];
    result.wrong_ties += p.wrong_tie ? 1 : 0;
    if (!p.visible) continue;
    result.least[i] = static_cast<float>(p.visible->depths.lower);
    result.greatest[i] = static_cast<float>(p.visible->depths.upper);
  }
}

void set_sharpness(const std::vector<PixelResult>& pixels, const Truth& truth,
                   Attribution& result) {
  std::vector<double> widths, steps;
  std::uint64_t may = 0, touched = 0;
  result.certain_pixels.assign(truth.mesh.triangles.size(), 0);
  for (std::size_t i = 0; i < pixels.size(); ++i) {
    const PixelResult& p = pixels[i];
    may += p.may ? 1 : 0;
    touched += p.touched ? 1 : 0;
    if (!p.visible || !(p.visible->relative_width >= 0)) continue;  // none between two infinities
    widths.push_back(p.visible->relative_width);
    steps.push_back(p.visible->steps_width);
    if (!p.may) ++result.certain_pixels[truth.triangles[i]];
  }
  result.median_relative_width = median(widths);
  result.median_steps_width = median(steps);
  result.may_share = touched == 0 ? 0 : static_cast<double>(may) / static_cast<double>(touched);
}

DepthErrors errors_of(const std::vector<PixelResult>& pixels) {
  DepthErrors errors;
  std::vector<double> relative;
  double sum = 0;
  for (const PixelResult& p : pixels) {
    if (!p.error) continue;
    ++errors.pixels;
    sum += p.error->absolute;
    errors.greatest = std::max(errors.greatest, p.error->absolute);
    errors.greatest_relative = std::max(errors.greatest_relative, p.error->relative);
    relative.push_back(p.error->relative);
  }
  errors.mean = relative.empty() ? 0 : sum / static_cast<double>(relative.size());
  errors.median_relative = median(relative);
  return errors;
}

/// Of the pixels of a triangle: stored minus expected, how much of that roundings may be that all
/// triangles share, and the widths of the intervals, in steps.
struct TriangleBias {
  double sum = 0, shared = 0, widths = 0;
  std::uint32_t pixels = 0;
};

/// Roundings are those of a triangle's corners and plane: its pixels share them, so triangles are
/// what is averaged, each with the inverse square of how uncertain its depth is.
void set_mean_bias(const std::vector<TriangleBias>& triangles, Attribution& result) {
  std::vector<std::pair<double, double>> means;  // and weights
  double weights = 0, sum = 0, shared = 0;
  for (const TriangleBias& t : triangles) {
    if (t.pixels == 0 || !(t.widths > 0) || std::isinf(t.widths)) continue;
    const double weight = std::pow(t.pixels / t.widths, 2);
    means.emplace_back(t.sum / t.pixels, weight);
    weights += weight;
    sum += weight * means.back().first;
    shared += weight * t.shared / t.pixels;
  }
  result.bias_triangles = means.size();
  if (means.size() < 2) return;
  result.bias_steps = sum / weights;
  result.bias_shared = shared / weights;
  double squares = 0;
  for (const auto& [mean, weight] : means) {
    squares += std::pow(weight * (mean - result.bias_steps), 2);
  }
  result.bias_deviation = std::sqrt(squares) / weights;
}

void set_bias(const std::vector<PixelResult>& pixels, const Truth& truth, Attribution& result) {
  std::vector<TriangleBias> triangles(truth.mesh.triangles.size());
  for (std::size_t i = 0; i < pixels.size(); ++i) {
    const PixelResult& p = pixels[i];
    if (!p.bias) continue;
    ++result.bias_pixels;
    TriangleBias& bias = triangles[truth.triangles[i]];
    bias.sum += p.bias->off;
    bias.shared += p.bias->shared;
    bias.widths += p.visible->steps_width;
    ++bias.pixels;
  }
  set_mean_bias(triangles, result);
}

}  // namespace

Attribution summary_of(const std::vector<PixelResult>& pixels, const Truth& truth) {
  Attribution result;
  set_images(pixels, result);
  set_sharpness(pixels, truth, result);
  result.errors = errors_of(pixels);
  set_bias(pixels, truth, result);
  return result;
}

}  // namespace fathom::attribution
