#include "validation/studies/picture.h"

#include <png.h>

#include "fathom/numeric/errors.h"

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
  const RgbImage large = enlarged(image, scale);
  png_image png{};
  png.version = PNG_IMAGE_VERSION;
  png.width = large.width;
  png.height = large.height;
  png.format = PNG_FORMAT_RGB;
  png_alloc_size_t size = 0;
  std::string bytes;
  const void* pixels = large.pixels.data();
  bool written = png_image_write_to_memory(&png, nullptr, &size, 0, pixels, 0, nullptr) != 0;
  bytes.resize(size);
  written =
      written && png_image_write_to_memory(&png, bytes.data(), &size, 0, pixels, 0, nullptr) != 0;
  if (!written) throw OutputError(name + ".png: " + png.message);
  bytes.resize(size);
  return {name + ".png", bytes};
}

}  // namespace fathom::studies
