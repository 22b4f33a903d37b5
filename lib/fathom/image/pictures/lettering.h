#pragma once

#include <memory>
#include <string>

#include "fathom/image/rgb_image.h"

namespace fathom::image {

/// Text on pictures, in the font of the build (DejaVu Sans), UTF-8, left to right.
class Lettering {
 public:
  /// Fails    OutputError if the font file is missing.
  Lettering();
  ~Lettering();
  Lettering(Lettering&&) noexcept;
  Lettering& operator=(Lettering&&) = delete;

  /// Width of a line in pixels, at a size given in pixels per em.
  [[nodiscard]] int width(const std::string& text, int size) const;
  /// Draws a line whose baseline begins at (x, y); whatever is outside the image is cut off.
  void draw(RgbImage& image, int x, int y, const std::string& text, int size, Rgb colour) const;

 private:
  struct Font;
  std::unique_ptr<Font> font_;
};

}  // namespace fathom::image
