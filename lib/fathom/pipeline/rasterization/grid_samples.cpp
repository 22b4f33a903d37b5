#include "fathom/pipeline/rasterization/grid_samples.h"

#include <cmath>
#include <utility>

namespace fathom::pipeline {
namespace {

double radical_inverse(int k, int base) {
  double inverse = 0, digit = 1;
  for (; k > 0; k /= base) {
    digit /= base;
    inverse += digit * (k % base);
  }
  return inverse;
}

/// From pixels to grid units, rounded down.
GridPoint on_grid(double u, double v) {
  const auto one = static_cast<double>(grid_one);
  return {static_cast<std::int64_t>(std::floor(u * one)),
          static_cast<std::int64_t>(std::floor(v * one))};
}

}  // namespace

GridSamples GridSamples::centre() {
  GridSamples samples;
  samples.offsets_ = {{0, 0}};
  return samples;
}

GridSamples GridSamples::of(SamplePattern pattern) {
  GridSamples samples;
  if (pattern.jittered) {
    samples.jittered_ = std::move(pattern);
  } else {
    for (const auto& [u, v] : pattern.offsets) samples.offsets_.push_back(on_grid(u, v));
  }
  return samples;
}

GridSamples GridSamples::regular(int n) {
  GridSamples samples;
  for (int j = 0; j < n; ++j)
    for (int i = 0; i < n; ++i)
      samples.offsets_.push_back(on_grid((i + 0.5) / n - 0.5, (j + 0.5) / n - 0.5));
  return samples;
}

GridSamples GridSamples::halton(int k) {
  GridSamples samples;
  samples.offsets_ = {on_grid(radical_inverse(k + 1, 2) - 0.5, radical_inverse(k + 1, 3) - 0.5)};
  return samples;
}

GridPoint GridSamples::in_cell(const Pixel& pixel, std::size_t sample) const {
  const auto [u, v] = jittered_->at(sample, static_cast<std::uint32_t>(pixel.x),
                                    static_cast<std::uint32_t>(pixel.y));
  return on_grid(u, v);
}

}  // namespace fathom::pipeline
