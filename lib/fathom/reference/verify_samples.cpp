#include "fathom/reference/verify_samples.h"

#include <algorithm>
#include <utility>

#include "fathom/reference/ray_decisions.h"

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

using triangle::ProjectedTriangle;
using triangle::Sample;

ChosenRays::ChosenRays(const View& view, const ChosenRows& chosen, std::uint32_t first_row,
                       std::uint32_t end_row)
    : view_(view), chosen_(chosen), first_row_(first_row), end_row_(end_row) {
  pixels_.reserve(chosen.start(end_row) - chosen.start(first_row));
  for (std::uint32_t row = first_row; row < end_row; ++row) {
    for (std::size_t k = chosen.start(row); k < chosen.start(row + 1); ++k)
      pixels_.push_back({view.preimages->of_pixel(chosen.column(k), row), nullptr});
  }
}

// Among equals the lowest number, which comes first, remains.
void ChosenRays::draw(ProjectedTriangle t, const PixelBox& box) {
  const std::size_t first = chosen_.start(first_row_);
  const DepthRange range(t, view_.camera);
  TierCounts tiers;
  std::vector<Pixel*> shown;
  const std::uint32_t end = std::min(box.last_row + 1, end_row_);
  for (std::uint32_t row = std::max(box.first_row, first_row_); row < end; ++row) {
    const auto pixels = chosen_.within(row, box.first_column, box.last_column);
    for (std::size_t k = pixels.first; k < pixels.end; ++k) {
      Pixel& pixel = pixels_[k - first];
      if (!pixel.ray) continue;
      const Sample s(*pixel.ray);
      if (!covers(t, s, tiers) || !range.contains(s, tiers)) continue;
      if (pixel.nearest && order_along(t, *pixel.nearest, *pixel.ray) != Sign::positive) continue;
      shown.push_back(&pixel);
    }
  }
  if (shown.empty()) return;
  triangles_.push_back(std::move(t));
  for (Pixel* const pixel : shown) pixel->nearest = &triangles_.back();
}

void ChosenRays::write(triangle::ChannelWriter& writer,
                       const std::function<void(std::size_t, const std::string&)>& on_fault) const {
  const std::size_t first = chosen_.start(first_row_);
  std::uint32_t* const valid = writer.values().valid;
  for (std::size_t i = 0; i < pixels_.size(); ++i) {
    const Pixel& pixel = pixels_[i];
    if (valid) valid[first + i] = pixel.ray ? 1 : 0;
    if (!pixel.nearest) continue;
    if (const auto fault = writer.write(first + i, *pixel.nearest, *pixel.ray))
      on_fault(first + i, fault->why);
  }
}

}  // namespace fathom::reference
