#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <limits>

#include "fathom/image/compare_internal.h"
#include "fathom/image/pictures/legend.h"
#include "fathom/image/preview.h"
#include "fathom/numeric/standard_arithmetic.h"

namespace fathom {
using namespace image;

namespace {

using Kind = PixelDifference::Kind;

struct KindLook {
  Kind kind;
  Rgb colour;
  const char* text;
};
constexpr std::array<KindLook, 5> looks{
    {{Kind::equal, {44, 47, 54}, "equal"},
     {Kind::only_truth, {0, 190, 220}, "a surface in the first map only"},
     {Kind::only_other, {80, 220, 100}, "a surface in the second map only"},
     {Kind::incommensurable, {255, 0, 255}, "cannot be measured (NaN, infinity)"},
     {Kind::neither, {206, 210, 216}, "no surface in either"}}};

/// Brighter than the dark colour of equal pixels: the upper three fifths of magma.
Rgb heat(double t) {
  return colour_at(ColourMap::magma, 0.4 + 0.6 * t);
}

/// The colours of differences, by their logarithm. The scale starts at the least difference, or at
/// a number small enough to be drawn as the least.
struct LogarithmicScale {
  double least = 1, greatest = 1;

  /// 0 at `least`, 1 at `greatest`.
  [[nodiscard]] double share(double difference) const {
    if (!(greatest > least)) return 0.5;
    return (std::log2(difference) - std::log2(least)) / (std::log2(greatest) - std::log2(least));
  }
};

LogarithmicScale scale_of(const std::vector<PixelDifference>& differences, DifferenceMeasure by) {
  constexpr double drawn_as_least = 1e-6;
  double least = std::numeric_limits<double>::infinity(), greatest = 0;
  for (const PixelDifference& each : differences) {
    if (each.kind != Kind::different) continue;
    least = std::min(least, each.difference);
    greatest = std::max(greatest, each.difference);
  }
  if (greatest == 0) return {};
  if (by == DifferenceMeasure::ulp) return {1, greatest};
  return {std::max(least, drawn_as_least * greatest), greatest};
}

std::string label(double difference, DifferenceMeasure by) {
  const char* const unit = by != DifferenceMeasure::ulp ? "" : difference == 1 ? " ulp" : " ulps";
  std::array<char, 32> text{};
  std::snprintf(text.data(), text.size(), "%.4g%s", difference, unit);
  return text.data();
}

/// Marks at both ends and at the powers of two (only for ulps), ten or a thousand, whichever are
/// few enough.
std::vector<ColourBar::Mark> marks_of(const LogarithmicScale& scale, DifferenceMeasure by) {
  if (!(scale.greatest > scale.least)) return {{0.5, label(scale.greatest, by)}};
  std::vector<ColourBar::Mark> marks{{0, label(scale.least, by)}, {1, label(scale.greatest, by)}};
  const double range = std::log2(scale.greatest) - std::log2(scale.least);
  const double base = range <= 10 && by == DifferenceMeasure::ulp ? 2 : 10;
  const double factor = range > 40 ? 1000 : base;
  const double first = std::ceil(std::log(scale.least) / std::log(factor));
  for (double power = first; std::pow(factor, power) < scale.greatest; ++power) {
    const double value = std::pow(factor, power);
    if (value > scale.least) marks.push_back({scale.share(value), label(value, by)});
  }
  return marks;
}

/// The pair of Z, else the first pair of depths, else the first.
const std::pair<const ImageChannel*, const ImageChannel*>& pair_to_draw(const PairedNames& names) {
  const auto find = [&](const auto& fits) { return std::ranges::find_if(names.pairs, fits); };
  const auto z = find([](const auto& pair) { return pair.first->name == "Z"; });
  if (z != names.pairs.end()) return *z;
  const auto depth =
      find([](const auto& pair) { return kind_of(*pair.first) == ChannelKind::depth; });
  return depth != names.pairs.end() ? *depth : names.pairs.front();
}

std::string title_of(const std::string& a, const std::string& b, const ChannelPair& pair,
                     DifferenceMeasure by) {
  const std::string names = a == b ? a : a + " and " + b;
  if (pair.identifiers()) return "Differences in " + names;
  switch (by) {
    case DifferenceMeasure::relative:
      return "Relative differences in " + names;
    case DifferenceMeasure::ulp:
      return "Differences in " + names + ", in units in the last place";
    case DifferenceMeasure::absolute:
      break;
  }
  const bool is_length = a == "Z" || a == "distance";
  return "Differences in " + names + (is_length ? ", in scene units" : ", absolute");
}

}  // namespace

RgbImage draw_differences(const DepthMap& truth, const DepthMap& other,
                          const CompareOptions& options, DifferenceMeasure by) {
  const StandardArithmetic standard;
  const PairedNames names = paired_channels(truth, other, options);
  const auto& [a, b] = pair_to_draw(names);
  const ChannelPair pair = make_pair(truth, *a, other, *b, options);
  const std::vector<PixelDifference> differences = pixel_differences(pair, by);

  std::array<std::uint64_t, 6> counts{};
  for (const PixelDifference& difference : differences)
    ++counts[static_cast<std::size_t>(difference.kind)];
  const LogarithmicScale scale = scale_of(differences, by);
  Sheet sheet;
  sheet.title = title_of(a->name, b->name, pair, by);
  sheet.picture = RgbImage(truth.width, truth.height);
  for (std::size_t k = 0; k < differences.size(); ++k) {
    const PixelDifference& d = differences[k];
    if (d.kind == Kind::different) {
      sheet.picture.pixels[k] = heat(scale.share(d.difference));
      continue;
    }
    for (const KindLook& look : looks)
      if (look.kind == d.kind) sheet.picture.pixels[k] = look.colour;
  }
  if (counts[static_cast<std::size_t>(Kind::different)] > 0) {
    const bool one_colour = !(scale.greatest > scale.least);
    sheet.bar =
        ColourBar{one_colour ? [](double) { return heat(0.5); } : heat, marks_of(scale, by)};
  }
  for (const KindLook& look : looks) {
    const std::uint64_t count = counts[static_cast<std::size_t>(look.kind)];
    const bool identifiers = look.kind == Kind::incommensurable && pair.identifiers();
    if (count > 0)
      sheet.entries.push_back({look.colour, std::string(identifiers ? "different" : look.text) +
                                                ": " + std::to_string(count)});
  }
  FittedPicture fitted = fit_to_screen(std::move(sheet.picture));
  sheet.picture = std::move(fitted.image);
  sheet.subtitle = std::to_string(truth.width) + " × " + std::to_string(truth.height) + " pixels";
  if (!fitted.remark.empty()) sheet.subtitle += ", " + fitted.remark;
  return lay_out(sheet);
}

}  // namespace fathom
