#include "fathom/fast/coverage/edge_balance.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cstdint>
#include <map>
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
    for (const auto& edge : edges) balance.add(edge.from, edge.to);
    std::multiset<std::pair<std::uint32_t, std::uint32_t>> found;
    balance.for_each_left([&](const EdgeBalance::Edge& e) {
      EXPECT_GT(e.times, 0U);
      for (std::uint32_t k = 0; k < e.times; ++k) found.insert({e.from, e.to});
    });
    EXPECT_EQ(found, left);
  }
}

// Thousands of equal edges take one place.
TEST(EdgeBalance, EqualEdgesAreCounted) {
  const auto left_of = [](const EdgeBalance& balance) {
    std::vector<std::array<std::uint32_t, 3>> left;
    balance.for_each_left([&](const EdgeBalance::Edge& e) {
      left.push_back({e.from, e.to, e.times});
    });
    return left;
  };
  using Left = std::vector<std::array<std::uint32_t, 3>>;
  EdgeBalance balance;
  balance.start(1);
  for (int i = 0; i < 5000; ++i) balance.add(7, 3);
  EXPECT_EQ(left_of(balance), (Left{{7, 3, 5000}}));
  balance.add(3, 7, 4999);
  EXPECT_EQ(left_of(balance), (Left{{7, 3, 1}}));
  balance.add(3, 7, 3);
  EXPECT_EQ(left_of(balance), (Left{{3, 7, 2}}));
  // It grows, and they stay what they are.
  for (std::uint32_t i = 100; i < 1100; ++i) balance.add(i, i + 1, 2);
  for (std::uint32_t i = 100; i < 1100; ++i) balance.add(i + 1, i, i == 500 ? 1 : 2);
  balance.add(7, 3, 2);
  EXPECT_EQ(left_of(balance), (Left{{500, 501, 1}}));
}

/// How often each edge is there more than its opposite, by its ends in order.
class Balance {
 public:
  void add(std::uint32_t from, std::uint32_t to) {
    ++count_;
    (from < to ? times_[{from, to}] : times_[{to, from}]) += from < to ? 1 : -1;
  }
  [[nodiscard]] std::size_t count() const { return count_; }
  /// But for edges that cancel.
  [[nodiscard]] std::map<std::pair<std::uint32_t, std::uint32_t>, int> left() const {
    auto left = times_;
    std::erase_if(left, [](const auto& edge) { return edge.second == 0; });
    return left;
  }

 private:
  std::map<std::pair<std::uint32_t, std::uint32_t>, int> times_;
  std::size_t count_ = 0;
};

Balance left_by(const EdgeSieve& sieve) {
  Balance left;
  sieve.for_each_left([&](std::uint32_t from, std::uint32_t to) { left.add(from, to); });
  return left;
}

/// What a sieve leaves of edges has the same balance as all of them.
TEST(EdgeSieve, KeepsTheBalance) {
  std::mt19937_64 random(41);
  EdgeSieve sieve;
  for (int i = 0; i < 200; ++i) {
    SCOPED_TRACE(i);
    // Few vertices: edges that are there many times; many: all different, in few places.
    std::uniform_int_distribution<std::uint32_t> vertex(0, i % 2 ? 5 : 4'294'967'294U);
    const std::size_t count = 10 + static_cast<std::size_t>(i) * 5;
    sieve.start(count);
    Balance all;
    for (std::size_t k = 0; k < count; ++k) {
      const std::uint32_t from = vertex(random), to = vertex(random);
      if (from == to) continue;
      sieve.add(from, to);
      all.add(from, to);
    }
    EXPECT_EQ(left_by(sieve).left(), all.left());
  }
}

/// A grid of squares of two triangles, row by row: only what is around it is left, and few others.
TEST(EdgeSieve, LeavesLittleOfASurface) {
  constexpr std::uint32_t side = 60;
  EdgeSieve sieve;
  sieve.start(std::size_t{6} * side * side);
  for (std::uint32_t row = 0; row < side; ++row) {
    for (std::uint32_t column = 0; column < side; ++column) {
      const std::uint32_t a = row * (side + 1) + column, b = a + 1, c = a + side + 1, d = c + 1;
      for (const auto& [from, to] : {std::pair{a, b}, {b, c}, {c, a}, {b, d}, {d, c}, {c, b}}) {
        sieve.add(from, to);
      }
    }
  }
  const Balance left = left_by(sieve);
  EXPECT_EQ(left.left().size(), 4 * side);
  EXPECT_LT(left.count(), 4 * side + 6 * side * side / 20);
}

}  // namespace
}  // namespace fathom
