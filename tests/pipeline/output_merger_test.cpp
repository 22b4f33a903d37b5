#include "fathom/pipeline/output/output_merger.h"

#include <gtest/gtest.h>

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

}  // namespace
}  // namespace fathom::pipeline
