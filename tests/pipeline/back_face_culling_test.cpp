#include "fathom/pipeline/geometry/back_face_culling.h"

#include <gtest/gtest.h>

#include <random>
#include <utility>

namespace fathom::pipeline {
namespace {

constexpr auto counter_clockwise = FrontFace::counter_clockwise;

/// (0, 0), (1, 0), (0, 1) with y up: counter-clockwise as seen.
TEST(Facing, InNdcAndInTheWindowYPointsTheOtherWay) {
  std::array<NdcVertex<double>, 3> ndc{};
  ndc[1].x = 1;
  ndc[2].y = 1;
  EXPECT_EQ(facing_in_ndc(ndc, counter_clockwise), Facing::front);
  EXPECT_EQ(facing_in_ndc(ndc, FrontFace::clockwise), Facing::back);
  std::array<WindowVertex<double>, 3> window{};
  window[1].x = 1;
  window[2].y = 1;  // downwards
  EXPECT_EQ(facing_in_window(window, counter_clockwise), Facing::back);
  EXPECT_EQ(facing_in_window(window, FrontFace::clockwise), Facing::front);
  std::swap(window[1], window[2]);
  EXPECT_EQ(facing_in_window(window, counter_clockwise), Facing::front);
  window[2] = window[1];
  EXPECT_EQ(facing_in_window(window, counter_clockwise), Facing::edge_on);
}

TEST(Facing, InTheWorldFromTheEyeOrAlongTheView) {
  // Its normal is +z.
  const std::array<WorldVertex<double>, 3> t{{{0, 0, 5}, {1, 0, 5}, {0, 1, 5}}};
  const auto facing = [&](std::array<double, 3> eye, bool perspective, bool mirrored = false) {
    return facing_in_world(t, eye, perspective, mirrored, counter_clockwise);
  };
  EXPECT_EQ(facing({0, 0, 9}, true), Facing::front);
  EXPECT_EQ(facing({0, 0, 1}, true), Facing::back);
  EXPECT_EQ(facing({70, 0, 5}, true), Facing::edge_on);
  EXPECT_EQ(facing({0, 0, 9}, true, true), Facing::back);
  EXPECT_EQ(facing({0, 0, 1}, false), Facing::front);  // a direction towards the viewer
  EXPECT_EQ(facing({1, 0, 0}, false), Facing::edge_on);
}

TEST(Culling, LeavesOutOneSideAndWhatIsSeenEdgeOn) {
  for (const Culling culling : {Culling::none, Culling::back, Culling::front}) {
    EXPECT_TRUE(is_culled(Facing::edge_on, culling));
    EXPECT_EQ(is_culled(Facing::back, culling), culling == Culling::back);
    EXPECT_EQ(is_culled(Facing::front, culling), culling == Culling::front);
  }
}

/// The sign of (B − A) × (C − A) · V, in integers.
TEST(Facing, InTheWorldIsTheSignOfTheTripleProduct) {
  std::mt19937_64 random(73);
  int edge_on = 0;
  for (int i = 0; i < 3000; ++i) {
    const auto number = [&] { return static_cast<int>(random() % 9) - 4; };
    std::array<std::array<int, 3>, 4> p;  // three corners, and the eye or the direction to it
    for (auto& q : p) q = {number(), number(), number()};
    for (const bool perspective : {true, false}) {
      std::array<int, 3> s, t, V;
      for (std::size_t k = 0; k < 3; ++k) {
        s[k] = p[1][k] - p[0][k];
        t[k] = p[2][k] - p[0][k];
        V[k] = perspective ? p[3][k] - p[0][k] : p[3][k];
      }
      const int triple = (s[1] * t[2] - s[2] * t[1]) * V[0] + (s[2] * t[0] - s[0] * t[2]) * V[1] +
                         (s[0] * t[1] - s[1] * t[0]) * V[2];
      std::array<WorldVertex<double>, 3> corners;
      for (std::size_t k = 0; k < 3; ++k) {
        corners[k] = {double(p[k][0]), double(p[k][1]), double(p[k][2])};
      }
      for (const bool mirrored : {false, true}) {
        const int sign = mirrored ? -triple : triple;
        const auto right = sign > 0 ? Facing::front : sign < 0 ? Facing::back : Facing::edge_on;
        ASSERT_EQ(facing_in_world(corners, {double(p[3][0]), double(p[3][1]), double(p[3][2])},
                                  perspective, mirrored, counter_clockwise),
                  right);
      }
      edge_on += triple == 0;
    }
  }
  EXPECT_GT(edge_on, 50);
}

}  // namespace
}  // namespace fathom::pipeline
