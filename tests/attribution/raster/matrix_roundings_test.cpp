#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <random>

#include "fathom/attribution/attribution.h"
#include "fathom/attribution/model/renderer_input.h"
#include "fathom/attribution/raster/clip_vertex.h"
#include "fathom/camera/camera_making.h"
#include "fathom/numeric/standard_arithmetic.h"
#include "tests/attribution/hand_made.h"

/// Held against matrices each entry of which is off by a rounding.
namespace fathom::attribution {
namespace {

using WorldPoint = std::array<double, 3>;

WorldPoint point_at(const Camera& camera, std::size_t pixel, double depth) {
  const CameraRays rays = camera_rays(camera);
  const std::size_t column = pixel % camera.width, row = pixel / camera.width;
  const double x = static_cast<double>(column) + 0.5;
  const double y = static_cast<double>(row) + 0.5;
  WorldPoint p{};
  for (std::size_t k = 0; k < 3; ++k) {
    const auto at = [&](const CameraRays::Affine& f) {
      return f.at_corner[k] + x * f.per_u[k] + y * f.per_v[k];
    };
    p[k] = at(rays.origin) + depth * at(rays.direction);
  }
  return p;
}

/// z/w where entry k of row r is off by change(r, k), relatively.
template <class Change>
double normalized_depth(const std::array<ClipRow, 4>& rows, const WorldPoint& p,
                        const Change& change) {
  const auto value = [&](std::size_t r) {
    double sum = rows[r].row[3] * (1 + change(r, 3));
    for (std::size_t k = 0; k < 3; ++k) sum += rows[r].row[k] * (1 + change(r, k)) * p[k];
    return sum;
  };
  return value(2) / value(3);
}

class RoundedMatrix : public testing::TestWithParam<Mapping> {
 protected:
  const Camera camera_ = test::level_camera();
  const RasterModel model_{.premultiplied = true, .mapping = GetParam()};
  const double half_ = GetParam() == Mapping::opengl ? 0.5 : 1;
};

TEST_P(RoundedMatrix, MovesWindowDepthsByUpToTheBound) {
  constexpr double u = unit_roundoff<float>;
  const MatrixRoundings roundings(camera_, model_, {});
  const std::array<ClipRow, 4> rows = rows_of_camera(camera_, model_);
  std::mt19937 random(1);
  std::uniform_real_distribution<double> rounding(-u, u);
  for (const std::size_t pixel : {std::size_t{0}, std::size_t{3000}, std::size_t{96 * 72 - 1}}) {
    for (const double depth : {0.6, 3.0, 18.0}) {
      const WorldPoint p = point_at(camera_, pixel, depth);
      const double exact = normalized_depth(rows, p, [](auto...) { return 0; });
      // First order in u, and 2⁻⁵³ of sums in binary64.
      const double bound = roundings.of_window(pixel, depth) * (1 + 1e-5);
      for (int k = 0; k < 100; ++k) {
        const double moved =
            normalized_depth(rows, p, [&](auto...) { return rounding(random); }) - exact;
        EXPECT_LE(half_ * std::abs(moved), bound) << pixel << " " << depth;
      }
      // All to one side: terms of z up, those of w down, or up where z/w is negative.
      const double worst = normalized_depth(rows, p, [&](std::size_t r, std::size_t k) {
        const double term = rows[r].row[k] * (k < 3 ? p[k] : 1);
        const bool up = (term > 0) == (r == 2 || exact < 0);
        return up ? u : -u;
      });
      EXPECT_GE(half_ * std::abs(worst - exact), bound * (1 - 1e-4)) << pixel << " " << depth;
    }
  }
}

INSTANTIATE_TEST_SUITE_P(All, RoundedMatrix, testing::Values(Mapping::opengl, Mapping::reversed));

TEST(MatrixRoundings, AreNoneOfAMatrixThatIsKnown) {
  RasterModel model;
  model.matrix = clip_from_held(test::level_camera(), model);
  EXPECT_EQ(MatrixRoundings(test::level_camera(), model, {}).of_window(0, 3), 0);
}

TEST(MatrixRoundings, OfTwoMatricesAreMore) {
  const MatrixRoundings one(test::level_camera(), {.premultiplied = true}, {});
  const MatrixRoundings two(test::level_camera(), {.premultiplied = false}, {});
  EXPECT_GE(two.of_window(0, 3), 2 * one.of_window(0, 3));
}

TEST(Bias, IsMoreThanTheMatrixCanBe) {
  Attribution found;
  found.bias.triangles = 100;
  found.bias.deviation = 0.02;
  for (const double sign : {-1, 1}) {
    found.bias.steps = sign;
    found.bias.shared = 0.9;
    EXPECT_TRUE(found.bias.is_significant());
    found.bias.shared = 0.95;
    EXPECT_FALSE(found.bias.is_significant());
  }
}

}  // namespace
}  // namespace fathom::attribution
