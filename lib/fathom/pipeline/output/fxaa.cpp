#include "fathom/pipeline/output/fxaa.h"

#include <algorithm>
#include <cmath>

namespace fathom::pipeline {
namespace {

constexpr double longest_span = 8, least_reduction = 1.0 / 128, reduction_factor = 1.0 / 8;

double luma(const Colour& c) {
  return 0.299 * c[0] + 0.587 * c[1] + 0.114 * c[2];
}

/// The picture between pixels, with its border repeated; (0, 0) is the centre of the first pixel.
Colour at(const ColourImage& image, double x, double y) {
  const auto clamp = [](double v, std::uint32_t size) {
    return std::clamp(v, 0.0, static_cast<double>(size - 1));
  };
  x = clamp(x, image.width), y = clamp(y, image.height);
  const auto i = static_cast<std::uint32_t>(x), j = static_cast<std::uint32_t>(y);
  const std::uint32_t i1 = std::min(i + 1, image.width - 1), j1 = std::min(j + 1, image.height - 1);
  const double s = x - i, t = y - j;
  Colour colour;
  for (std::size_t k = 0; k < 3; ++k)
    colour[k] = (1 - t) * ((1 - s) * image.at(i, j)[k] + s * image.at(i1, j)[k]) +
                t * ((1 - s) * image.at(i, j1)[k] + s * image.at(i1, j1)[k]);
  return colour;
}

Colour mean(const Colour& a, const Colour& b) {
  return {(a[0] + b[0]) / 2, (a[1] + b[1]) / 2, (a[2] + b[2]) / 2};
}

Colour filtered(const ColourImage& image, double x, double y) {
  const double nw = luma(at(image, x - 1, y - 1)), ne = luma(at(image, x + 1, y - 1));
  const double sw = luma(at(image, x - 1, y + 1)), se = luma(at(image, x + 1, y + 1));
  const Colour here = at(image, x, y);
  const double m = luma(here);
  // Along the edge: across the gradient of luma.
  double dx = (sw + se) - (nw + ne), dy = (nw + sw) - (ne + se);
  const double reduction = std::max((nw + ne + sw + se) * 0.25 * reduction_factor, least_reduction);
  const double scale = 1 / (std::min(std::abs(dx), std::abs(dy)) + reduction);
  dx = std::clamp(dx * scale, -longest_span, longest_span);
  dy = std::clamp(dy * scale, -longest_span, longest_span);
  const auto along = [&](double t) { return at(image, x + t * dx, y + t * dy); };
  const Colour two = mean(along(1.0 / 3 - 0.5), along(2.0 / 3 - 0.5));
  const Colour four = mean(two, mean(along(-0.5), along(0.5)));
  const auto [low, high] = std::minmax({m, nw, ne, sw, se});
  return luma(four) < low || luma(four) > high ? two : four;
}

}  // namespace

ColourImage fxaa(const ColourImage& image) {
  ColourImage result = image;
  for (std::uint32_t y = 0; y < image.height; ++y)
    for (std::uint32_t x = 0; x < image.width; ++x)
      result.pixels[std::size_t{y} * image.width + x] = filtered(image, x, y);
  return result;
}

}  // namespace fathom::pipeline
