#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <vector>

#include "fathom/image/samples.h"

namespace fathom::app {

/// A mask, 1 or 0 for each pixel, row by row from the top, with what BOP counts of it.
struct CountedMask {
  std::vector<std::uint8_t> mask;
  std::uint64_t count = 0;
  /// Of the pixels that it has.
  long first_column = 0, first_row = 0, last_column = -1, last_row = -1;

  /// x, y, and the differences of the last and the first column and row, as BOP has boxes, in an image
  /// whose corner is at this column and row.
  [[nodiscard]] std::array<long, 4> box(long column, long row) const {
    return {first_column - column, first_row - row, last_column - first_column,
            last_row - first_row};
  }
};

/// Where an object is seen, or, without one, any surface.
CountedMask mask_of(const Samples<std::uint32_t>& objects, std::uint32_t width,
                    std::optional<std::uint32_t> object);

/// The middle ninth of a mask three times as wide and as high as this.
std::vector<std::uint8_t> middle_of(const std::vector<std::uint8_t>& mask, std::uint32_t width,
                                    std::uint32_t height);

}  // namespace fathom::app
