// Visible edges against a judge that compares all triangles at the middle of every piece of every
// line.
#include "fathom/area/visible_edges.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>

#include "fathom/failures/errors.h"
#include "tests/adversaries.h"
#include "tests/area/crowds.h"
#include "tests/area/judged_edges.h"
#include "tests/area/surfaces.h"
#include "tests/inputs/adversarial_scenes.h"
#include "tests/inputs/random_scenes.h"
#include "tests/inputs/soup.h"
#include "tests/inputs/spheres.h"
#include "tests/oracle/against_oracle.h"

namespace fathom {
namespace {

using oracle::Point;
using oracle::Q;
using testing::Case;
using testing::JudgedEdge;

std::vector<VisibleEdge> edges_of(const Scene& scene, const Camera& camera,
                                  const EdgeOptions& options = {.edges = EdgeSelection::all}) {
  std::vector<VisibleEdge> edges;
  visible_edges(scene, camera, options, [&](const VisibleEdge& edge) { edges.push_back(edge); });
  return edges;
}

Point point_of(const ImagePlace& place) {
  return {testing::rational(place.u), testing::rational(place.v)};
}

testing::JudgedScene judged_scene(const Scene& scene, const Camera& camera) {
  testing::JudgedScene judged{
      testing::ray_camera(camera), camera.width, camera.height, testing::triangles_of(scene), {}};
  const TriangleSource triangles(scene);
  for (std::uint32_t number = 0; number < triangles.count(); ++number)
    judged.objects.push_back(triangles.origin(number).object);
  return judged;
}

/// Whether p lies on the segment.
bool is_between(const Point& from, const Point& to, const Point& p) {
  const Q turn = (to[0] - from[0]) * (p[1] - from[1]) - (to[1] - from[1]) * (p[0] - from[0]);
  return sgn(turn) == 0 && std::min(from, to) <= p && p <= std::max(from, to);
}

/// Every piece of the judge is on one edge, with its sides, and the ends of an edge are ends of
/// pieces.
void expect_judged(const std::vector<VisibleEdge>& edges, const std::vector<JudgedEdge>& pieces) {
  std::vector<bool> is_found(pieces.size());
  for (const VisibleEdge& edge : edges) {
    const Point from = point_of(edge.from), to = point_of(edge.to);
    Q length = 0;
    for (std::size_t k = 0; k < pieces.size(); ++k) {
      const JudgedEdge& piece = pieces[k];
      if (!is_between(from, to, piece.from) || !is_between(from, to, piece.to)) continue;
      EXPECT_FALSE(is_found[k]) << "drawn twice";
      is_found[k] = true;
      EXPECT_EQ(edge.owner, piece.owner);
      EXPECT_EQ(edge.other, piece.other ? *piece.other : VisibleEdge::background);
      EXPECT_EQ(edge.joined, piece.joined);
      length += abs(piece.to[0] - piece.from[0]) + abs(piece.to[1] - piece.from[1]);
    }
    EXPECT_EQ(length, abs(to[0] - from[0]) + abs(to[1] - from[1])) << "a stub";
  }
  EXPECT_EQ(std::ranges::count(is_found, false), 0) << "a gap";
}

/// Edges of one name are in order, and joined where they can be.
void expect_merged(const std::vector<VisibleEdge>& edges) {
  for (std::size_t k = 1; k < edges.size(); ++k) {
    const VisibleEdge &a = edges[k - 1], &b = edges[k];
    if (a.name != b.name) continue;
    EXPECT_LE(point_of(a.to), point_of(b.from));
    const bool is_same = a.owner == b.owner && a.other == b.other && a.joined == b.joined;
    EXPECT_FALSE(is_same && point_of(a.to) == point_of(b.from)) << "cut in two";
  }
}

void expect_as_judged(const Scene& scene, const Camera& camera) {
  const std::vector<JudgedEdge> pieces = testing::judged_edges(judged_scene(scene, camera));
  const std::vector<VisibleEdge> edges = edges_of(scene, camera);
  expect_judged(edges, pieces);
  expect_merged(edges);
  std::vector<JudgedEdge> outlines;
  std::ranges::copy_if(pieces, std::back_inserter(outlines),
                       [](const JudgedEdge& piece) { return !piece.joined; });
  expect_judged(edges_of(scene, camera, {.edges = EdgeSelection::silhouettes}), outlines);
}

TEST(VisibleEdgesAdversaries, AreJudged) {
  for (const testing::Family family : testing::all_families) {
    SCOPED_TRACE(name_of(family));
    testing::for_each_adversary(12, [&](std::uint64_t seed) {
      const Case c = testing::adversarial_case(family, seed);
      expect_as_judged(c.scene, c.camera);
    });
  }
}

TEST(VisibleEdges, OfRandomScenesAreJudged) {
  for (const testing::Kind kind : {testing::Kind::few_bits, testing::Kind::neighbours,
                                   testing::Kind::huge, testing::Kind::tiny}) {
    testing::CaseMaker maker(54 + static_cast<std::uint64_t>(kind), kind);
    for (int i = 0; i < 60 / testing::effort && !HasFailure(); ++i) {
      SCOPED_TRACE(i);
      const Case c = maker.make();
      expect_as_judged(c.scene, c.camera);
    }
  }
}

TEST(VisibleEdges, OfCrowdsAreJudged) {
  for (const testing::Crowd& crowd : testing::crowds()) {
    SCOPED_TRACE(crowd.name);
    expect_as_judged(crowd.scene, testing::plain_camera(1, 1));
    expect_as_judged(crowd.scene, testing::plain_camera(3, 2));
  }
}

}  // namespace
}  // namespace fathom
