#include "validation/studies/course/aliasing.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "fathom/pipeline/scan/polygon_fill.h"

namespace fathom::studies {

std::array<RgbImage, 2> curve_twice() {
  const auto filled = [](std::uint32_t size) {
    pipeline::FillPolygon<double> outline(1);
    const int steps = static_cast<int>(size) * 4;
    for (int i = 0; i < steps; ++i) {
      const double t = 2 * std::numbers::pi * i / steps;
      const double r = size * (0.3 + 0.12 * std::cos(3 * t));
      outline[0].push_back({size / 2.0 + r * std::cos(t), size / 2.0 + r * std::sin(t), {}});
    }
    RgbImage image(size, size, {255, 255, 255});
    pipeline::fill_polygon<double>(
        outline, pipeline::FillRule::non_zero, {0, 0, size, size}, [&](const auto& line) {
          for (const auto& span : line.spans)
            for (auto x = span.pixels.x_begin; x < span.pixels.x_end; ++x)
              image.at(static_cast<std::uint32_t>(x), static_cast<std::uint32_t>(line.y)) = {40, 80,
                                                                                             160};
        });
    return image;
  };
  return {filled(48), filled(384)};
}

namespace {

constexpr std::uint32_t wheel_size = 96, spokes = 12;

/// How dark the wheel is at a place relative to its middle, turned by a share of a full turn: 0
/// between spokes, 2 on the one that is marked.
int darkness(double dx, double dy, double turn) {
  const double place = (std::atan2(dy, dx) / (2 * std::numbers::pi) - turn + 4) * spokes;
  const bool first = std::fmod(place, spokes) < 0.3;
  return std::fmod(place, 1.0) < 0.3 ? (first ? 2 : 1) : 0;
}

}  // namespace

RgbImage turning_wheel(bool temporal_supersampling) {
  constexpr std::uint32_t size = wheel_size, frames = 8;
  constexpr double degrees_a_frame = 27;  // almost 30, the distance of two spokes
  const int instants = temporal_supersampling ? 16 : 1;
  RgbImage image(size * frames, size, {255, 255, 255});
  for (std::uint32_t frame = 0; frame < frames; ++frame) {
    for (std::uint32_t y = 0; y < size; ++y) {
      for (std::uint32_t x = 0; x < size; ++x) {
        const double dx = x + 0.5 - size / 2.0, dy = y + 0.5 - size / 2.0;
        if (std::hypot(dx, dy) > size / 2.0 - 2) continue;
        int dark = 0;
        for (int i = 0; i < instants; ++i) {
          dark +=
              darkness(dx, dy, (frame + static_cast<double>(i) / instants) * degrees_a_frame / 360);
        }
        const double share = std::min(1.0, static_cast<double>(dark) / instants);
        const auto grey = static_cast<std::uint8_t>(std::lround(235 - 200 * share));
        image.at(frame * size + x, y) = {grey, grey, grey};
      }
    }
  }
  return image;
}

}  // namespace fathom::studies
