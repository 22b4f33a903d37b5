#include "fathom/camera/camera_making.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "fathom/failures/errors.h"
#include "fathom/numeric/rounding.h"
#include "tests/scratch_folder.h"
#include "tests/special_values.h"

namespace fathom {
namespace {

using testing::HasSubstr;
constexpr Vector3 y_up{0, 1, 0}, z_up{0, 0, 1};
constexpr std::array<Vector3, 6> directions_of_axes{
    {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {-1, 0, 0}, {0, -1, 0}, {0, 0, -1}}};

double rounded(const Dyadic& x) {
  return round_to_binary64(Ratio(x));
}

Vector3 camera_point(const Camera& camera, const Vector3& X) {
  const CameraPoint p = to_camera(camera.world_to_camera, WorldPoint{X[0], X[1], X[2]});
  return {rounded(p.x), rounded(p.y), rounded(p.z)};
}

std::array<double, 2> pixel(const Camera& camera, const Vector3& X) {
  const auto [U, V, W] =
      to_image(camera.projection, to_camera(camera.world_to_camera, WorldPoint{X[0], X[1], X[2]}));
  return {round_to_binary64(Ratio(U, W)), round_to_binary64(Ratio(V, W))};
}

TEST(LookAt, AlongTheAxesIsExact) {
  // From z = 5 towards the origin: right is +x, down is −y, forward is −z.
  const Camera camera = look_at({0, 0, 5}, {0, 0, 0}, {0, 1, 0});
  const std::array<std::array<double, 4>, 3> expected{{{1, 0, 0, 0}, {0, -1, 0, 0}, {0, 0, -1, 5}}};
  EXPECT_EQ(camera.world_to_camera, expected);
  EXPECT_EQ(camera.width, 1280U);
  EXPECT_EQ(camera.height, 720U);
  EXPECT_EQ(camera.projection.cx, 640);
  EXPECT_EQ(camera.projection.cy, 360);
  EXPECT_EQ(camera.projection.fx, camera.projection.fy);
  // 360 / tan 20°.
  EXPECT_NEAR(camera.projection.fx, 989.0918710036640, 1e-12);
}

TEST(LookAt, TargetLandsInTheMiddleAndUpIsUp) {
  std::mt19937 random(3);
  std::uniform_real_distribution<double> any(-10, 10);
  for (int i = 0; i < 500; ++i) {
    const Vector3 eye{any(random), any(random), any(random)};
    const Vector3 target{any(random), any(random), any(random)};
    const Vector3 up{any(random), any(random), any(random)};
    const Camera camera = look_at(eye, target, up);
    // R and t have entries within 2⁻⁵³ relative of the exact ones, of at most 1 and 18: a point
    // within 18 of the origin errs by less than 1e-14 in the camera frame.
    const Vector3 origin = camera_point(camera, eye);
    for (const double x : origin) ASSERT_NEAR(x, 0, 1e-14);
    const Vector3 p = camera_point(camera, target);
    const double distance = std::hypot(target[0] - eye[0], target[1] - eye[1], target[2] - eye[2]);
    ASSERT_NEAR(p[0], 0, 2e-14);
    ASSERT_NEAR(p[1], 0, 2e-14);
    ASSERT_NEAR(p[2], distance, 1e-13);
    const Vector3 above =
        camera_point(camera, {target[0] + up[0], target[1] + up[1], target[2] + up[2]});
    ASSERT_NEAR(above[0], 0, 3e-14);
    ASSERT_LT(above[1], 0);
    // A proper rotation: its determinant is 1 but for the rounding of nine entries.
    ASSERT_NEAR(rounded(determinant_of_rotation(camera.world_to_camera)), 1, 1e-15 * 4);
  }
}

TEST(LookAt, WorksAtAnyScale) {
  for (const double s : {1e150, 1e-150, 1e300, 0x1p-1060}) {
    const Camera camera = look_at({0, 0, 5 * s}, {0, 0, 0}, {0, s, 0});
    EXPECT_EQ(camera.world_to_camera[1], (std::array<double, 4>{0, -1, 0, 0}));
    EXPECT_EQ(camera.world_to_camera[2], (std::array<double, 4>{0, 0, -1, 5 * s}));
  }
  // 1 ulp beside the line of sight is not along it.
  EXPECT_NO_THROW(look_at({0, 0, 0}, {1, 1, 1}, {1, 1, std::nextafter(1.0, 2.0)}));
}

TEST(LookAt, LensesAreAsDescribed) {
  LensChoice lens;
  lens.width = 300, lens.height = 200;
  lens.focal = 123.5;
  lens.near = 0.5, lens.far = 9;
  Camera camera = look_at({0, 0, 5}, {0, 0, 0}, {0, 1, 0}, lens);
  EXPECT_EQ(camera.projection.fx, 123.5);
  EXPECT_EQ(camera.projection.cx, 150);
  EXPECT_EQ(camera.near, 0.5);
  EXPECT_EQ(camera.far, 9);
  lens.model = ProjectionModel::orthographic;
  lens.vertical_extent = 4;
  camera = look_at({0, 0, 5}, {0, 0, 0}, {0, 1, 0}, lens);
  EXPECT_EQ(camera.projection.model, ProjectionModel::orthographic);
  // 4 units span the height: y = 2 is the upper edge, x = 3 the right one.
  EXPECT_EQ(pixel(camera, {3, 2, 1}), (std::array<double, 2>{300, 0}));
}

// w and h are the image's; a cylinder's fy is the focal length of its height.
TEST(LookAt, PanoramasShowTheFullTurn) {
  LensChoice lens;
  lens.width = 300, lens.height = 200;
  lens.distortion = Lens{LensModel::equirectangular};
  Projection expected{.fx = 300, .fy = 200, .cx = 150, .cy = 100};
  expected.lens = lens.distortion;
  EXPECT_EQ(look_at({0, 0, 5}, {0, 0, 0}, {0, 1, 0}, lens).projection, expected);
  lens.distortion = expected.lens = Lens{LensModel::cylindrical};
  lens.vertical_fov = 90;
  expected.fy = 100;
  EXPECT_EQ(look_at({0, 0, 5}, {0, 0, 0}, {0, 1, 0}, lens).projection, expected);
  lens.focal = expected.fy = 80;
  EXPECT_EQ(look_at({0, 0, 5}, {0, 0, 0}, {0, 1, 0}, lens).projection, expected);
  lens.distortion = Lens{LensModel::equirectangular};
  EXPECT_EQ(message_of<UsageError>([&] {
              look_at({0, 0, 5}, {0, 0, 0}, {0, 1, 0}, lens);
            }),
            "EQUIRECTANGULAR has no focal length");
}

TEST(LookAt, RefusesWhatCannotBe) {
  const auto refused = [](const Vector3& eye, const Vector3& target, const Vector3& up,
                          const LensChoice& lens = {}) {
    return message_of<UsageError>([&] { look_at(eye, target, up, lens); });
  };
  EXPECT_THAT(refused({1, 2, 3}, {1, 2, 3}, {0, 1, 0}), HasSubstr("same point"));
  EXPECT_THAT(refused({0, 0, 0}, {0.1, 0.2, 0.3}, {0.2, 0.4, 0.6}), HasSubstr("line of sight"));
  EXPECT_THAT(refused({0, 0, 0}, {0, 0, 1}, {0, 0, 0}), HasSubstr("zero"));
  EXPECT_THAT(refused({0, 0, infinity}, {0, 0, 1}, {0, 1, 0}), HasSubstr("eye is not finite"));
  EXPECT_THAT(refused({0, 0, 0}, {NAN, 0, 1}, {0, 1, 0}), HasSubstr("target is not finite"));
  const auto with_lens = [&](void (*change)(LensChoice&)) {
    LensChoice lens;
    change(lens);
    return refused({0, 0, 5}, {0, 0, 0}, {0, 1, 0}, lens);
  };
  EXPECT_THAT(with_lens([](LensChoice& l) { l.vertical_fov = 180; }), HasSubstr("field of view"));
  EXPECT_THAT(with_lens([](LensChoice& l) { l.vertical_fov = 0; }), HasSubstr("field of view"));
  EXPECT_THAT(with_lens([](LensChoice& l) { l.vertical_fov = NAN; }), HasSubstr("field of view"));
  EXPECT_THAT(with_lens([](LensChoice& l) { l.focal = -1; }), HasSubstr("focal"));
  EXPECT_THAT(with_lens([](LensChoice& l) { l.focal = infinity; }), HasSubstr("fx"));
  EXPECT_THAT(with_lens([](LensChoice& l) { l.width = 0; }), HasSubstr("width"));
  EXPECT_THAT(with_lens([](LensChoice& l) { l.near = 2, l.far = 1; }), HasSubstr("far"));
  EXPECT_THAT(with_lens([](LensChoice& l) { l.model = ProjectionModel::orthographic; }),
              HasSubstr("vertical extent"));
}

/// Where the camera is: the world point that it takes to its origin, for an orthonormal R.
Vector3 eye_of(const Camera& camera) {
  Vector3 eye{};
  for (int k = 0; k < 3; ++k)
    for (int i = 0; i < 3; ++i)
      eye[k] -= camera.world_to_camera[i][k] * camera.world_to_camera[i][3];
  return eye;
}

void expect_near(const Vector3& a, const Vector3& b) {
  // Sines and cosines within an ulp of numbers below 10.
  for (int k = 0; k < 3; ++k) EXPECT_NEAR(a[k], b[k], 1e-14);
}

TEST(LookFrom, AzimuthAndElevationAreAsDocumented) {
  const double h = std::sqrt(0.5);
  expect_near(eye_of(look_from({0, 0, y_up}, {0, 0, 0}, 2)), {0, 0, 2});
  expect_near(eye_of(look_from({90, 0, y_up}, {0, 0, 0}, 2)), {2, 0, 0});
  expect_near(eye_of(look_from({180, 0, y_up}, {1, 2, 3}, 2)), {1, 2, 1});
  expect_near(eye_of(look_from({0, 45, y_up}, {0, 0, 0}, 2)), {0, 2 * h, 2 * h});
  expect_near(eye_of(look_from({45, 0, y_up}, {0, 0, 0}, 2)), {2 * h, 0, 2 * h});
  expect_near(eye_of(look_from({0, 0, z_up}, {0, 0, 0}, 2)), {0, -2, 0});
  expect_near(eye_of(look_from({90, 0, z_up}, {0, 0, 0}, 2)), {2, 0, 0});
  expect_near(eye_of(look_from({0, 45, z_up}, {0, 0, 0}, 2)), {0, -2 * h, 2 * h});
  expect_near(eye_of(look_from({0, 90, y_up}, {0, 0, 0}, 2)), {0, 2, 0});
  expect_near(eye_of(look_from({0, -90, z_up}, {0, 0, 0}, 2)), {0, 0, -2});
}

TEST(LookFrom, AnyDirectionMayPointUp) {
  struct Expected {
    Vector3 up, at_0, at_90, above;  // where the eye is, at a distance of 2
  };
  const double h = std::sqrt(0.5);
  for (const auto& [up, at_0, at_90, above] :
       std::vector<Expected>{{{0, 5, 0}, {0, 0, 2}, {2, 0, 0}, {0, 2, 0}},
                             {{0, -1, 0}, {0, 0, -2}, {2, 0, 0}, {0, -2, 0}},
                             {{0, 0, 1e-300}, {0, -2, 0}, {2, 0, 0}, {0, 0, 2}},
                             {{0, 0, -3}, {0, 2, 0}, {2, 0, 0}, {0, 0, -2}},
                             {{1, 0, 0}, {0, 0, -2}, {0, 2, 0}, {2, 0, 0}},
                             {{-1, 0, 0}, {0, 0, 2}, {0, 2, 0}, {-2, 0, 0}},
                             {{0, 1, 1}, {0, -2 * h, 2 * h}, {2, 0, 0}, {0, 2 * h, 2 * h}},
                             {{3, 4, 0}, {0, 0, 2}, {1.6, -1.2, 0}, {1.2, 1.6, 0}}}) {
    SCOPED_TRACE(::testing::PrintToString(up));
    expect_near(eye_of(look_from({0, 0, up}, {}, 2)), at_0);
    expect_near(eye_of(look_from({90, 0, up}, {}, 2)), at_90);
    expect_near(eye_of(look_from({17, 90, up}, {}, 2)), above);
  }
}

TEST(LookFrom, NeedsADirectionThatPointsUp) {
  const auto refusal = [](const Vector3& up) {
    return message_of<UsageError>([&] { look_from({0, 0, up}, {}, 1); });
  };
  EXPECT_EQ(refusal({0, 0, 0}), "the up direction is zero");
  EXPECT_EQ(refusal({0, infinity, 0}), "the up direction is not finite");
}

TEST(LookFrom, RightAngledViewsAreExact) {
  for (const Vector3& up : directions_of_axes)
    for (int azimuth = -720; azimuth <= 720; azimuth += 90)
      for (const double elevation : {-90.0, 0.0, 90.0}) {
        const Camera camera = look_from({static_cast<double>(azimuth), elevation, up}, {}, 1);
        for (const auto& row : camera.world_to_camera)
          for (int k = 0; k < 3; ++k)
            EXPECT_TRUE(row[k] == 0 || std::abs(row[k]) == 1) << azimuth << " " << elevation;
        EXPECT_EQ(determinant_of_rotation(camera.world_to_camera), Dyadic(1.0));
      }
}

TEST(LookFrom, AgreesWithLookAt) {
  std::vector<Vector3> ups(directions_of_axes.begin(), directions_of_axes.end());
  ups.insert(ups.end(), {{1, 2, 3}, {-0.7, 0.1, 0}, {1, 1e-8, 0}, {1e300, -1e300, 1e-300}});
  for (const Vector3& up : ups)
    for (double azimuth = -170; azimuth < 190; azimuth += 17)
      for (double elevation = -85; elevation < 90; elevation += 17) {
        const Camera camera = look_from({azimuth, elevation, up}, {1, 2, 3}, 4);
        const Camera other = look_at(eye_of(camera), {1, 2, 3}, up);
        for (int i = 0; i < 3; ++i)
          for (int k = 0; k < 4; ++k)
            // The eye above is known to 1e-15·10; the direction to it divides that by 4, and by
            // cos 85° for the horizontal part.
            EXPECT_NEAR(camera.world_to_camera[i][k], other.world_to_camera[i][k], 1e-12);
      }
}

TEST(Orbit, StepsAroundTheCentre) {
  const auto path = orbit({10, 20, z_up}, 4, Vector3{1, 2, 3}, 5);
  ASSERT_EQ(path.size(), 4U);
  for (int i = 0; i < 4; ++i) {
    const Camera expected = look_from({10 + 90.0 * i, 20, z_up}, {1, 2, 3}, 5);
    EXPECT_EQ(path[i].world_to_camera, expected.world_to_camera);
  }
  EXPECT_THAT(message_of<UsageError>([] { orbit({}, 0, Vector3{}, 1); }), HasSubstr("from 1 to"));
  EXPECT_THAT(message_of<UsageError>([] { orbit({}, 4000000000U, Vector3{}, 1); }),
              HasSubstr("from 1 to"));
  EXPECT_THAT(message_of<UsageError>([] { orbit({}, 3, Vector3{}, 0); }), HasSubstr("distance"));
}

}  // namespace
}  // namespace fathom
