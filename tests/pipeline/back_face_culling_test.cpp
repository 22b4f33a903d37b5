#include "fathom/pipeline/geometry/back_face_culling.h"

#include <gtest/gtest.h>

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

}  // namespace
}  // namespace fathom::pipeline
