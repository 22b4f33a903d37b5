// What lies below an edge, against a search through all edges.
#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <random>
#include <set>

#include "fathom/clipping/exact_kernel.h"
#include "fathom/clipping/weiler_atherton/edge_order.h"
#include "fathom/clipping/weiler_atherton/side_contacts.h"
#include "tests/clipping/print.h"
#include "tests/clipping/random_polygons.h"
#include "tests/effort.h"

namespace fathom::clipping::test {
namespace {

using P = Point2<Rational>;

struct Edges {
  std::vector<P> points;
  std::vector<UndirectedEdge> edges;
};

/// The edges of one side; none where its rings cross.
Edges edges_of(const Rings<Rational>& rings) {
  const auto corners = numbered(rings);
  const auto touching = enter_touches(corners.rings, PointOrder(corners.points));
  std::set<UndirectedEdge> edges;
  if (const auto* split = std::get_if<NumberedRings>(&touching))
    for (const NumberedRing& ring : *split)
      for (std::size_t i = 0; i < ring.size(); ++i)
        edges.insert(undirected(ring[i], following(ring, i)));
  return {corners.points, {edges.begin(), edges.end()}};
}

/// The height of the edge at x; it is not upright.
Rational height_at(const P& left, const P& right, const Rational& x) {
  return left.y + (x - left.x) * (right.y - left.y) / (right.x - left.x);
}

/// The highest edge below the middle of edge e, which is not upright.
std::optional<std::size_t> below_slowly(const Edges& all, std::size_t e) {
  const P &left = all.points[all.edges[e].left], &right = all.points[all.edges[e].right];
  // So near the left end that no other point lies between.
  const Rational x = left.x + (right.x - left.x) / 1000000;
  const Rational y = height_at(left, right, x);
  std::optional<std::size_t> below;
  Rational greatest;
  for (std::size_t i = 0; i < all.edges.size(); ++i) {
    const P &p = all.points[all.edges[i].left], &q = all.points[all.edges[i].right];
    if (!(p.x < x && x < q.x)) continue;
    const Rational height = height_at(p, q, x);
    if (height < y && (!below || height > greatest)) below = i, greatest = height;
  }
  return below;
}

TEST(Sweep, ATriangleInASquareOnPaper) {
  const Edges all = edges_of({{{0, 0}, {6, 0}, {6, 6}, {0, 6}}, {{1, 3}, {5, 1}, {5, 5}}});
  const auto swept = sweep(all.edges, PointOrder(all.points));
  ASSERT_EQ(swept.size(), 7U);
  std::map<std::pair<P, P>, std::optional<std::pair<P, P>>> below;
  const auto ends = [&](std::size_t e) {
    return std::pair(all.points[all.edges[e].left], all.points[all.edges[e].right]);
  };
  for (const auto& [edge, under] : swept) {
    below[ends(edge)] = under ? std::optional(ends(*under)) : std::nullopt;
  }
  const std::pair bottom(P{0, 0}, P{6, 0}), lower(P{1, 3}, P{5, 1}), upper(P{1, 3}, P{5, 5});
  EXPECT_EQ(below[bottom], std::nullopt);
  EXPECT_EQ((below[{P{0, 0}, P{0, 6}}]), bottom);  // upright: what is right of it
  EXPECT_EQ((below[{P{0, 6}, P{6, 6}}]), bottom);
  EXPECT_EQ(below[lower], bottom);
  EXPECT_EQ(below[upper], lower);
  EXPECT_EQ((below[{P{5, 1}, P{5, 5}}]), bottom);
  EXPECT_EQ((below[{P{6, 0}, P{6, 6}}]), std::nullopt);
}

TEST(Sweep, IsTheHighestEdgeBelow) {
  PolygonMaker maker(231);
  std::size_t tested = 0;
  for (int i = 0; i < 2000 / checks::effort; ++i) {
    const auto never = [](const Rings<double>&) { return false; };
    const Edges all = edges_of(to_exact(maker.polygon(4 + i % 5, 10, never)));
    std::vector<bool> met(all.edges.size(), false);
    for (const auto& [edge, below] : sweep(all.edges, PointOrder(all.points))) {
      met[edge] = true;
      if (below) {
        EXPECT_TRUE(met[*below]);
      }
      if (all.points[all.edges[edge].left].x == all.points[all.edges[edge].right].x) continue;
      ASSERT_EQ(below, below_slowly(all, edge)) << "polygon " << i;
      ++tested;
    }
    EXPECT_EQ(std::count(met.begin(), met.end(), true), std::ssize(all.edges));
  }
  EXPECT_GT(tested, 3000U / checks::effort);
}

}  // namespace
}  // namespace fathom::clipping::test
