#include "fathom/image/pictures/legend.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>

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

}  // namespace fathom::image
