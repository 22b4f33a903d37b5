// The part of an image without rays, against a question for each pixel.
#include "fathom/lens/without_ray.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <numbers>

#include "fathom/lens/preimages.h"
#include "tests/lens/lens_oracle.h"

namespace fathom::lens {
namespace {

using Reason = WithoutRay::Reason;

constexpr std::uint32_t width = 48, height = 36;

Projection with(const Lens& lens, double focal_length) {
  Projection projection;
  projection.fx = focal_length;
  projection.fy = -focal_length;
  projection.skew = has_one_focal_length(entry_of(lens.model)) ? 0 : 1.5;
  projection.cx = 22;
  projection.cy = 19;
  projection.lens = lens;
  return projection;
}

/// The share of pixels without a ray.
double counted(const Projection& projection) {
  const Preimages preimages(projection, *projection.lens);
  int missing = 0;
  for (std::uint32_t row = 0; row < height; ++row)
    for (std::uint32_t column = 0; column < width; ++column)
      missing += !preimages.of_pixel(column, row).has_value();
  return missing / (1.0 * width * height);
}

void expect_share(const Lens& lens, double focal_length, Reason reason) {
  SCOPED_TRACE(name_of(lens.model));
  const Projection projection = with(lens, focal_length);
  const auto found = find_samples_without_ray(projection, width, height);
  ASSERT_TRUE(found.has_value());
  EXPECT_EQ(found->reason, reason);
  EXPECT_GT(found->share, 0.02);
  // Of the pixels on the rim, of which there are about 80, each is off by half of itself at most.
  EXPECT_NEAR(found->share, counted(projection), 10.0 / (width * height));
}

TEST(WithoutRay, IsTheAreaBeyondTheFold) {
  expect_share({LensModel::simple_radial, {-0.25}}, 25, Reason::fold);
  expect_share({LensModel::opencv, {-0.25, 0.01, 0.01, -0.02}}, 25, Reason::fold);
  expect_share({LensModel::full_opencv, {-0.3, 0, 0, 0, 0, 0.1, 0.02, 0.01}}, 25, Reason::fold);
  expect_share({LensModel::opencv_14, {-0.25, 0, 0, 0, 0, 0, 0, 0, 0.01, 0, 0, 0, 0.1, -0.2}}, 25,
               Reason::fold);
}

TEST(WithoutRay, IsTheAreaBeyondTheFoldOfEitherStage) {
  const auto model = LensModel::rad_tan_thin_prism_fisheye;
  expect_share({model, {-0.2, 0, 0, 0, 0, 0, 0.01, 0.02, 0.03}}, 16, Reason::fold);
  expect_share({model, {0.01, 0, 0, 0, 0, 0, 0.1, 0.02, 0.3, 0, -0.1}}, 16, Reason::fold);
}

/// A panorama of `turns` of this image's width.
Projection panorama(const Lens& lens, double turns, double fy) {
  Projection projection = with(lens, 1);
  projection.fx = width / turns;
  projection.fy = fy;
  projection.skew = 0;
  return projection;
}

TEST(WithoutRay, IsTheAreaOfAPanoramaBeyondItsPolesAndMaxRadius) {
  // A row is off by half a pixel at each end of what it sees; a turn has two.
  const auto share = [](const Projection& projection, Reason reason) {
    const auto found = find_samples_without_ray(projection, width, height);
    ASSERT_TRUE(found.has_value());
    EXPECT_EQ(found->reason, reason);
    EXPECT_NEAR(found->share, counted(projection), 1.0 / width + 1 / projection.fx);
  };
  Lens lens{LensModel::equirectangular};
  share(panorama(lens, 1, 24), Reason::end_of_model);
  EXPECT_EQ(why_no_ray(panorama(lens, 1, 24), 0, 0),
            "it is beyond a pole, 90 degrees above or below");
  EXPECT_FALSE(find_samples_without_ray(panorama(lens, 1, 40), width, height).has_value());
  for (const auto& [turns, radius] : {std::pair(0.3, 0.5),
                                      {1.0, 0.5},
                                      {1.0, 1.5},
                                      {1.0, 2.5},
                                      {2.2, 0.5},
                                      {2.2, 1.5},
                                      {2.2, 2.5}}) {
    lens = {LensModel::equirectangular, {}, radius};
    share(panorama(lens, turns, 40), Reason::max_radius);
    lens.model = LensModel::cylindrical;
    share(panorama(lens, turns, -20), Reason::max_radius);
  }
  EXPECT_EQ(why_no_ray(panorama(lens, 1, 20), 0, 0), "it is beyond max_radius");
}

TEST(WithoutRay, IsTheAreaBeyondMaxRadius) {
  Lens lens{LensModel::simple_radial, {-0.1}};
  lens.max_radius = 0.7;
  expect_share(lens, 25, Reason::max_radius);
  lens = {LensModel::pinhole};
  lens.max_radius = 0.7;
  expect_share(lens, 25, Reason::max_radius);
  for (const double k : {-0.25, 0.2}) {
    lens = {LensModel::division, {k}};
    lens.max_radius = 0.5;
    expect_share(lens, 40, Reason::max_radius);
  }
  lens = {LensModel::fisheye_stereographic};
  lens.max_radius = std::numbers::pi / 2;
  expect_share(lens, 11, Reason::max_radius);
}

TEST(WithoutRay, IsTheAreaBeyondTheEndOfADivision) {
  expect_share({LensModel::division, {0.5}}, 15, Reason::end_of_model);
  Lens lens{LensModel::division, {0.5}};
  lens.max_radius = 3;  // no ray is so far from the axis
  expect_share(lens, 15, Reason::end_of_model);
}

TEST(WithoutRay, IsTheAreaOfAFieldOfViewBeyondItsEnds) {
  expect_share({LensModel::fov, {-1.25}}, 12, Reason::end_of_model);
  expect_share({LensModel::fov, {1.25}, 1.6}, 12, Reason::end_of_model);
  expect_share({LensModel::fov, {1.25}, 0.75}, 25, Reason::max_radius);
  expect_share({LensModel::fov, {0}, 0.5}, 40, Reason::max_radius);
}

TEST(WithoutRay, IsTheAreaWhereAnAngleEnds) {
  expect_share({LensModel::ftheta, {0, 1, -0.375}}, 17, Reason::end_of_model);
  expect_share({LensModel::ftheta, {0.25, 1.5}}, 12, Reason::end_of_model);
  expect_share({LensModel::ftheta, {-0.25, 1, 0.125}, 0.75}, 25, Reason::max_radius);
}

TEST(WithoutRay, IsTheAreaBeyondTheEndOfARoot) {
  expect_share({LensModel::fisheye_orthographic}, 15, Reason::end_of_model);
  expect_share({LensModel::fisheye_equisolid}, 8, Reason::end_of_model);
  expect_share({LensModel::ucm, {0.75}}, 12, Reason::end_of_model);
  expect_share({LensModel::eucm, {1, 4}}, 30, Reason::end_of_model);
  expect_share({LensModel::double_sphere, {0.25, 0.75}}, 12, Reason::end_of_model);
  expect_share({LensModel::omni, {1.25}}, 12, Reason::end_of_model);
  expect_share({LensModel::omni, {1.25, 0.1, 0, 0.01, 0.02}}, 11, Reason::end_of_model);
  expect_share({LensModel::omni, {1.25, -0.4, 0, 0.01, 0.02}}, 25, Reason::fold);
  expect_share({LensModel::fisheye_orthographic, {}, 1.6}, 15, Reason::end_of_model);
}

TEST(WithoutRay, IsTheAreaBeyondMaxRadiusOfARoot) {
  expect_share({LensModel::fisheye_orthographic, {}, 1}, 20, Reason::max_radius);
  expect_share({LensModel::fisheye_equisolid, {}, 2}, 11, Reason::max_radius);
  expect_share({LensModel::ucm, {0.25}, 0.5}, 40, Reason::max_radius);
  expect_share({LensModel::eucm, {0.75, 0.5}, 1.25}, 14, Reason::max_radius);
  expect_share({LensModel::double_sphere, {-0.25, 0.6}, 0.75}, 22, Reason::max_radius);
  expect_share({LensModel::omni, {0.75}, 1.25}, 25, Reason::max_radius);
  expect_share({LensModel::omni, {0.75, 0.1, 0, 0.01, 0.02}, 1}, 28, Reason::max_radius);
}

TEST(WithoutRay, IsNoneWhereAllSamplesHaveARay) {
  const auto found = [](const Lens& lens, double focal_length) {
    return find_samples_without_ray(with(lens, focal_length), width, height).has_value();
  };
  EXPECT_FALSE(found({LensModel::simple_radial, {-0.25}}, 100));
  EXPECT_FALSE(found({LensModel::simple_radial, {0.25}}, 10));
  EXPECT_FALSE(found({LensModel::opencv}, 10));
  EXPECT_FALSE(found({LensModel::fisheye_stereographic}, 1));
  EXPECT_FALSE(found({LensModel::ucm, {0.5}}, 1));
  EXPECT_FALSE(found({LensModel::omni, {1}}, 1));
  EXPECT_FALSE(found({LensModel::fov, {0.75}}, 25));
  EXPECT_FALSE(found({LensModel::fisheye_equisolid}, 17));
  EXPECT_FALSE(find_samples_without_ray(Projection(), width, height).has_value());
}

TEST(WithoutRay, OfNumbersBeyondBinary64IsNotKnown) {
  EXPECT_FALSE(
      find_samples_without_ray(with({LensModel::opencv, {-1e-300}}, 1e300), width, height));
}

}  // namespace
}  // namespace fathom::lens
