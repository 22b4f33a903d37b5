#include "fathom/pipeline/output/output_merger.h"

#include <gtest/gtest.h>

#include "fathom/pipeline/output/fxaa.h"

namespace fathom::pipeline {
namespace {

TEST(FrameBuffer, ResolvesToTheMeanOfItsSamples) {
  FrameBuffer buffer(2, 2, 4, {1, 1, 1}, 10);
  EXPECT_EQ(buffer.at({1, 11}, 3).id, no_surface);
  buffer.replace({1, 10}, 0, {0, 0.5, 1});
  buffer.replace({1, 10}, 3, {0, 0.5, 1});
  const ColourImage image = buffer.resolve();
  EXPECT_EQ(image.at(1, 0), (Colour{0.5, 0.75, 1}));
  EXPECT_EQ(image.at(0, 0), (Colour{1, 1, 1}));
}

TEST(FrameBuffer, BlendsOverWhatIsStored) {
  FrameBuffer buffer(1, 1, 1, {0, 0, 1});
  buffer.blend({0, 0}, 0, {1, 0, 0}, 0.25);
  EXPECT_EQ(buffer.resolve().at(0, 0), (Colour{0.25, 0, 0.75}));
  buffer.blend({0, 0}, 0, {0, 1, 0}, 0.5);
  EXPECT_EQ(buffer.resolve().at(0, 0), (Colour{0.125, 0.5, 0.375}));
  EXPECT_EQ(buffer.at({0, 0}, 0).id, no_surface);
}

TEST(ColourImage, IsRoundedToTheNearestOf256) {
  const ColourImage image{3, 1, {{0, 1, 0.5}, {-0.1, 1.1, 0.25}, {1.4 / 255, 1.6 / 255, 1}}};
  const RgbImage rgb = to_rgb(image);
  EXPECT_EQ(rgb.pixels[0], (Rgb{0, 255, 128}));
  EXPECT_EQ(rgb.pixels[1], (Rgb{0, 255, 64}));
  EXPECT_EQ(rgb.pixels[2], (Rgb{1, 2, 255}));
}

/// Without an edge nothing changes; across a step the pixels beside it are mixed, and no colour
/// leaves the range of what was there.
TEST(Fxaa, BlursEdgesAlone) {
  ColourImage flat{5, 4, std::vector<Colour>(20, Colour{0.25, 0.5, 0.75})};
  EXPECT_EQ(fxaa(flat).pixels, flat.pixels);
  ColourImage stairs{16, 16, std::vector<Colour>(256)};
  for (std::uint32_t y = 0; y < 16; ++y) {
    for (std::uint32_t x = 0; x < 16; ++x) {
      const double c = x > y ? 1 : 0;
      stairs.pixels[std::size_t{y} * 16 + x] = {c, c, c};
    }
  }
  const ColourImage smooth = fxaa(stairs);
  int changed = 0;
  for (std::uint32_t y = 0; y < 16; ++y) {
    for (std::uint32_t x = 0; x < 16; ++x) {
      const double value = smooth.at(x, y)[0];
      EXPECT_GE(value, -1e-15);
      EXPECT_LE(value, 1 + 1e-15);
      const std::uint32_t away = x > y ? x - y : y - x;
      if (away > 6) {
        EXPECT_EQ(value, stairs.at(x, y)[0]) << x << ' ' << y;
      }
      changed += value != stairs.at(x, y)[0];
    }
  }
  EXPECT_GT(changed, 16);
}

}  // namespace
}  // namespace fathom::pipeline
