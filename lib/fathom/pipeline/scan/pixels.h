#pragma once

#include <algorithm>
#include <cstdint>

/// Pixels of a window: pixel (x, y) is the square [x, x+1] × [y, y+1], y grows down, its centre is
/// (x + ½, y + ½).
namespace fathom::pipeline {

struct Pixel {
  std::int64_t x = 0, y = 0;
  friend bool operator==(const Pixel&, const Pixel&) = default;
  friend auto operator<=>(const Pixel&, const Pixel&) = default;
};

/// The pixels x_begin ≤ x < x_end of row y.
struct Span {
  std::int64_t y = 0, x_begin = 0, x_end = 0;
  friend bool operator==(const Span&, const Span&) = default;
};

/// The requested pixels: x_begin ≤ x < x_end, y_begin ≤ y < y_end. By default all pixels that an
/// algorithm can reach.
struct PixelWindow {
  static constexpr std::int64_t far_away = std::int64_t{1} << 40;
  std::int64_t x_begin = -far_away, y_begin = -far_away;
  std::int64_t x_end = far_away, y_end = far_away;

  [[nodiscard]] bool contains(const Pixel& p) const {
    return x_begin <= p.x && p.x < x_end && y_begin <= p.y && p.y < y_end;
  }
  [[nodiscard]] bool is_unlimited() const { return *this == PixelWindow{}; }
  [[nodiscard]] bool is_empty() const { return x_begin >= x_end || y_begin >= y_end; }
  friend bool operator==(const PixelWindow&, const PixelWindow&) = default;
};

inline PixelWindow overlap(const PixelWindow& a, const PixelWindow& b) {
  return {std::max(a.x_begin, b.x_begin), std::max(a.y_begin, b.y_begin),
          std::min(a.x_end, b.x_end), std::min(a.y_end, b.y_end)};
}

/// The requested part of a span; x_begin ≥ x_end if it is empty.
inline Span clipped(const Span& span, const PixelWindow& window) {
  if (span.y < window.y_begin || span.y >= window.y_end) return {span.y, 0, 0};
  return {span.y, std::max(span.x_begin, window.x_begin), std::min(span.x_end, window.x_end)};
}

/// The range of coordinates, in pixels, for scan conversion: |x| ≤ 2³¹.
inline constexpr double greatest_coordinate = 2147483648.0;

}  // namespace fathom::pipeline
