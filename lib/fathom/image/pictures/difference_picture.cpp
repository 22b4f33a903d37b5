#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>

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

/// Marks at the powers of two, ten or a thousand, whichever are few enough.
std::vector<ColourBar::Mark> logarithmic_marks(double greatest) {
  const double range = std::log2(greatest);
  const auto label = [](double ulp) {
    std::array<char, 32> text{};
    std::snprintf(text.data(), text.size(), ulp == 1 ? "%.4g ulp" : "%.4g ulps", ulp);
    return std::string(text.data());
  };
  if (range <= 0) return {{0.5, label(1)}};
  std::vector<ColourBar::Mark> marks{{0, label(1)}, {1, label(greatest)}};
  const double base = range <= 10 ? 2 : 10;
  const double factor = range > 40 ? 1000 : base;
  for (double value = factor; value < greatest; value *= factor)
    marks.push_back({std::log2(value) / range, label(value)});
  return marks;
}

}  // namespace

RgbImage draw_differences(const DepthMap& truth, const DepthMap& other,
                          const CompareOptions& options) {
  const StandardArithmetic standard;
  const PairedNames names = paired_channels(truth, other, options);
  const auto& [a, b] = names.pairs.front();
  const ChannelPair pair = make_pair(truth, *a, other, *b, options);
  const std::vector<PixelDifference> differences = pixel_differences(pair);

  double greatest = 0;
  std::array<std::uint64_t, 6> counts{};
  for (const PixelDifference& difference : differences) {
    greatest = std::max(greatest, difference.ulp);
    ++counts[static_cast<std::size_t>(difference.kind)];
  }
  const double range = std::log2(std::max(greatest, 1.0));
  Sheet sheet;
  sheet.title = "Differences in " + a->name + (a->name == b->name ? "" : " and " + b->name);
  sheet.picture = RgbImage(truth.width, truth.height);
  for (std::size_t k = 0; k < differences.size(); ++k) {
    const PixelDifference& d = differences[k];
    if (d.kind == Kind::different) {
      sheet.picture.pixels[k] = heat(range > 0 ? std::log2(std::max(d.ulp, 1.0)) / range : 0.5);
      continue;
    }
    for (const KindLook& look : looks)
      if (look.kind == d.kind) sheet.picture.pixels[k] = look.colour;
  }
  if (counts[static_cast<std::size_t>(Kind::different)] > 0)
    sheet.bar =
        ColourBar{range > 0 ? heat : [](double) { return heat(0.5); }, logarithmic_marks(greatest)};
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
