#pragma once

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <cstdint>
#include <optional>

#include "fathom/camera/camera.h"
#include "fathom/camera_directions.h"

/// Imported lenses are held to the forward projection of the program that calibrated them, written
/// out in binary64 from its source: it takes the ray of each pixel back to that pixel.
namespace fathom::test {

using Direction = std::array<double, 3>;
using PixelPoint = std::array<double, 2>;

/// Expects that `project` takes the ray of every pixel to the pixel's centre, where the centre of
/// the first pixel is (first, first). Directions are rounded to binary64, and focal lengths and
/// pixels are below 100: a projection of some twenty operations errs by less than 10⁻¹¹.
template <class Project>
void expect_rays(const Camera& camera, double first, const Project& project) {
  const DirectionTable table = directions_of(camera);
  int rays = 0;
  for (std::uint32_t row = 0; row < camera.height; ++row) {
    for (std::uint32_t column = 0; column < camera.width; ++column) {
      const auto direction = table.at(column, row);
      if (!direction) continue;
      ++rays;
      const PixelPoint p = project(*direction);
      EXPECT_NEAR(p[0], column + first, 1e-11) << column << ", " << row;
      EXPECT_NEAR(p[1], row + first, 1e-11) << column << ", " << row;
    }
  }
  EXPECT_GT(rays, 8) << "nearly no pixel has a ray";
}

/// Expects that the ray of every pixel has the direction that `direction_at` has for the pixel's
/// column and row, or that neither has one.
template <class DirectionAt>
void expect_directions(const Camera& camera, const DirectionAt& direction_at) {
  const DirectionTable table = directions_of(camera);
  int rays = 0;
  for (std::uint32_t row = 0; row < camera.height; ++row) {
    for (std::uint32_t column = 0; column < camera.width; ++column) {
      const auto ours = table.at(column, row);
      const std::optional<Direction> theirs = direction_at(column, row);
      ASSERT_EQ(ours.has_value(), theirs.has_value()) << column << ", " << row;
      if (!ours) continue;
      ++rays;
      const double length = std::hypot((*ours)[0], (*ours)[1], (*ours)[2]);
      const double other = std::hypot((*theirs)[0], (*theirs)[1], (*theirs)[2]);
      for (std::size_t k = 0; k < 3; ++k)
        EXPECT_NEAR((*ours)[k] / length, (*theirs)[k] / other, 1e-14) << column << ", " << row;
    }
  }
  EXPECT_GT(rays, 8) << "nearly no pixel has a ray";
}

}  // namespace fathom::test
