// A conversion to float rounds, whatever the compiler makes of its neighbours. GCC 12 at -O3 packs
// the first two of three coordinates into one instruction and drops their conversions, unless it is
// told not to (cmake/FathomOptions.cmake).

#include <gtest/gtest.h>

#include <array>
#include <cstddef>
#include <vector>

namespace fathom {
namespace {

using Point = std::array<double, 3>;

/// As the pipeline moves a vertex: a difference, which some options scale and round.
inline Point moved(const Point& from, const Point& origin, double scale, bool narrows) {
  Point to{};
  for (std::size_t k = 0; k < 3; ++k) {
    to[k] = from[k] - origin[k];
    if (narrows) to[k] = static_cast<float>(to[k] * scale);
  }
  return to;
}

// Not inlined, so that nothing is known of the arguments.
__attribute__((noinline)) void move_all(const std::vector<Point>& from, std::vector<Point>& to,
                                        const Point& origin, double scale, bool narrows) {
  for (std::size_t i = 0; i < from.size(); ++i) to[i] = moved(from[i], origin, scale, narrows);
}

TEST(Narrowing, RoundsEachOfThreeCoordinates) {
  const std::vector<Point> from{{1.1, 2.2, 3.3}, {4.4, 5.5, 6.6}};
  std::vector<Point> to(from.size());
  move_all(from, to, {0.1, 0.2, 0.3}, 1.0000001, true);
  for (const Point& point : to) {
    for (const double coordinate : point) {
      volatile float rounded = static_cast<float>(coordinate);
      EXPECT_EQ(coordinate, rounded);
    }
  }
}

}  // namespace
}  // namespace fathom
