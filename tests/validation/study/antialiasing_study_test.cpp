// The figures of the study `antialiasing` against what can be known about them.

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "apps/study/antialiasing/coverage.h"
#include "apps/study/antialiasing/curve.h"
#include "apps/study/antialiasing/methods.h"
#include "apps/study/antialiasing/sampling.h"
#include "apps/study/effort.h"
#include "apps/study/pipeline_scenes.h"
#include "apps/study/study_scene.h"
#include "fathom/failures/errors.h"
#include "fathom/pipeline/render_pipeline.h"
#include "fathom/render.h"
#include "tests/effort.h"

namespace fathom::studies {
namespace {

using pipeline::AntialiasMethod;
using pipeline::ColourImage;

void paint(Scene& scene, const std::vector<std::array<float, 4>>& by_triangle) {
  for (const auto& colour : by_triangle)
    scene.meshes[0].colours.insert(scene.meshes[0].colours.end(), 3, colour);
}

/// Right of x = 1.75 − y/4: in column 1 of row 0 the line runs from 1.75 to 1.5, so 0.375 is
/// covered; in row 3 from 1 to 0.75, so all of column 1 and an eighth of column 0.
TEST(ExactPicture, HasTheCoverageOfASlantedEdge) {
  const Scene scene = scene_of({{1.75, 0, 0.5}, {40, 0, 0.5}, {0.75, 4, 0.5}}, {{0, 1, 2}});
  const ColourImage image = exact_picture(scene, window_camera(3, 4), {0, 0.5, 1});
  const auto expect = [&](std::uint32_t x, std::uint32_t y, double covered) {
    const pipeline::Colour& c = image.at(x, y);
    EXPECT_NEAR(c[0], covered, 0x1p-24) << x << ' ' << y;
    EXPECT_NEAR(c[1], covered + 0.5 * (1 - covered), 0x1p-24);
    EXPECT_NEAR(c[2], 1, 0x1p-24);
  };
  expect(0, 0, 0);
  expect(1, 0, 0.375);
  expect(2, 0, 1);
  expect(1, 1, 0.625);
  expect(0, 2, 0);
  expect(1, 2, 0.875);
}

/// Depths 2 + x and 2.6 − x meet at x = 0.3: red is nearer on its left, green on its right.
TEST(ExactPicture, SplitsAPixelWhereSurfacesCross) {
  Scene scene =
      scene_of({{-1, -1, 1}, {3, -1, 5}, {-1, 3, 1}, {-1, -1, 3.6}, {3, -1, -0.4}, {-1, 3, 3.6}},
               {{0, 1, 2}, {3, 4, 5}});
  paint(scene, {{1, 0, 0, 1}, {0, 1, 0, 1}});
  Camera camera = window_camera(1, 1);
  camera.near = 0.0625;
  camera.far = 8;
  const ColourImage image = exact_picture(scene, camera);
  EXPECT_NEAR(image.at(0, 0)[0], 0.3, 0x1p-24);
  EXPECT_NEAR(image.at(0, 0)[1], 0.7, 0x1p-24);
}

TEST(ExactPicture, RefusesCornersOfDifferentColours) {
  Scene scene = scene_of({{0, 0, 0.5}, {1, 0, 0.5}, {0, 1, 0.5}}, {{0, 1, 2}});
  scene.meshes[0].colours = {{1, 1, 1, 1}, {1, 1, 1, 1}, {0, 1, 1, 1}};
  EXPECT_THROW(exact_picture(scene, window_camera(1, 1)), InputError);
}

pipeline::PipelineOptions drawn(const Judged& judged, const pipeline::Antialias& antialias) {
  pipeline::PipelineOptions options;
  options.shading = pipeline::Shading::none;
  options.filter = pipeline::TextureFilter::nearest;
  if (judged.textured) options.texture = "checker";
  options.antialias = antialias;
  return options;
}

PictureError error_with(const Judged& judged, const pipeline::PipelineOptions& options) {
  return error_of(render_frame(judged.scene, judged.camera, options, true).picture, judged.truth);
}

/// The star's rays are white and hide nothing: its truth is the channel A.
TEST(JudgedScenes, TheStarIsItsCoverage) {
  const Judged judged = star();
  const DepthMap map = render(judged.scene, judged.camera, {.channels = {Channel::A}}).map;
  const auto& A = *map.values<float>("A");
  for (std::size_t i = 0; i < A.size(); ++i) {
    // Some thirty rays meet in the middle, each area rounded by itself.
    ASSERT_NEAR(judged.truth.pixels[i][0], static_cast<double>(A[i]), 0x1p-23) << i;
  }
}

/// Area sampling is off by what snapping moves: sixteen times as much on a grid sixteen times as
/// coarse, and by more than the rounding of the truth, so it is not judged by itself.
TEST(AntialiasingMethods, ErrorsOfAreasAreThoseOfTheGrid) {
  for (const Judged& judged : {star(), crossing_sheets()}) {
    pipeline::PipelineOptions options = drawn(judged, {AntialiasMethod::area, 1});
    options.precision = pipeline::Precision::binary64;
    const auto with_bits = [&](int bits) {
      options.subpixel_bits = bits;
      return error_with(judged, options);
    };
    const PictureError four = with_bits(4), eight = with_bits(8), twelve = with_bits(12);
    for (const auto& [coarse, fine] : {std::pair(four, eight), std::pair(eight, twelve)}) {
      EXPECT_GT(coarse.mean / fine.mean, 8);
      EXPECT_LT(coarse.mean / fine.mean, 32);
    }
    // An edge that moves by half a step changes at most that share of the pixels that it crosses.
    EXPECT_GT(eight.mean, 1e-5);
    EXPECT_LT(eight.mean, 0x1p-9);
    EXPECT_LT(eight.greatest, 0.01);
  }
}

/// The texture's squares as triangles are where the texture has them: 256 samples a pixel come
/// near.
TEST(JudgedScenes, TexturesAreWhereTheirSquaresAre) {
  const Judged wall = checkered_wall();
  EXPECT_LT(error_with(wall, drawn(wall, {AntialiasMethod::ssaa, 16})).mean, 1e-3);
  EXPECT_GT(error_with(wall, drawn(wall, {AntialiasMethod::none, 1})).mean, 1e-2);
  const Judged plane = checkered_plane();
  EXPECT_LT(error_with(plane, drawn(plane, {AntialiasMethod::ssaa, 8})).mean,
            error_with(plane, drawn(plane, {AntialiasMethod::ssaa, 2})).mean / 3);
}

TEST(AntialiasingMethods, OnlyFxaaChangesWhatIsRightAsItIs) {
  const Judged judged = text();
  for (const AntialiasMethod method : {AntialiasMethod::none, AntialiasMethod::area})
    EXPECT_EQ(error_with(judged, drawn(judged, {method, 1})).greatest, 0);
  EXPECT_EQ(error_with(judged, drawn(judged, {AntialiasMethod::msaa, 16})).greatest, 0);
  EXPECT_GT(error_with(judged, drawn(judged, {AntialiasMethod::fxaa, 1})).greatest, 0.25);
}

TEST(AntialiasingMethods, FxaaComesNearerToEdgesOfSurfacesAndTextures) {
  for (const Judged& judged : {star(), crossing_sheets(), checkered_wall()})
    EXPECT_LT(error_with(judged, drawn(judged, {AntialiasMethod::fxaa, 1})).mean,
              0.75 * error_with(judged, drawn(judged, {AntialiasMethod::none, 1})).mean);
}

/// What a frame takes is measured, so that buffers count that no table knows of: FXAA has a second
/// picture, samples are kept while they are drawn.
TEST(AntialiasingMethods, MemoryIsMeasured) {
  if (checks::effort > 1) GTEST_SKIP() << "sanitizers keep memory of their own";
  const Judged large{siemens_star(36, 90, 96.3, 95.8), window_camera(192, 192), false, {}};
  const auto bytes_a_pixel = [&](const pipeline::Antialias& antialias) {
    const auto bytes =
        peak_bytes([&] { render_frame(large.scene, large.camera, drawn(large, antialias), true); });
    EXPECT_TRUE(bytes);
    return static_cast<double>(bytes.value_or(0)) / (192 * 192);
  };
  const double none = bytes_a_pixel({AntialiasMethod::none, 1});
  EXPECT_GT(none, sizeof(pipeline::StoredSample));
  // A picture is three numbers of binary64 for each pixel.
  EXPECT_GT(bytes_a_pixel({AntialiasMethod::fxaa, 1}), none + 20);
  EXPECT_GT(bytes_a_pixel({AntialiasMethod::msaa, 4}), none + 3 * sizeof(pipeline::StoredSample));
}

/// A wave of less than half a cycle a pixel is what its samples are reconstructed to; a finer one
/// comes back as its alias. Samples come back as they are.
TEST(Gratings, ReconstructionIsTheWaveBelowHalfACycle) {
  constexpr int n = 480;
  for (const int cycles : {24, 100, 230, 250, 380}) {
    const double f = static_cast<double>(cycles) / n;
    const double alias = std::min(f, 1 - f);
    std::vector<double> samples;
    for (int k = 0; k < n; ++k) samples.push_back(std::cos(2 * std::numbers::pi * f * k));
    for (const double x : {0.5, 3.5, 7.25, 100.9, 479.99}) {
      EXPECT_NEAR(reconstructed(samples, x), std::cos(2 * std::numbers::pi * alias * (x - 0.5)),
                  1e-9)
          << f << " " << x;
    }
  }
  // Of a grating: 0.3 cycles a pixel keep their bars' place, 0.7 look like 0.3.
  const std::vector<double> coarse = grating_samples(0.3), fine = grating_samples(0.7);
  EXPECT_EQ(coarse.size(), 480U);
  for (const std::vector<double>& samples : {coarse, fine})
    for (int k = 0; k < 480; ++k)
      EXPECT_NEAR(reconstructed(samples, k + 0.5), samples[static_cast<std::size_t>(k)], 1e-9);
  const RgbImage picture = grating_picture({0.3, 0.3, 1, 1, 0, 0, 0});
  EXPECT_EQ(picture.width, 192U);
  // Eight columns of a pixel are alike in the strip of the samples.
  for (std::uint32_t x = 0; x < 192; ++x) EXPECT_EQ(picture.at(x, 50), picture.at(x / 8 * 8, 50));
}

/// The closed form against a sum over a million points.
TEST(Gratings, WhitePartsAreWhatIsWhite) {
  for (const double f : {0.1, 0.37, 0.5, 1.0, 1.45}) {
    for (const double x : {0.0, 3.0, 17.0}) {
      int white = 0;
      constexpr int points = 1 << 20;
      for (int i = 0; i < points; ++i) {
        const double cycles = (x + (i + 0.5) / points) * f;
        white += cycles - std::floor(cycles) < 0.5;
      }
      EXPECT_NEAR(white_part(f, x), static_cast<double>(white) / points, 4e-6) << f << ' ' << x;
    }
  }
}

/// Sampling turns f into its distance from the nearest whole number; up to half a cycle that is f.
TEST(Gratings, SeemToHaveTheFrequencyOfTheirAlias) {
  const std::vector<GratingSeen> gratings = gratings_seen();
  ASSERT_EQ(gratings.size(), 60U);
  for (const GratingSeen& g : gratings) {
    EXPECT_NEAR(g.apparent, std::abs(g.frequency - std::round(g.frequency)), 1e-12) << g.frequency;
    // Snapping to 2⁻¹⁶ of a pixel moves each of at most three edges in a pixel by half a step.
    EXPECT_LT(g.error_by_area, 3 * 0x1p-17) << g.frequency;
    EXPECT_LE(g.error_ssaa, g.error + 1e-12) << g.frequency;
  }
  EXPECT_EQ(nyquist_limit(gratings), 0.5);
  // Half a cycle below and above one cycle a pixel the bars look alike, at full contrast; areas
  // leave of them sinc f, near 0.1 of it at 0.9 cycles.
  EXPECT_NEAR(gratings[35].contrast, 1, 0.02);
  const double f = gratings[35].frequency;
  EXPECT_NEAR(gratings[35].contrast_by_area,
              std::sin(std::numbers::pi * f) / (std::numbers::pi * f), 0.01);
}

/// The rates are chosen so that no alias is at the limit, where both directions look alike.
TEST(Temporal, AWheelSeemsToTurnByItsAlias) {
  for (const double rate : {3.0, 9.0, 21.0, 27.0, 30.0, 33.0, 57.0, 63.0}) {
    const WheelSeen seen = wheel_seen(rate);
    EXPECT_NEAR(seen.apparent, std::remainder(rate, 30.0), 0.2) << rate;
    // Pixels of a wheel at one instant are not sharp circles: a few hundredths of the contrast.
    EXPECT_NEAR(seen.contrast,
                std::abs(std::sin(std::numbers::pi * rate / 30) / (std::numbers::pi * rate / 30)),
                0.02)
        << rate;
  }
}

/// The share of N instants is off by less than 1/N at a centre; areas are linear in time but for
/// their kinks, so their error falls with the square.
TEST(Temporal, MorePicturesComeNearerToTheIntegralOverTime) {
  for (const int n : {1, 2, 4, 8, 16, 32, 64}) EXPECT_LE(time_error(n).centres, 1.0 / n) << n;
  EXPECT_GT(time_error(1).centres, 0.1);
  EXPECT_LT(time_error(32).areas, time_error(4).areas / 32);
}

TEST(Temporal, HistoryThatFollowsAndIsLimitedHelps) {
  const HistoryError still = history_error(0), whole = history_error(1), part = history_error(0.7);
  EXPECT_LT(still.taa, still.none / 2);
  EXPECT_LT(whole.taa, whole.none / 2);
  EXPECT_LT(part.taa, part.none);
  EXPECT_LT(part.taa, part.unlimited);
  EXPECT_LT(part.taa, part.unmoved);
  EXPECT_GT(part.neither, part.none);
}

/// A square as curves: straight ones, whose control points lie at thirds.
std::vector<pipeline::CubicBezier> square_outline(double x, double end) {
  const pipeline::PlanePoint corners[] = {{x, x}, {end, x}, {end, end}, {x, end}};
  std::vector<pipeline::CubicBezier> outline;
  for (std::size_t i = 0; i < 4; ++i) {
    const auto &a = corners[i], &b = corners[(i + 1) % 4];
    outline.push_back({{{a,
                         {a.x + (b.x - a.x) / 3, a.y + (b.y - a.y) / 3},
                         {a.x + 2 * (b.x - a.x) / 3, a.y + 2 * (b.y - a.y) / 3},
                         b}}});
  }
  return outline;
}

TEST(Curve, AreasOfAnOutlineAreKnown) {
  const ColourImage image = outline_areas(square_outline(1.25, 3.5), 5);
  const double lengths[] = {0, 0.75, 1, 0.5, 0};
  for (std::uint32_t y = 0; y < 5; ++y)
    for (std::uint32_t x = 0; x < 5; ++x)
      EXPECT_NEAR(image.at(x, y)[0], lengths[x] * lengths[y], 1e-12) << x << ' ' << y;
  // All pixels of the heart together, against the closed form.
  double sum = 0, area = 0;
  std::vector<pipeline::CubicBezier> outline;
  for (const auto& curve : heart()) {
    outline.push_back(curve.scaled(40));
    area += area_beside(outline.back());
  }
  for (const auto& colour : outline_areas(outline, 40).pixels) sum += colour[0];
  EXPECT_NEAR(sum, std::abs(area), 1e-4);
}

/// A chord within a tenth of a pixel leaves less than that of each pixel of the outline, of which
/// there are some 2.6 times as many as the picture is wide.
TEST(Curve, DrawnAnewItIsAsGoodAtEveryMagnification) {
  std::size_t chords = 0;
  for (const int magnification : {1, 4, 16}) {
    const CurveError e = curve_error(magnification);
    EXPECT_LT(e.anew, 0.1 * 4 / (24 * magnification));
    EXPECT_LT(std::abs(e.area), 0.1 * 4 / (24 * magnification));
    if (chords > 0) {
      EXPECT_GT(e.chords, chords);
      EXPECT_LE(e.chords, 3 * chords);
    }
    chords = e.chords;
  }
  EXPECT_GT(curve_error(16).enlarged, 20 * curve_error(16).anew);
}

}  // namespace
}  // namespace fathom::studies
