#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "fathom/fast/bins/tile_shape.h"

namespace fathom::fast {

/// What meets which pixel of a tile; pixels are numbered by rows.
class PixelMeetings {
 public:
  void clear() { unsorted_.clear(); }
  void add(std::uint32_t pixel, std::size_t index) {
    unsorted_.push_back({pixel, static_cast<std::uint32_t>(index)});
  }
  /// To be called after the last add().
  void sort() {
    starts_.fill(0);
    for (const Meeting& meeting : unsorted_) ++starts_[meeting.pixel + 1];
    for (std::size_t i = 1; i < starts_.size(); ++i) starts_[i] += starts_[i - 1];
    sorted_.resize(unsorted_.size());
    auto next = starts_;
    for (const Meeting& meeting : unsorted_) sorted_[next[meeting.pixel]++] = meeting.index;
  }
  /// The indices for a pixel, in the order in which they were added.
  [[nodiscard]] std::span<const std::uint32_t> at(std::uint32_t pixel) const {
    return std::span(sorted_).subspan(starts_[pixel], starts_[pixel + 1] - starts_[pixel]);
  }

 private:
  struct Meeting {
    std::uint32_t pixel, index;
  };
  std::vector<Meeting> unsorted_;
  std::vector<std::uint32_t> sorted_;
  std::array<std::uint32_t, TileShape::samples + std::size_t{1}> starts_{};
};

}  // namespace fathom::fast
