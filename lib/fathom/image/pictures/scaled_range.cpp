#include "fathom/image/pictures/scaled_range.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>
#include <string>

#include "fathom/failures/errors.h"
#include "fathom/failures/unknown_name.h"

namespace fathom {

std::string_view name_of(ColourScale scale) {
  constexpr std::array<std::string_view, 4> names{"linear", "log", "inverse", "equalised"};
  return names[static_cast<std::size_t>(scale)];
}

std::optional<ColourScale> colour_scale_named(const std::string& name) {
  return value_named(all_colour_scales, name == "equalized" ? "equalised" : name);
}

namespace image {

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

}  // namespace image
}  // namespace fathom
