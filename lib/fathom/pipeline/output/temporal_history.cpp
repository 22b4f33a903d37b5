#include "fathom/pipeline/output/temporal_history.h"

#include <algorithm>
#include <cmath>

namespace fathom::pipeline {
namespace {

bool is_inside(const ColourImage& image, double x, double y) {
  return x >= -0.5 && y >= -0.5 && x <= image.width - 0.5 && y <= image.height - 0.5;
}

/// Limits a colour to those of the 3 × 3 pixels around.
Colour limited(Colour colour, const ColourImage& image, std::uint32_t x, std::uint32_t y) {
  Colour least = image.at(x, y), greatest = least;
  for (std::uint32_t j = y == 0 ? 0 : y - 1; j <= std::min(y + 1, image.height - 1); ++j) {
    for (std::uint32_t i = x == 0 ? 0 : x - 1; i <= std::min(x + 1, image.width - 1); ++i) {
      for (std::size_t k = 0; k < 3; ++k) {
        least[k] = std::min(least[k], image.at(i, j)[k]);
        greatest[k] = std::max(greatest[k], image.at(i, j)[k]);
      }
    }
  }
  for (std::size_t k = 0; k < 3; ++k) colour[k] = std::clamp(colour[k], least[k], greatest[k]);
  return colour;
}

}  // namespace

Colour TemporalHistory::earlier(const ColourImage& present, const PixelMoves& moves,
                                std::uint32_t x, std::uint32_t y) const {
  PixelMove move;
  if (settings_.reprojected) {
    const auto& known = moves[std::size_t{y} * present.width + x];
    if (!known || !is_inside(history_, x + known->x, y + known->y)) return present.at(x, y);
    move = *known;
  }
  const Colour colour = between(history_, x + move.x, y + move.y);
  return settings_.clamped ? limited(colour, present, x, y) : colour;
}

void TemporalHistory::add(const ColourImage& present, const PixelMoves& moves) {
  const double weight = std::max(1.0 / ++pictures_, settings_.weight);
  if (pictures_ == 1) {
    history_ = present;
    return;
  }
  ColourImage next = present;
  for (std::uint32_t y = 0; y < present.height; ++y) {
    for (std::uint32_t x = 0; x < present.width; ++x) {
      const Colour before = earlier(present, moves, x, y);
      Colour& colour = next.pixels[std::size_t{y} * present.width + x];
      for (std::size_t k = 0; k < 3; ++k) colour[k] = before[k] + weight * (colour[k] - before[k]);
    }
  }
  history_ = std::move(next);
}

}  // namespace fathom::pipeline
