#include "fathom/image/preview.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>

#include "fathom/failures/errors.h"
#include "fathom/image/pictures/legend.h"
#include "fathom/image/surface.h"
#include "tests/image/map_samples.h"

namespace fathom {
namespace {

using namespace image;
using namespace fathom::checks;

constexpr Rgb neutral{206, 210, 216};

/// The middle of a pixel of a map of five pixels, which is enlarged 96 times.
Rgb block(const RgbImage& image, std::uint32_t k) {
  return image.at(20 + 96 * k + 48, 72 + 48);
}

TEST(Preview, GoesFromOneEndOfTheColoursToTheOther) {
  const DepthMap map = map_of(5, 1, "Z", std::vector<float>{2, 4, 3, inf, 2});
  const RgbImage image = draw_preview(map);
  EXPECT_EQ(block(image, 0), colour_at(ColourMap::viridis, 0));
  EXPECT_EQ(block(image, 1), colour_at(ColourMap::viridis, 1));
  EXPECT_EQ(block(image, 2), colour_at(ColourMap::viridis, 0.5));
  EXPECT_EQ(block(image, 3), neutral);
}

TEST(Preview, RangeCanBeGiven) {
  const DepthMap map = map_of(5, 1, "Z", std::vector<float>{2, 4, 3, inf, 1});
  PreviewOptions options;
  options.low = 2;
  options.high = 3;
  options.colours = ColourMap::turbo;
  const RgbImage image = draw_preview(map, options);
  EXPECT_EQ(block(image, 1), colour_at(ColourMap::turbo, 1));
  EXPECT_EQ(block(image, 4), colour_at(ColourMap::turbo, 0));
  options.low = 3;
  EXPECT_THROW(draw_preview(map, options), UsageError);
  options.channel = "distance";
  EXPECT_THROW(draw_preview(map, options), UsageError);
  options.channel = "N";
  EXPECT_THROW(draw_preview(map, options), UsageError);
}

Rgb of_place(double t) {
  return colour_at(ColourMap::viridis, t);
}

TEST(Preview, ScalesPlaceValuesByRatiosInversesAndRanks) {
  const DepthMap map = map_of(5, 1, "Z", std::vector<float>{1, 2, 4, 16, inf});
  PreviewOptions options;
  options.scale = ColourScale::log;
  EXPECT_EQ(block(draw_preview(map, options), 2), of_place(0.5));
  options.scale = ColourScale::inverse;
  EXPECT_EQ(block(draw_preview(map, options), 1), of_place((1 - 1 / 2.0) / (1 - 1 / 16.0)));
  options.scale = ColourScale::equalised;
  EXPECT_EQ(block(draw_preview(map, options), 1), of_place(1 / 3.0));
  EXPECT_EQ(block(draw_preview(map, options), 3), of_place(1));
}

TEST(Preview, LogarithmsAndInversesNeedARangeAboveZero) {
  const DepthMap map = map_of(5, 1, "Z", std::vector<float>{0, 2, 4, 16, inf});
  const DepthMap empty = map_of(5, 1, "Z", std::vector<float>(5, inf));
  PreviewOptions options;
  for (const ColourScale scale : {ColourScale::log, ColourScale::inverse}) {
    options.scale = scale;
    options.low.reset();
    EXPECT_THROW(draw_preview(map, options), UsageError);
    EXPECT_NO_THROW(draw_preview(empty, options));
    options.low = 2;
    EXPECT_EQ(block(draw_preview(map, options), 0), of_place(0));
    EXPECT_EQ(block(draw_preview(map, options), 3), of_place(1));
  }
}

TEST(ScaledRange, MarksLieWhereTheirNumbersAre) {
  for (const ColourScale scale : all_colour_scales) {
    const ScaledRange range(scale, 0.1, 1000, {0.1, 1, 7, 8, 9, 100, 1000});
    const auto marks = range.marks();
    EXPECT_GT(marks.size(), 4U) << name_of(scale);
    EXPECT_EQ(marks[0].text, "0.1");
    EXPECT_EQ(marks[1].text, "1000");
    for (const auto& [t, text] : marks) EXPECT_NEAR(range.place(std::stod(text)), t, 1e-12) << text;
  }
}

constexpr Rgb wrong{215, 25, 28}, right{146, 154, 164};

DepthMap fights_in(std::uint32_t width, std::uint32_t height, const std::vector<std::size_t>& at) {
  DepthMap map = map_of(width, height, "Z", std::vector<float>(width * height, 2));
  std::get<Samples<float>>(map.channels[0].values)[0] = inf;
  std::vector<std::uint32_t> fights(width * height, 0);
  for (const std::size_t k : at) fights[k] = 1;
  map.channels.push_back({"Zfight", fights});
  return map;
}

TEST(Preview, WrongPixelsStandOutFromNeutralOnes) {
  const RgbImage image = draw_preview(fights_in(5, 1, {2}), {.channel = "Zfight"});
  EXPECT_EQ(block(image, 0), neutral);
  EXPECT_EQ(block(image, 1), right);
  EXPECT_EQ(block(image, 2), wrong);
}

TEST(Preview, FewWrongPixelsOfALargeMapAreDrawnLarger) {
  // The picture lies at (20, 72) of the sheet.
  const RgbImage image = draw_preview(fights_in(300, 200, {100 * 300 + 50}), {.channel = "Zfight"});
  EXPECT_EQ(image.at(20 + 48, 72 + 102), wrong);
  EXPECT_EQ(image.at(20 + 47, 72 + 100), right);
  std::vector<std::size_t> many(300 * 100);
  for (std::size_t k = 0; k < many.size(); ++k) many[k] = 2 * k + 1;
  const RgbImage crowded = draw_preview(fights_in(300, 200, many), {.channel = "Zfight"});
  EXPECT_EQ(crowded.at(20 + 50, 72 + 100), right);
  EXPECT_EQ(crowded.at(20 + 51, 72 + 100), wrong);
}

TEST(Preview, ErrorsAreWhiteAtZero) {
  DepthMap map = map_of(5, 1, "Z", std::vector<float>{2, 2, 2, 2, inf});
  map.channels.push_back({"Zerror", std::vector<float>{0, -1, 0.5, -0.5, 0}});
  const RgbImage image = draw_preview(map, {.channel = "Zerror"});
  EXPECT_EQ(block(image, 0), (Rgb{255, 255, 255}));
  EXPECT_EQ(block(image, 1), colour_at(ColourMap::diverging, 0));
  EXPECT_EQ(block(image, 2), colour_at(ColourMap::diverging, 0.75));
  const RgbImage viridis = draw_preview(map, {.channel = "Zerror", .colours = ColourMap::viridis});
  EXPECT_EQ(block(viridis, 1), of_place(0));
  EXPECT_EQ(block(viridis, 2), of_place(1));
  // Also as the first channel of a map that has no Z.
  const RgbImage alone =
      draw_preview(map_of(5, 1, "Zerror", std::vector<float>{0, -1, 0.5, -0.5, 0}));
  EXPECT_EQ(block(alone, 0), (Rgb{255, 255, 255}));
  EXPECT_EQ(block(alone, 1), colour_at(ColourMap::diverging, 0));
}

TEST(Preview, DrawsChannelsByNameAndType) {
  const Samples<float> numbers{1};
  const Samples<std::uint32_t> integers{1};
  EXPECT_EQ(drawing_of({"Z", numbers}), ChannelDrawing::numbers);
  EXPECT_EQ(drawing_of({"Zerror", numbers}), ChannelDrawing::errors);
  EXPECT_EQ(drawing_of({"Zfight", integers}), ChannelDrawing::fights);
  EXPECT_EQ(drawing_of({"Zfight", numbers}), ChannelDrawing::numbers);
  EXPECT_EQ(drawing_of({"Zwinner", integers}), ChannelDrawing::identifiers);
  EXPECT_EQ(drawing_of({"valid", integers}), ChannelDrawing::numbers);
  EXPECT_EQ(colours_for(ChannelDrawing::errors), ColourMap::diverging);
  EXPECT_EQ(colours_for(ChannelDrawing::numbers), ColourMap::viridis);
}

TEST(Preview, OddMapsAreDrawn) {
  const auto drawn = [](std::vector<float> values) {
    return draw_preview(map_of(5, 1, "Z", std::move(values)));
  };
  EXPECT_EQ(block(drawn(std::vector<float>(5, inf)), 2), neutral);
  EXPECT_EQ(block(drawn(std::vector<float>(5, 7)), 2), colour_at(ColourMap::viridis, 0.5));
  const float greatest = std::numeric_limits<float>::max();
  EXPECT_EQ(block(drawn({-greatest, greatest, inf, inf, inf}), 1),
            colour_at(ColourMap::viridis, 1));
  DepthMap huge = map_of(5, 1, "Z", std::vector<double>{-1.7e308, 1.7e308, 0, INFINITY, 0});
  EXPECT_EQ(block(draw_preview(huge), 2), colour_at(ColourMap::viridis, 0.5));
  huge.channels[0].values = std::vector<double>{1e-310, 2e-310, 0, INFINITY, 3e-310};
  EXPECT_NO_THROW(draw_preview(huge));
  DepthMap overflowed = map_of(5, 1, "Z", std::vector<float>{1, inf, inf, -inf, NAN});
  overflowed.channels.push_back({"id", std::vector<std::uint32_t>{0, 1, no_surface, 3, 4}});
  const RgbImage image = draw_preview(overflowed);
  EXPECT_EQ(block(image, 1), (Rgb{230, 25, 120}));
  EXPECT_EQ(block(image, 2), neutral);
  EXPECT_EQ(block(image, 3), (Rgb{120, 40, 200}));
  EXPECT_EQ(block(image, 4), (Rgb{255, 120, 0}));
  EXPECT_NO_THROW(draw_preview(map_of(5000, 2, "Z", random_bits<float>(10000, 11))));
}

TEST(Preview, IdentifiersHaveColoursOfTheirOwn) {
  DepthMap map = map_of(5, 1, "object", std::vector<std::uint32_t>{0, 1, 0, no_surface, 2});
  map.object_names = {"spot"};
  const RgbImage image = draw_preview(map);
  EXPECT_EQ(block(image, 0), block(image, 2));
  EXPECT_NE(block(image, 0), block(image, 1));
  EXPECT_EQ(block(image, 3), neutral);
}

/// What is visible and has no material is neither background nor a material; a triangle of that
/// number is one like others.
TEST(Preview, SurfacesWithoutASegmentAreGrey) {
  DepthMap map =
      map_of(5, 1, "material", std::vector<std::uint32_t>{0, 1, no_segment, no_surface, 0});
  map.tables["material"] = {"oak", "steel"};
  const RgbImage image = draw_preview(map);
  EXPECT_EQ(block(image, 2), (Rgb{96, 96, 96}));
  EXPECT_EQ(block(image, 3), neutral);
  EXPECT_NE(block(image, 0), block(image, 1));
  map.channels[0].name = "id";
  EXPECT_NE(block(draw_preview(map), 2), (Rgb{96, 96, 96}));
}

TEST(Preview, NormalsAreRgb) {
  for (const std::string name : {"N", "Nc", "Ns"}) {
    DepthMap map = map_of(5, 1, name + ".X", std::vector<float>{1, 0, 0, 0, -1});
    map.channels.push_back({name + ".Y", std::vector<float>{0, 1, 0, 0, 0}});
    map.channels.push_back({name + ".Z", std::vector<float>{0, 0, 1, 0, 0}});
    PreviewOptions options;
    options.channel = name;
    const RgbImage image = draw_preview(map, options);
    EXPECT_EQ(block(image, 0), (Rgb{255, 128, 128}));
    EXPECT_EQ(block(image, 4), (Rgb{0, 128, 128}));
    EXPECT_EQ(block(image, 3), neutral);
    options.channel = name == "N" ? "Ns" : "N";
    EXPECT_THROW(draw_preview(map, options), UsageError);
  }
}

/// Relative luminance of sRGB (IEC 61966-2-1).
double luminance(Rgb colour) {
  const auto linear = [](std::uint8_t byte) {
    const double c = byte / 255.0;
    return c <= 0.04045 ? c / 12.92 : std::pow((c + 0.055) / 1.055, 2.4);
  };
  return 0.2126 * linear(colour[0]) + 0.7152 * linear(colour[1]) + 0.0722 * linear(colour[2]);
}

TEST(ColourMaps, BrightenAllTheWay) {
  for (const ColourMap map : {ColourMap::viridis, ColourMap::magma, ColourMap::grey})
    for (int k = 1; k <= 64; ++k)
      EXPECT_GT(luminance(colour_at(map, k / 64.0)), luminance(colour_at(map, (k - 1) / 64.0)))
          << k;
}

/// The published tables' ends and middles, in 8 bits. The polynomials are said to be within 2 % of
/// them; 0.04·255 ≈ 10 allows for twice that.
TEST(ColourMaps, AreTheOnesTheyAreCalled) {
  const auto near = [](Rgb a, Rgb b) {
    for (std::size_t c = 0; c < 3; ++c)
      if (std::abs(a[c] - b[c]) > 10) return false;
    return true;
  };
  EXPECT_TRUE(near(colour_at(ColourMap::viridis, 0), {68, 1, 84}));
  EXPECT_TRUE(near(colour_at(ColourMap::viridis, 0.5), {33, 145, 140}));
  EXPECT_TRUE(near(colour_at(ColourMap::viridis, 1), {253, 231, 37}));
  EXPECT_TRUE(near(colour_at(ColourMap::magma, 0), {0, 0, 4}));
  EXPECT_TRUE(near(colour_at(ColourMap::magma, 0.5), {183, 55, 121}));
  EXPECT_TRUE(near(colour_at(ColourMap::magma, 1), {252, 253, 191}));
  // Turbo's polynomial follows its table less closely: blue, green, red in turn.
  const auto strongest = [](double t) {
    const Rgb c = colour_at(ColourMap::turbo, t);
    return std::max_element(c.begin(), c.end()) - c.begin();
  };
  EXPECT_EQ(strongest(0.15), 2);
  EXPECT_EQ(strongest(0.5), 1);
  EXPECT_EQ(strongest(0.85), 0);
}

TEST(LinearMarks, AreTheEndsAndRoundNumbersBetween) {
  const auto marks = linear_marks(0.25, 3.5);
  EXPECT_EQ(marks[0].text, "0.25");
  EXPECT_EQ(marks[1].text, "3.5");
  ASSERT_EQ(marks.size(), 5u);  // and 1, 2, 3
  EXPECT_EQ(marks[2].text, "1");
  EXPECT_EQ(marks[4].text, "3");
  EXPECT_EQ(marks[3].t, (2 - 0.25) / 3.25);
  // Ends that differ in the last digits only are told apart.
  const auto close = linear_marks(1000000, std::nextafter(1000000, 2e6));
  EXPECT_NE(close[0].text, close[1].text);
  EXPECT_LE(linear_marks(-1e308, 1.7e308).size(), 12u);
}

}  // namespace
}  // namespace fathom
