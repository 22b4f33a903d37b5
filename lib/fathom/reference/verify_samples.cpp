#include "fathom/reference/verify_samples.h"

#include <algorithm>

namespace fathom::reference {

ChosenRows::ChosenRows(const PixelChoice& chosen, std::uint32_t width, std::uint32_t height,
                       std::uint32_t first_row, std::size_t enough)
    : first_row_(first_row), end_row_(first_row), starts_{0} {
  while (end_row_ < height && (end_row_ == first_row_ || columns_.size() < enough)) {
    const std::size_t row = static_cast<std::size_t>(end_row_) * width;
    for (std::uint32_t column = 0; column < width; ++column) {
      if (chosen[row + column]) columns_.push_back(column);
    }
    starts_.push_back(columns_.size());
    ++end_row_;
  }
}

ChosenRows::Range ChosenRows::within(std::uint32_t row, std::uint32_t first_column,
                                     std::uint32_t last_column) const {
  const auto begin = columns_.begin() + static_cast<std::ptrdiff_t>(start(row));
  const auto end = columns_.begin() + static_cast<std::ptrdiff_t>(start(row + 1));
  const auto first = std::lower_bound(begin, end, first_column);
  const auto last = std::upper_bound(first, end, last_column);
  return {static_cast<std::size_t>(first - columns_.begin()),
          static_cast<std::size_t>(last - columns_.begin())};
}

bool ChosenRows::meet(const PixelBox& box) const {
  if (box.is_empty()) return false;
  const std::uint32_t end = std::min(box.last_row + 1, end_row_);
  for (std::uint32_t row = std::max(box.first_row, first_row_); row < end; ++row) {
    const Range found = within(row, box.first_column, box.last_column);
    if (found.first != found.end) return true;
  }
  return false;
}

}  // namespace fathom::reference
