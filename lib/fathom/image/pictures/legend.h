#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "fathom/image/rgb_image.h"

/// Puts a picture together with its title, colour bar and legend.
namespace fathom::image {

struct ColourBar {
  /// The colour at t in [0, 1], from the low end to the high one.
  std::function<Rgb(double)> colour;
  /// Marks: where in [0, 1], and what is written there. Both ends come first and are always drawn.
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

/// The greatest side of a picture that is enlarged, and of one that is not reduced, in pixels.
inline constexpr std::uint32_t enlarged_up_to = 240, reduced_from = 2048;

/// `picture` with every pixel enlarged to a block of k × k if it is small, or only every k-th pixel
/// of every k-th row if it is large; the remark says so in a few words, or is empty.
struct FittedPicture {
  RgbImage image;
  std::string remark;
};
FittedPicture fit_to_screen(RgbImage picture);

}  // namespace fathom::image
