#include "apps/validate/faults/golden_image.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace fathom::validation {
namespace {

using attribution::OtherMap;

bool is_surface(double depth) {
  return std::abs(depth) < std::numeric_limits<double>::infinity();
}

bool differs(double before, double after) {
  if (is_surface(before) != is_surface(after)) return true;
  return is_surface(before) && !(std::abs(after - before) <= 0.01 * std::abs(before));
}

/// Means, variances and covariance over a window.
double similarity_at(const std::vector<std::uint8_t>& a, const std::vector<std::uint8_t>& b,
                     std::size_t width, std::size_t first) {
  constexpr std::size_t side = 8;
  constexpr double n = side * side, c1 = 0.01 * 255 * 0.01 * 255, c2 = 0.03 * 255 * 0.03 * 255;
  double sum_a = 0, sum_b = 0, aa = 0, bb = 0, ab = 0;
  for (std::size_t y = 0; y < side; ++y) {
    for (std::size_t x = 0; x < side; ++x) {
      const double p = a[first + y * width + x], q = b[first + y * width + x];
      sum_a += p;
      sum_b += q;
      aa += p * p;
      bb += q * q;
      ab += p * q;
    }
  }
  const double mean_a = sum_a / n, mean_b = sum_b / n;
  const double var_a = aa / n - mean_a * mean_a, var_b = bb / n - mean_b * mean_b;
  const double covariance = ab / n - mean_a * mean_b;
  return (2 * mean_a * mean_b + c1) * (2 * covariance + c2) /
         ((mean_a * mean_a + mean_b * mean_b + c1) * (var_a + var_b + c2));
}

}  // namespace

std::vector<std::uint8_t> grey_picture(const OtherMap& map, const OtherMap& range_of) {
  double least = std::numeric_limits<double>::infinity(), greatest = -least;
  for (const double depth : range_of.depths) {
    if (!is_surface(depth)) continue;
    least = std::min(least, depth);
    greatest = std::max(greatest, depth);
  }
  std::vector<std::uint8_t> grey;
  for (const double depth : map.depths) {
    const double part = (depth - least) / (greatest - least);
    const bool shows = is_surface(depth) && part == part;
    grey.push_back(
        shows ? static_cast<std::uint8_t>(std::lround(255 - 254 * std::clamp(part, 0.0, 1.0))) : 0);
  }
  return grey;
}

double structural_similarity(const std::vector<std::uint8_t>& a, const std::vector<std::uint8_t>& b,
                             std::uint32_t width) {
  const std::size_t height = a.size() / width;
  double sum = 0, windows = 0;
  for (std::size_t y = 0; y + 8 <= height; y += 4) {
    for (std::size_t x = 0; x + 8 <= width; x += 4) {
      sum += similarity_at(a, b, width, y * width + x);
      ++windows;
    }
  }
  return windows > 0 ? sum / windows : 1;
}

GoldenVerdicts golden_verdicts(const OtherMap& before, const OtherMap& after,
                               const Camera& camera) {
  GoldenVerdicts verdicts;
  const std::vector<std::uint8_t> a = grey_picture(before, before), b = grey_picture(after, before);
  verdicts.ssim = structural_similarity(a, b, camera.width) < 0.99;
  std::uint64_t different = 0;
  for (std::size_t i = 0; i < before.depths.size(); ++i) {
    different += differs(before.depths[i], after.depths[i]) ? 1 : 0;
  }
  verdicts.one_percent = different * 100 > before.depths.size();
  if (const std::optional<double> error = vtk_image_difference(a, b, camera.width)) {
    constexpr double usual_threshold = 10;
    verdicts.has_vtk = true;
    verdicts.vtk = *error > usual_threshold;
  }
  return verdicts;
}

}  // namespace fathom::validation
