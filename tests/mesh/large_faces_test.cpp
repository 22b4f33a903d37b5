// Faces of many corners, against the slow way to cut them.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <map>
#include <random>

#include "tests/mesh/slow_face.h"

namespace fathom {
namespace {

using checks::slow::Point2;
using mesh::triangulate_face;
using mesh::Triangulation;

using Points = std::vector<Point2>;
using Triangles = std::vector<std::array<std::uint32_t, 3>>;
using Random = std::mt19937;

constexpr double turn = 6.283185307179586;

double below(Random& random, int n) {
  return static_cast<double>(random() % static_cast<unsigned>(n));
}

Point2 at_angle(double angle, double radius) {
  return {radius * std::cos(angle), radius * std::sin(angle)};
}

Points star(Random& random, int n) {
  Points ring;
  for (int k = 0; k < n; ++k) ring.push_back(at_angle(turn * k / n, 20 + below(random, 80)));
  return ring;
}

/// Teeth in whole numbers, some of no height.
Points comb(Random& random, int n) {
  Points ring;
  for (int k = 0; k < n / 2; ++k) {
    ring.push_back({2.0 * k, 0});
    ring.push_back({2.0 * k + 1, below(random, 40)});
  }
  ring.push_back({static_cast<double>(n), 0});
  ring.push_back({static_cast<double>(n), 50});
  ring.push_back({0, 50});
  return ring;
}

Points spiral(Random& random, int n) {
  Points outside, inside;
  const double width = 0.5 + below(random, 10) / 100;
  for (int k = 0; k < n / 2; ++k) {
    const double angle = 0.2 * k, radius = 10 + 0.2 * angle;
    outside.push_back(at_angle(angle, radius));
    inside.push_back(at_angle(angle, radius - width));
  }
  outside.insert(outside.end(), inside.rbegin(), inside.rend());
  return outside;
}

/// A road that goes to and fro, each time with one bend: each bend lies in all those around it.
Points bends(Random&, int n) {
  Points right, left;
  const int roads = n / 6;
  const double reach = roads;
  const auto add = [](Points& side, double x, double up) { side.push_back({x, std::abs(x) + up}); };
  for (int k = 0; k < roads; ++k) {
    const double below = k, above = k + 0.25;
    const bool forth = k % 2 == 0;
    Points &lower = forth ? right : left, &upper = forth ? left : right;
    const double way = forth ? 1 : -1;
    const double lower_start = forth ? reach : reach, upper_start = reach + 1;
    add(lower, -way * lower_start, below);
    add(lower, 0, below);
    add(lower, way * (reach + 1), below);
    add(upper, -way * upper_start, above);
    add(upper, 0, above);
    add(upper, way * reach, above);
  }
  right.insert(right.end(), left.rbegin(), left.rend());
  return right;
}

/// Between a wide arc and uneven ground.
Points dome(Random& random, int n) {
  Points ring;
  for (int k = 0; k < n / 2; ++k) ring.push_back({k - n / 4.0, below(random, 1000) / 1000});
  for (int k = 1; k <= n / 2; ++k) {
    const Point2 p = at_angle(turn / 2 * k / (n / 2 + 1), n / 2.0);
    ring.push_back({p[0], p[1] + 2});
  }
  return ring;
}

using Shape = Points (*)(Random&, int);
constexpr Shape shapes[] = {star, comb, spiral, bends, dome};

/// Corners that repeat the one before, lie on sides, or in the middle of them: still simple.
void crowd(Random& random, Points& ring) {
  for (int i = 0; i < 10; ++i) {
    const auto k = static_cast<std::ptrdiff_t>(random() % ring.size());
    const Point2 a = ring[k], b = ring[(k + 1) % ring.size()];
    const bool repeats = random() % 3 == 0;
    ring.insert(ring.begin() + k + 1,
                repeats ? a : Point2{a[0] / 2 + b[0] / 2, a[1] / 2 + b[1] / 2});
  }
}

/// Makes a ring touch or cross itself, mostly: a corner moved to another, onto a side, or anywhere.
void spoil(Random& random, Points& ring) {
  const std::size_t i = random() % ring.size(), k = random() % ring.size();
  const Point2 a = ring[k], b = ring[(k + 1) % ring.size()];
  switch (random() % 4) {
    case 0:
      ring[i] = a;
      return;
    case 1:
      ring[i] = {a[0] / 2 + b[0] / 2, a[1] / 2 + b[1] / 2};
      return;
    case 2:
      ring[i] = ring[(i + 2) % ring.size()];
      return;
    default:
      std::swap(ring[i], ring[k]);
  }
}

void turn_about(Random& random, Points& ring) {
  if (random() % 2 == 0) std::reverse(ring.begin(), ring.end());
  std::rotate(ring.begin(), ring.begin() + static_cast<std::ptrdiff_t>(random() % ring.size()),
              ring.end());
}

class LargeFaces : public ::testing::TestWithParam<Shape> {};

TEST_P(LargeFaces, AreCutAsTheSlowWayCutsThem) {
  Random random(51);
  std::map<Triangulation, int> kinds;
  for (int i = 0; i < 200; ++i) {
    // On both sides of the number up to which edges are compared pair by pair.
    Points points = GetParam()(random, 40 + static_cast<int>(random() % 400));
    if (random() % 2 == 0) crowd(random, points);
    if (random() % 3 == 0) spoil(random, points);
    turn_about(random, points);
    std::vector<MeshPoint> ring;
    for (const Point2& p : points) ring.push_back({p[0], p[1], 0});
    Triangles triangles, truth;
    const Triangulation kind = triangulate_face(ring, triangles);
    const Triangulation true_kind = checks::slow::triangulate(points, truth);
    ASSERT_EQ(kind, true_kind) << i;
    ASSERT_EQ(triangles, truth) << i;
    ++kinds[kind];
  }
  EXPECT_GT(kinds[Triangulation::ear_clipping], 50);
  EXPECT_GT(kinds[Triangulation::fallback_fan], 20);
}

INSTANTIATE_TEST_SUITE_P(EachShape, LargeFaces, ::testing::ValuesIn(shapes));

}  // namespace
}  // namespace fathom
