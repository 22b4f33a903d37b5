#include "fathom/attribution/cause.h"

#include <fmt/format.h>

#include <cmath>

#include "fathom/attribution/worst_pixels.h"
#include "fathom/numeric/standard_arithmetic.h"
#include "fathom/text/counted.h"

namespace fathom::attribution {
namespace {

std::string depth_text(double depth) {
  return std::isfinite(depth) ? fmt::format("{:.9g}", depth) : "background";
}

}  // namespace

std::string pixel_text(const Truth& truth, const OtherMap& other, const Attribution& found,
                       std::size_t pixel) {
  const StandardArithmetic standard;
  std::string text =
      fmt::format("({}, {}): {} instead of {}", pixel % other.width, pixel / other.width,
                  depth_text(other.depths[pixel]), depth_text(truth.depths[pixel]));
  const float least = found.least[pixel], greatest = found.greatest[pixel];
  // Where the renderer may have drawn nothing there is no interval.
  if (std::isfinite(least) && std::isfinite(greatest)) {
    text += fmt::format(", allowed {} to {}", depth_text(least), depth_text(greatest));
  }
  return text;
}

std::string finding_text(const Finding& f) {
  return fmt::format("{} ({})", f.text, text::counted(f.pixels, "pixel"));
}

std::string finding_line(const Finding& f) {
  return f.kind + ": " + finding_text(f);
}

std::string verdict_text(const Truth& truth, const OtherMap& other, const Attribution& found) {
  const StandardArithmetic standard;
  if (!found.findings.empty()) return "failed: " + finding_text(found.findings.front());
  const std::string cause = cause_of(truth, other, found);
  return cause.empty() ? "every pixel is explained" : "failed: " + cause;
}

std::string cause_of(const Truth& truth, const OtherMap& other, const Attribution& found) {
  const StandardArithmetic standard;
  if (!found.findings.empty()) return finding_line(found.findings.front());
  const std::uint64_t unexplained = found.count(PixelClass::unexplained);
  if (unexplained == 0) return "";
  return fmt::format("{} of {} unexplained, the worst {}", unexplained,
                     text::counted(found.classes.size(), "pixel"),
                     pixel_text(truth, other, found, worst_pixels(truth, other, found, 1).front()));
}

}  // namespace fathom::attribution
