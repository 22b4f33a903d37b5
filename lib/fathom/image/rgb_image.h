#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

namespace fathom {

/// A colour in sRGB, 8 bits per component.
using Rgb = std::array<std::uint8_t, 3>;

/// A picture for people to look at: width × height colours, row by row from the top left. Not for
/// measurements; those are in a DepthMap.
struct RgbImage {
  std::uint32_t width = 0;
  std::uint32_t height = 0;
  std::vector<Rgb> pixels;

  RgbImage() = default;
  RgbImage(std::uint32_t columns, std::uint32_t rows, Rgb fill = {0, 0, 0})
      : width(columns), height(rows), pixels(std::size_t{columns} * rows, fill) {}

  [[nodiscard]] Rgb& at(std::uint32_t x, std::uint32_t y) {
    return pixels[std::size_t{y} * width + x];
  }
  [[nodiscard]] const Rgb& at(std::uint32_t x, std::uint32_t y) const {
    return pixels[std::size_t{y} * width + x];
  }
};

/// Writes `image` as an 8-bit RGB PNG to `path` itself, in place. The bytes depend only on the
/// image.
/// Fails    OutputError: "PATH: why"; InputError if there is no pixel, or not a colour for each.
void write_png(const RgbImage& image, const std::filesystem::path& path);
/// The bytes of such a file; `name` is its name for messages.
/// Fails    InputError as write_png().
std::vector<std::byte> encode_png(const RgbImage& image, const std::string& name);

}  // namespace fathom
