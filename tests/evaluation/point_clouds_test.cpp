// Clouds against surfaces and clouds: known answers, and a judge that looks at every pair of points
// with rational numbers.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

#include "fathom/evaluate.h"
#include "fathom/evaluation/box_tree.h"
#include "fathom/evaluation/placed_points.h"
#include "fathom/failures/errors.h"
#include "fathom/numeric/rounding.h"
#include "tests/evaluation/scenes.h"
#include "tests/scratch_folder.h"

namespace fathom::evaluation {
namespace {

Scene cloud_of(std::vector<MeshPoint> points) {
  return checks::scene_of(std::move(points), {});
}

/// A square of side 2 across the z axis.
Scene plate(double z) {
  return checks::scene_of({{-1, -1, z}, {1, -1, z}, {1, 1, z}, {-1, 1, z}}, {{0, 1, 2}, {0, 2, 3}});
}

/// Whole coordinates, among them ones that coincide, moved and scaled.
Scene whole_cloud(std::mt19937& random, int size, int points, double offset = 0,
                  double factor = 1) {
  const auto coordinate = [&] {
    return factor * (offset + static_cast<double>(random() % (2 * size + 1)) - size);
  };
  std::vector<MeshPoint> list;
  for (int i = 0; i < points; ++i) {
    const double x = coordinate(), y = coordinate(), z = coordinate();
    list.push_back({x, y, z});
  }
  return cloud_of(std::move(list));
}

std::vector<WorldPoint> points_of(const Scene& scene) {
  std::vector<WorldPoint> points;
  for (const Object& object : scene.objects)
    for (const MeshPoint& p : scene.meshes[object.mesh].vertices)
      points.push_back(to_world(object, p));
  return points;
}

Ratio judged(const WorldPoint& p, const std::vector<WorldPoint>& cloud) {
  const auto square = [](const Dyadic& x) { return x * x; };
  std::optional<Ratio> least;
  for (const WorldPoint& q : cloud) {
    const Ratio squared(square(p.x - q.x) + square(p.y - q.y) + square(p.z - q.z));
    if (!least || squared < *least) least = squared;
  }
  return *least;
}

SurfaceComparisonOptions kept(std::vector<double> within = {}) {
  SurfaceComparisonOptions options;
  options.points = 500;
  options.within = std::move(within);
  options.keep_points = true;
  return options;
}

void expect_as_judged(const Scene& from, const Scene& to) {
  const std::vector<WorldPoint> points = points_of(from), cloud = points_of(to);
  const SurfaceDistances found = compare_surfaces(from, to, {}, kept()).accuracy;
  ASSERT_EQ(found.measured.size(), points.size());
  for (std::size_t i = 0; i < points.size(); ++i)
    ASSERT_EQ(found.measured[i].distance, round_sqrt_to_binary64(judged(points[i], cloud))) << i;
}

TEST(PointClouds, AreAsFarFromASurfaceAsTheyStand) {
  const Scene cloud = cloud_of({{0, 0, 2.5}, {1, 1, 2.25}, {-1, 0, 1.75}, {4, -1, 2}});
  const SurfaceComparison c = compare_surfaces(cloud, plate(2), {}, kept({0.25, 0.5, 1}));
  EXPECT_EQ(c.accuracy.points, 4U);
  EXPECT_EQ(c.accuracy.seen, 4U);
  EXPECT_EQ(c.accuracy.cloud_points, 4U);
  EXPECT_EQ(c.completeness.cloud_points, 0U);
  EXPECT_EQ(c.accuracy.mean, (0.5 + 0.25 + 0.25 + 3) / 4);
  EXPECT_EQ(c.accuracy.max, 3);
  EXPECT_EQ(c.accuracy.shares, (std::vector<double>{0, 0.5, 0.75}));
  EXPECT_EQ(c.accuracy.measured[3].at, (std::array<double, 3>{4, -1, 2}));
  EXPECT_EQ(c.accuracy.measured[3].distance, 3);
}

TEST(PointClouds, AreMeasuredToFromASurface) {
  const Scene cloud = cloud_of({{0, 0, 5}, {0, 0, 1}});
  const SurfaceComparison c = compare_surfaces(cloud, plate(2), {}, kept());
  EXPECT_EQ(c.completeness.points, 500U);
  for (const auto& [at, distance] : c.completeness.measured) {
    const WorldPoint p{at[0], at[1], at[2]};
    EXPECT_EQ(distance, round_sqrt_to_binary64(judged(p, points_of(cloud))));
  }
  const SurfaceComparison other = compare_surfaces(plate(2), cloud, {}, kept());
  EXPECT_EQ(other.accuracy.mean, c.completeness.mean);
  EXPECT_EQ(other.completeness.max, c.accuracy.max);
}

TEST(PointClouds, AreAsFarFromEachOtherAsRationalNumbersSay) {
  std::mt19937 random(11);
  for (int round = 0; round < 20; ++round) {
    const int size = 1 + static_cast<int>(random() % 30);
    const Scene from = whole_cloud(random, size, 40);
    expect_as_judged(from, whole_cloud(random, size, 1 + static_cast<int>(random() % 200)));
    expect_as_judged(from, from);
  }
}

TEST(PointClouds, AreMeasuredInUnitsThatBinary64HardlyHasAndFarFromTheOrigin) {
  std::mt19937 random(12);
  for (const double factor : {0x1p500, 0x1p-500})
    expect_as_judged(whole_cloud(random, 9, 30, 0, factor), whole_cloud(random, 9, 60, 0, factor));
  expect_as_judged(whole_cloud(random, 9, 30, 0x1p45), whole_cloud(random, 9, 60, 0x1p45));
}

// A transform whose numbers binary64 does not have, and a second object.
TEST(PointClouds, ArePlacedByTheirObjects) {
  std::mt19937 random(13);
  Scene from = whole_cloud(random, 9, 30), to = whole_cloud(random, 9, 30);
  for (Scene* scene : {&from, &to}) {
    Object object = scene->objects[0];
    object.placed_as_is = false;
    object.world_from_mesh.rows[0][0] = Dyadic(1 / 3.0) * Dyadic(1 / 7.0);
    object.world_from_mesh.rows[1][3] = 3.5;
    scene->objects.push_back(object);
  }
  expect_as_judged(from, to);
}

/// Moved so far that binary64 rounds coordinates by as much as the points are apart.
Scene moved_far(Scene scene) {
  scene.objects[0].placed_as_is = false;
  for (std::size_t i = 0; i < 3; ++i) scene.objects[0].world_from_mesh.rows[i][3] = 0x1p51;
  return scene;
}

TEST(PointClouds, AreMeasuredExactlyWhereBinary64RoundsThem) {
  std::mt19937 random(17);
  for (int round = 0; round < 10; ++round)
    expect_as_judged(moved_far(whole_cloud(random, 9, 30, 0, 0.125)),
                     moved_far(whole_cloud(random, 9, 60, 0, 0.125)));
}

// Each point would otherwise be compared with all of them.
TEST(PointClouds, MayHoldOnePointAMillionTimes) {
  std::vector<MeshPoint> points(300000, {1, 2, 3});
  points.push_back({1, 2, 4});
  const Scene cloud = cloud_of(std::move(points));
  const SurfaceComparison c = compare_surfaces(cloud, cloud, {}, {});
  EXPECT_EQ(c.accuracy.points, 300001U);
  EXPECT_EQ(c.accuracy.max, 0);
}

TEST(PointClouds, HaveOutliers) {
  const Scene cloud = cloud_of({{0, 0, 2.5}, {0, 0, 2.25}, {0, 0, 4}, {0, 0, 5}});
  SurfaceComparisonOptions options = kept({0.3});
  options.max_distance = 2;
  const SurfaceDistances found = compare_surfaces(cloud, plate(2), {}, options).accuracy;
  EXPECT_EQ(found.seen, 4U);
  EXPECT_EQ(found.outliers, 2U);
  EXPECT_EQ(found.mean, 0.375);
  EXPECT_EQ(found.max, 0.5);
  EXPECT_EQ(found.shares, (std::vector<double>{0.25}));
  EXPECT_EQ(found.measured.size(), 4U);
  options.max_distance = std::nextafter(2.0, 3.0);
  EXPECT_EQ(compare_surfaces(cloud, plate(2), {}, options).accuracy.outliers, 1U);
  options.max_distance = 0.25;
  const SurfaceDistances none = compare_surfaces(cloud, plate(2), {}, options).accuracy;
  EXPECT_EQ(none.outliers, 4U);
  EXPECT_FALSE(none.has_figures());
  EXPECT_EQ(none.mean, 0);
  EXPECT_EQ(none.shares, (std::vector<double>{0.25}));
}

/// Which points remain, by every pair.
std::vector<std::uint32_t> judged_thinning(const Scene& cloud, double density) {
  const std::vector<WorldPoint> points = points_of(cloud);
  std::vector<WorldPoint> remaining;
  std::vector<std::uint32_t> numbers;
  for (std::uint32_t i = 0; i < points.size(); ++i) {
    if (!remaining.empty() &&
        judged(points[i], remaining) < Ratio(Dyadic(density) * Dyadic(density)))
      continue;
    remaining.push_back(points[i]);
    numbers.push_back(i);
  }
  return numbers;
}

void expect_thinned_as_judged(const Scene& cloud, double density) {
  const long power = power_of_unit(cloud);
  EXPECT_EQ(thinned(PlacedCloud(cloud, power), density), judged_thinning(cloud, density))
      << density;
}

// Whole coordinates are often as far apart as the density exactly, or by one bit.
TEST(ThinnedClouds, KeepWhatRationalNumbersKeep) {
  std::mt19937 random(14);
  for (int round = 0; round < 20; ++round) {
    const Scene cloud = whole_cloud(random, 1 + static_cast<int>(random() % 12), 200);
    for (const double density : {1e-9, 1.0, 2.0, std::sqrt(2.0), std::sqrt(5.0), 3.0, 40.0}) {
      expect_thinned_as_judged(cloud, density);
      expect_thinned_as_judged(cloud, std::nextafter(density, 0));
      expect_thinned_as_judged(cloud, std::nextafter(density, 100));
    }
  }
}

TEST(ThinnedClouds, MayLieFarFromTheOrigin) {
  std::mt19937 random(15);
  for (const double density : {1.0, 2.0, std::nextafter(2.0, 3.0), 3.0})
    expect_thinned_as_judged(whole_cloud(random, 5, 200, 0x1p45), density);
}

TEST(ThinnedClouds, AreThinnedExactlyWhereBinary64RoundsThem) {
  std::mt19937 random(18);
  for (const double density : {0.125, 0.25, std::nextafter(0.25, 1.0), 0.75})
    expect_thinned_as_judged(moved_far(whole_cloud(random, 5, 200, 0, 0.125)), density);
}

TEST(ThinnedClouds, AreMeasuredOnEitherSide) {
  const Scene cloud = cloud_of({{0, 0, 0}, {0, 0, 0.5}, {0, 0, 1}, {0, 0, 1.75}});
  SurfaceComparisonOptions options = kept();
  options.density = options.truth_density = 1;
  const SurfaceComparison c =
      compare_surfaces(cloud, cloud_of({{0, 0, 1.75}, {0, 0, 1.5}}), {}, options);
  EXPECT_EQ(c.accuracy.cloud_points, 4U);
  ASSERT_EQ(c.accuracy.points, 2U);
  EXPECT_EQ(c.accuracy.measured[0].at[2], 0);
  EXPECT_EQ(c.accuracy.measured[1].at[2], 1);
  EXPECT_EQ(c.accuracy.max, 1.75);
  ASSERT_EQ(c.completeness.points, 1U);
  EXPECT_EQ(c.completeness.max, 0.75);
  EXPECT_EQ(c.overall, ((1.75 + 0.75) / 2 + 0.75) / 2);
  options.truth_density.reset();
  EXPECT_EQ(compare_surfaces(cloud, cloud, {}, options).completeness.points, 4U);
}

TEST(PointClouds, AreTheSameWithAnyNumberOfThreads) {
  std::mt19937 random(16);
  const Scene one = whole_cloud(random, 900, 30000), other = whole_cloud(random, 900, 30000);
  SurfaceComparisonOptions options;
  options.within = {20, 40};
  options.density = 15;
  options.truth_density = 10;
  options.threads = 1;
  const SurfaceComparison single = compare_surfaces(one, other, {}, options);
  options.threads = 3;
  const SurfaceComparison several = compare_surfaces(one, other, {}, options);
  EXPECT_EQ(single.accuracy.mean, several.accuracy.mean);
  EXPECT_EQ(single.completeness.points, several.completeness.points);
  EXPECT_EQ(single.completeness.rms, several.completeness.rms);
  EXPECT_EQ(single.f_scores, several.f_scores);
}

// Of a cloud every point counts; of the truth, what the camera sees.
TEST(PointClouds, HaveNoDepthsAndHideNothing) {
  Scene truth = plate(2);
  truth.meshes.push_back(plate(4).meshes[0]);
  truth.objects.push_back({.mesh = 1, .name = "behind"});
  const Scene cloud = cloud_of({{0, 0, 2}, {0, 0, 3}, {0, 0, -5}});
  const Camera camera = checks::camera_of(100, 100, 50);
  const Evaluation found = evaluate(cloud, truth, {camera}, kept());
  EXPECT_FALSE(found.depth);
  EXPECT_EQ(found.surfaces.accuracy.seen, 3U);
  EXPECT_EQ(found.surfaces.completeness.seen, 250U);
  EXPECT_FALSE(evaluate(truth, cloud, {camera}, kept()).depth);
}

TEST(PointClouds, NeedPointsAndOptionsThatApply) {
  const Scene cloud = cloud_of({{0, 0, 0}}), surface = plate(1);
  const auto message = [](const Scene& made, const Scene& truth,
                          const std::vector<Camera>& cameras = {},
                          const SurfaceComparisonOptions& options = {}) {
    return message_of<Error>([&] { compare_surfaces(made, truth, cameras, options); });
  };
  EXPECT_EQ(message(cloud_of({}), surface), "the reconstruction: has neither faces nor points");
  EXPECT_EQ(message(cloud, Scene()), "the truth: has neither faces nor points");
  Scene both = surface;
  both.meshes.push_back(cloud.meshes[0]);
  both.objects.push_back({.mesh = 1, .name = "cloud"});
  EXPECT_EQ(message(surface, both),
            "the truth: has meshes and point clouds, expected one or the other");
  const Camera camera = checks::camera_of(100, 100, 50);
  EXPECT_EQ(message(cloud, cloud, {camera}), "camera: sees surfaces; both sides are point clouds");
  SurfaceComparisonOptions dense, dense_truth;
  dense.density = dense_truth.truth_density = 1;
  EXPECT_EQ(message(surface, cloud, {}, dense),
            "density: thins a point cloud; the reconstruction has faces");
  EXPECT_EQ(message(cloud, surface, {}, dense_truth),
            "truth_density: thins a point cloud; the truth has faces");
  for (const double wrong : {0.0, -1.0, std::numeric_limits<double>::quiet_NaN(),
                             std::numeric_limits<double>::infinity()}) {
    SurfaceComparisonOptions thin, thin_truth, far;
    thin.density = thin_truth.truth_density = far.max_distance = wrong;
    EXPECT_EQ(message(surface, cloud, {}, thin_truth), "truth_density: expected a positive number");
    EXPECT_EQ(message(cloud, surface, {}, thin), "density: expected a positive number");
    EXPECT_EQ(message(cloud, surface, {}, far), "max_distance: expected a positive number");
  }
  const double nan = std::numeric_limits<double>::quiet_NaN();
  EXPECT_EQ(message(cloud_of({{0, 0, 0}, {0, nan, 0}}), surface),
            "scene: mesh 0: vertex 1 has a number that is not finite");
}

}  // namespace
}  // namespace fathom::evaluation
