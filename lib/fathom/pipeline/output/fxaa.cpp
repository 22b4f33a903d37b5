#include "fathom/pipeline/output/fxaa.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "fathom/threads/interruption.h"

namespace fathom::pipeline {
namespace {

/// How far each step along an edge goes, in pixels; nothing is looked up after the last one.
constexpr std::array<double, 12> steps{1, 1, 1, 1, 1, 1.5, 2, 2, 2, 2, 4, 8};

double luma(const Colour& c) {
  return 0.299 * c[0] + 0.587 * c[1] + 0.114 * c[2];
}

/// Luma of a pixel and its neighbours.
struct Lumas {
  double nw, n, ne, w, m, e, sw, s, se;

  Lumas(const ColourImage& image, double x, double y) {
    const auto look = [&](int dx, int dy) { return luma(between(image, x + dx, y + dy)); };
    nw = look(-1, -1), n = look(0, -1), ne = look(1, -1);
    w = look(-1, 0), m = look(0, 0), e = look(1, 0);
    sw = look(-1, 1), s = look(0, 1), se = look(1, 1);
  }

  [[nodiscard]] double greatest() const { return std::max({n, w, m, e, s}); }
  [[nodiscard]] double range() const { return greatest() - std::min({n, w, m, e, s}); }

  /// Whether luma changes more from row to row than from column to column.
  [[nodiscard]] bool is_horizontal() const {
    const double along_columns =
        std::abs(nw - 2 * w + sw) + 2 * std::abs(n - 2 * m + s) + std::abs(ne - 2 * e + se);
    const double along_rows =
        std::abs(nw - 2 * n + ne) + 2 * std::abs(w - 2 * m + e) + std::abs(sw - 2 * s + se);
    return along_columns >= along_rows;
  }

  /// How much the pixel differs from the weighted mean of its neighbours, smoothed; from 0 to 1.
  [[nodiscard]] double sticking_out() const {
    const double mean = (2 * (n + w + e + s) + nw + ne + sw + se) / 12;
    const double part = std::clamp(std::abs(mean - m) / range(), 0.0, 1.0);
    const double smooth = part * part * (3 - 2 * part);
    return smooth * smooth;
  }
};

/// The side of a pixel along which an edge runs.
struct Side {
  bool horizontal;
  int across;     ///< −1: above or to the left; 1: below or to the right
  double step;    ///< of luma across it
  double middle;  ///< mean luma of the pixels on both sides

  explicit Side(const Lumas& l) : horizontal(l.is_horizontal()) {
    const double before = horizontal ? l.n : l.w, after = horizontal ? l.s : l.e;
    const double step_before = std::abs(before - l.m), step_after = std::abs(after - l.m);
    const bool is_before = step_before >= step_after;
    across = is_before ? -1 : 1;
    step = std::max(step_before, step_after);
    middle = ((is_before ? before : after) + l.m) / 2;
  }
};

/// Where an edge ends in one of its directions.
struct End {
  double distance;  ///< from the pixel
  double change;    ///< of the mean luma across the edge
};

End find_end(const ColourImage& image, double x, double y, const Side& side, int direction) {
  const double a = side.horizontal ? x : x + side.across * 0.5;
  const double b = side.horizontal ? y + side.across * 0.5 : y;
  End end{0, 0};
  for (std::size_t k = 0; k < steps.size(); ++k) {
    end.distance += steps[k];
    if (k + 1 == steps.size()) break;
    const double d = direction * end.distance;
    end.change =
        luma(side.horizontal ? between(image, a + d, b) : between(image, a, b + d)) - side.middle;
    if (std::abs(end.change) >= side.step / 4) break;
  }
  return end;
}

/// How much of the pixel belongs to the other side of the edge, were it smooth.
double share_of_neighbour(const ColourImage& image, double x, double y, const Side& side,
                          double here) {
  const End back = find_end(image, x, y, side, -1), ahead = find_end(image, x, y, side, 1);
  const End& nearer = back.distance < ahead.distance ? back : ahead;
  // The pixel's own side yields at this end, or it continues and the other side yields.
  const bool gives_way = (nearer.change < 0) != (here < side.middle);
  return gives_way ? 0.5 - nearer.distance / (back.distance + ahead.distance) : 0;
}

Colour filtered(const ColourImage& image, double x, double y, const FxaaSettings& settings) {
  const Lumas lumas(image, x, y);
  const double range = lumas.range();
  if (range == 0 ||
      range < std::max(settings.least_threshold, lumas.greatest() * settings.threshold))
    return between(image, x, y);
  const Side side(lumas);
  const double share = std::max(share_of_neighbour(image, x, y, side, lumas.m),
                                lumas.sticking_out() * settings.subpixel);
  const double moved = side.across * share;
  return side.horizontal ? between(image, x, y + moved) : between(image, x + moved, y);
}

}  // namespace

ColourImage fxaa(const ColourImage& image, const FxaaSettings& settings) {
  ColourImage result = image;
  for (std::uint32_t y = 0; y < image.height; ++y) {
    check_interruption();
    for (std::uint32_t x = 0; x < image.width; ++x)
      result.pixels[std::size_t{y} * image.width + x] = filtered(image, x, y, settings);
  }
  return result;
}

}  // namespace fathom::pipeline
