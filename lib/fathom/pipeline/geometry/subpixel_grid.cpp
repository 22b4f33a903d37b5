#include "fathom/pipeline/geometry/subpixel_grid.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace fathom::pipeline {

std::int64_t snap(double x, int bits) {
  // A power of two times x is exact, and nearbyint rounds to nearest, ties to even.
  const double position = std::nearbyint(std::ldexp(x, bits));
  return static_cast<std::int64_t>(position) << (grid_bits - bits);
}

std::optional<GridTriangle> GridTriangle::of(const std::array<GridPoint, 3>& p) {
  GridTriangle t;
  t.twice_area_ =
      Int128{p[1].y - p[0].y} * (p[2].x - p[0].x) - Int128{p[1].x - p[0].x} * (p[2].y - p[0].y);
  if (t.twice_area_ == 0) return std::nullopt;
  t.turned_ = t.twice_area_ < 0;
  const Int128 sign = t.turned_ ? -1 : 1;
  t.twice_area_ *= sign;
  for (std::size_t k = 0; k < 3; ++k) {
    const GridPoint &from = p[(k + 1) % 3], &to = p[(k + 2) % 3];
    Edge& e = t.edges_[k];
    e.a = sign * (to.y - from.y);
    e.b = sign * (from.x - to.x);
    e.c = sign * (Int128{to.x} * from.y - Int128{from.x} * to.y);
    e.left_or_top = e.a > 0 || (e.a == 0 && e.b > 0);
  }
  t.least_ = {std::min({p[0].x, p[1].x, p[2].x}), std::min({p[0].y, p[1].y, p[2].y})};
  t.greatest_ = {std::max({p[0].x, p[1].x, p[2].x}), std::max({p[0].y, p[1].y, p[2].y})};
  return t;
}

std::array<Int128, 3> GridTriangle::edges_at(const GridPoint& sample) const {
  return {edges_[0].at(sample), edges_[1].at(sample), edges_[2].at(sample)};
}

bool GridTriangle::covers(const GridPoint& sample) const {
  return std::all_of(edges_.begin(), edges_.end(), [&](const Edge& e) {
    const Int128 value = e.at(sample);
    return value > 0 || (value == 0 && e.left_or_top);
  });
}

Span GridTriangle::span_of_row(std::int64_t y, const PixelWindow& window, std::int64_t dx,
                               std::int64_t dy) const {
  Span span{y, window.x_begin, window.x_end};
  const GridPoint origin = sample_of({0, y}, dx, dy);
  for (const Edge& e : edges_) {
    // Inside where value + x·step ≥ least; x is an integer column.
    const Int128 value = e.at(origin) - (e.left_or_top ? 0 : 1);
    const Int128 step = e.a * grid_one;
    if (step == 0) {
      if (value < 0) return {y, 0, 0};
    } else if (step > 0) {
      const Int128 first = -floor_quotient(value, step);  // ⌈−value / step⌉
      if (first > span.x_begin)
        span.x_begin = first > span.x_end ? span.x_end : static_cast<std::int64_t>(first);
    } else {
      const Int128 end = floor_quotient(value, -step) + 1;
      if (end < span.x_end)
        span.x_end = end < span.x_begin ? span.x_begin : static_cast<std::int64_t>(end);
    }
    if (span.x_begin >= span.x_end) return {y, 0, 0};
  }
  return span;
}

PixelWindow GridTriangle::bounding_box() const {
  return {least_.x >> grid_bits, least_.y >> grid_bits, (greatest_.x >> grid_bits) + 1,
          (greatest_.y >> grid_bits) + 1};
}

GridTriangle::BlockCoverage GridTriangle::test_block(const Pixel& corner, std::int64_t size) const {
  const std::int64_t x0 = corner.x * grid_one, y0 = corner.y * grid_one;
  const std::int64_t x1 = x0 + size * grid_one, y1 = y0 + size * grid_one;
  bool all = true;
  for (const Edge& e : edges_) {
    const Int128 greatest = e.at({e.a > 0 ? x1 : x0, e.b > 0 ? y1 : y0});
    if (greatest < 0) return BlockCoverage::none;
    const Int128 least = e.at({e.a > 0 ? x0 : x1, e.b > 0 ? y0 : y1});
    all = all && least > 0;
  }
  return all ? BlockCoverage::all : BlockCoverage::some;
}

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
