#pragma once

#include <array>
#include <cstddef>
#include <filesystem>
#include <span>
#include <string>
#include <vector>

#include "fathom/image/rgb_image.h"
#include "fathom/pipeline/options.h"

namespace fathom::pipeline {

/// Where a fragment looks into a texture: coordinates, (0, 0) being the lower left corner,
/// repeated, and their changes to the next pixel. A coordinate that is no finite number is 0.
struct TextureFootprint {
  std::array<double, 2> uv{}, duv_dx{}, duv_dy{};
};

/// A picture with its mip maps: each level halves the previous level by the mean of 2 × 2 texels
/// (odd sizes drop the last row or column), down to one texel.
/// Fails    InputError if there is no texel, or not a colour for each.
class Texture {
 public:
  explicit Texture(const RgbImage& image);
  /// 8 × 8 squares, black and white.
  static Texture checker();

  /// Nearest and bilinear use only the finest level. Trilinear uses the longer of the two changes,
  /// which blurs surfaces seen obliquely; anisotropic uses the shorter change and the mean of up to
  /// 16 samples along the longer.
  [[nodiscard]] Colour sample(const TextureFootprint& footprint, TextureFilter filter) const;

  [[nodiscard]] std::size_t level_count() const { return levels_.size(); }

 private:
  struct Level {
    std::int64_t width, height;
    std::vector<Colour> texels;  ///< row by row from the top
    [[nodiscard]] const Colour& at(std::int64_t x, std::int64_t y) const;
  };
  [[nodiscard]] static Colour nearest(const Level& level, const std::array<double, 2>& uv);
  [[nodiscard]] static Colour bilinear(const Level& level, const std::array<double, 2>& uv);
  [[nodiscard]] Colour trilinear(const std::array<double, 2>& uv, double texels) const;
  [[nodiscard]] Colour anisotropic(const TextureFootprint& footprint) const;
  [[nodiscard]] double texels_along(const std::array<double, 2>& duv) const;

  std::vector<Level> levels_;
};

/// Reads a PNG of any kind as 8-bit colours: 1 to 16 bits, grey, palette or RGB; transparent pixels
/// are mixed with black in linear light (gamma 2.2).
///
/// Rounded  16 bits to the nearest of 8.
/// Fails    InputError: missing, not a PNG, without texels, larger than 8192 × 8192, or with an
///          index beyond its palette.
RgbImage read_rgb_png(const std::filesystem::path& path);
/// The same of the bytes of a file; `name` is for messages.
RgbImage decode_rgb_png(std::span<const std::byte> bytes, const std::string& name);

}  // namespace fathom::pipeline
