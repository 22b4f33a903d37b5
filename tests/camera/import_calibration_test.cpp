// Calibrations of OpenCV and ROS.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string>

#include "fathom/camera/data_set_cameras.h"
#include "fathom/failures/errors.h"
#include "tests/camera/judged.h"

namespace fathom {
namespace {

using namespace test;
using ::testing::HasSubstr;

constexpr const char* matrix =
    R"({"rows": 3, "cols": 3, "dt": "d", "data": [600, 2, 319.5, 0, 601, 239.5, 0, 0, 1]})";

std::string opencv(const std::string& distortion, const std::string& more = "") {
  return R"({"image_width": 640, "image_height": 480, "camera_matrix": )" + std::string(matrix) +
         R"(, "distortion_coefficients": )" + distortion + more + "}";
}

std::string ros(const std::string& model, const std::string& distortion) {
  return R"({"image_width": 640, "image_height": 480, "camera_name": "left", "camera_matrix": )" +
         std::string(matrix) + R"(, "distortion_model": ")" + model +
         R"(", "distortion_coefficients": )" + distortion + "}";
}

ImportedCamera of_opencv(const std::string& json, const GivenLens& given = {}) {
  return cameras_of_opencv(json, "calibrations/left.yml", given).at(0);
}

ImportedCamera of_ros(const std::string& json) {
  return cameras_of_ros(json, "ost.yaml", {}).at(0);
}

TEST(ImportCalibration, OpencvIsTakenAsItIs) {
  const ImportedCamera one = of_opencv(opencv("[-0.25, 0.06, 0.001, -0.0005, 0.01]"));
  EXPECT_EQ(one.fault + one.absence + one.distortion, "");
  EXPECT_EQ(one.camera.name, "left");
  EXPECT_EQ(one.camera.width, 640U);
  EXPECT_EQ(one.camera.height, 480U);
  const Projection& projection = one.camera.projection;
  EXPECT_EQ(projection.fx, 600);
  EXPECT_EQ(projection.skew, 2);
  EXPECT_EQ(projection.fy, 601);
  EXPECT_EQ(projection.cx, 319.5);
  EXPECT_EQ(projection.cy, 239.5);
  EXPECT_EQ(projection.pixel_centre, 0);
  EXPECT_EQ(projection.lens, (Lens{LensModel::opencv_14, {-0.25, 0.06, 0.001, -0.0005, 0.01}}));
  EXPECT_EQ(one.camera.world_to_camera, Camera().world_to_camera);
}

TEST(ImportCalibration, OpencvHasAFewCountsOfNumbers) {
  for (const std::size_t count : {4, 5, 8, 12, 14}) {
    std::string list = "0.01";
    for (std::size_t i = 1; i < count; ++i) list += ", 0.01";
    const ImportedCamera one = of_opencv(opencv("[[" + list + "]]"));
    EXPECT_EQ(one.fault, "") << count;
    EXPECT_EQ(one.camera.projection.lens->distortion[count - 1], 0.01);
    EXPECT_EQ(count == 14 || one.camera.projection.lens->distortion[count] == 0, true);
  }
  EXPECT_THAT(
      of_opencv(opencv("[1, 2, 3]")).fault,
      HasSubstr("distortion_coefficients: found 3 numbers, OPENCV_14 has 4, 5, 8, 12 or 14"));
  EXPECT_EQ(of_opencv(opencv("[0, 0, 0, 0, 0]")).camera.projection.lens, std::nullopt);
}

TEST(ImportCalibration, OpencvHasOtherNames) {
  const std::string other = R"({"image_Width": 640, "image_Height": 480, "cameraMatrix": )" +
                            std::string(matrix) + R"(, "distCoeffs": [0.1, 0, 0, 0]})";
  EXPECT_EQ(of_opencv(other).camera.projection.lens, (Lens{LensModel::opencv_14, {0.1}}));
}

TEST(ImportCalibration, OpencvHasFisheyes) {
  const auto lens = [](const std::string& list) {
    return of_opencv(opencv(list, R"(, "fisheye_model": 1)")).camera.projection.lens;
  };
  EXPECT_EQ(lens("[0.1, 0.2, 0.3, 0.4]"), (Lens{LensModel::opencv_fisheye, {0.1, 0.2, 0.3, 0.4}}));
  EXPECT_EQ(lens("[0, 0, 0, 0]"), Lens{LensModel::opencv_fisheye});
}

TEST(ImportCalibration, ValuesCanBeGiven) {
  const GivenLens given{.width = 320, .height = 240, .K = {}, .pixel_centre = 0.5};
  const Camera camera = of_opencv(opencv("[0, 0, 0, 0]"), given).camera;
  EXPECT_EQ(camera.width, 320U);
  EXPECT_EQ(camera.height, 240U);
  EXPECT_EQ(camera.projection.pixel_centre, 0.5);
}

TEST(ImportCalibration, EachPoseIsACamera) {
  const Pose pose{{{1, 0, 0, 1}, {0, 1, 0, 2}, {0, 0, 1, 3}}};
  const Pose inverse{{{1, 0, 0, -1}, {0, 1, 0, -2}, {0, 0, 1, -3}}};
  const std::string text = opencv("[0.1, 0, 0, 0]");
  const auto cameras = judged(cameras_of_opencv(text, "a.yml", {}, {{{"0", pose}, {"1", pose}}}));
  ASSERT_EQ(cameras.size(), 2U);
  EXPECT_EQ(cameras[1].camera.name, "1");
  EXPECT_EQ(cameras[1].camera.world_to_camera, pose);
  EXPECT_EQ(cameras[1].camera.projection.lens, (Lens{LensModel::opencv_14, {0.1}}));
  const auto inverted =
      judged(cameras_of_opencv(text, "a.yml", {}, {{{"0", pose}}, PoseDirection::camera_to_world}));
  EXPECT_EQ(inverted.at(0).camera.world_to_camera, inverse);
}

TEST(ImportCalibration, OpencvFaultsAreNamed) {
  EXPECT_THAT(of_opencv("{}").fault, HasSubstr("left.yml: has no camera matrix: expected"));
  EXPECT_THAT(of_opencv(R"({"K": [1, 0, 0, 0, 1, 0, 0, 0, 1], "D": [0, 0, 0, 0]})").fault,
              HasSubstr("has no image size: expected image_width or image_Width"));
  EXPECT_THAT(
      of_opencv(R"({"image_width": 4, "image_height": 3, "K": [1, 0, 0, 0, 1, 0, 0, 0]})").fault,
      HasSubstr("K: expected 3 rows of 3 numbers, found 8 numbers"));
  EXPECT_THAT(of_opencv(opencv(R"({"rows": 5, "cols": 1, "data": [1, 2]})")).fault,
              HasSubstr("has 2 numbers, expected rows times cols, 5"));
  EXPECT_THAT(of_opencv(opencv("[0.1, 0, 0, \"x\"]")).fault, HasSubstr("[3]"));
  EXPECT_THAT(of_opencv(opencv("[0, 0, 0, 0, 0]", R"(, "fisheye_model": 1)")).fault,
              HasSubstr("found 5 numbers, OPENCV_FISHEYE has 4"));
  EXPECT_EQ(of_opencv(opencv("[0, 0, 0, 0]", R"(, "fisheye_model": 0)")).distortion, "");
  EXPECT_THAT(
      of_opencv(R"({"image_width": 4, "image_height": 3, "K": )" + std::string(matrix) + "}")
          .distortion,
      HasSubstr("has no numbers of distortion: expected distortion_coefficients"));
  EXPECT_THAT(of_opencv(opencv("[0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 9, 0]")).distortion,
              HasSubstr("tauX is not between"));
}

TEST(ImportCalibration, RosModels) {
  const ImportedCamera one = of_ros(ros("plumb_bob", "[-0.25, 0.06, 0.001, -0.0005, 0.01]"));
  EXPECT_EQ(one.fault + one.absence + one.distortion, "");
  EXPECT_EQ(one.camera.name, "left");
  EXPECT_EQ(one.camera.projection.pixel_centre, 0);
  EXPECT_EQ(one.camera.projection.lens,
            (Lens{LensModel::opencv_14, {-0.25, 0.06, 0.001, -0.0005, 0.01}}));
  EXPECT_EQ(of_ros(ros("rational_polynomial", "[1, 2, 3, 4, 5, 6, 7, 8]")).camera.projection.lens,
            (Lens{LensModel::opencv_14, {1, 2, 3, 4, 5, 6, 7, 8}}));
  EXPECT_EQ(of_ros(ros("equidistant", "[1, 2, 3, 4]")).camera.projection.lens,
            (Lens{LensModel::opencv_fisheye, {1, 2, 3, 4}}));
  EXPECT_EQ(of_ros(ros("plumb_bob", "[]")).camera.projection.lens, std::nullopt);
}

TEST(ImportCalibration, RosFaultsAreNamed) {
  EXPECT_THAT(of_ros(ros("plumb_bob", "[1, 2, 3, 4, 5, 6, 7, 8]")).fault,
              HasSubstr("found 8 numbers, plumb_bob has 4 or 5"));
  EXPECT_THAT(of_ros(ros("rational_polynomial", "[1, 2, 3, 4]")).fault,
              HasSubstr("found 4 numbers, rational_polynomial has 8, 12 or 14"));
  EXPECT_THAT(of_ros(ros("equidistant", "[0, 0, 0, 0, 0]")).fault,
              HasSubstr("found 5 numbers, equidistant has 4"));
  EXPECT_THAT(of_ros(ros("unknown", "[0, 0, 0, 0]")).distortion,
              HasSubstr("distortion_model: unknown is not available yet; expected equidistant"));
}

TEST(ImportCalibration, RosMessages) {
  const std::string message =
      R"({"width": 640, "height": 480, "distortion_model": "plumb_bob", "d": [0.1, 0, 0, 0, 0],
          "k": [600, 0, 319.5, 0, 600, 239.5, 0, 0, 1]})";
  const ImportedCamera one = of_ros(message);
  EXPECT_EQ(one.fault, "");
  EXPECT_EQ(one.camera.name, "ost");
  EXPECT_EQ(one.camera.projection.lens, (Lens{LensModel::opencv_14, {0.1}}));
}

}  // namespace
}  // namespace fathom
