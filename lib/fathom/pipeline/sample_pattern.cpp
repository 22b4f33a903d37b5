#include "fathom/pipeline/sample_pattern.h"

#include <cmath>
#include <stdexcept>

namespace fathom::pipeline {
namespace {

/// A number in [0, 2³²) from the pixel and the sample, well mixed.
/// Source   the finalizer of MurmurHash3 (A. Appleby, public domain).
std::uint32_t mixed(std::uint64_t key) {
  key ^= key >> 33;
  key *= 0xff51afd7ed558ccdULL;
  key ^= key >> 33;
  key *= 0xc4ceb9fe1a85ec53ULL;
  key ^= key >> 33;
  return static_cast<std::uint32_t>(key);
}

double radical_inverse(int k, int base) {
  double inverse = 0, digit = 1;
  for (; k > 0; k /= base) {
    digit /= base;
    inverse += digit * (k % base);
  }
  return inverse;
}

GridPoint from_unit(double x, double y) {
  const auto one = static_cast<double>(grid_one);
  return {static_cast<std::int64_t>(std::floor((x - 0.5) * one)),
          static_cast<std::int64_t>(std::floor((y - 0.5) * one))};
}

}  // namespace

SamplePattern SamplePattern::centre() {
  SamplePattern pattern;
  pattern.offsets_ = {{0, 0}};
  return pattern;
}

SamplePattern SamplePattern::standard(int samples) {
  SamplePattern pattern;
  switch (samples) {
    case 1:
      pattern.offsets_ = {{0, 0}};
      break;
    case 2:
      pattern.offsets_ = {{4, 4}, {-4, -4}};
      break;
    case 4:
      pattern.offsets_ = {{-2, -6}, {6, -2}, {-6, 2}, {2, 6}};
      break;
    case 8:
      pattern.offsets_ = {{1, -3}, {-1, 3}, {5, 1}, {-3, -5}, {-5, 5}, {-7, -1}, {3, 7}, {7, -7}};
      break;
    case 16:
      pattern.offsets_ = {{1, 1},  {-1, -3}, {-3, 2}, {4, -1}, {-5, -2}, {2, 5},
                          {5, 3},  {3, -5},  {-2, 6}, {0, -7}, {-4, -6}, {-6, 4},
                          {-8, 0}, {7, -4},  {6, 7},  {-7, -8}};
      break;
    default:
      throw std::invalid_argument("there is no standard pattern of so many samples");
  }
  for (GridPoint& p : pattern.offsets_) p = {p.x * (grid_one / 16), p.y * (grid_one / 16)};
  return pattern;
}

SamplePattern SamplePattern::grid(int n) {
  SamplePattern pattern;
  for (int j = 0; j < n; ++j)
    for (int i = 0; i < n; ++i) pattern.offsets_.push_back(from_unit((i + 0.5) / n, (j + 0.5) / n));
  return pattern;
}

SamplePattern SamplePattern::jittered(int samples) {
  SamplePattern pattern;
  const int side = static_cast<int>(std::lround(std::sqrt(samples)));
  pattern.cells_ = side * side == samples ? side : 1;
  pattern.offsets_.resize(static_cast<std::size_t>(samples));
  return pattern;
}

SamplePattern SamplePattern::halton(int k) {
  SamplePattern pattern;
  pattern.offsets_ = {from_unit(radical_inverse(k + 1, 2), radical_inverse(k + 1, 3))};
  return pattern;
}

GridPoint SamplePattern::at(const Pixel& pixel, std::size_t sample) const {
  if (cells_ == 0) return offsets_[sample];
  const auto key = (static_cast<std::uint64_t>(pixel.y) << 40) ^
                   (static_cast<std::uint64_t>(pixel.x) << 16) ^ (2 * sample);
  const auto cell = static_cast<int>(sample);
  const double x = (cell % cells_ + mixed(key) * 0x1p-32) / cells_;
  const double y = (cell / cells_ % cells_ + mixed(key + 1) * 0x1p-32) / cells_;
  return from_unit(x, y);
}

}  // namespace fathom::pipeline
