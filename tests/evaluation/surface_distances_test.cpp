#include "fathom/evaluation/surface_distances.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <array>

#include "fathom/evaluate.h"
#include "fathom/evaluation/depth_agreement.h"
#include "fathom/failures/errors.h"
#include "tests/evaluation/scenes.h"
#include "tests/inputs/floating_point_modes.h"

namespace fathom {
namespace {

/// A square of side 2 across the z axis.
Scene plate(double z, double side = 2) {
  const double h = side / 2;
  return checks::scene_of({{-h, -h, z}, {h, -h, z}, {h, h, z}, {-h, h, z}}, {{0, 1, 2}, {0, 2, 3}});
}

void append(Scene& scene, const Scene& other) {
  Mesh& mesh = scene.meshes[0];
  const auto first = static_cast<std::uint32_t>(mesh.vertices.size());
  for (const MeshPoint& p : other.meshes[0].vertices) mesh.vertices.push_back(p);
  for (const CornerIndices& t : other.meshes[0].triangles)
    mesh.triangles.push_back({t[0] + first, t[1] + first, t[2] + first});
  mesh.face_count = mesh.triangles.size();
}

SurfaceComparisonOptions few_points(std::vector<double> within = {}) {
  SurfaceComparisonOptions options;
  options.points = 1000;
  options.within = std::move(within);
  return options;
}

TEST(SurfaceDistances, OfPlatesThatAreParallel) {
  const SurfaceComparison c =
      compare_surfaces(plate(2.25), plate(2), {}, few_points({0.25, 0.2500000000000001, 0.125}));
  for (const SurfaceDistances* d : {&c.accuracy, &c.completeness}) {
    EXPECT_EQ(d->points, 1000U);
    EXPECT_EQ(d->seen, 1000U);
    for (const double figure : {d->mean, d->rms, d->median, d->p90, d->p99, d->max})
      EXPECT_EQ(figure, 0.25);
    // As asked for, whatever their order; a distance that equals the threshold is not below it.
    EXPECT_EQ(d->shares, (std::vector<double>{0, 1, 0}));
  }
  EXPECT_EQ(c.f_scores, (std::vector<double>{0, 1, 0}));
}

TEST(SurfaceDistances, OfASurfaceFromItselfAreNone) {
  std::mt19937 random(8);
  const Scene scene = evaluation::test::whole_soup(random, 9, 20);
  const SurfaceComparison c = compare_surfaces(scene, scene, {}, few_points({1e-300}));
  EXPECT_EQ(c.accuracy.max, 0);
  EXPECT_EQ(c.completeness.max, 0);
  EXPECT_EQ(c.f_scores[0], 1);
}

// A reconstruction with a wall that no camera sees, and without a part that none sees of the truth.
TEST(SurfaceDistances, CountWhatIsSeen) {
  Scene reconstruction = plate(2), truth = plate(2);
  append(reconstruction, plate(7));
  append(truth, plate(4));
  const Camera camera = checks::camera_of(100, 100, 50);
  const SurfaceComparison seen = compare_surfaces(reconstruction, truth, {camera}, few_points());
  EXPECT_EQ(seen.accuracy.seen, 500U);
  EXPECT_EQ(seen.accuracy.max, 0);
  EXPECT_EQ(seen.completeness.max, 0);
  const SurfaceComparison whole = compare_surfaces(reconstruction, truth, {}, few_points());
  EXPECT_EQ(whole.accuracy.mean, 1.5);
  EXPECT_EQ(whole.accuracy.max, 3);
  EXPECT_EQ(whole.completeness.mean, 1);
}

TEST(SurfaceDistances, CountWhatOneOfSeveralCamerasSees) {
  Camera left = checks::camera_of(50, 100, 50), right = left;
  left.projection.cx = 50;
  right.projection.cx = 0;
  const auto seen = [](const std::vector<Camera>& cameras) {
    return compare_surfaces(plate(2), plate(2), cameras, few_points()).accuracy.seen;
  };
  EXPECT_EQ(seen({left}) + seen({right}), 1000U);
  EXPECT_NEAR(static_cast<double>(seen({left})), 500, 10);
  EXPECT_EQ(seen({left, right}), 1000U);
}

TEST(SurfaceDistances, AreTheSameWithAnyNumberOfThreads) {
  std::mt19937 random(9);
  const Scene one = evaluation::test::whole_soup(random, 9, 40);
  const Scene other = evaluation::test::whole_soup(random, 9, 40);
  Camera camera = checks::camera_of(100, 100, 50);
  camera.world_to_camera[2][3] = 20;
  SurfaceComparisonOptions options = few_points({1});
  options.points = 3000;
  options.threads = 1;
  const SurfaceComparison single = compare_surfaces(one, other, {camera}, options);
  options.threads = 3;
  const SurfaceComparison several = compare_surfaces(one, other, {camera}, options);
  EXPECT_EQ(single.accuracy.mean, several.accuracy.mean);
  EXPECT_EQ(single.accuracy.seen, several.accuracy.seen);
  EXPECT_EQ(single.completeness.rms, several.completeness.rms);
  EXPECT_EQ(single.f_scores, several.f_scores);
}

TEST(SurfaceDistances, OfObjectsThatAreMoved) {
  Scene moved = plate(1);
  Object& object = moved.objects[0];
  object.placed_as_is = false;
  object.world_from_mesh.rows[2][3] = 1.5;
  const SurfaceComparison c = compare_surfaces(moved, plate(2), {}, few_points());
  EXPECT_EQ(c.accuracy.mean, 0.5);
  EXPECT_EQ(c.completeness.max, 0.5);
}

TEST(SurfaceDistances, NeedSurfacesAndPoints) {
  const auto message = [](const Scene& made, const Scene& truth,
                          const SurfaceComparisonOptions& options) -> std::string {
    try {
      compare_surfaces(made, truth, {}, options);
      return "";
    } catch (const Error& error) {
      return error.what();
    }
  };
  EXPECT_EQ(message(Scene(), plate(1), few_points()),
            "the reconstruction: has neither faces nor points");
  const Scene line = checks::scene_of({{0, 0, 0}, {1, 1, 1}, {2, 2, 2}}, {{0, 1, 2}});
  EXPECT_EQ(message(plate(1), line, few_points()), "the truth: the surface has no area");
  EXPECT_NE(message(plate(1), plate(1), few_points({0})), "");
  SurfaceComparisonOptions many;
  many.points = 0xFFFFFFFF;
  EXPECT_THAT(message(plate(1), plate(1), many),
              ::testing::StartsWith("comparing 4294967295 points of each surface needs "));
  SurfaceComparisonOptions none;
  none.points = 0;
  EXPECT_NE(message(plate(1), plate(1), none), "");
}

TEST(SurfaceDistances, RefuseCamerasWhoseRaysAreBent) {
  Camera camera = checks::camera_of(100, 100, 50);
  Lens& lens = camera.projection.lens.emplace(Lens{LensModel::simple_radial});
  lens.distortion[0] = -0.2;
  const Scene cloud = checks::scene_of({{0, 0, 2}}, {});
  for (const Scene& made : {plate(2), cloud}) {
    EXPECT_THROW(compare_surfaces(made, plate(2), {camera}, few_points()), UsageError);
    EXPECT_THROW(evaluate(made, plate(2), {camera}, few_points()), UsageError);
  }
}

// The second camera and the density are refused before the first map is rendered.
TEST(SurfaceDistances, AreRefusedBeforeAnythingIsRendered) {
  Camera bent = checks::camera_of(100, 100, 50);
  bent.projection.lens.emplace(Lens{LensModel::simple_radial}).distortion[0] = -0.2;
  int reports = 0;
  const auto progress = [&](double) { ++reports; };
  const Camera camera = checks::camera_of(100, 100, 50);
  EXPECT_THROW(evaluate(plate(2), plate(2), {camera, bent}, few_points(), progress), UsageError);
  SurfaceComparisonOptions thin = few_points();
  thin.density = 0.2;
  EXPECT_THROW(evaluate(plate(2), plate(2), {camera}, thin, progress), UsageError);
  EXPECT_EQ(reports, 0);
}

DepthMap map_of(std::vector<float> depths) {
  DepthMap map;
  map.width = static_cast<std::uint32_t>(depths.size());
  map.height = 1;
  map.channels.push_back({"Z", Samples<float>(depths)});
  return map;
}

constexpr float none = std::numeric_limits<float>::infinity();

TEST(DepthAgreement, OfTwoViewsWorkedOutByHand) {
  DepthAgreementSum sum;
  sum.add(map_of({1, 2, none, 4}), map_of({1.5F, 2, 8, none}));
  sum.add(map_of({none, none, none, none}), map_of({none, none, none, 2}));
  const DepthAgreement d = sum.result();
  EXPECT_EQ(d.views, 2U);
  EXPECT_EQ(d.both, 2U);
  EXPECT_EQ(d.only_truth, 1U);
  EXPECT_EQ(d.only_reconstruction, 2U);
  EXPECT_EQ(d.metrics.mae, 0.25);
  // ((½ + 0 + 8 + 4)/4 + 2/4)/2; no view has more than 100 pixels of the truth.
  EXPECT_EQ(d.l1_of_all_pixels, 1.8125);
  EXPECT_EQ(d.views_of_truth, 0U);
  EXPECT_EQ(d.l1_of_truth_pixels, 0);
}

TEST(DepthAgreement, CountsViewsWithMoreThanAHundredPixelsOfTheTruth) {
  for (const std::size_t pixels : {100, 101}) {
    std::vector<float> truth(pixels, 3), other(pixels, 3);
    truth.push_back(none);
    other.push_back(1);
    other[0] = none;
    DepthAgreementSum sum;
    sum.add(map_of(truth), map_of(other));
    const DepthAgreement d = sum.result();
    EXPECT_EQ(d.views_of_truth, pixels == 101 ? 1U : 0U);
    EXPECT_EQ(d.l1_of_truth_pixels, pixels == 101 ? 3 / 101.0 : 0);
  }
}

TEST(DepthAgreement, IsTheSameInEveryFloatingPointMode) {
  checks::expect_same_in_all_modes([] {
    DepthAgreementSum sum;
    for (int view = 0; view < 3; ++view)
      sum.add(map_of({1.1F, 2.3F, 7}), map_of({1.3F, 2.7F, 9.1F}));
    const DepthAgreement d = sum.result();
    return std::array{d.l1_of_all_pixels, d.metrics.mae, d.metrics.rmse, d.metrics.rmse_log};
  });
}

TEST(DepthAgreement, RefusesMapsOfOtherSizes) {
  DepthAgreementSum sum;
  EXPECT_THROW(sum.add(map_of({1}), map_of({1, 2})), std::invalid_argument);
  EXPECT_THROW(sum.add(DepthMap(), map_of({1})), std::invalid_argument);
}

}  // namespace
}  // namespace fathom
