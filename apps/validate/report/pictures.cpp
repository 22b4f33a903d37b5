#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include "apps/validate/report/report_formats.h"
#include "apps/validate/report/reported_result.h"
#include "fathom/image/pictures/legend.h"
#include "fathom/image/preview.h"

namespace fathom::validation {
namespace {

using attribution::pixel_class_count;
using attribution::PixelClass;

/// As in page/elements.js.
constexpr std::array<Rgb, pixel_class_count> class_colours{{{226, 232, 240},
                                                            {168, 205, 230},
                                                            {86, 150, 200},
                                                            {240, 190, 80},
                                                            {150, 95, 190},
                                                            {40, 160, 120},
                                                            {235, 110, 60},
                                                            {200, 20, 30}}};
constexpr Rgb white{255, 255, 255}, missing{20, 20, 20}, added{120, 60, 160};

image::Sheet sheet_of(const ValidationCase& c, const std::string& title) {
  image::Sheet sheet;
  sheet.title = title;
  sheet.picture = RgbImage(c.other.width, c.other.height, white);
  return sheet;
}

RgbImage finished(image::Sheet sheet, const ValidationCase& c) {
  image::FittedPicture fitted = image::fit_to_screen(std::move(sheet.picture));
  sheet.picture = std::move(fitted.image);
  sheet.subtitle = fmt::format("{}, {} × {} pixels{}{}", title_of(c), c.other.width, c.other.height,
                               fitted.remark.empty() ? "" : ", ", fitted.remark);
  return image::lay_out(sheet);
}

/// (other − truth) / truth; NaN where one of them shows no surface.
double relative_difference(const ValidationCase& c, std::size_t i) {
  const double truth = c.truth->depths[i], other = c.other.depths[i];
  if (!std::isfinite(truth) || !std::isfinite(other)) return std::nan("");
  return truth == other ? 0 : (other - truth) / truth;
}

/// The end of the colour bar: 98 % of the differences that are not 0 are at most that.
double end_of_scale(const ValidationCase& c) {
  std::vector<double> sizes;
  for (std::size_t i = 0; i < c.other.depths.size(); ++i) {
    const double size = std::abs(relative_difference(c, i));
    if (std::isfinite(size) && size > 0) sizes.push_back(size);
  }
  if (sizes.empty()) return 1e-7;
  const auto at =
      sizes.begin() + static_cast<std::ptrdiff_t>(0.98 * static_cast<double>(sizes.size() - 1));
  std::nth_element(sizes.begin(), at, sizes.end());
  return *at;
}

}  // namespace

RgbImage class_picture(const ValidationCase& c) {
  image::Sheet sheet = sheet_of(c, "Classes of pixels");
  for (std::size_t i = 0; i < c.attribution.classes.size(); ++i) {
    sheet.picture.pixels[i] = class_colours[static_cast<std::size_t>(c.attribution.classes[i])];
  }
  for (std::size_t k = 0; k < pixel_class_count; ++k) {
    if (c.attribution.counts[k] == 0) continue;
    sheet.entries.push_back(
        {class_colours[k], fmt::format("{}: {}", attribution::name_of(static_cast<PixelClass>(k)),
                                       c.attribution.counts[k])});
  }
  return finished(std::move(sheet), c);
}

RgbImage difference_picture(const ValidationCase& c) {
  image::Sheet sheet = sheet_of(c, "Relative differences of depth");
  const double end = end_of_scale(c);
  std::uint64_t lost = 0, gained = 0;
  for (std::size_t i = 0; i < c.other.depths.size(); ++i) {
    Rgb& pixel = sheet.picture.pixels[i];
    const bool seen = std::isfinite(c.other.depths[i]),
               is_there = std::isfinite(c.truth->depths[i]);
    if (seen && is_there) {
      const double t = std::clamp(relative_difference(c, i) / end, -1.0, 1.0);
      pixel = colour_at(ColourMap::diverging, 0.5 + t / 2);
    } else if (is_there) {
      pixel = missing;
      ++lost;
    } else if (seen) {
      pixel = added;
      ++gained;
    }
  }
  sheet.bar = image::ColourBar{
      [](double t) { return colour_at(ColourMap::diverging, t); },
      {{0, fmt::format("{:.2g}", -end)}, {1, fmt::format("{:.2g}", end)}, {0.5, "0"}}};
  if (lost > 0) sheet.entries.push_back({missing, fmt::format("surface missing: {}", lost)});
  if (gained > 0) sheet.entries.push_back({added, fmt::format("surface added: {}", gained)});
  return finished(std::move(sheet), c);
}

}  // namespace fathom::validation
