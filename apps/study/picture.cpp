#include "apps/study/picture.h"

#include "apps/study/gnuplot.h"

namespace fathom::studies {
namespace {

RgbImage enlarged(const RgbImage& image, std::uint32_t scale) {
  RgbImage large(image.width * scale, image.height * scale);
  for (std::uint32_t y = 0; y < large.height; ++y)
    for (std::uint32_t x = 0; x < large.width; ++x) large.at(x, y) = image.at(x / scale, y / scale);
  return large;
}

}  // namespace

StudyFile picture_file(const std::string& name, const RgbImage& image, std::uint32_t scale) {
  return {name + ".png", png_bytes(enlarged(image, scale))};
}

}  // namespace fathom::studies
