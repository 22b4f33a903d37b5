#include <gtest/gtest.h>

#include <array>
#include <map>
#include <random>

#include "fathom/fast/rounds/kept_triangles.h"

namespace fathom::fast {
namespace {

TEST(DistinctVertices, NumbersPointsInTheirOrder) {
  DistinctVertices vertices;
  EXPECT_EQ(vertices.number_of({1, 2, 3}), 0U);
  EXPECT_EQ(vertices.number_of({3, 2, 1}), 1U);
  EXPECT_EQ(vertices.number_of({1, 2, 3}), 0U);
  // Equal numbers, though not the same: nobody need prove that they are taken to the same place.
  EXPECT_EQ(vertices.number_of({0, 2, 3}), 2U);
  EXPECT_EQ(vertices.number_of({-0.0, 2, 3}), 3U);
  EXPECT_EQ(vertices.size(), 4U);
  const std::vector<MeshPoint> points = vertices.take();
  ASSERT_EQ(points.size(), 4U);
  EXPECT_EQ(points[1].x, 3);
  EXPECT_EQ(vertices.size(), 0U);
  EXPECT_EQ(vertices.number_of({3, 2, 1}), 0U);
}

TEST(DistinctVertices, AsAMapSays) {
  std::mt19937 random(1713);
  DistinctVertices vertices;
  std::map<std::array<double, 3>, std::uint32_t> truth;
  for (int i = 0; i < 20000; ++i) {
    if (i == 500) vertices.reserve(3000);
    // A grid, whose numbers have few bits that are not 0.
    const auto coordinate = [&] { return static_cast<double>(random() % 16) / 8; };
    const std::array<double, 3> p{coordinate(), coordinate(), coordinate()};
    const auto next = static_cast<std::uint32_t>(truth.size());
    const std::uint32_t expected = truth.try_emplace(p, next).first->second;
    ASSERT_EQ(vertices.number_of({p[0], p[1], p[2]}), expected);
  }
  const std::vector<MeshPoint> points = vertices.take();
  ASSERT_EQ(points.size(), truth.size());
  for (const auto& [p, number] : truth) {
    EXPECT_EQ(points[number].x, p[0]);
    EXPECT_EQ(points[number].y, p[1]);
    EXPECT_EQ(points[number].z, p[2]);
  }
}

}  // namespace
}  // namespace fathom::fast
