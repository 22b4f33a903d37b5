#include "fathom/triangle/recent_triangles.h"

#include <gtest/gtest.h>

#include <vector>

namespace fathom {
namespace {

using namespace triangle;

struct Fact {
  std::uint32_t number = 0xFFFFFFFF;
};

TEST(RecentTriangles, FactsAreFoundOutOnceWhileTheyAreRemembered) {
  RecentTriangles<Fact, 8> recent;
  std::vector<std::uint32_t> made;
  const auto fact = [&](std::uint32_t number) {
    return recent
        .get(number,
             [&](Fact& made_now) {
               made_now.number = number;
               made.push_back(number);
             })
        .number;
  };
  for (int round = 0; round < 3; ++round) {
    for (std::uint32_t number = 40; number < 48; ++number) EXPECT_EQ(fact(number), number);
  }
  EXPECT_EQ(made.size(), 8U);
  // One that shares a place drives one out, and is told from it.
  EXPECT_EQ(fact(48), 48U);
  EXPECT_EQ(fact(41), 41U);
  EXPECT_EQ(made.size(), 9U);
  EXPECT_EQ(fact(40), 40U);
  EXPECT_EQ(made, (std::vector<std::uint32_t>{40, 41, 42, 43, 44, 45, 46, 47, 48, 40}));
}

/// An empty place does not pass for the triangle 0.
TEST(RecentTriangles, NumberZeroIsNotKnownAtFirst) {
  RecentTriangles<Fact, 4> recent;
  bool made = false;
  recent.get(0, [&](Fact&) { made = true; });
  EXPECT_TRUE(made);
}

/// Facts are made from what another triangle left.
TEST(RecentTriangles, WhatWasKnownOfAnotherIsHandedOn) {
  RecentTriangles<Fact, 4> recent;
  recent.get(2, [](Fact& fact) { fact.number = 2; });
  recent.get(6, [](Fact& fact) { EXPECT_EQ(fact.number, 2U); });
}

}  // namespace
}  // namespace fathom
