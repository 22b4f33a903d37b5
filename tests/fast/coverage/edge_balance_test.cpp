#include "fathom/fast/coverage/edge_balance.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdint>
#include <random>
#include <set>
#include <utility>
#include <vector>

namespace fathom {
namespace {

using namespace fast;

TEST(EdgeBalance, OppositeEdgesCancelWhateverTheOrder) {
  std::mt19937_64 random(22);
  for (int i = 0; i < 200; ++i) {
    std::vector<EdgeBalance::Edge> edges;
    std::multiset<std::pair<std::uint32_t, std::uint32_t>> left;
    std::uniform_int_distribution<std::uint32_t> vertex(0, i < 100 ? 12 : 4'000'000'000U);
    const auto add = [&](std::uint32_t from, std::uint32_t to) {
      edges.push_back({from, to});
      const auto opposite = left.find({to, from});
      if (opposite != left.end()) {
        left.erase(opposite);
      } else {
        left.insert({from, to});
      }
    };
    for (int k = 0; k < 300; ++k) {
      const std::uint32_t from = vertex(random), to = vertex(random);
      if (from == to) continue;
      add(from, to);
      if (k % 3 == 0) add(to, from);
    }
    std::shuffle(edges.begin(), edges.end(), random);
    EdgeBalance balance;
    balance.start(i % 2 == 0 ? 1 : 1000);
    for (const auto& [from, to] : edges) balance.add(from, to);
    std::multiset<std::pair<std::uint32_t, std::uint32_t>> found;
    balance.for_each_left([&](const EdgeBalance::Edge& e) { found.insert({e.from, e.to}); });
    EXPECT_EQ(found, left);
  }
}

}  // namespace
}  // namespace fathom
