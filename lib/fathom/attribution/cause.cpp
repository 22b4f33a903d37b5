#include "fathom/attribution/cause.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

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

namespace {

/// Classes in the order in which they are looked at; 0: not at all.
int urgency(PixelClass c) {
  switch (c) {
    case PixelClass::unexplained:
      return 4;
    case PixelClass::convention:
      return 3;
    case PixelClass::missed:
      return 2;
    case PixelClass::equal:
      return 0;
    default:
      return 1;
  }
}

double relative_error(double truth, double other) {
  if (std::isinf(truth) || std::isinf(other)) return 0;
  return std::abs(other - truth) / truth;
}

}  // namespace

std::vector<std::size_t> worst_pixels(const Truth& truth, const OtherMap& other,
                                      const Attribution& found, std::size_t count) {
  const StandardArithmetic standard;
  using Rank = std::pair<int, double>;
  std::vector<std::pair<Rank, std::size_t>> ranked;
  for (std::size_t i = 0; i < found.classes.size(); ++i) {
    const int rank = urgency(found.classes[i]);
    if (rank > 0) ranked.push_back({{rank, relative_error(truth.depths[i], other.depths[i])}, i});
  }
  count = std::min(count, ranked.size());
  std::partial_sort(ranked.begin(), ranked.begin() + static_cast<std::ptrdiff_t>(count),
                    ranked.end(), [](const auto& a, const auto& b) {
                      return a.first != b.first ? a.first > b.first : a.second < b.second;
                    });
  std::vector<std::size_t> worst;
  for (std::size_t i = 0; i < count; ++i) worst.push_back(ranked[i].second);
  return worst;
}

}  // namespace fathom::attribution
