#include "fathom/image/pictures/legend.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <string>

#include "fathom/failures/errors.h"
#include "fathom/failures/unknown_name.h"
#include "fathom/image/pictures/lettering.h"

namespace fathom::image {
namespace {

constexpr Rgb paper{255, 255, 255}, ink{33, 37, 41}, faint_ink{108, 117, 125}, frame{173, 181, 189};
constexpr int margin = 20, title_size = 18, text_size = 13, bar_width = 22, row_height = 22,
              swatch = 14, gap = 28;

void fill(RgbImage& image, int left, int top, int width, int height, Rgb colour) {
  for (int y = top; y < top + height; ++y)
    for (int x = left; x < left + width; ++x)
      image.at(static_cast<std::uint32_t>(x), static_cast<std::uint32_t>(y)) = colour;
}

void outline(RgbImage& image, int left, int top, int width, int height) {
  fill(image, left - 1, top - 1, width + 2, 1, frame);
  fill(image, left - 1, top + height, width + 2, 1, frame);
  fill(image, left - 1, top, 1, height, frame);
  fill(image, left + width, top, 1, height, frame);
}

void draw_bar(RgbImage& image, const Lettering& letters, const ColourBar& bar, int left, int top,
              int height) {
  for (int y = 0; y < height; ++y)
    fill(image, left, top + y, bar_width, 1, bar.colour(1 - (y + 0.5) / height));
  outline(image, left, top, bar_width, height);
  std::vector<int> taken;
  for (const ColourBar::Mark& mark : bar.marks) {
    const int y = top + static_cast<int>(std::lround((1 - mark.t) * (height - 1)));
    if (std::any_of(taken.begin(), taken.end(),
                    [&](int other) { return std::abs(other - y) < 18; }))
      continue;
    taken.push_back(y);
    fill(image, left + bar_width + 1, y, 5, 1, ink);
    letters.draw(image, left + bar_width + 11, y + 5, mark.text, text_size, ink);
  }
}

void draw_picture(RgbImage& image, const RgbImage& picture, int left, int top) {
  for (std::uint32_t y = 0; y < picture.height; ++y)
    for (std::uint32_t x = 0; x < picture.width; ++x)
      image.at(x + static_cast<std::uint32_t>(left), y + static_cast<std::uint32_t>(top)) =
          picture.at(x, y);
  outline(image, left, top, static_cast<int>(picture.width), static_cast<int>(picture.height));
}

int legend_width(const Sheet& sheet, const Lettering& letters) {
  int width = 0;
  if (sheet.bar)
    for (const ColourBar::Mark& mark : sheet.bar->marks)
      width = std::max(width, bar_width + 11 + letters.width(mark.text, text_size));
  for (const LegendEntry& entry : sheet.entries)
    width = std::max(width, swatch + 10 + letters.width(entry.text, text_size));
  return width;
}

}  // namespace

std::string formatted(double value, int digits) {
  std::array<char, 40> text{};
  const int length =
      std::snprintf(text.data(), text.size(), "%.*g", digits, value == 0 ? 0 : value);
  return {text.data(), static_cast<std::size_t>(length)};
}

std::vector<ColourBar::Mark> linear_marks(double low, double high) {
  // Halves, so that the range does not overflow binary64.
  const double half_range = high / 2 - low / 2;
  const double greatest = std::max(std::abs(low), std::abs(high));
  // Enough digits to show a thousandth of the range.
  const int digits =
      std::clamp(4 + static_cast<int>(std::ceil(std::log10(greatest / 2 / half_range))), 5, 17);
  std::vector<ColourBar::Mark> marks{{0, formatted(low, digits)}, {1, formatted(high, digits)}};
  const double tenth = std::pow(10, std::floor(std::log10(half_range / 5)));
  for (const double multiple : {1.0, 2.0, 5.0, 10.0}) {
    const double half_step = multiple * tenth;
    if (!(half_range / half_step <= 8) || !(half_step > 0)) continue;
    const double first = std::ceil(low / 2 / half_step), last = std::floor(high / 2 / half_step);
    for (double n = first; n <= last && marks.size() < 12; ++n)
      marks.push_back(
          {(n * half_step - low / 2) / half_range, formatted(2 * n * half_step, digits)});
    break;
  }
  return marks;
}

FittedPicture fit_to_screen(RgbImage picture) {
  const std::uint32_t side = std::max(picture.width, picture.height);
  if (side <= reduced_from && side > enlarged_up_to) return {std::move(picture), ""};
  if (side > reduced_from) {
    const std::uint32_t step = (side + reduced_from - 1) / reduced_from;
    RgbImage image((picture.width + step - 1) / step, (picture.height + step - 1) / step);
    for (std::uint32_t y = 0; y < image.height; ++y)
      for (std::uint32_t x = 0; x < image.width; ++x)
        image.at(x, y) = picture.at(x * step, y * step);
    return {std::move(image), "one pixel in " + std::to_string(step) + " of each row and column"};
  }
  const std::uint32_t factor = 2 * enlarged_up_to / side;
  RgbImage image(picture.width * factor, picture.height * factor);
  for (std::uint32_t y = 0; y < image.height; ++y)
    for (std::uint32_t x = 0; x < image.width; ++x)
      image.at(x, y) = picture.at(x / factor, y / factor);
  return {std::move(image), "enlarged " + std::to_string(factor) + " times"};
}

RgbImage lay_out(const Sheet& sheet) {
  const Lettering letters;
  const int picture_width = static_cast<int>(sheet.picture.width);
  const int picture_height = static_cast<int>(sheet.picture.height);
  const int top = margin + title_size + (sheet.subtitle.empty() ? 12 : 12 + row_height);
  const int entries_height = static_cast<int>(sheet.entries.size()) * row_height;
  const int bar_height = sheet.bar ? std::clamp(picture_height - entries_height - 20, 200, 480) : 0;
  const int legend_left = margin + picture_width + gap;
  const int legend_height = bar_height + (sheet.bar ? 20 : 0) + entries_height;
  const int width = std::max({legend_left + legend_width(sheet, letters) + margin,
                              2 * margin + letters.width(sheet.title, title_size),
                              2 * margin + letters.width(sheet.subtitle, text_size)});
  RgbImage image(static_cast<std::uint32_t>(width),
                 static_cast<std::uint32_t>(top + std::max(picture_height, legend_height) + margin),
                 paper);
  letters.draw(image, margin, margin + title_size - 4, sheet.title, title_size, ink);
  letters.draw(image, margin, top - 10, sheet.subtitle, text_size, faint_ink);
  draw_picture(image, sheet.picture, margin, top);
  if (sheet.bar) draw_bar(image, letters, *sheet.bar, legend_left, top, bar_height);
  int y = top + (sheet.bar ? bar_height + 20 : 0);
  for (const LegendEntry& entry : sheet.entries) {
    fill(image, legend_left, y, swatch, swatch, entry.colour);
    outline(image, legend_left, y, swatch, swatch);
    letters.draw(image, legend_left + swatch + 10, y + 12, entry.text, text_size, ink);
    y += row_height;
  }
  return image;
}

ScaledRange::ScaledRange(ColourScale scale, double low, double high,
                         const std::vector<double>& values)
    : scale_(scale), low_(low), high_(high) {
  const bool needs_positive = scale == ColourScale::log || scale == ColourScale::inverse;
  if (needs_positive && !(low > 0)) {
    throw UsageError("scale " + std::string(name_of(scale)) + " needs a range above 0, and " +
                     formatted(low, 6) + " is its low end");
  }
  if (scale != ColourScale::equalised) return;
  std::ranges::copy_if(values, std::back_inserter(sorted_),
                       [&](double value) { return value >= low && value <= high; });
  std::ranges::sort(sorted_);
}

double ScaledRange::place(double value) const {
  if (low_ == high_) return 0.5;
  switch (scale_) {
    case ColourScale::linear:  // halves, so that no difference overflows
      return (value / 2 - low_ / 2) / (high_ / 2 - low_ / 2);
    case ColourScale::log:
      return value <= low_ ? 0 : std::log(value / low_) / std::log(high_ / low_);
    case ColourScale::inverse:
      return value <= low_ ? 0 : (1 - low_ / value) / (1 - low_ / high_);
    case ColourScale::equalised:
      break;
  }
  const auto below = std::ranges::lower_bound(sorted_, value) - sorted_.begin();
  return static_cast<double>(below) /
         static_cast<double>(std::max<std::size_t>(1, sorted_.size() - 1));
}

double ScaledRange::value_at(double place) const {
  switch (scale_) {
    case ColourScale::linear:
      return 2 * (low_ / 2 + place * (high_ / 2 - low_ / 2));
    case ColourScale::log:
      return low_ * std::pow(high_ / low_, place);
    case ColourScale::inverse:
      return low_ / (1 - place * (1 - low_ / high_));
    case ColourScale::equalised:
      break;
  }
  if (sorted_.empty()) return low_;
  return sorted_[static_cast<std::size_t>(
      std::lround(place * static_cast<double>(sorted_.size() - 1)))];
}

std::vector<ColourBar::Mark> ScaledRange::marks() const {
  if (scale_ == ColourScale::linear) return linear_marks(low_, high_);
  const double greatest = std::max(std::abs(low_), std::abs(high_));
  // Enough digits to tell neighbouring marks of a narrow range apart.
  const double widths = greatest / 2 / (high_ / 2 - low_ / 2);
  const int digits = std::clamp(2 + static_cast<int>(std::ceil(std::log10(widths))), 2, 17);
  std::vector<ColourBar::Mark> marks{{0, formatted(low_, digits + 2)},
                                     {1, formatted(high_, digits + 2)}};
  constexpr int parts = 8;
  for (int k = 1; k < parts; ++k) {
    const std::string text = formatted(value_at(static_cast<double>(k) / parts), digits);
    const double t = place(std::strtod(text.c_str(), nullptr));
    if (t > 0 && t < 1) marks.push_back({t, text});
  }
  return marks;
}

}  // namespace fathom::image

namespace fathom {

std::string_view name_of(ColourScale scale) {
  constexpr std::array<std::string_view, 4> names{"linear", "log", "inverse", "equalised"};
  return names[static_cast<std::size_t>(scale)];
}

std::optional<ColourScale> colour_scale_named(const std::string& name) {
  return value_named(all_colour_scales, name == "equalized" ? "equalised" : name);
}

}  // namespace fathom
