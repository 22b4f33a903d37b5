#include "fathom/evaluation/nearest_surface.h"

#include <gtest/gtest.h>

#include <cmath>

#include "fathom/evaluation/box_tree.h"
#include "fathom/numeric/rounding.h"
#include "tests/effort.h"
#include "tests/evaluation/rational_judge.h"
#include "tests/evaluation/scenes.h"

namespace fathom::evaluation {
namespace {

TEST(ExactDistance, OfTrianglesWithoutArea) {
  const WorldPoint a{0.0, 0.0, 0.0}, b{4.0, 0.0, 0.0}, c{1.0, 0.0, 0.0};
  const WorldPoint p{3.0, 2.0, 0.0};
  const auto is = [](const Ratio& x, double value) { return compare(x, Ratio(value)) == 0; };
  EXPECT_TRUE(is(squared_distance(p, {a, b, c}), 4));
  EXPECT_TRUE(is(squared_distance(p, {c, a, b}), 4));
  EXPECT_TRUE(is(squared_distance(p, {a, a, c}), 8));
  EXPECT_TRUE(is(squared_distance(p, {a, a, a}), 13));
}

// Triangles of all shapes, thin ones and ones without area among them, and points anywhere, on
// corners, edges and in the plane too. The bounds hold, and mostly lie as near to each other as
// rounding lets them.
TEST(DistanceBounds, HoldAndAreTight) {
  std::mt19937 random(10);
  std::uniform_real_distribution<double> any(-1, 1);
  const auto coordinate = [&](int kind) {
    return kind == 0   ? any(random)
           : kind == 1 ? std::round(2 * any(random)) / 2
                       : 1e-6 * any(random);
  };
  int all = 0, wide = 0;
  for (int i = 0; i < 20000 / checks::effort; ++i) {
    const int kind = static_cast<int>(random() % 3);
    PlacedTriangles::Corners corners;
    for (Vector& corner : corners)
      for (double& x : corner) x = coordinate(kind);
    if (i % 4 == 0) corners[2] = corners[1];
    Vector p;
    for (double& x : p) x = coordinate(random() % 2 == 0 ? kind : 0);
    std::array<WorldPoint, 3> exact;
    for (std::size_t k = 0; k < 3; ++k) exact[k] = {corners[k][0], corners[k][1], corners[k][2]};
    const Ratio squared = squared_distance({p[0], p[1], p[2]}, exact);
    const double distance = round_sqrt_to_binary64(squared);
    const DistanceBounds found = distance_bounds(corners, p);
    ASSERT_LE(found.lower, distance);
    ASSERT_GE(found.upper, distance);
    if (distance < 1e-3) continue;
    ++all;
    wide += found.upper - found.lower > 4 * bounds::distance_error;
  }
  EXPECT_LT(wide, all / 50);
}

/// Of `points` points on one scene, the distance from another.
void expect_as_by_cgal(const Scene& from, const Scene& to, std::uint32_t points) {
  const TriangleSource from_source(from), to_source(to);
  const long power = std::max(power_of_unit(from_source), power_of_unit(to_source));
  const PlacedTriangles from_placed(from_source, power), to_placed(to_source, power);
  const BoxTree tree(to_placed);
  const NearestSurface nearest(to_source, to_placed, tree);
  for (const SurfacePoint& point : surface_points(from_placed, points)) {
    const double expected = test::squared_distance(from, point, to);
    const PlacedPoint p = placed(point, from_source, from_placed);
    ASSERT_EQ(round_to_binary64(nearest.squared_distance(p)), expected)
        << "triangle " << point.triangle << " at " << point.v << ", " << point.w;
  }
}

TEST(NearestSurface, IsThatOfCgal) {
  std::mt19937 random(4);
  for (int round = 0; round < 100 / checks::effort; ++round) {
    const int size = 2 + static_cast<int>(random() % 20);
    const Scene from = test::whole_soup(random, size, 1 + static_cast<int>(random() % 20));
    const Scene to = test::whole_soup(random, size, 1 + static_cast<int>(random() % 40));
    expect_as_by_cgal(from, to, 20);
    expect_as_by_cgal(from, from, 5);
  }
}

TEST(NearestSurface, IsThatOfCgalInUnitsThatBinary64HardlyHas) {
  std::mt19937 random(5);
  for (const double factor : {0x1p500, 0x1p-500}) {
    const Scene from = test::scaled(test::whole_soup(random, 9, 10), factor);
    const Scene to = test::scaled(test::whole_soup(random, 9, 30), factor);
    expect_as_by_cgal(from, to, 30);
  }
}

// Far from the origin a distance is the difference of numbers of which binary64 has few digits
// left.
TEST(NearestSurface, OfSurfacesFarFromTheOrigin) {
  std::mt19937 random(6);
  Scene from = test::whole_soup(random, 9, 10), to = test::whole_soup(random, 9, 30);
  for (Scene* scene : {&from, &to})
    for (MeshPoint& p : scene->meshes[0].vertices) p.x += 0x1p45;
  expect_as_by_cgal(from, to, 30);
}

TEST(SurfacePoints, StandInProportionToArea) {
  std::mt19937 random(7);
  const Scene scene = test::whole_soup(random, 9, 30);
  const TriangleSource source(scene);
  const PlacedTriangles placed(source, power_of_unit(source));
  constexpr std::uint32_t count = 20000;
  std::vector<int> counts(source.count());
  for (const SurfacePoint& point : surface_points(placed, count)) {
    ++counts[point.triangle];
    ASSERT_GE(point.v, 0);
    ASSERT_GE(point.w, 0);
    ASSERT_LE(point.v + point.w, 1);
    ASSERT_EQ(point.v * 0x1p25, std::floor(point.v * 0x1p25));
    ASSERT_EQ(point.w * 0x1p25, std::floor(point.w * 0x1p25));
  }
  std::vector<double> areas;
  double sum = 0;
  for (std::uint32_t t = 0; t < source.count(); ++t) {
    const auto X = source.world_corners(t);
    const Dyadic a[] = {X[1].x - X[0].x, X[1].y - X[0].y, X[1].z - X[0].z};
    const Dyadic b[] = {X[2].x - X[0].x, X[2].y - X[0].y, X[2].z - X[0].z};
    const Dyadic n[] = {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2],
                        a[0] * b[1] - a[1] * b[0]};
    areas.push_back(round_sqrt_to_binary64(Ratio(n[0] * n[0] + n[1] * n[1] + n[2] * n[2])) / 2);
    sum += areas.back();
  }
  for (std::uint32_t t = 0; t < source.count(); ++t)
    EXPECT_NEAR(counts[t], count * areas[t] / sum, 1.001) << t;
}

// Any quarter of a triangle gets a quarter of its points: the four that halve its edges.
TEST(SurfacePoints, StandEverywhereInATriangle) {
  const Scene scene = checks::scene_of({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}, {{0, 1, 2}});
  const TriangleSource source(scene);
  constexpr std::uint32_t count = 4000;
  std::array<int, 4> quarters{};
  for (const SurfacePoint& p : surface_points(PlacedTriangles(source, 1), count))
    ++quarters[p.v > 0.5 ? 0 : p.w > 0.5 ? 1 : p.v + p.w < 0.5 ? 2 : 3];
  for (const int quarter : quarters) EXPECT_NEAR(quarter, count / 4, 10);
}

}  // namespace
}  // namespace fathom::evaluation
