// Project Aria's cameras project as `facebookresearch/projectaria_tools`: has them in its classes
// FisheyeRadTanThinPrism and KannalaBrandtK3, and stand where its parseCameraCalibrationFromJson()
// has them. The centre of the first pixel is 0 (checkPixelInImageBound()).
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <string>

#include "fathom/camera/data_set_cameras.h"
#include "fathom/failures/errors.h"
#include "tests/camera/imported_rays.h"
#include "tests/camera/judged.h"
#include "tests/scratch_folder.h"

namespace fathom {
namespace {

using namespace test;
using ::testing::HasSubstr;

const std::string config = R"(, "ConfigData": {"ImageWidth": 8, "ImageHeight": 6,
    "MaxSolidAngle": 1.25, "ValidRadius": 3})";
const std::string at_device = R"({"Translation": [0, 0, 0], "UnitQuaternion": [1, [0, 0, 0]]})";

std::string camera(const std::string& label, const std::string& name, const std::string& params,
                   const std::string& more = config, const std::string& pose = at_device) {
  return R"({"Calibrated": true, "Label": ")" + label + R"(", "SerialNumber": "0",
    "Projection": {"Name": ")" +
         name + R"(", "Description": "", "Params": [)" + params + R"(]}, "T_Device_Camera": )" +
         pose + more + "}";
}

std::string file_of(const std::string& cameras, const std::string& more = "") {
  return R"({"CameraCalibrations": [)" + cameras + R"(], "ImuCalibrations": [])" + more + "}";
}

std::vector<ImportedCamera> import(const std::string& json, const GivenLens& given = {},
                                   const CalibrationPoses& poses = {}) {
  return cameras_of_aria(json, "calib.json", given, poses);
}

ImportedCamera one(const std::string& json) {
  return import(file_of(json)).at(0);
}

const std::string fisheye624 =
    "5, 3.25, 2.5, 0.01, -0.02, 0.03, -0.01, 0.002, 0.001, 0.003, -0.004, 0.005, -0.002, 0.001, "
    "0.006";

TEST(ImportAria, KannalaBrandt) {
  const ImportedCamera imported =
      one(camera("rgb", "KannalaBrandtK3", "5, 6, 3.25, 2.5, 0.01, -0.02, 0.03, -0.004"));
  ASSERT_EQ(imported.fault + imported.absence, "");
  EXPECT_EQ(imported.camera.name, "rgb");
  EXPECT_EQ(imported.camera.width, 8U);
  EXPECT_EQ(imported.camera.height, 6U);
  EXPECT_EQ(imported.camera.projection.pixel_centre, 0);
  EXPECT_EQ(imported.camera.projection.lens->max_radius, 1.25);
  expect_rays(imported.camera, 0, [](const Direction& d) {
    const double r = std::hypot(d[0], d[1]), theta = std::atan2(r, d[2]), t = theta * theta;
    const double s =
        theta * (1 + 0.01 * t - 0.02 * t * t + 0.03 * t * t * t - 0.004 * t * t * t * t) / r;
    return PixelPoint{5 * d[0] * s + 3.25, 6 * d[1] * s + 2.5};
  });
}

TEST(ImportAria, Fisheye624) {
  const ImportedCamera imported = one(camera("slam", "FisheyeRadTanThinPrism", fisheye624));
  EXPECT_EQ(imported.fault, "");
  if (!lens_model_named("RAD_TAN_THIN_PRISM_FISHEYE")) {
    EXPECT_EQ(imported.absence,
              "calib.json: CameraCalibrations[0].Projection.Params: the lens model "
              "RAD_TAN_THIN_PRISM_FISHEYE is not available");
    return;
  }
  ASSERT_EQ(imported.absence, "");
  expect_rays(imported.camera, 0, [](const Direction& d) {
    const double r = std::hypot(d[0], d[1]), theta = std::atan2(r, d[2]), t = theta * theta;
    const double k[]{0.01, -0.02, 0.03, -0.01, 0.002, 0.001};
    double radial = 1, power = t;
    for (const double coefficient : k) {
      radial += coefficient * power;
      power *= t;
    }
    const double x = theta * radial * d[0] / r, y = theta * radial * d[1] / r, q = x * x + y * y;
    const double p0 = 0.003, p1 = -0.004;
    const double u = x + (2 * x * x + q) * p0 + 2 * x * y * p1 + 0.005 * q - 0.002 * q * q;
    const double v = y + (2 * y * y + q) * p1 + 2 * x * y * p0 + 0.001 * q + 0.006 * q * q;
    return PixelPoint{5 * u + 3.25, 5 * v + 2.5};
  });
}

const std::string kannala = "5, 6, 3.25, 2.5, 0, 0, 0, 0";

// A quarter turn about x: the quaternion (1, 1, 0, 0) takes the camera's (x, y, z) to (x, −z, y).
TEST(ImportAria, CamerasStandOnTheDevice) {
  const std::string turned = R"({"Translation": [1, 2, 3], "UnitQuaternion": [1, [1, 0, 0]]})";
  const Pose pose{{{1, 0, 0, -1}, {0, 0, 1, -3}, {0, -1, 0, 2}}};
  const std::string json = file_of(camera("a", "KannalaBrandtK3", kannala) + "," +
                                   camera("b", "KannalaBrandtK3", kannala, config, turned));
  const auto cameras = judged(import(json));
  ASSERT_EQ(cameras.size(), 2U);
  EXPECT_EQ(cameras[0].camera.world_to_camera, Camera().world_to_camera);
  EXPECT_EQ(cameras[1].camera.world_to_camera, pose);
  // The device one unit to the right: the world's (x, y, z) is the device's (x − 1, y, z).
  const Pose device{{{1, 0, 0, -1}, {0, 1, 0, 0}, {0, 0, 1, 0}}};
  const auto moved = judged(import(json, {}, {{{"7", device}}}));
  EXPECT_EQ(moved.at(1).camera.name, "b/7");
  const Pose both{{{1, 0, 0, -2}, {0, 0, 1, -3}, {0, -1, 0, 2}}};
  EXPECT_EQ(moved.at(1).camera.world_to_camera, both);
}

TEST(ImportAria, SizesComeFromThreePlaces) {
  const std::string bare = camera("a", "KannalaBrandtK3", kannala, "");
  const auto listed = judged(import(file_of(bare, R"(, "ImageSizes": [[640, 480]])")));
  EXPECT_EQ(listed.at(0).camera.width, 640U);
  EXPECT_EQ(listed.at(0).camera.height, 480U);
  EXPECT_EQ(listed.at(0).camera.projection.lens, Lens{LensModel::opencv_fisheye});
  const auto given =
      judged(import(file_of(bare), {.width = 64, .height = 48, .pixel_centre = 0.5}));
  EXPECT_EQ(given.at(0).camera.width, 64U);
  EXPECT_EQ(given.at(0).camera.projection.pixel_centre, 0.5);
  EXPECT_THAT(one(bare).fault, HasSubstr("CameraCalibrations[0]: has no image size: expected"));
}

TEST(ImportAria, FaultsAreNamed) {
  EXPECT_EQ(one(camera("a", "Fisheye62", "1")).fault,
            "calib.json: CameraCalibrations[0].Projection.Name: found Fisheye62, expected "
            "FisheyeRadTanThinPrism or KannalaBrandtK3");
  EXPECT_THAT(one(camera("a", "FisheyeRadTanThinPrism", "1, 2, 3")).fault,
              HasSubstr("CameraCalibrations[0].Projection.Params: expected"));
  EXPECT_THAT(one(camera("a", "KannalaBrandtK3", kannala, config,
                         R"({"Translation": [1, 2, 3], "UnitQuaternion": [0, [0, 0, 0]]})"))
                  .fault,
              HasSubstr("T_Device_Camera.UnitQuaternion: the quaternion is zero"));
  EXPECT_THAT(one(camera("a", "KannalaBrandtK3", kannala, config, "{}")).fault,
              HasSubstr("T_Device_Camera: the key \"Translation\" is missing"));
  EXPECT_THAT(one(camera("a", "KannalaBrandtK3", kannala,
                         R"(, "ConfigData": {"ImageWidth": 8, "ImageHeight": 6,
                            "MaxSolidAngle": 0})"))
                  .fault,
              HasSubstr("ConfigData.MaxSolidAngle: expected an angle greater than 0"));
  std::string off = camera("a", "KannalaBrandtK3", kannala);
  off.replace(off.find("true"), 4, "false");
  EXPECT_EQ(one(off).absence, "calib.json: CameraCalibrations[0]: is not calibrated");
  const auto fault = [](const std::string& json) {
    return message_of<InputError>([&] { import(json); });
  };
  EXPECT_THAT(fault("{}"), HasSubstr("calib.json: the key \"CameraCalibrations\" is missing"));
  EXPECT_THAT(fault(file_of("{}")), HasSubstr("the key \"Label\" is missing"));
  EXPECT_THAT(fault(R"({"CameraCalibrations": [)"), HasSubstr("calib.json: line 1: not JSON"));
  const std::string twice = camera("a", "KannalaBrandtK3", kannala);
  EXPECT_THAT(fault(file_of(twice + "," + twice)), HasSubstr("two images have the name 'a'"));
}

}  // namespace
}  // namespace fathom
