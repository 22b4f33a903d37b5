#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "apps/bench/parts/exact_picture.h"

namespace fathom::bench {

/// A number for each pixel, with room at the right for the rest of a vector.
template <class Number>
struct PaddedImage {
  PaddedImage(std::uint32_t its_width, std::uint32_t its_height, Number value)
      : width(its_width),
        height(its_height),
        stride(its_width + most_lanes),
        numbers(stride * its_height, value) {}
  static constexpr std::size_t most_lanes = 16;

  [[nodiscard]] Number* row(std::size_t y) { return numbers.data() + y * stride; }
  /// Without what lies at the right.
  [[nodiscard]] Picture picture() const {
    Picture result;
    result.reserve(std::size_t{width} * height);
    for (std::size_t y = 0; y < height; ++y) {
      const auto begin = numbers.begin() + static_cast<std::ptrdiff_t>(y * stride);
      result.insert(result.end(), begin, begin + width);
    }
    return result;
  }

  std::uint32_t width, height;
  std::size_t stride;
  std::vector<Number> numbers;
};

}  // namespace fathom::bench
