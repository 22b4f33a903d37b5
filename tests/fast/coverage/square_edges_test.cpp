// Lengths between edges, integrated over the unit square: triangles and crossings on paper.
#include "fathom/fast/coverage/square_edges.h"

#include <gtest/gtest.h>

#include <algorithm>

namespace fathom {
namespace {

using namespace fast;

double in_square(double x) {
  return std::clamp(x, 0.0, 1.0);
}

/// The integral of the length right of the leftmost edge, up to the next, within the square.
double area_between(const SquareEdges& edges) {
  return edges.integrate([&](double height) {
    std::vector<double> crossings;
    for (const SquareEdges::Edge& e : edges.edges()) {
      if (e.low <= height && height <= e.high) crossings.push_back(e.at(height));
    }
    std::sort(crossings.begin(), crossings.end());
    double length = 0;
    for (std::size_t i = 0; i + 1 < crossings.size(); i += 2) {
      length += in_square(crossings[i + 1]) - in_square(crossings[i]);
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
  edges.cut(false);
  return edges;
}

void expect_area(const SquareEdges& edges, double expected) {
  EXPECT_NEAR(area_between(edges), expected, edges.error_of(6));
  EXPECT_LT(edges.error_of(6), 1e-11);
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
  edges.cut(false);
  expect_area(edges, 0.5);
  // With one tag they are taken not to cross, and the slab stays whole: its middle has no length.
  SquareEdges together;
  together.clear();
  together.add({0, 0}, {1, 1}, 5);
  together.add({1, 0}, {0, 1}, 5);
  together.cut(true);
  EXPECT_NEAR(area_between(together), 0, 1e-12);
}

TEST(SquareEdges, LevelEdgesDivideToo) {
  SquareEdges edges;
  edges.clear();
  edges.add({-3, 0.25}, {5, 0.25}, 0);
  edges.cut(false);
  // A length that jumps at the height of the edge is integrated exactly.
  const double area = edges.integrate([](double height) { return height > 0.25 ? 1.0 : 0.0; });
  EXPECT_EQ(area, 0.75);
}

TEST(SquareEdges, ClearForgets) {
  SquareEdges edges = triangle({0, 0}, {1, 0}, {0, 1});
  edges.clear();
  edges.cut(false);
  EXPECT_TRUE(edges.edges().empty());
  EXPECT_EQ(area_between(edges), 0);
}

}  // namespace
}  // namespace fathom
