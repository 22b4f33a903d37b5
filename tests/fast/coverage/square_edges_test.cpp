// Lengths between edges, integrated over the unit square: triangles and crossings on paper.
#include "fathom/fast/coverage/square_edges.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <vector>

namespace fathom {
namespace {

using namespace fast;

double in_square(double x) {
  return std::clamp(x, 0.0, 1.0);
}

const auto divided = [](const SquareEdges::Strip&) { return -1.0; };

/// The integral of the length right of the leftmost edge, up to the next, within the square.
double area_between(SquareEdges& edges) {
  return edges.integrate(divided, [](const SquareEdges::Slab& slab) {
    double length = 0;
    for (std::size_t i = 0; i < slab.crossings.size(); i += 2) {
      const auto rest = slab.crossings.subspan(i);
      length += in_square(rest.size() > 1 ? rest[1].x : 1) - in_square(rest[0].x);
    }
    return length;
  });
}

SquareEdges triangle(const SquarePoint& a, const SquarePoint& b, const SquarePoint& c) {
  SquareEdges edges;
  edges.clear();
  edges.add(a, b, 0);
  edges.add(b, c, 1);
  edges.add(c, a, 2);
  return edges;
}

void expect_area(SquareEdges edges, double expected) {
  const double area = area_between(edges);
  EXPECT_NEAR(area, expected, edges.error(area));
  EXPECT_LT(edges.error(area), 1e-11);
}

TEST(SquareEdges, TrianglesInTheSquareAndAcrossItsSides) {
  expect_area(triangle({0, 0}, {1, 0}, {0, 1}), 0.5);
  expect_area(triangle({0.25, 0.25}, {0.75, 0.25}, {0.5, 0.75}), 0.125);
  expect_area(triangle({-1, -1}, {3, -1}, {-1, 3}), 1);  // beyond all sides: x + y ≤ 2
  expect_area(triangle({-2, 0}, {1, 0}, {1, 1}), 2.5 / 3);
  expect_area(triangle({2, 0}, {3, 0}, {2, 1}), 0);
  expect_area(triangle({0.5, -1}, {0.5, 2}, {9, 0.5}), 0.5);
}

/// Two edges that cross within the square: the length between them is not linear in the height.
TEST(SquareEdges, ACrossingDividesASlab) {
  SquareEdges edges;
  edges.clear();
  edges.add({0, 0}, {1, 1}, 0);
  edges.add({1, 0}, {0, 1}, 1);
  expect_area(edges, 0.5);
}

TEST(SquareEdges, LevelEdgesDivideToo) {
  SquareEdges edges;
  edges.clear();
  edges.add({-3, 0.25}, {5, 0.25}, 0);
  // A length that jumps at the height of the edge is integrated exactly.
  const double area = edges.integrate(
      divided, [](const SquareEdges::Slab& slab) { return slab.middle > 0.25 ? 1.0 : 0.0; });
  EXPECT_EQ(area, 0.75);
}

/// What grows by a tag from the left of an edge to its right, followed along the left side.
TEST(SquareEdges, TheLeftSideIsFollowed) {
  SquareEdges edges;
  edges.clear();
  edges.add({0.5, 0.125}, {-0.5, 0.375}, 3);   // at height 0.25 to the left
  edges.add({-0.5, 0.375}, {0.5, 0.625}, 5);   // at height 0.5 to the right
  edges.add({-1, 0.75}, {2, 0.75}, 7);         // level, from the upper end, at 2, to the left
  edges.add({-0.5, 0.875}, {0, 0.9375}, 11);   // to x = 0, which is on the right
  edges.add({0, 0.9375}, {0.25, 0.96875}, 1);  // and on
  std::vector<std::int32_t> found;
  edges.for_each_slab([](const SquareEdges::Strip&) { return false; },
                      [&](const SquareEdges::Slab& slab) {
                        if (found.empty() || found.back() != slab.passed)
                          found.push_back(slab.passed);
                        return true;
                      });
  EXPECT_EQ(found, (std::vector<std::int32_t>{0, 3, -2, 5, -6}));
  int visits = 0;
  edges.for_each_slab([](const SquareEdges::Strip&) { return false; },
                      [&](const SquareEdges::Slab&) { return ++visits < 2; });
  EXPECT_EQ(visits, 2);
}

/// Strips between ends at 0.25 and 0.75: an edge in the square, one that comes into it, and ones
/// beyond its sides, of which only the first two count.
TEST(SquareEdges, StripsSayWhatEdgesCanChange) {
  SquareEdges edges;
  edges.clear();
  edges.add({0.5, 0.25}, {0.25, 0.75}, 2);
  edges.add({-0.5, 0.25}, {0.5, 0.75}, 3);
  edges.add({-0.5, 0.25}, {-0.25, 0.75}, 100);
  edges.add({1.5, 0.25}, {1.25, 0.75}, 1000);
  std::vector<std::array<std::int32_t, 3>> found;
  const double sum = edges.integrate(
      [&](const SquareEdges::Strip& strip) {
        found.push_back({strip.passed, strip.least, strip.greatest});
        return strip.thickness < 0.3 ? 1.0 : 0.5;
      },
      [](const SquareEdges::Slab&) { return 1e9; });
  EXPECT_EQ(found, (std::vector<std::array<std::int32_t, 3>>{{0, 0, 0}, {0, -3, 2}, {-3, 0, 0}}));
  EXPECT_EQ(sum, 0.75);
}

TEST(SquareEdges, ClearForgets) {
  SquareEdges edges = triangle({0, 0}, {1, 0}, {0, 1});
  edges.clear();
  EXPECT_TRUE(edges.edges().empty());
  EXPECT_EQ(area_between(edges), 0);
}

}  // namespace
}  // namespace fathom
