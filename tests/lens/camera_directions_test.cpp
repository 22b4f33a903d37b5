// The rounded directions of cameras, against the oracle and by hand.
#include "fathom/camera_directions.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "fathom/failures/errors.h"
#include "fathom/lens/preimages.h"
#include "tests/lens/lens_oracle.h"

namespace fathom {
namespace {

using oracle::ArbBall;

constexpr std::uint32_t width = 6, height = 4;

/// A coarse image of what a random camera of 1280×720 pixels shows.
Camera random_camera(std::mt19937_64& random, LensModel model) {
  Camera camera;
  camera.width = width;
  camera.height = height;
  camera.projection = oracle::random_camera(random);
  for (double* number : {&camera.projection.fx, &camera.projection.fy, &camera.projection.cx,
                         &camera.projection.cy, &camera.projection.skew})
    *number /= 200;
  if (has_one_focal_length(entry_of(model))) {
    camera.projection.fy = camera.projection.fx;
    camera.projection.skew = 0;
  }
  camera.projection.lens = oracle::random_lens(random, model, 0.1);
  return camera;
}

/// The components of (m, 1) over the greatest of them, rounded.
DirectionTable::Direction rounded_by_oracle(const oracle::OraclePoint<ArbBall>& m) {
  const ArbBall d[]{m.x, m.y, ArbBall(1.0)};
  ArbBall greatest = d[2];
  for (int k = 0; k < 2; ++k) {
    const ArbBall size = d[k].sign() < 0 ? ArbBall(0.0) - d[k] : d[k];
    if ((size - greatest).sign() > 0) greatest = size;
  }
  return {(d[0] / greatest).approximate(), (d[1] / greatest).approximate(),
          (d[2] / greatest).approximate()};
}

TEST(CameraDirections, AreThoseOfTheOracleRounded) {
  std::mt19937_64 random(41);
  int rays = 0, sideways = 0;
  for (const LensModel model : oracle::stage_models) {
    SCOPED_TRACE(name_of(model));
    const Camera camera = random_camera(random, model);
    const DirectionTable table = directions_of(camera);
    const double disc = lens::Preimages(camera.projection, *camera.projection.lens).disc();
    const oracle::NamedParameters numbers(*camera.projection.lens);
    for (std::uint32_t row = 0; row < height; ++row) {
      for (std::uint32_t column = 0; column < width; ++column) {
        const auto d = table.at(column, row);
        if (!d) continue;
        const auto m = oracle::preimage(camera.projection, numbers, column + 0.5, row + 0.5, disc);
        ASSERT_TRUE(m.has_value());
        EXPECT_EQ(*d, rounded_by_oracle(*m)) << column << ' ' << row;
        ++rays;
        sideways += (*d)[2] != 1;
      }
    }
  }
  EXPECT_GT(rays, 70);
  EXPECT_GT(sideways, 0);
}

Camera pinhole() {
  Camera camera;
  camera.width = 2;
  camera.height = 1;
  return camera;
}

TEST(CameraDirections, OfAPinholeAreTheInverseOfItsMatrix) {
  Camera camera = pinhole();
  camera.projection.fx = 3;
  camera.projection.fy = -0.25;
  const DirectionTable table = directions_of(camera);
  EXPECT_EQ(table.at(0, 0), (DirectionTable::Direction{(0.5 / 3) / 2, -1, 0.5}));
  EXPECT_EQ(table.at(1, 0), (DirectionTable::Direction{0.25, -1, 0.5}));
}

// (½ + 2⁻²⁵ + 2⁻⁶², 0, 1): binary64 has not the last bit, without which binary32 would round down.
TEST(CameraDirections, AreRoundedOnce) {
  Camera camera = pinhole();
  camera.projection.cx = -(0x1p-25 + 0x1p-62);
  camera.projection.cy = 0.5;
  EXPECT_EQ((*directions_of(camera).at(0, 0))[0], 0.5 + 0x1p-25);
  EXPECT_EQ((*directions_of(camera, DirectionRounding::binary32).at(0, 0))[0], 0.5 + 0x1p-24);
}

TEST(CameraDirections, OfATableHaveTheLengthOfItsGreatestComponent) {
  Camera camera = pinhole();
  const double NaN = std::numeric_limits<double>::quiet_NaN();
  camera.projection.lens.emplace(Lens{LensModel::table}).directions =
      std::make_shared<const DirectionTable>(
          2, 1, std::vector<double>{0x1p-1070, -0x1p-1069, 0, NaN, 1, 1});
  const DirectionTable once = directions_of(camera);
  EXPECT_EQ(once.at(0, 0), (DirectionTable::Direction{0.5, -1, 0}));
  EXPECT_EQ(once.numbers()[3], 0);  // no ray
  camera.projection.lens->directions = std::make_shared<const DirectionTable>(once);
  EXPECT_EQ(directions_of(camera), once);
}

TEST(CameraDirections, OfParallelRaysAreRefused) {
  Camera camera = pinhole();
  camera.projection.model = ProjectionModel::orthographic;
  EXPECT_THROW(directions_of(camera), UsageError);
  camera.projection = {};
  camera.projection.fx = 0;
  EXPECT_THROW(directions_of(camera), InputError);
}

}  // namespace
}  // namespace fathom
