#include "fathom/pipeline/fragments/texture.h"

#include <png.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>

#include "fathom/failures/errors.h"
#include "fathom/files/input_file.h"
#include "fathom/image/depth_map.h"
#include "fathom/image/png_stream.h"
#include "fathom/text/counted.h"
#include "fathom/threads/interruption.h"

namespace fathom::pipeline {
namespace {

Colour mix(const Colour& a, const Colour& b, double t) {
  return {a[0] + t * (b[0] - a[0]), a[1] + t * (b[1] - a[1]), a[2] + t * (b[2] - a[2])};
}

std::int64_t wrapped(std::int64_t i, std::int64_t size) {
  return (i % size + size) % size;
}

/// The place within the repeated picture.
double fraction(double x) {
  return std::isfinite(x) ? x - std::floor(x) : 0;
}

constexpr std::uint32_t greatest_size = 8192;

}  // namespace

const Colour& Texture::Level::at(std::int64_t x, std::int64_t y) const {
  return texels[static_cast<std::size_t>(wrapped(y, height) * width + wrapped(x, width))];
}

Texture::Texture(const RgbImage& image) {
  if (image.width == 0 || image.height == 0 ||
      image.pixels.size() != std::size_t{image.width} * image.height)
    throw InputError("a texture needs a texel at least, and a colour for each");
  levels_.push_back({image.width, image.height, {}});
  levels_[0].texels.reserve(image.pixels.size());
  for (const Rgb& c : image.pixels)
    levels_[0].texels.push_back({c[0] / 255., c[1] / 255., c[2] / 255.});
  while (levels_.back().width > 1 || levels_.back().height > 1) {
    const Level& fine = levels_.back();
    Level coarse{
        std::max<std::int64_t>(1, fine.width / 2), std::max<std::int64_t>(1, fine.height / 2), {}};
    coarse.texels.reserve(static_cast<std::size_t>(coarse.width * coarse.height));
    for (std::int64_t y = 0; y < coarse.height; ++y) {
      check_interruption();
      for (std::int64_t x = 0; x < coarse.width; ++x) {
        const std::int64_t x1 = std::min(2 * x + 1, fine.width - 1);
        const std::int64_t y1 = std::min(2 * y + 1, fine.height - 1);
        coarse.texels.push_back(mix(mix(fine.at(2 * x, 2 * y), fine.at(x1, 2 * y), 0.5),
                                    mix(fine.at(2 * x, y1), fine.at(x1, y1), 0.5), 0.5));
      }
    }
    levels_.push_back(std::move(coarse));
  }
}

Texture Texture::checker() {
  constexpr std::uint32_t size = 256, square = size / 8;
  RgbImage image(size, size);
  for (std::uint32_t y = 0; y < size; ++y)
    for (std::uint32_t x = 0; x < size; ++x)
      if ((x / square + y / square) % 2 == 0) image.at(x, y) = {255, 255, 255};
  return Texture(image);
}

Colour Texture::nearest(const Level& level, const std::array<double, 2>& uv) {
  const double u = fraction(uv[0]), v = fraction(uv[1]);
  return level.at(
      static_cast<std::int64_t>(u * static_cast<double>(level.width)),
      level.height - 1 - static_cast<std::int64_t>(v * static_cast<double>(level.height)));
}

Colour Texture::bilinear(const Level& level, const std::array<double, 2>& uv) {
  const double u = fraction(uv[0]), v = fraction(uv[1]);
  const double x = u * static_cast<double>(level.width) - 0.5;
  const double y = (1 - v) * static_cast<double>(level.height) - 0.5;
  const auto i = static_cast<std::int64_t>(std::floor(x)),
             j = static_cast<std::int64_t>(std::floor(y));
  const double s = x - static_cast<double>(i), t = y - static_cast<double>(j);
  return mix(mix(level.at(i, j), level.at(i + 1, j), s),
             mix(level.at(i, j + 1), level.at(i + 1, j + 1), s), t);
}

Colour Texture::trilinear(const std::array<double, 2>& uv, double texels) const {
  const double level =
      std::clamp(texels > 0 ? std::log2(texels) : 0, 0.0, static_cast<double>(levels_.size() - 1));
  const auto fine = static_cast<std::size_t>(level);
  const Colour colour = bilinear(levels_[fine], uv);
  if (fine + 1 == levels_.size()) return colour;
  return mix(colour, bilinear(levels_[fine + 1], uv), level - static_cast<double>(fine));
}

double Texture::texels_along(const std::array<double, 2>& duv) const {
  return std::hypot(duv[0] * static_cast<double>(levels_[0].width),
                    duv[1] * static_cast<double>(levels_[0].height));
}

Colour Texture::anisotropic(const TextureFootprint& f) const {
  constexpr double most_looks = 16;
  const double along_x = texels_along(f.duv_dx), along_y = texels_along(f.duv_dy);
  const auto& axis = along_x > along_y ? f.duv_dx : f.duv_dy;
  const double longer = std::max(along_x, along_y), shorter = std::min(along_x, along_y);
  const double looks = std::clamp(std::ceil(longer / std::max(shorter, 1e-9)), 1.0,
                                  std::min(most_looks, std::max(1.0, std::ceil(longer))));
  Colour sum{};
  for (double i = 0; i < looks; ++i) {
    const double t = (i + 0.5) / looks - 0.5;
    const Colour c = trilinear({f.uv[0] + t * axis[0], f.uv[1] + t * axis[1]},
                               std::max(shorter, longer / looks));
    for (std::size_t k = 0; k < 3; ++k) sum[k] += c[k] / looks;
  }
  return sum;
}

Colour Texture::sample(const TextureFootprint& f, TextureFilter filter) const {
  switch (filter) {
    case TextureFilter::nearest:
      return nearest(levels_[0], f.uv);
    case TextureFilter::bilinear:
      return bilinear(levels_[0], f.uv);
    case TextureFilter::trilinear:
      return trilinear(f.uv, std::max(texels_along(f.duv_dx), texels_along(f.duv_dy)));
    default:
      return anisotropic(f);
  }
}

namespace {

png_const_bytep bytes_of(std::span<const std::byte> bytes) {
  return reinterpret_cast<png_const_bytep>(bytes.data());
}

/// Width and height from the header, which follows the signature; 1×1 if it is truncated.
std::array<std::uint32_t, 2> stated_size(std::span<const std::byte> bytes) {
  if (bytes.size() < 24) return {1, 1};
  return {png_get_uint_32(bytes_of(bytes) + 16), png_get_uint_32(bytes_of(bytes) + 20)};
}

/// The fault of the texels of a picture whose palette has so many colours, if any: libpng would
/// draw an index beyond them black.
std::optional<std::string> fault_of_palette(std::span<const std::byte> bytes,
                                            std::uint32_t colours) {
  png_image png{};
  png.version = PNG_IMAGE_VERSION;
  if (png_image_begin_read_from_memory(&png, bytes.data(), bytes.size()) == 0) return png.message;
  png.format = PNG_FORMAT_RGB_COLORMAP;
  const png_color black{0, 0, 0};
  std::vector<png_byte> indices(PNG_IMAGE_SIZE(png));
  std::array<png_color, 256> palette;
  if (png_image_finish_read(&png, &black, indices.data(), 0, palette.data()) == 0)
    return png.message;
  const auto beyond =
      std::ranges::find_if(indices, [&](png_byte index) { return index >= colours; });
  if (beyond == indices.end()) return std::nullopt;
  const auto k = static_cast<std::size_t>(beyond - indices.begin());
  return image::place_of_pixel(k, png.width) + "the index " + std::to_string(*beyond) +
         " is beyond the palette, which has " + text::counted(colours, "colour");
}

}  // namespace

RgbImage decode_rgb_png(std::span<const std::byte> bytes, const std::string& name) {
  png_image png{};
  png.version = PNG_IMAGE_VERSION;
  const auto fail = [&](const std::string& why) {
    png_image_free(&png);
    throw InputError(name + ": " + why);
  };
  if (bytes.size() < 8 || png_sig_cmp(bytes_of(bytes), 0, 8) != 0)
    fail(bytes.empty() ? "is empty, expected a PNG file" : "is no PNG file");
  if (!image::chunks_fit(bytes)) fail("broken PNG file: a chunk is longer than the file");
  // Before libpng looks at them, whose message would name no numbers.
  if (const auto [width, height] = stated_size(bytes);
      width == 0 || height == 0 || width > greatest_size || height > greatest_size)
    fail(std::to_string(width) + "x" + std::to_string(height) +
         " texels; a texture has 1x1 to 8192x8192");
  if (png_image_begin_read_from_memory(&png, bytes.data(), bytes.size()) == 0)
    fail(std::string("broken PNG file: ") + png.message);
  // Deflate makes at most 1032 bytes of one, and a byte holds at most eight texels: a small file
  // does not make us take memory for a large picture that cannot be in it.
  if (std::uint64_t{png.width} * png.height / 8 > 1032 * std::uint64_t{bytes.size()})
    fail("broken PNG file: too short for " + std::to_string(png.width) + "x" +
         std::to_string(png.height) + " texels");
  if (const auto fault = (png.format & PNG_FORMAT_FLAG_COLORMAP) != 0
                             ? fault_of_palette(bytes, png.colormap_entries)
                             : std::nullopt)
    fail("broken PNG file: " + *fault);
  png.format = PNG_FORMAT_RGB;
  // Without a gamma in the file, 16 bits mean the same as 8 bits; libpng would treat them as
  // linear.
  png.flags |= PNG_IMAGE_FLAG_16BIT_sRGB;
  RgbImage image(png.width, png.height);
  const png_color black{0, 0, 0};
  if (png_image_finish_read(&png, &black, image.pixels.data(), 0, nullptr) == 0)
    fail(std::string("broken PNG file: ") + png.message);
  return image;
}

RgbImage read_rgb_png(const std::filesystem::path& path) {
  const std::string name = path.string();
  if (!std::filesystem::exists(path))
    throw InputError(name + ": does not exist; a texture is a PNG file or 'checker'");
  return decode_rgb_png(files::InputFile(path).bytes(), name);
}

}  // namespace fathom::pipeline
