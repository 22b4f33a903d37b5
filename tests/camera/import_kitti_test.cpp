// KITTI's rectified cameras project as its development kit does: s·(u, v, 1) = P_i·X, X of
// rectified camera 0, whose pose takes it to the world.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <array>
#include <string>

#include "fathom/camera/camera_import_internal.h"
#include "fathom/failures/errors.h"
#include "tests/camera/judged.h"
#include "tests/camera/seen_points.h"
#include "tests/scratch_folder.h"

namespace fathom {
namespace {

using namespace camera;
using namespace test;
using ::testing::ElementsAre;
using ::testing::HasSubstr;

/// Of sequence 00, in its own digits.
constexpr const char* odometry =
    "P0: 7.188560000000e+02 0.000000000000e+00 6.071928000000e+02 0.000000000000e+00 "
    "0.000000000000e+00 7.188560000000e+02 1.852157000000e+02 0.000000000000e+00 "
    "0.000000000000e+00 0.000000000000e+00 1.000000000000e+00 0.000000000000e+00\n"
    "P2: 7.188560000000e+02 0.000000000000e+00 6.071928000000e+02 4.538225000000e+01 "
    "0.000000000000e+00 7.188560000000e+02 1.852157000000e+02 -1.130887000000e-01 "
    "0.000000000000e+00 0.000000000000e+00 1.000000000000e+00 3.779761000000e-03\n"
    "Tr: 1 0 0 0 0 1 0 0 0 0 1 0\n";
constexpr std::array<Real, 12> P2{718.856L,  0,           607.1928L, 45.38225L, 0, 718.856L,
                                  185.2157L, -0.1130887L, 0,         0,         1, 0.003779761L};
const GivenLens size{.width = 1241, .height = 376};

/// By P; pixel centres at integers.
Seen by_projection(const std::array<Real, 12>& P, const Vector& X) {
  const auto row = [&](std::size_t i) {
    return P[4 * i] * X[0] + P[4 * i + 1] * X[1] + P[4 * i + 2] * X[2] + P[4 * i + 3];
  };
  return {row(0) / row(2) + 0.5L, row(1) / row(2) + 0.5L, row(2)};
}

template <class Read>
std::string fault(const Read& read) {
  return message_of<InputError>([&] { judged(read()); });
}

TEST(ImportKitti, CamerasStandBesideCameraZero) {
  const auto cameras = judged(parse_kitti({odometry, "calib.txt"}, std::nullopt, {}, size));
  ASSERT_EQ(cameras.size(), 2U);
  EXPECT_EQ(cameras[0].camera.name, "image_0");
  EXPECT_EQ(cameras[1].camera.name, "image_2");
  EXPECT_EQ(cameras[0].camera.world_to_camera, Camera().world_to_camera);
  EXPECT_EQ(cameras[1].camera.width, 1241U);
  for (const Vector& X : {Vector{1, 2, 10}, Vector{-8, 0.5L, 30}})
    expect_same(seen(cameras[1].camera, X), by_projection(P2, X));
  // 6 cm to the left of camera 0, as the devkit has it: t = (45.38225 − 607.1928·0.003779761)/f.
  EXPECT_NEAR(cameras[1].camera.world_to_camera[0][3], 0.0599, 1e-4);
}

TEST(ImportKitti, ProjectsAlongATrajectory) {
  Draws draw(6);
  for (int round = 0; round < 100; ++round) {
    // [A | b], camera 0 to world: a turn, its columns in binary64 as the file would have them.
    const std::array<Real, 4> q{draw(-1, 1), draw(-1, 1), draw(-1, 1), draw(0.25, 1)};
    std::array<Vector, 3> axes;
    for (std::size_t k = 0; k < 3; ++k) {
      Vector e{};
      e[k] = 1;
      axes[k] = turned(q, e);
      for (Real& x : axes[k]) x = static_cast<double>(x);
    }
    const Vector b = draw.point(5);
    std::string line;
    for (std::size_t i = 0; i < 3; ++i)
      line += joined(std::array{axes[0][i], axes[1][i], axes[2][i], b[i]}, " ") + " ";
    const auto cameras = judged(
        parse_kitti({odometry, "calib.txt"}, NamedText{line + "\n" + line, "00.txt"}, 2, size));
    ASSERT_EQ(cameras.size(), 2U);
    EXPECT_EQ(cameras[0].camera.name, "000000");
    EXPECT_EQ(cameras[1].camera.name, "000001");
    const Vector own{draw(-5, 5), draw(-5, 5), draw(10, 30)};
    Vector X = b;
    for (std::size_t i = 0; i < 3; ++i)
      for (std::size_t k = 0; k < 3; ++k) X[i] += axes[k][i] * own[k];
    for (Real& x : X) x = static_cast<double>(x);
    expect_same(seen(cameras[1].camera, X), by_projection(P2, own));
  }
}

TEST(ImportKitti, RawCalibrationHasItsSizes) {
  const std::string raw =
      "calib_time: 09-Jan-2012 13:57:47\ncorner_dist: 9.950000e-02\nS_02: 1.392000e+03 "
      "5.120000e+02\n"
      "P_rect_02: 7.215377e+02 0 6.095593e+02 4.485728e+01 0 7.215377e+02 1.728540e+02 "
      "2.163791e-01 "
      "0 0 1 2.745884e-03\nS_rect_02: 1.242000e+03 3.750000e+02\n";
  const auto cameras = judged(parse_kitti({raw, "c.txt"}, std::nullopt, {}, {}));
  ASSERT_EQ(cameras.size(), 1U);
  EXPECT_EQ(cameras[0].camera.name, "image_02");
  EXPECT_EQ(cameras[0].camera.width, 1242U);
  EXPECT_EQ(cameras[0].camera.height, 375U);
  const std::array<Real, 12> P{721.5377L, 0,          609.5593L, 44.85728L, 0, 721.5377L,
                               172.854L,  0.2163791L, 0,         0,         1, 0.002745884L};
  const Vector X{1, 2, 10};
  expect_same(seen(cameras[0].camera, X), by_projection(P, X));
}

TEST(ImportKitti, NamesLineAndFault) {
  const auto text = [&](const std::string& calibration, const char* poses = nullptr) {
    return fault([&] {
      return parse_kitti({calibration, "calib.txt"},
                         poses ? std::optional(NamedText{poses, "00.txt"}) : std::nullopt, 2, size);
    });
  };
  EXPECT_THAT(text("K: 1"), HasSubstr("calib.txt: expected P0 to P3"));
  EXPECT_THAT(text("P0: 1 2 3"), HasSubstr("calib.txt: line 1: expected 3 rows of 4 numbers"));
  EXPECT_THAT(text("P0: 1 0 2 0 9 1 2 0 0 0 1 0"), HasSubstr("line 1: expected fx s cx"));
  EXPECT_THAT(text("P0: 1 0 2 nan 0 1 2 0 0 0 1 0"), HasSubstr("line 1: a number is not finite"));
  EXPECT_THAT(text("P0: 0 0 2 0 0 1 2 0 0 0 1 0"), HasSubstr("line 1: fx is 0"));
  EXPECT_THAT(text(std::string(odometry) + odometry), HasSubstr("P0 stands twice"));
  EXPECT_THAT(text(odometry, "1 2 3"), HasSubstr("00.txt: line 1: expected a matrix"));
  EXPECT_THAT(text(odometry, "0 0 0 0 0 0 0 0 0 0 0 0"),
              HasSubstr("line 1: the matrix is singular"));
  EXPECT_THAT(text(odometry, ""), HasSubstr("00.txt: holds no pose"));
  EXPECT_THAT(text("P0: 1 0 2 0 0 1 2 0 0 0 1 0", ""), HasSubstr("calib.txt: has no camera 2"));
  EXPECT_THAT(text("P_rect_00: 1 0 2 0 0 1 2 0 0 0 1 0\nS_rect_00: 1.5 2"),
              HasSubstr("line 2: expected the image's width and height"));
  EXPECT_THROW(parse_kitti({odometry, "calib.txt"}, std::nullopt, {}, {}), UsageError);
  EXPECT_THROW(parse_kitti({odometry, "calib.txt"}, NamedText{"", "00.txt"}, {}, size), UsageError);
}

}  // namespace
}  // namespace fathom
