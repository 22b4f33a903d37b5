#pragma once

#include <cstdint>
#include <vector>

#include "fathom/geometry/pixel_box.h"
#include "fathom/reference/verify.h"

namespace fathom::reference {

/// The chosen pixels of consecutive rows of an image, numbered from 0 in row order.
class ChosenRows {
 public:
  /// Takes rows from `first_row` on, at least one, until it has `enough` pixels or the image ends.
  ChosenRows(const PixelChoice& chosen, std::uint32_t width, std::uint32_t height,
             std::uint32_t first_row, std::size_t enough);

  [[nodiscard]] std::uint32_t first_row() const { return first_row_; }
  [[nodiscard]] std::uint32_t end_row() const { return end_row_; }
  [[nodiscard]] std::size_t size() const { return columns_.size(); }

  /// Number of the first chosen pixel of a row; end_row() is allowed.
  [[nodiscard]] std::size_t start(std::uint32_t row) const { return starts_[row - first_row_]; }
  [[nodiscard]] std::uint32_t column(std::size_t pixel) const { return columns_[pixel]; }

  struct Range {
    std::size_t first, end;
  };
  /// The chosen pixels of a row within [first_column, last_column].
  [[nodiscard]] Range within(std::uint32_t row, std::uint32_t first_column,
                             std::uint32_t last_column) const;
  /// Whether the box contains a chosen pixel.
  [[nodiscard]] bool meet(const PixelBox& box) const;

 private:
  std::uint32_t first_row_, end_row_;
  std::vector<std::size_t> starts_;
  std::vector<std::uint32_t> columns_;
};

}  // namespace fathom::reference
