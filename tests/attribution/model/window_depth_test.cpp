#include "fathom/attribution/model/window_depth.h"

#include <gtest/gtest.h>

#include <string>

#include "tests/special_values.h"

namespace fathom::attribution {
namespace {

constexpr double near_plane = 0.5, far_plane = 20;

/// What a mapping makes of near and far.
struct Ends {
  std::string name;
  ProjectionModel projection;
  Mapping mapping;
  double at_near, at_far;
};

void PrintTo(const Ends& ends, std::ostream* stream) {
  *stream << ends.name;
}

class WindowDepths : public testing::TestWithParam<Ends> {};

TEST_P(WindowDepths, GoFromNearToFarAndBack) {
  const Ends& ends = GetParam();
  const WindowDepth window = window_depth(ends.projection, ends.mapping, near_plane, far_plane);
  EXPECT_NEAR(window.of_depth(near_plane), ends.at_near, 1e-15);
  EXPECT_NEAR(window.of_depth(far_plane), ends.at_far, 1e-15);
  EXPECT_EQ(window.reversed(), ends.at_near > ends.at_far);
  for (const double depth : {0.5, 0.75, 3.0, 19.5}) {
    EXPECT_NEAR(window.to_depth(window.of_depth(depth)), depth, 1e-13 * depth);
  }
}

INSTANTIATE_TEST_SUITE_P(
    All, WindowDepths,
    testing::Values(
        Ends{"OpenGl", ProjectionModel::perspective, Mapping::opengl, 0, 1},
        Ends{"Standard", ProjectionModel::perspective, Mapping::standard, 0, 1},
        Ends{"Reversed", ProjectionModel::perspective, Mapping::reversed, 1, 0},
        Ends{"Infinite", ProjectionModel::perspective, Mapping::infinite, 0,
             1 - near_plane / far_plane},
        Ends{"ReversedInfinite", ProjectionModel::perspective, Mapping::reversed_infinite, 1,
             near_plane / far_plane},
        Ends{"Logarithmic", ProjectionModel::perspective, Mapping::log_ulrich, 0, 1},
        Ends{"OrthographicOpenGl", ProjectionModel::orthographic, Mapping::opengl, 0, 1},
        Ends{"OrthographicReversed", ProjectionModel::orthographic, Mapping::reversed, 1, 0},
        Ends{"OrthographicLogarithmic", ProjectionModel::orthographic, Mapping::log_ulrich, 0, 1}),
    [](const auto& ends) { return ends.param.name; });

TEST(WindowDepth, BeyondInfinityThereIsNothing) {
  const WindowDepth window =
      window_depth(ProjectionModel::perspective, Mapping::standard, near_plane, far_plane);
  EXPECT_EQ(window.to_depth(far_plane / (far_plane - near_plane)), infinity);
  EXPECT_EQ(window.to_depth(2), infinity);
  EXPECT_EQ(
      window_depth(ProjectionModel::perspective, Mapping::reversed_infinite, near_plane, infinity)
          .to_depth(0),
      infinity);
}

}  // namespace
}  // namespace fathom::attribution
