#include "validation/report/cause.h"

#include <fmt/format.h>

#include <cmath>

#include "validation/report/worst_pixels.h"

namespace fathom::validation {
namespace {

std::string depth_text(double depth) {
  return std::isfinite(depth) ? fmt::format("{:.9g}", depth) : "background";
}

}  // namespace

std::string pixel_text(const ValidationCase& c, std::size_t pixel) {
  std::string text =
      fmt::format("({}, {}): {} instead of {}", pixel % c.other.width, pixel / c.other.width,
                  depth_text(c.other.depths[pixel]), depth_text(c.truth->depths[pixel]));
  const float least = c.attribution.least[pixel], greatest = c.attribution.greatest[pixel];
  // Where the renderer may have drawn nothing there is no interval.
  if (std::isfinite(least) && std::isfinite(greatest)) {
    text += fmt::format(", allowed {} to {}", depth_text(least), depth_text(greatest));
  }
  return text;
}

std::string cause_of(const ValidationCase& c) {
  if (!c.is_done()) return c.failure;
  if (c.is_good()) return "";
  if (!c.attribution.findings.empty()) {
    const attribution::Finding& first = c.attribution.findings.front();
    return fmt::format("{}: {} ({} pixels)", first.kind, first.text, first.pixels);
  }
  return fmt::format("{} of {} pixels unexplained, the worst {}",
                     c.attribution.count(attribution::PixelClass::unexplained),
                     c.attribution.classes.size(), pixel_text(c, worst_pixels(c, 1).front()));
}

}  // namespace fathom::validation
