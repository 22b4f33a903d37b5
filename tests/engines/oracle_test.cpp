// The reference engine against rays cast in rational numbers, every channel, over random scenes.
#include <gtest/gtest.h>

#include "fathom/reference/probe.h"
#include "fathom/threads/threads.h"
#include "tests/effort.h"
#include "tests/engines/tested_engine.h"
#include "tests/inputs/random_scenes.h"
#include "tests/oracle/against_oracle.h"

namespace fathom {
namespace {

using checks::Case;
using checks::CaseMaker;
using checks::Kind;

struct Tally {
  int hits = 0, ties = 0, on_edges = 0;
  RenderStatistics statistics;
};

void add_ties(const Case& c, int x, int y, Tally& tally) {
  const auto seen =
      probe(c.scene, c.camera, static_cast<std::uint32_t>(x), static_cast<std::uint32_t>(y));
  if (seen.empty()) return;
  for (const Sign side : seen[0].edge_signs) tally.on_edges += side == Sign::zero;
  tally.ties += seen.size() > 1 && seen[1].counts && seen[0].depth == seen[1].depth;
}

void check(const Case& c, Tally& tally) {
  RenderOptions options;
  options.channels = checks::all_channels();
  options.threads = 1;
  const auto [map, statistics, doubtful] = checks::render_and_count(c.scene, c.camera, options);
  add(tally.statistics, statistics);
  const oracle::RayCaster rays = checks::cast_at(c.scene, c.camera);
  for (int y = 0; y < 5; ++y) {
    for (int x = 0; x < 6; ++x) {
      const auto hit = rays.cast(x, y);
      checks::expect_pixel(map, x, y, hit, c.scene);
      if (!hit) continue;
      ++tally.hits;
      add_ties(c, x, y, tally);
    }
  }
}

class Oracle : public ::testing::TestWithParam<std::tuple<Kind, int>> {};

TEST_P(Oracle, EveryChannelOfEveryPixelAgrees) {
  const auto [kind, part] = GetParam();
  CaseMaker maker(static_cast<std::uint64_t>(1000 * static_cast<int>(kind) + part), kind);
  Tally tally;
  const int scenes = checks::cases_to_draw(1200, 4);
  for (int i = 0; i < scenes && !HasFailure(); ++i) {
    SCOPED_TRACE("scene " + std::to_string(i) + " of this seed");
    check(maker.make(), tally);
  }
  // The scenes are worth their time: the hard cases are among them, and every tier was reached
  // (samples on edges of few bits are settled by the filter: its interval is the point 0).
  if (checks::effort > 1) return;
  EXPECT_GT(tally.hits, 4 * scenes);
  EXPECT_GT(tally.on_edges, scenes / 6);
  EXPECT_GT(tally.ties, scenes * 2 / 5);
  const auto count = static_cast<std::uint64_t>(scenes);
  EXPECT_GT(tally.statistics.visibility.exact, count * 2 / 5);
  EXPECT_GT(tally.statistics.edges.interval, kind == Kind::huge ? 0 : 8 * count);
  if (kind == Kind::neighbours || kind == Kind::huge) {
    EXPECT_GT(tally.statistics.edges.exact, count * 4 / 5);
    EXPECT_GT(tally.statistics.facing.exact, count * 4 / 5);
  }
}

INSTANTIATE_TEST_SUITE_P(RandomScenes, Oracle,
                         ::testing::Combine(::testing::Values(Kind::few_bits, Kind::neighbours,
                                                              Kind::huge, Kind::tiny),
                                            ::testing::Range(0, 3)));

}  // namespace
}  // namespace fathom
