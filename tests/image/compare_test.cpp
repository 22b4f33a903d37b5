#include "fathom/image/compare.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "fathom/failures/errors.h"
#include "fathom/image/surface.h"
#include "tests/image/map_samples.h"

namespace fathom {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using namespace fathom::checks;

const float nan_value = std::bit_cast<float>(0x7FC00000u);

DepthMap depths(std::vector<float> values) {
  const auto width = static_cast<std::uint32_t>(values.size());
  return map_of(width, 1, "Z", std::move(values));
}

ChannelComparison compared(std::vector<float> a, std::vector<float> b,
                           const CompareOptions& options = {}) {
  return compare_maps(depths(std::move(a)), depths(std::move(b)), options).channels.at(0);
}

TEST(Compare, CountsCoverageAndFindsTheFirstDisagreement) {
  const auto c = compared({1, inf, 2, inf, 5}, {1, 3, inf, inf, 5});
  EXPECT_EQ(c.pixels, 5u);
  EXPECT_EQ(c.both, 2u);
  EXPECT_EQ(c.only_truth, 1u);
  EXPECT_EQ(c.only_other, 1u);
  EXPECT_EQ(c.neither, 1u);
  EXPECT_EQ(c.bit_equal, 2u);
  EXPECT_EQ(c.first_coverage_disagreement, (PixelPosition{1, 0}));
  EXPECT_FALSE(c.within_tolerance());
  EXPECT_THAT(c.notes, IsEmpty());
}

TEST(Compare, AnyOfTheTolerancesIsEnough) {
  // 0.5 and 1/8 apart, and 2^20 ulp; 1 and 1/4.
  const std::vector<float> truth{4, 4}, other{4.5f, 5};
  const auto beyond = [&](const CompareOptions& options) {
    return compared(truth, other, options).beyond_tolerance;
  };
  EXPECT_EQ(beyond({}), 2u);
  EXPECT_EQ(beyond({.tolerance_absolute = 0.5}), 1u);
  EXPECT_EQ(beyond({.tolerance_absolute = std::nextafter(0.5, 0)}), 2u);
  EXPECT_EQ(beyond({.tolerance_relative = 0.2}), 0u);
  EXPECT_EQ(beyond({.tolerance_relative = std::nextafter(0.2, 0)}), 1u);
  EXPECT_EQ(beyond({.tolerance_ulp = 1e9}), 0u);
  EXPECT_EQ(beyond({.tolerance_absolute = 0.5, .tolerance_relative = 0.2}), 0u);
  EXPECT_EQ(compared({4}, {nan_value}, {.tolerance_absolute = INFINITY}).both, 0u);
  for (const double wrong : {-1.0, std::nan("")}) {
    EXPECT_THROW(beyond({.tolerance_absolute = wrong}), UsageError);
    EXPECT_THROW(beyond({.tolerance_relative = wrong}), UsageError);
  }
}

TEST(Compare, MetricsOfDepths) {
  const auto c = compared({4, 2, inf, 8, 1}, {5, 2, 3, inf, 4}, {.metrics = Metrics::by_channel});
  ASSERT_TRUE(c.depth_metrics);
  EXPECT_FALSE(c.disparity_metrics);
  const DepthMetrics& m = *c.depth_metrics;
  EXPECT_EQ(m.pixels, 3u);
  EXPECT_EQ(m.left_out, 0u);
  EXPECT_EQ(m.mae, 4.0 / 3);
  EXPECT_EQ(m.abs_rel, (0.25 + 3) / 3);
  EXPECT_EQ(m.sq_rel, (0.25 + 9) / 3);
  EXPECT_EQ(m.rmse, std::sqrt(10.0 / 3));
  EXPECT_DOUBLE_EQ(m.rmse_log,
                   std::sqrt((std::pow(std::log(1.25), 2) + std::pow(std::log(4), 2)) / 3));
  // 1.25 is not below 1.25.
  EXPECT_EQ(m.delta_1, 1.0 / 3);
  EXPECT_EQ(m.delta_2, 2.0 / 3);
  EXPECT_EQ(m.delta_3, 2.0 / 3);
  EXPECT_FALSE(compared({1}, {1}).depth_metrics);
  EXPECT_EQ(compared({inf}, {inf}, {.metrics = Metrics::by_channel}).depth_metrics->rmse, 0);
  // What is not above 0 has no logarithm; a background that is given lets it be a surface.
  const auto left =
      compared({1, -1}, {1, 2}, {.truth_background = 7.0, .metrics = Metrics::by_channel});
  EXPECT_EQ(left.depth_metrics->pixels, 1u);
  EXPECT_EQ(left.depth_metrics->left_out, 1u);
}

TEST(Compare, MetricsOfDisparities) {
  const DepthMap truth = map_of(5, 1, "disparity", std::vector<float>{1, 2, 3, 4, inf});
  const DepthMap other = map_of(5, 1, "disparity", std::vector<float>{1, 2.5f, 2, 7, 1});
  const auto c = compare_maps(truth, other, {.metrics = Metrics::by_channel}).channels.at(0);
  ASSERT_TRUE(c.disparity_metrics);
  EXPECT_FALSE(c.depth_metrics);
  EXPECT_EQ(c.disparity_metrics->pixels, 4u);
  EXPECT_EQ(c.disparity_metrics->epe, 4.5 / 4);
  EXPECT_EQ(c.disparity_metrics->rmse, std::sqrt(10.25 / 4));
  EXPECT_EQ(c.disparity_metrics->bad_0_5, 0.5);
  EXPECT_EQ(c.disparity_metrics->bad_1, 0.25);
  EXPECT_EQ(c.disparity_metrics->bad_2, 0.25);
  const auto of_z = compared({1, 2}, {1, 3}, {.metrics = Metrics::of_disparity});
  EXPECT_EQ(of_z.disparity_metrics->epe, 0.5);
}

TEST(Compare, MeasuresInAllThreeTerms) {
  const float next = std::nextafterf(8, 9);  // 2^-20 above 8
  const auto c = compared({8, 4, 1}, {next, 5, 1});
  EXPECT_EQ(c.compared, 3u);
  EXPECT_EQ(c.bit_equal, 1u);
  EXPECT_EQ(c.absolute.max, 1);
  EXPECT_EQ(c.absolute.worst, (PixelPosition{1, 0}));
  EXPECT_EQ(c.absolute.mean, (1 + 0x1p-20) / 3);
  EXPECT_EQ(c.relative.max, 0.2);
  EXPECT_EQ(c.ulp.max, 0x1p21);  // 4 to 5 is a quarter of the 2^23 numbers from 4 to 8
  EXPECT_EQ(c.ulp.p50, 1);
  EXPECT_EQ(c.beyond_tolerance, 2u);
}

TEST(Compare, ToleranceIsInUlps) {
  CompareOptions options;
  options.tolerance_ulp = 1;
  EXPECT_TRUE(compared({8}, {std::nextafterf(8, 9)}, options).within_tolerance());
  EXPECT_TRUE(compared({8}, {std::nextafterf(8, 7)}, options).within_tolerance());
  EXPECT_FALSE(
      compared({8}, {std::nextafterf(std::nextafterf(8, 9), 9)}, options).within_tolerance());
}

TEST(Compare, UlpsCountAcrossZeroAndMaximum) {
  CompareOptions options;
  options.truth_background = options.other_background = std::nan("");
  const float least = std::numeric_limits<float>::denorm_min();
  EXPECT_EQ(compared({-least}, {least}, options).ulp.max, 2);
  EXPECT_EQ(compared({-0.0f}, {0.0f}, options).ulp.max, 0);
  EXPECT_EQ(compared({-0.0f}, {0.0f}, options).bit_equal, 0u);
  const float greatest = std::numeric_limits<float>::max();
  EXPECT_EQ(compared({-greatest}, {greatest}, options).ulp.max, 2.0 * 0x7F7FFFFF);
}

TEST(Compare, PercentilesAreNearestRank) {
  std::vector<float> a(1000), b(1000);
  for (std::size_t k = 0; k < 1000; ++k) {
    a[k] = 1;
    b[k] = 1 + static_cast<float>(k + 1) * 0x1p-23f;  // k + 1 ulps away
  }
  const auto c = compared(a, b);
  EXPECT_EQ(c.ulp.p50, 500);
  EXPECT_EQ(c.ulp.p90, 900);
  EXPECT_EQ(c.ulp.p99, 990);
  EXPECT_EQ(c.ulp.p99_9, 999);
  EXPECT_EQ(c.ulp.max, 1000);
  EXPECT_EQ(c.ulp.mean, 500.5);
  EXPECT_EQ(c.ulp.worst, (PixelPosition{999, 0}));
}

/// An overflowed depth is +∞ and told from background by `id`.
TEST(Compare, InfinitiesAndNaNsFollowTheRule) {
  const auto with_id = [](std::vector<float> z, std::vector<std::uint32_t> id) {
    DepthMap map = depths(std::move(z));
    map.channels.push_back({"id", std::move(id)});
    return map;
  };
  const DepthMap a = with_id({inf, inf, nan_value, inf, 1}, {0, 1, 2, no_surface, 4});
  const DepthMap b = with_id({inf, 1, nan_value, inf, nan_value}, {0, 1, 2, no_surface, 4});
  CompareOptions options;
  options.tolerance_ulp = 1e300;
  const auto result = compare_maps(a, b, options);
  const auto& z = result.channels.at(0);
  EXPECT_EQ(z.both, 4u);
  EXPECT_EQ(z.neither, 1u);
  EXPECT_EQ(z.bit_equal, 2u);
  EXPECT_EQ(z.compared, 2u);
  EXPECT_EQ(z.incommensurable, 2u);
  EXPECT_EQ(z.beyond_tolerance, 2u);
  EXPECT_EQ(z.first_mismatch, (PixelPosition{1, 0}));
  EXPECT_TRUE(result.channels.at(1).within_tolerance());
  EXPECT_FALSE(result.within_tolerance());
}

TEST(Compare, IdentifiersAreEqualOrNot) {
  const auto ids = [](std::vector<std::uint32_t> values) {
    return map_of(2, 2, "id", std::move(values));
  };
  const auto c =
      compare_maps(ids({1, 2, no_surface, 4}), ids({1, 3, no_surface, no_surface})).channels.at(0);
  EXPECT_TRUE(c.identifiers);
  EXPECT_EQ(c.both, 2u);
  EXPECT_EQ(c.bit_equal, 1u);
  EXPECT_EQ(c.different_identifiers, 1u);
  EXPECT_EQ(c.first_mismatch, (PixelPosition{1, 0}));
  EXPECT_EQ(c.only_truth, 1u);
  EXPECT_EQ(c.neither, 1u);
}

TEST(Compare, OtherProgramsBackgroundsAreDetectedAndNoted) {
  for (const float background : {1e10f, 0.0f, 65504.0f, std::numeric_limits<float>::max()}) {
    const auto c = compared({1, inf, inf}, {1, background, background});
    EXPECT_EQ(c.neither, 2u) << background;
    ASSERT_EQ(c.notes.size(), 1u);
    EXPECT_THAT(c.notes[0], HasSubstr("at 2 pixels is taken for background"));
  }
  const auto nans = compared({1, inf}, {1, nan_value});
  EXPECT_EQ(nans.neither, 1u);
  EXPECT_THAT(nans.notes, IsEmpty());
  // Where infinities are background, 0 is not.
  EXPECT_EQ(compared({1, inf, 0}, {1, inf, 0}).both, 2u);
}

// The far plane's depth, or a window depth of 1. The note names the option with which maps agree.
TEST(Compare, ABackgroundThatIsNotInfiniteIsNoted) {
  for (const float far : {100.0f, 1.0f, 0.1f}) {
    const std::vector<float> truth{far / 4, inf, inf, far / 2}, other{far / 4, far, far, far / 2};
    const auto c = compared(truth, other);
    EXPECT_EQ(c.only_other, 2u);
    ASSERT_EQ(c.notes.size(), 1u);
    const auto turned = compared(other, truth);
    ASSERT_EQ(turned.notes.size(), 1u);
    EXPECT_THAT(turned.notes[0], HasSubstr("truth: the background is "));
    EXPECT_TRUE(compared(truth, other, {.other_background = far}).within_tolerance());
    EXPECT_THAT(compared(truth, other, {.other_background = far}).notes, IsEmpty());
  }
  EXPECT_THAT(compared({1, inf, inf}, {1, 100, 100}).notes,
              ElementsAre("other: the background is 100, not infinite, at 2 pixels: give "
                          "--other-background 100 (in Python other_background=100)"));
}

// Surfaces that only one map shows are no background: of several depths, one pixel, or of a depth
// that both maps show.
TEST(Compare, SurfacesOfOneMapAreNoBackground) {
  EXPECT_THAT(compared({1, inf, inf, inf}, {1, 2, 3, 4}).notes, IsEmpty());
  EXPECT_THAT(compared({1, inf}, {1, 100}).notes, IsEmpty());
  EXPECT_THAT(compared({1, inf, inf, 100}, {1, 100, 100, 100}).notes, IsEmpty());
  EXPECT_THAT(compared({1, inf, inf, 200}, {1, 100, 100, 200}).notes, IsEmpty());
}

TEST(Compare, BackgroundCanBeGiven) {
  CompareOptions options;
  options.other_background = 20;
  const auto c = compared({1, inf}, {1, 20}, options);
  EXPECT_EQ(c.neither, 1u);
  EXPECT_THAT(c.notes, IsEmpty());
}

TEST(Compare, ChannelsOfOtherNamesAndTypes) {
  const DepthMap blender = map_of(2, 1, "ViewLayer.Depth.Z", std::vector<float>{1, 1e10f});
  const auto found = compare_maps(depths({1, inf}), blender);
  EXPECT_THAT(found.notes,
              ElementsAre("no channel in common: 'Z' is compared with 'ViewLayer.Depth.Z'"));
  EXPECT_TRUE(found.within_tolerance());

  const DepthMap doubles = map_of(2, 1, "Z", std::vector<double>{1 + 0x1p-40, INFINITY});
  const auto mixed = compare_maps(depths({1, inf}), doubles).channels.at(0);
  EXPECT_EQ(mixed.ulp.max, 0);
  EXPECT_EQ(mixed.absolute.max, 0x1p-40);
  EXPECT_EQ(mixed.bit_equal, 0u);
  EXPECT_EQ(mixed.notes.size(), 1u);
  const auto wide = compare_maps(map_of(2, 1, "Z", std::vector<double>{1, INFINITY}), doubles);
  EXPECT_EQ(wide.channels.at(0).ulp.max, 4096);

  DepthMap codes = map_of(2, 1, "Z", std::vector<std::uint16_t>{1003, 0});
  codes.png_scale = 1000;
  DepthMap others = map_of(2, 1, "Z", std::vector<std::uint16_t>{1000, 0});
  others.png_scale = 1000;
  const auto steps = compare_maps(codes, others).channels.at(0);
  EXPECT_EQ(steps.ulp.max, 3);
  EXPECT_EQ(steps.neither, 1u);
  EXPECT_EQ(steps.absolute.max, 1.003 - 1);
  const auto against_floats = compare_maps(depths({1, inf}), others).channels.at(0);
  EXPECT_EQ(against_floats.absolute.max, 0);
  EXPECT_TRUE(against_floats.within_tolerance());
}

TEST(Compare, WhatCannotBeComparedIsNamed) {
  EXPECT_THROW(compare_maps(depths({1}), depths({1, 2})), InputError);
  EXPECT_THROW(compare_maps(depths({1}), map_of(1, 1, "A", std::vector<float>{1})), InputError);
  EXPECT_THROW(compare_maps(depths({1}), map_of(1, 1, "Z", std::vector<std::uint32_t>{1})),
               InputError);
  CompareOptions options;
  options.channel = "A";
  EXPECT_THROW(compare_maps(depths({1}), depths({1}), options), UsageError);
  options.channel = "";
  DepthMap more = depths({1});
  more.channels.push_back({"A", std::vector<float>{1}});
  const auto result = compare_maps(depths({1}), more);
  EXPECT_THAT(result.only_in_other, ElementsAre("A"));
  EXPECT_TRUE(result.within_tolerance());
}

TEST(Compare, GroupsAndCoverageHaveTheirOwnBackground) {
  DepthMap a = map_of(3, 1, "N.X", std::vector<float>{0, 0, 1});
  a.channels.push_back({"N.Y", std::vector<float>{1, 0, 0}});
  a.channels.push_back({"N.Z", std::vector<float>{0, 0, 0}});
  a.channels.push_back({"A", std::vector<float>{0, 0.5, 1}});
  EXPECT_THAT(surface_mask(a, a.channels[2]), ElementsAre(1, 0, 1));
  EXPECT_THAT(surface_mask(a, a.channels[3]), ElementsAre(1, 1, 1));
  DepthMap p = map_of(2, 1, "P.X", std::vector<float>{nan_value, 0});
  EXPECT_THAT(surface_mask(p, p.channels[0]), ElementsAre(0, 1));
}

// A sample may have a ray and meet nothing.
TEST(Compare, RaysAreComparedWhereNothingIsSeen) {
  DepthMap a = map_of(3, 1, "Z", std::vector<float>{2, inf, inf});
  DepthMap b = a;
  a.channels.push_back({"valid", std::vector<std::uint32_t>{1, 1, 0}});
  b.channels.push_back({"valid", std::vector<std::uint32_t>{1, 0, 0}});
  EXPECT_THAT(surface_mask(a, a.channels[1]), ElementsAre(1, 1, 1));
  EXPECT_TRUE(compare_maps(a, a, {}).within_tolerance());
  EXPECT_FALSE(compare_maps(a, b, {}).within_tolerance());
}

TEST(DifferencePicture, ShowsEachKindInItsColour) {
  // Enlarged 96 times: the middle of each block of pixels.
  const RgbImage image = draw_differences(depths({1, 1, 1, inf, inf}), depths({1, 2, inf, 1, inf}));
  const auto block = [&](std::uint32_t k) { return image.at(20 + 96 * k + 48, 20 + 18 + 34 + 48); };
  EXPECT_EQ(block(0), (Rgb{44, 47, 54}));
  EXPECT_EQ(block(2), (Rgb{0, 190, 220}));
  EXPECT_EQ(block(3), (Rgb{80, 220, 100}));
  EXPECT_EQ(block(4), (Rgb{206, 210, 216}));
  EXPECT_GT(block(1)[0], 200);  // the hottest
}

/// The first channel by name differs everywhere, Z at one pixel.
TEST(DifferencePicture, DrawsDepthsBeforeOtherChannels) {
  DepthMap a = map_of(2, 1, "N.X", std::vector<float>{0.5, 0.5});
  a.channels.push_back({"Z", std::vector<float>{1, 2}});
  DepthMap b = map_of(2, 1, "N.X", std::vector<float>{0.25, 0.25});
  b.channels.push_back({"Z", std::vector<float>{1, 3}});
  const auto block = [](const RgbImage& image, std::uint32_t k) {
    return image.at(20 + 240 * k + 120, 20 + 18 + 34 + 120);
  };
  const Rgb equal{44, 47, 54};
  EXPECT_EQ(block(draw_differences(a, b), 0), equal);
  EXPECT_NE(block(draw_differences(a, b), 1), equal);
  EXPECT_NE(block(draw_differences(a, b, {.channel = "N.X"}), 0), equal);
  // Without Z, another channel of depths.
  a.channels[1].name = b.channels[1].name = "distance";
  EXPECT_EQ(block(draw_differences(a, b), 0), equal);
}

/// 1 to 2 and 1000 to 1001: as far in scene units, not in others.
TEST(DifferencePicture, ColoursMeasureTheUnitThatIsAskedFor) {
  const DepthMap a = depths({1, 1000}), b = depths({2, 1001});
  const auto colours = [&](DifferenceMeasure by) {
    const RgbImage image = draw_differences(a, b, {}, by);
    const std::uint32_t row = 20 + 18 + 34 + 120;
    return std::pair(image.at(20 + 120, row), image.at(20 + 360, row));
  };
  const auto absolute = colours(DifferenceMeasure::absolute);
  EXPECT_EQ(absolute.first, absolute.second);
  const auto relative = colours(DifferenceMeasure::relative);
  EXPECT_NE(relative.first, relative.second);
  const auto ulp = colours(DifferenceMeasure::ulp);
  EXPECT_NE(ulp.first, ulp.second);
}

}  // namespace
}  // namespace fathom
