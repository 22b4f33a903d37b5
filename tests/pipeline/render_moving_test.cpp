#include "fathom/pipeline/render_moving.h"

#include <gtest/gtest.h>

#include <cmath>

#include "fathom/failures/errors.h"
#include "fathom/pipeline/output/temporal_history.h"

namespace fathom::pipeline {
namespace {

/// Orthographic: the world's x and y are pixels.
Camera window(std::uint32_t width, std::uint32_t height) {
  Camera camera;
  camera.width = width;
  camera.height = height;
  camera.projection.model = ProjectionModel::orthographic;
  camera.near = 0.125;
  camera.far = 1;
  return camera;
}

Scene square(double x, double end, double height) {
  Scene scene;
  scene.meshes.emplace_back();
  scene.meshes[0].vertices = {{x, 0, 0.5}, {end, 0, 0.5}, {end, height, 0.5}, {x, height, 0.5}};
  scene.meshes[0].triangles = {{0, 1, 2}, {0, 2, 3}};
  scene.meshes[0].face_count = 2;
  scene.objects.push_back({.name = "square"});
  return scene;
}

/// By `distance` to the right from time 0 to 1.
Motion to_the_right(double distance) {
  Keyframe start{0, {}}, end{1, {}};
  end.world_from_placed.rows[0][3] = distance;
  return {{{"square", {start, end}}}};
}

PipelineOptions precise(AntialiasMethod method, int count) {
  PipelineOptions options;
  options.precision = Precision::binary64;
  options.subpixel_bits = 16;
  options.shading = Shading::none;
  options.antialias = {method, count};
  return options;
}

/// The square [2, 4] moves by 3. A place c is covered while c − 4 < s < c − 2: up to the way s its
/// covered length is the overlap, and a pixel's integral over s is that of a trapezoid.
double covered_way(double c) {
  return std::max(0.0, std::min(3.0, c - 2) - std::max(0.0, c - 4));
}

/// ∫ covered_way over a pixel: it is linear between whole numbers.
double covered_pixel(double p) {
  return (covered_way(p) + covered_way(p + 1)) / 2 / 3;
}

TEST(RenderMoving, IntegratesOverTime) {
  MovingScene scene(square(2, 4, 1), to_the_right(3));
  const auto picture = [&](AntialiasMethod method, int n) {
    return render_moving(scene, window(10, 1), precise(method, n), {0, 1}, true).picture;
  };
  const ColourImage areas = picture(AntialiasMethod::temporal_area, 60);
  const ColourImage centres = picture(AntialiasMethod::temporal, 60);
  double light = 0;
  for (std::uint32_t x = 0; x < 10; ++x) {
    // A step of 1/20 of a pixel: the midpoint rule is exact where the way that is covered is
    // linear, which it is between the whole numbers that the steps meet; snapping moves an edge by
    // at most 2⁻¹⁷.
    EXPECT_NEAR(areas.at(x, 0)[0], covered_pixel(x), 0x1p-16) << x;
    // The share of 60 instants at which a point is covered: each end is off by less than one.
    EXPECT_NEAR(centres.at(x, 0)[0], covered_way(x + 0.5) / 3, 1.0 / 60) << x;
    light += areas.at(x, 0)[0];
  }
  EXPECT_NEAR(light, 2, 1e-4);  // what is there all the time
}

TEST(RenderMoving, OneInstantIsThePictureOfTheMiddle) {
  MovingScene scene(square(2, 4, 1), to_the_right(3));
  const ColourImage one =
      render_moving(scene, window(10, 1), precise(AntialiasMethod::temporal, 1), {0, 0.5}, true)
          .picture;
  const ColourImage middle =
      render_frame(scene.at(0.25), window(10, 1), precise(AntialiasMethod::none, 1), true).picture;
  EXPECT_EQ(one.pixels, middle.pixels);
}

/// The map is that of the end, whatever the picture shows.
TEST(RenderMoving, TheMapIsThatOfTheTimeOfClosing) {
  MovingScene scene(square(2, 4, 1), to_the_right(3));
  for (const AntialiasMethod method :
       {AntialiasMethod::temporal, AntialiasMethod::temporal_area, AntialiasMethod::taa}) {
    const PipelineFrame frame =
        render_moving(scene, window(10, 1), precise(method, 4), {0, 1}, true);
    for (std::uint32_t x = 0; x < 10; ++x)
      EXPECT_EQ(frame.id[x] != no_surface, x >= 5 && x < 7) << x;
  }
}

/// TAA of what does not move is the mean of pictures in which every channel has its share.
TEST(RenderMoving, TaaAtRestMixesEveryChannelAlike) {
  Scene scene = square(2.5, 7, 1);
  scene.meshes[0].colours.assign(4, {1, 0.5F, 0.25F, 1});
  for (const int n : {1, 2, 3, 16}) {
    const ColourImage picture =
        render_frame(scene, window(10, 1), precise(AntialiasMethod::taa, n), true).picture;
    const Colour edge = picture.at(2, 0);
    EXPECT_NEAR(edge[0] * n, std::round(edge[0] * n), 1e-14) << n;  // whole pictures see it
    EXPECT_NEAR(edge[0], 0.5, 0.5 / n + 1e-14) << n;
    EXPECT_NEAR(edge[1], edge[0] / 2, 1e-15);
    EXPECT_NEAR(edge[2], edge[0] / 4, 1e-15);
    EXPECT_NEAR(picture.at(4, 0)[0], 1, 1e-15);
    EXPECT_NEAR(picture.at(4, 0)[1], 0.5, 1e-15);
  }
}

/// N pictures of a scene at rest take N times the fragments of one.
TEST(RenderMoving, EveryPictureCounts) {
  MovingScene scene(square(2, 4, 1), {});
  const auto count = [&](AntialiasMethod method, int n) {
    return render_moving(scene, window(10, 1), precise(method, n), {0, 1}, true).statistics;
  };
  const PipelineStatistics one =
      render_frame(scene.at(0), window(10, 1), precise(AntialiasMethod::none, 1), true).statistics;
  for (const AntialiasMethod method : {AntialiasMethod::temporal, AntialiasMethod::taa}) {
    for (const int n : {1, 2, 5}) {
      EXPECT_EQ(count(method, n).fragments, n * one.fragments) << n;
      EXPECT_EQ(count(method, n).depth_passed, n * one.depth_passed) << n;
      EXPECT_EQ(count(method, n).shaded, n * one.shaded) << n;
    }
  }
  const PipelineStatistics areas = count(AntialiasMethod::temporal_area, 1);
  EXPECT_EQ(count(AntialiasMethod::temporal_area, 7).shaded, 7 * areas.shaded);
}

/// Where no picture is asked for none is made; where one is, and nothing is to be averaged, it is
/// the picture of the end.
TEST(RenderMoving, MakesPicturesThatAreAskedFor) {
  MovingScene scene(square(2, 4, 1), to_the_right(3));
  for (const AntialiasMethod method : {AntialiasMethod::none, AntialiasMethod::area,
                                       AntialiasMethod::temporal, AntialiasMethod::taa}) {
    const PipelineFrame without =
        render_moving(scene, window(10, 1), precise(method, 2), {0, 1}, false);
    EXPECT_TRUE(without.picture.pixels.empty());
    EXPECT_NE(without.id[5], no_surface);
    EXPECT_EQ(without.id[4], no_surface);
  }
  const PipelineOptions plain = precise(AntialiasMethod::area, 1);
  EXPECT_EQ(render_moving(scene, window(10, 1), plain, {0, 1}, true).picture.pixels,
            render_frame(scene.at(1), window(10, 1), plain, true).picture.pixels);
}

/// TAA of a scene at rest, in its first pictures: the plain mean of pictures taken elsewhere in the
/// pixel, so that a pixel of which half is covered is a half on average, at k/N with whole k.
TEST(RenderMoving, TaaIsTheMeanOfItsFirstPictures) {
  MovingScene scene(square(2.5, 7, 1), {});
  for (const int n : {2, 4, 8}) {
    const ColourImage picture =
        render_moving(scene, window(10, 1), precise(AntialiasMethod::taa, n), {0, 1}, true,
                      {true, false, 1.0 / 16})
            .picture;
    EXPECT_EQ(picture.at(1, 0)[0], 0);
    EXPECT_NEAR(picture.at(3, 0)[0], 1, 1e-15);
    // Places in the pixel are spread evenly: of every two one is on the left.
    EXPECT_NEAR(picture.at(2, 0)[0], 0.5, 1e-15) << n;
  }
}

TEST(RenderMoving, RefusesTimesThatDoNotIncrease) {
  MovingScene scene(square(2, 4, 1), to_the_right(3));
  const PipelineOptions options = precise(AntialiasMethod::temporal, 2);
  for (const Shutter& shutter : {Shutter{1, 1}, Shutter{1, 0}, Shutter{std::nan(""), 1}}) {
    EXPECT_THROW(render_moving(scene, window(4, 1), options, shutter, true), UsageError);
  }
  EXPECT_THROW(render_frame(scene.at(0), window(4, 1), options, true), UsageError);
}

/// A point of a triangle half-way between two corners in space, under perspective: seen nearer to
/// the farther one's image than half-way, and found again.
TEST(SurfaceMotion, FindsPointsOfTrianglesAgain) {
  Camera camera;
  camera.width = camera.height = 100;
  camera.projection.fx = camera.projection.fy = 100;
  camera.projection.cx = camera.projection.cy = 50;
  Scene scene;
  scene.meshes.emplace_back();
  scene.meshes[0].vertices = {{-1, 0, 2}, {1, 0, 6}, {0, 1, 4}};
  scene.meshes[0].triangles = {{0, 1, 2}};
  scene.meshes[0].face_count = 1;
  scene.objects.push_back({});
  const ImageTriangle triangle = ImageTriangles(scene, camera)[0];
  // (0, 0.25, 4): a quarter of the third corner, three eighths of each of the others.
  const auto weights = weights_at(triangle, 50, 50 + 100 * 0.25 / 4);
  ASSERT_TRUE(weights);
  EXPECT_NEAR((*weights)[0], 0.375, 1e-15);
  EXPECT_NEAR((*weights)[1], 0.375, 1e-15);
  EXPECT_NEAR((*weights)[2], 0.25, 1e-15);
  const auto place = place_of(triangle, *weights);
  ASSERT_TRUE(place);
  EXPECT_NEAR((*place)[0], 50, 1e-12);
  EXPECT_NEAR((*place)[1], 56.25, 1e-12);
  // Behind the eye: (−5, 0, −6) lies on the line through the first two corners.
  EXPECT_FALSE(place_of(triangle, {3, -2, 0}));
}

ColourImage picture_with(std::uint32_t x, std::uint32_t y, double value) {
  ColourImage image{9, 9, std::vector<Colour>(81)};
  image.pixels[std::size_t{y} * 9 + x] = {value, value, value};
  return image;
}

TEST(TemporalHistory, FollowsTheMovesAndIsLimitedByItsNeighbours) {
  const PixelMoves two_to_the_left(81, PixelMove{-2, 0});
  const auto second = [&](const HistorySettings& settings, const PixelMoves& moves,
                          const ColourImage& present) {
    TemporalHistory history(settings);
    history.add(picture_with(3, 4, 1), {});
    history.add(present, moves);
    return history.picture();
  };
  // The dot of the first picture is seen two to the right, where the second has none: half of each.
  const HistorySettings loose{true, false, 0.1}, still{false, false, 0.1}, strict{true, true, 0.1};
  const ColourImage empty = picture_with(0, 0, 0);
  EXPECT_EQ(second(loose, two_to_the_left, empty).at(5, 4)[0], 0.5);
  EXPECT_EQ(second(loose, two_to_the_left, empty).at(3, 4)[0], 0);
  EXPECT_EQ(second(still, {}, empty).at(3, 4)[0], 0.5);
  // Nothing around has its colour, so it is a ghost; a neighbour that has it lets it be.
  EXPECT_EQ(second(strict, two_to_the_left, empty).at(5, 4)[0], 0);
  EXPECT_EQ(second(strict, two_to_the_left, picture_with(6, 5, 0.25)).at(5, 4)[0], 0.125);
  // What was not seen before is taken as it is, and so is what comes in from beyond the border.
  EXPECT_EQ(second(loose, PixelMoves(81), picture_with(3, 4, 0.5)).at(3, 4)[0], 0.5);
  EXPECT_EQ(second(loose, PixelMoves(81, PixelMove{-4, 0}), picture_with(3, 4, 0.5)).at(3, 4)[0],
            0.5);
}

/// A colour of the past stays where one of the nine pixels around has it now, and no farther.
TEST(TemporalHistory, IsLimitedByNineNeighbours) {
  const PixelMoves at_rest(81, PixelMove{0, 0});
  for (std::uint32_t y = 0; y < 9; ++y) {
    for (std::uint32_t x = 0; x < 9; ++x) {
      for (const auto& [px, py] : {std::pair{4U, 4U}, {0U, 0U}, {8U, 8U}, {1U, 7U}}) {
        TemporalHistory history({true, true, 0.5});
        history.add(picture_with(px, py, 1), {});
        history.add(picture_with(x, y, 1), at_rest);
        const bool near =
            std::max(x, px) - std::min(x, px) <= 1 && std::max(y, py) - std::min(y, py) <= 1;
        const bool same = x == px && y == py;
        EXPECT_EQ(history.picture().at(px, py)[0], same   ? 1
                                                   : near ? 0.5
                                                          : 0)
            << x << ' ' << y << " beside " << px << ' ' << py;
      }
    }
  }
}

TEST(RenderMoving, OnlyTaaRefusesLines) {
  Scene scene = square(2, 4, 1);
  scene.meshes[0].lines = {{0, 1}};
  MovingScene moving(scene, to_the_right(1));
  const auto refused = [&](AntialiasMethod method) {
    try {
      render_moving(moving, window(10, 1), precise(method, 2), {0, 1}, true);
      return false;
    } catch (const UsageError&) {
      return true;
    }
  };
  EXPECT_TRUE(refused(AntialiasMethod::taa));
  EXPECT_FALSE(refused(AntialiasMethod::temporal));
}

/// History ends where the picture does, half a pixel beyond the centres of its outer pixels.
TEST(TemporalHistory, EndsAtTheBordersOfThePicture) {
  const ColourImage white{9, 7, std::vector<Colour>(63, Colour{1, 1, 1})};
  const ColourImage black{9, 7, std::vector<Colour>(63)};
  const auto after = [&](std::uint32_t x, std::uint32_t y, const PixelMove& move) {
    TemporalHistory history({true, false, 0.5});
    history.add(white, {});
    history.add(black, PixelMoves(63, move));
    return history.picture().at(x, y)[0];
  };
  const double kept = 0.5, gone = 0;
  EXPECT_EQ(after(8, 3, {0.5, 0}), kept);
  EXPECT_EQ(after(8, 3, {0.75, 0}), gone);
  EXPECT_EQ(after(0, 3, {-0.5, 0}), kept);
  EXPECT_EQ(after(0, 3, {-0.75, 0}), gone);
  EXPECT_EQ(after(4, 6, {0, 0.5}), kept);
  EXPECT_EQ(after(4, 6, {0, 0.75}), gone);
  EXPECT_EQ(after(4, 0, {0, -0.5}), kept);
  EXPECT_EQ(after(4, 0, {0, -0.75}), gone);
}

/// Between pixels history is Catmull and Rom's cubic, which gives back any parabola.
TEST(TemporalHistory, IsInterpolatedByACubic) {
  ColourImage parabola{9, 7, {}};
  for (int y = 0; y < 7; ++y)
    for (int x = 0; x < 9; ++x)
      parabola.pixels.push_back({x * x / 64.0, y * y / 64.0, x * y / 64.0});
  TemporalHistory history({true, false, 1.0 / 16});
  history.add(parabola, {});
  history.add(ColourImage{9, 7, std::vector<Colour>(63)}, PixelMoves(63, PixelMove{0.25, -0.625}));
  const Colour& found = history.picture().at(4, 3);
  EXPECT_NEAR(found[0], 4.25 * 4.25 / 64 / 2, 1e-15);
  EXPECT_NEAR(found[1], 2.375 * 2.375 / 64 / 2, 1e-15);
  EXPECT_NEAR(found[2], 4.25 * 2.375 / 64 / 2, 1e-15);
}

TEST(TemporalHistory, ForgetsByItsWeight) {
  TemporalHistory history({false, false, 0.25});
  double expected = 1;
  history.add(picture_with(4, 4, 1), {});
  for (const double weight : {1.0 / 2, 1.0 / 3, 1.0 / 4, 1.0 / 4, 1.0 / 4}) {
    history.add(picture_with(4, 4, 0), {});
    expected *= 1 - weight;
    EXPECT_NEAR(history.picture().at(4, 4)[0], expected, 1e-15);
  }
}

/// Pickets of 2.6 pixels, one every 5.3, that lean.
Scene fence() {
  Scene scene;
  scene.meshes.emplace_back();
  Mesh& mesh = scene.meshes[0];
  for (int i = 0; i < 12; ++i) {
    const auto first = static_cast<std::uint32_t>(mesh.vertices.size());
    const double x = 5.3 * i + 0.2, top = x + 2;
    for (const auto& [px, py] : {std::pair{x, 0.0}, {x + 2.6, 0.0}, {top + 2.6, 24.0}, {top, 24.0}})
      mesh.vertices.push_back({px, py, 0.5});
    mesh.triangles.push_back({first, first + 1, first + 2});
    mesh.triangles.push_back({first, first + 2, first + 3});
  }
  mesh.face_count = mesh.triangles.size();
  scene.objects.push_back({.name = "square"});
  return scene;
}

/// Errors of a fence that moves by `step` pixels a picture, against its areas at the last time.
struct FenceErrors {
  double none, taa, unlimited, unmoved, neither;
};
FenceErrors fence_errors(double step) {
  constexpr int pictures = 16;
  MovingScene moving(fence(), to_the_right(step * (pictures - 1)));
  const Camera camera = window(48, 24);
  const auto still = [&](AntialiasMethod method) {
    return render_frame(moving.at(1), camera, precise(method, 1), true).picture;
  };
  const ColourImage truth = still(AntialiasMethod::area);
  // Pixels that the fence comes into from the left have no history yet.
  const auto error = [&](const ColourImage& image) {
    double sum = 0;
    for (std::uint32_t y = 0; y < 24; ++y)
      for (std::uint32_t x = 16; x < 46; ++x)
        sum += std::abs(image.at(x, y)[0] - truth.at(x, y)[0]);
    return sum / (24 * 30);
  };
  const auto taa = [&](bool reprojected, bool clamped) {
    return error(render_moving(moving, camera, precise(AntialiasMethod::taa, pictures), {0, 1},
                               true, {reprojected, clamped, 0.1})
                     .picture);
  };
  return {error(still(AntialiasMethod::none)), taa(true, true), taa(true, false), taa(false, true),
          taa(false, false)};
}

TEST(RenderMoving, TaaFollowsWhatMoves) {
  const FenceErrors still = fence_errors(0), whole = fence_errors(1), part = fence_errors(0.7);
  EXPECT_LT(still.taa, still.none / 5);
  // By whole pixels history is taken over as it is, and the picture is as good as at rest.
  EXPECT_LT(whole.taa, whole.none / 5);
  EXPECT_NEAR(whole.taa, still.taa, 0.2 * still.taa);
  // By parts of pixels each picture's history is interpolated, which blurs.
  EXPECT_LT(part.taa, part.none);
  EXPECT_GT(part.taa, 2 * still.taa);
  // Either half of it alone is worse than one sample.
  for (const FenceErrors& e : {whole, part}) {
    EXPECT_GT(e.unlimited, e.none);
    EXPECT_GT(e.unmoved, 2 * e.none);
    EXPECT_GT(e.neither, 2 * e.none);
  }
}

}  // namespace
}  // namespace fathom::pipeline
