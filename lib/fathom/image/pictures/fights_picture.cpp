#include "fathom/image/pictures/fights_picture.h"

#include <algorithm>
#include <array>
#include <cstdint>
#include <cstdio>
#include <string>
#include <vector>

#include "fathom/image/surface.h"

namespace fathom::image {
namespace {

constexpr Rgb wrong_colour{215, 25, 28}, right_colour{146, 154, 164};

struct Square {
  std::uint32_t left, top, right, bottom;  ///< right and bottom excluded
};

/// Around a pixel, `reach` pixels to each side, within the picture.
Square square_around(const RgbImage& picture, std::size_t pixel, std::uint32_t reach) {
  const auto x = static_cast<std::uint32_t>(pixel % picture.width);
  const auto y = static_cast<std::uint32_t>(pixel / picture.width);
  return {x - std::min(x, reach), y - std::min(y, reach), std::min(x + reach + 1, picture.width),
          std::min(y + reach + 1, picture.height)};
}

/// How far squares reach: 0 where pixels can be seen as they are. Large pictures are drawn by every
/// k-th pixel, which a square must not slip through.
std::uint32_t reach_of_squares(const RgbImage& picture, std::size_t wrong) {
  const std::uint32_t side = std::max(picture.width, picture.height);
  const bool is_seen = side <= enlarged_up_to || wrong > picture.pixels.size() / 200;
  return is_seen ? 0 : std::max(2U, side / reduced_from);
}

std::string share_text(const char* what, std::size_t part, std::size_t whole) {
  std::array<char, 80> text{};
  std::snprintf(text.data(), text.size(), "%s: %zu (%.3g %%)", what, part,
                100 * static_cast<double>(part) / static_cast<double>(whole));
  return text.data();
}

}  // namespace

void draw_fights(Sheet& sheet, const DepthMap& map, const ImageChannel& channel, Rgb background) {
  const auto& fights = std::get<Samples<std::uint32_t>>(channel.values);
  const std::vector<std::uint8_t> mask = surface_mask(map, channel);
  RgbImage& picture = sheet.picture;
  std::vector<std::size_t> wrong;
  std::size_t surface = 0;
  for (std::size_t k = 0; k < mask.size(); ++k) {
    picture.pixels[k] = mask[k] ? right_colour : background;
    surface += mask[k] ? 1 : 0;
    if (mask[k] && fights[k] != 0) wrong.push_back(k);
  }
  const std::uint32_t reach = reach_of_squares(picture, wrong.size());
  for (const std::size_t pixel : wrong) {
    const Square square = square_around(picture, pixel, reach);
    for (std::uint32_t y = square.top; y < square.bottom; ++y)
      for (std::uint32_t x = square.left; x < square.right; ++x) picture.at(x, y) = wrong_colour;
  }
  const std::string side = std::to_string(2 * reach + 1);
  sheet.entries.push_back({right_colour, share_text("right", surface - wrong.size(),
                                                    std::max<std::size_t>(1, surface))});
  sheet.entries.push_back(
      {wrong_colour, share_text("wrong", wrong.size(), std::max<std::size_t>(1, surface))});
  if (reach > 0 && !wrong.empty())
    sheet.entries.push_back({wrong_colour, "each drawn as " + side + " × " + side + " pixels"});
  if (surface < mask.size()) sheet.entries.push_back({background, "no surface"});
}

}  // namespace fathom::image
