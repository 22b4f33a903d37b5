#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "fathom/image/preview.h"
#include "fathom/image/rgb_image.h"

/// Puts a picture together with its title, colour bar and legend, and places values on the bar.
namespace fathom::image {

struct ColourBar {
  /// The colour at t in [0, 1], from the low end to the high one.
  std::function<Rgb(double)> colour;
  /// Marks: places in [0, 1] with their labels. Both ends come first and are always drawn.
  struct Mark {
    double t;
    std::string text;
  };
  std::vector<Mark> marks;
};

struct LegendEntry {
  Rgb colour;
  std::string text;
};

struct Sheet {
  std::string title, subtitle;
  RgbImage picture;
  std::optional<ColourBar> bar;
  std::vector<LegendEntry> entries;
};

/// A number as a mark: `digits` significant digits, and no minus before 0.
std::string formatted(double value, int digits);

/// The marks of a linear scale: both ends, and round numbers between them.
std::vector<ColourBar::Mark> linear_marks(double low, double high);

RgbImage lay_out(const Sheet& sheet);

/// In pixels: pictures with sides up to the first number are enlarged; with a side above the second
/// they are reduced.
inline constexpr std::uint32_t enlarged_up_to = 240, reduced_from = 2048;

/// `picture` with every pixel enlarged to a block of k × k if it is small, or only every k-th pixel
/// of every k-th row if it is large; the remark describes the change in a few words, or is empty.
struct FittedPicture {
  RgbImage image;
  std::string remark;
};
FittedPicture fit_to_screen(RgbImage picture);

/// Places values between the ends of a colour bar, from 0 to 1.
class ScaledRange {
 public:
  /// `values` are the finite ones of the surface; only `equalised` needs them.
  /// Fails    UsageError if `log` or `inverse` has an end that is not above 0.
  ScaledRange(ColourScale scale, double low, double high, const std::vector<double>& values);

  /// Values beyond an end lie at that end, or beyond it; 0.5 if the ends are equal.
  [[nodiscard]] double place(double value) const;
  /// The value at this place.
  [[nodiscard]] double value_at(double place) const;
  /// Marks of the bar: both ends, and short numbers between them.
  [[nodiscard]] std::vector<ColourBar::Mark> marks() const;

 private:
  ColourScale scale_;
  double low_, high_;
  /// In ascending order, from low_ to high_.
  std::vector<double> sorted_;
};

}  // namespace fathom::image
