#include "fathom/mesh/triangulate_face.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

#include "tests/effort.h"
#include "tests/mesh/face_oracle.h"

namespace fathom {
namespace {

using namespace mesh;
using checks::FaceOracle;
using checks::Ring;
using checks::Triangles;
using ::testing::ElementsAre;

void expect_like_oracle(const Ring& ring) {
  Triangles triangles;
  const Triangulation kind = triangulate_face(ring, triangles);
  const auto [truth, warn] = FaceOracle(ring).run();
  const auto shown = [&] {
    std::string text;
    for (const MeshPoint& p : ring)
      text += "{" + std::to_string(p.x) + ", " + std::to_string(p.y) + ", " + std::to_string(p.z) +
              "} ";
    return text;
  };
  ASSERT_EQ(triangles, truth) << shown();
  ASSERT_EQ(kind == Triangulation::fallback_fan, warn && ring.size() > 3) << shown();
}

/// Rings of few bits, so that straight, repeated and touching corners abound.
TEST(TriangulateFace, AgreesWithTheOracleOnRandomRings) {
  std::mt19937 random(31);
  std::array<int, 3> kinds{};
  for (int i = 0; i < 30'000 / checks::effort; ++i) {
    const int corners = 4 + static_cast<int>(random() % 6),
              reach = 2 + static_cast<int>(random() % 5);
    const bool flat = random() % 2 == 0;
    Ring ring;
    for (int k = 0; k < corners; ++k) {
      const double x = random() % reach, y = random() % reach;
      ring.push_back({x, y, flat ? x + 2 * y : static_cast<double>(random() % reach)});
    }
    ASSERT_NO_FATAL_FAILURE(expect_like_oracle(ring));
    Triangles triangles;
    ++kinds[static_cast<int>(triangulate_face(ring, triangles))];
  }
  for (const int count : kinds) EXPECT_GT(count, checks::effort == 1 ? 500 : 10);
}

/// A star-shaped ring is simple: angles ascend. Some corners are repeated, some lie on edges.
Ring star_ring(std::mt19937& random, int corners) {
  Ring ring;
  for (int k = 0; k < corners; ++k) {
    const double angle = 6.283185307179586 * k / corners,
                 radius = 1 + static_cast<double>(random() % 64);
    ring.push_back(
        {std::round(16 * radius * std::cos(angle)), std::round(16 * radius * std::sin(angle)), 7});
    if (random() % 5 == 0) ring.push_back(ring.back());
  }
  return ring;
}

TEST(TriangulateFace, AgreesWithTheOracleOnConcaveRings) {
  std::mt19937 random(32);
  for (int i = 0; i < 2000 / checks::effort; ++i) {
    Ring ring = star_ring(random, 5 + static_cast<int>(random() % 20));
    if (i % 2 == 0) std::reverse(ring.begin(), ring.end());
    if (i % 3 == 0)
      for (MeshPoint& p : ring) p = {p.z, p.x, p.y};
    ASSERT_NO_FATAL_FAILURE(expect_like_oracle(ring));
  }
}

/// Signed areas add up exactly whatever the ring; triangles of a simple one all turn its way.
TEST(TriangulateFace, KeepsTheArea) {
  std::mt19937 random(33);
  for (int i = 0; i < 200; ++i) {
    const Ring ring = star_ring(random, 40);
    Triangles triangles;
    const Triangulation kind = triangulate_face(ring, triangles);
    ASSERT_EQ(triangles.size(), ring.size() - 2);
    double ring_area = 0, sum = 0;  // whole numbers below 2⁵³: exact
    for (std::size_t k = 0; k < ring.size(); ++k) {
      const MeshPoint &a = ring[k], &b = ring[(k + 1) % ring.size()];
      ring_area += a.x * b.y - a.y * b.x;
    }
    for (const auto& t : triangles) {
      const MeshPoint &a = ring[t[0]], &b = ring[t[1]], &c = ring[t[2]];
      const double area = (b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x);
      ASSERT_TRUE(kind != Triangulation::ear_clipping || area >= 0);
      sum += area;
    }
    ASSERT_EQ(sum, ring_area);
  }
}

TEST(TriangulateFace, ProjectsAlongTheFirstOfEqualAxes) {
  EXPECT_EQ(projection_axis(Ring{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}), 0);
  EXPECT_EQ(projection_axis(Ring{{0, 0, 0}, {1, 0, 0}, {1, 1, 1}, {0, 1, 1}}), 1);
  EXPECT_EQ(projection_axis(Ring{{0, 0, 0}, {1, 0, 0}, {1, 1, 0.5}, {0, 1, 0.5}}), 2);
  EXPECT_EQ(projection_axis(Ring{{0, 0, 0}, {1, 1, 1}, {2, 2, 2}}), -1);
  // One nextafter decides.
  const double more = std::nextafter(1.0, 2.0);
  EXPECT_EQ(projection_axis(Ring{{0, 0, 0}, {1, 0, 0}, {1, more, 1}, {0, more, 1}}), 2);
  // Beyond the range of binary64 products.
  EXPECT_EQ(projection_axis(Ring{{1e300, 0, 0}, {0, 1e300, 0}, {0, 0, 1e300}}), 0);
  EXPECT_EQ(projection_axis(Ring{{0, 0, 0}, {5e-324, 0, 0}, {0, 5e-324, 0}}), 2);
  EXPECT_EQ(projection_axis(Ring{{-1e308, -1e308, 1}, {1e308, -1e308, 1}, {1e308, 1e308, 1}}), 2);
}

TEST(TriangulateFace, KnownShapes) {
  Triangles t;
  // A pentagram turns one way and winds twice: no convex ring, not simple.
  EXPECT_EQ(triangulate_face(Ring{{0, 3, 0}, {-2, -3, 0}, {3, 1, 0}, {-3, 1, 0}, {2, -3, 0}}, t),
            Triangulation::fallback_fan);
  // A square with a corner in the middle of a side and one doubled.
  t.clear();
  EXPECT_EQ(
      triangulate_face(Ring{{0, 0, 0}, {1, 0, 0}, {2, 0, 0}, {2, 2, 0}, {2, 2, 0}, {0, 2, 0}}, t),
      Triangulation::convex_fan);
  // A spike out and back.
  t.clear();
  EXPECT_EQ(triangulate_face(Ring{{0, 0, 0}, {2, 0, 0}, {4, 0, 0}, {2, 0, 0}, {0, 2, 0}}, t),
            Triangulation::fallback_fan);
  // An arrowhead: only corners 1 and 3 are ears.
  t.clear();
  EXPECT_EQ(triangulate_face(Ring{{0, 0, 0}, {3, -2, 0}, {1, 0, 0}, {3, 2, 0}}, t),
            Triangulation::ear_clipping);
  EXPECT_THAT(
      t, ElementsAre(std::array<std::uint32_t, 3>{0, 1, 2}, std::array<std::uint32_t, 3>{0, 2, 3}));
  t.clear();
  EXPECT_EQ(triangulate_face(Ring{{1, 1, 1}, {1, 1, 1}, {1, 1, 1}, {1, 1, 1}}, t),
            Triangulation::fallback_fan);
  EXPECT_EQ(t.size(), 2U);
}

}  // namespace
}  // namespace fathom
