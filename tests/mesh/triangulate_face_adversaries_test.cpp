// Faces from families that are each hard for a reason of their own, against the rule of the
// specification in rational numbers; and whatever the rule, no part of a face is lost or doubled.
#include <gtest/gtest.h>

#include <cstdio>
#include <map>

#include "fathom/mesh/triangulate_face.h"
#include "tests/adversaries.h"
#include "tests/inputs/hard_faces.h"
#include "tests/mesh/face_oracle.h"

namespace fathom {
namespace {

using checks::FaceFamily;
using checks::Ring;
using checks::Triangles;
using mesh::triangulate_face;
using mesh::Triangulation;

std::string text_of(const Ring& ring) {
  std::string text;
  for (const MeshPoint& p : ring) {
    char corner[100];
    std::snprintf(corner, sizeof corner, "{%a, %a, %a}, ", p.x, p.y, p.z);
    text += corner;
  }
  return text;
}

/// The sides of the triangles, those that two share in opposite directions left out, are the
/// ring's.
void expect_the_rings_sides(std::size_t corners, const Triangles& triangles) {
  std::map<std::pair<std::uint32_t, std::uint32_t>, int> ways;
  const auto go = [&](std::uint32_t from, std::uint32_t to, int way) {
    if (from < to) ways[{from, to}] += way;
    if (to < from) ways[{to, from}] -= way;
  };
  for (const auto& t : triangles) {
    for (std::size_t i = 0; i < 3; ++i) go(t[i], t[(i + 1) % 3], 1);
  }
  for (std::uint32_t k = 0; k < corners; ++k) {
    go(k, static_cast<std::uint32_t>((k + 1) % corners), -1);
  }
  for (const auto& [side, way] : ways) EXPECT_EQ(way, 0) << side.first << " to " << side.second;
}

/// Where triangles have the ring's sides and none turns the other way, each point is covered as
/// many times as the ring goes round it.
void expect_one_way(const checks::FaceOracle& oracle, const Triangles& triangles) {
  for (const auto& t : triangles) {
    EXPECT_GE(oracle.turn_of(t) * oracle.way(), 0) << t[0] << " " << t[1] << " " << t[2];
  }
}

class TriangulateFaceAdversaries : public ::testing::TestWithParam<FaceFamily> {};

TEST_P(TriangulateFaceAdversaries, AreCutByTheRule) {
  std::map<Triangulation, int> kinds;
  constexpr std::uint64_t faces = 1500;
  checks::for_each_adversary(faces, [&](std::uint64_t seed) {
    const Ring ring = checks::hard_face(GetParam(), seed);
    SCOPED_TRACE(text_of(ring));
    Triangles triangles;
    const Triangulation kind = triangulate_face(ring, triangles);
    const checks::FaceOracle oracle(ring);
    const auto [truth, warn] = oracle.run();
    EXPECT_EQ(triangles, truth);
    EXPECT_EQ(kind == Triangulation::fallback_fan, warn);
    expect_the_rings_sides(ring.size(), triangles);
    if (kind != Triangulation::fallback_fan) expect_one_way(oracle, triangles);
    ++kinds[kind];
  });
  if (checks::number_of_adversaries(faces) < 500) return;
  for (const Triangulation kind :
       {Triangulation::convex_fan, Triangulation::ear_clipping, Triangulation::fallback_fan}) {
    EXPECT_GT(kinds[kind], 3) << static_cast<int>(kind);
  }
}

INSTANTIATE_TEST_SUITE_P(EachFamily, TriangulateFaceAdversaries,
                         ::testing::ValuesIn(checks::all_face_families),
                         [](const auto& test) { return checks::name_of(test.param); });

}  // namespace
}  // namespace fathom
