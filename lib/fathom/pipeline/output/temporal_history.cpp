#include "fathom/pipeline/output/temporal_history.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "fathom/threads/interruption.h"

namespace fathom::pipeline {
namespace {

bool is_inside(const ColourImage& image, double x, double y) {
  return x >= -0.5 && y >= -0.5 && x <= image.width - 0.5 && y <= image.height - 0.5;
}

/// Catmull and Rom's cubic [CR74]: weights of the four samples around a place, of which it is `t`
/// behind the second. It keeps edges where linear interpolation, picture after picture, would blur
/// them.
std::array<double, 4> cubic_weights(double t) {
  return {t * (-0.5 + t * (1 - 0.5 * t)), 1 + t * t * (-2.5 + 1.5 * t),
          t * (0.5 + t * (2 - 1.5 * t)), t * t * (-0.5 + 0.5 * t)};
}

/// The picture between pixels, with its border repeated; (0, 0) is the centre of the first pixel.
Colour smooth_between(const ColourImage& image, double x, double y) {
  const double i = std::floor(x), j = std::floor(y);
  const auto across = cubic_weights(x - i), down = cubic_weights(y - j);
  const auto limited = [](double place, std::uint32_t size) {
    return static_cast<std::uint32_t>(std::clamp(place, 0.0, static_cast<double>(size - 1)));
  };
  Colour sum{};
  for (std::size_t b = 0; b < 4; ++b) {
    for (std::size_t a = 0; a < 4; ++a) {
      const Colour& colour = image.at(limited(i - 1 + static_cast<double>(a), image.width),
                                      limited(j - 1 + static_cast<double>(b), image.height));
      for (std::size_t k = 0; k < 3; ++k) sum[k] += across[a] * down[b] * colour[k];
    }
  }
  return sum;
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
  const Colour colour = smooth_between(history_, x + move.x, y + move.y);
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
    check_interruption();
    for (std::uint32_t x = 0; x < present.width; ++x) {
      const Colour before = earlier(present, moves, x, y);
      Colour& colour = next.pixels[std::size_t{y} * present.width + x];
      for (std::size_t k = 0; k < 3; ++k) colour[k] = before[k] + weight * (colour[k] - before[k]);
    }
  }
  history_ = std::move(next);
}

}  // namespace fathom::pipeline
