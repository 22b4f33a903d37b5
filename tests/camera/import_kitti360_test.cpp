// KITTI-360's fisheyes project as camodocal, which calibrated them, does
// (CataCamera::spaceToPlane()), and stand where autonomousvision/kitti360Scripts has them
// (helpers/project.py: cam2world = pose · camToPose). That script leaves p1 and p2 out.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <string>

#include "fathom/camera/camera_import_internal.h"
#include "fathom/failures/errors.h"
#include "tests/camera/imported_rays.h"
#include "tests/camera/judged.h"
#include "tests/scratch_folder.h"

namespace fathom {
namespace {

using namespace camera;
using namespace test;
using ::testing::HasSubstr;

std::string mei(const std::string& distortion, const std::string& mirror = R"("xi": 2.2134)") {
  return R"({"model_type": "MEI", "camera_name": "image_02", "image_width": 8, "image_height": 6,
    "mirror_parameters": {)" +
         mirror + R"(}, "distortion_parameters": {)" + distortion + R"(},
    "projection_parameters": {"gamma1": 13.36, "gamma2": 13.35, "u0": 3.25, "v0": 2.5}})";
}

const std::string straight = mei(R"("k1": 0, "k2": 0, "p1": 0, "p2": 0)");
const std::string bent = mei(R"("k1": 0.0168, "k2": 1.6549, "p1": 0.00042, "p2": 0.000425)");

ImportedCamera import_folder(const std::string& json) {
  return parse_kitti360({json, "image_02.yaml"}, {}, std::nullopt, std::nullopt).at(0);
}

PixelPoint on_mirror(const Direction& d) {
  const double w = d[2] + 2.2134 * std::sqrt(d[0] * d[0] + d[1] * d[1] + d[2] * d[2]);
  return {d[0] / w, d[1] / w};
}

PixelPoint in_image(double x, double y) {
  return {13.36 * x + 3.25, 13.35 * y + 2.5};
}

TEST(ImportKitti360, MirrorsProjectAsMeiDoes) {
  const ImportedCamera one = import_folder(straight);
  ASSERT_EQ(one.fault + one.absence, "");
  EXPECT_EQ(one.camera.name, "image_02");
  EXPECT_EQ(one.camera.width, 8U);
  EXPECT_EQ(one.camera.height, 6U);
  EXPECT_EQ(one.camera.projection.pixel_centre, 0);
  expect_rays(one.camera, 0, [](const Direction& d) {
    const auto [x, y] = on_mirror(d);
    return in_image(x, y);
  });
}

TEST(ImportKitti360, DistortionFollowsTheMirror) {
  const ImportedCamera one = import_folder(bent);
  if (entry_of(LensModel::omni).distortion.size() == 1) {
    EXPECT_EQ(one.absence, "image_02.yaml: the lens model OMNI has no parameter k1");
    return;
  }
  ASSERT_EQ(one.fault + one.absence, "");
  expect_rays(one.camera, 0, [](const Direction& d) {
    const auto [x, y] = on_mirror(d);
    const double q = x * x + y * y, radial = 0.0168 * q + 1.6549 * q * q;
    return in_image(x + x * radial + 2 * 0.00042 * x * y + 0.000425 * (q + 2 * x * x),
                    y + y * radial + 2 * 0.000425 * x * y + 0.00042 * (q + 2 * y * y));
  });
}

/// Quarter turns and steps, exact in binary64. The vehicle: x forward, y left, z up.
constexpr const char* rig =
    "image_00: 0 0 1 1.5 -1 0 0 0.25 0 -1 0 1.5\n"
    "image_02: 1 0 0 0.5 0 0 1 0.75 0 -1 0 1.25\n";
constexpr const char* poses = "250 0 -1 0 100 1 0 0 200 0 0 1 50\n1000 1 0 0 1 0 1 0 2 0 0 1 3\n";

std::vector<ImportedCamera> drive(const std::string& vehicle, const std::string& cameras = rig) {
  return parse_kitti360({straight, "image_02.yaml"}, {}, NamedText{vehicle, "poses.txt"},
                        NamedText{cameras, "calib_cam_to_pose.txt"});
}

TEST(ImportKitti360, FramesStandOnTheVehicle) {
  const auto cameras = judged(drive(poses));
  ASSERT_EQ(cameras.size(), 2U);
  EXPECT_EQ(cameras[0].camera.name, "0000000250");
  EXPECT_EQ(cameras[1].camera.name, "0000001000");
  // The camera's (x, y, z) is (x + 0.5, z + 0.75, −y + 1.25) on the vehicle, whose (X, Y, Z) is
  // (−Y + 100, X + 200, Z + 50) in the world.
  const std::array<double, 3> p{1, 2, 4};
  const std::array<double, 3> on_vehicle{p[0] + 0.5, p[2] + 0.75, -p[1] + 1.25};
  const WorldPoint world{-on_vehicle[1] + 100, on_vehicle[0] + 200, on_vehicle[2] + 50};
  const CameraPoint found = to_camera(cameras[0].camera.world_to_camera, world);
  EXPECT_EQ(found.x, Dyadic(1.0));
  EXPECT_EQ(found.y, Dyadic(2.0));
  EXPECT_EQ(found.z, Dyadic(4.0));
}

TEST(ImportKitti360, FilesAreRead) {
  const ScratchFolder folder;
  folder.write("poses.txt", poses);
  folder.write("rig.txt", rig);
  const auto cameras =
      cameras_of_kitti360(straight, "image_02.yaml", {},
                          Kitti360Poses{folder.path() / "poses.txt", folder.path() / "rig.txt"});
  EXPECT_EQ(cameras.size(), 2U);
}

TEST(ImportKitti360, FaultsAreNamed) {
  EXPECT_THAT(import_folder(R"({"model_type": "KANNALA_BRANDT"})").fault,
              HasSubstr("\"image_width\" is missing"));
  std::string other = straight;
  other.replace(other.find("MEI"), 3, "PINHOLE");
  EXPECT_EQ(import_folder(other).fault, "image_02.yaml: model_type: found PINHOLE, expected MEI");
  EXPECT_THAT(import_folder(mei(R"("k1": 0)")).fault,
              HasSubstr("image_02.yaml: distortion_parameters: the key \"k2\" is missing"));
  EXPECT_THAT(import_folder(mei(R"("k1": 0, "k2": 0, "p1": 0, "p2": ".nan")")).fault,
              HasSubstr("distortion_parameters.p2: is a string, expected a number"));
  EXPECT_EQ(import_folder(mei(R"("k1": 0, "k2": 0, "p1": 0, "p2": 0)", R"("xi": -1)")).fault,
            "image_02.yaml: xi is less than 0");
  const auto fault = [](const auto& run) { return message_of<InputError>(run); };
  EXPECT_EQ(fault([] { drive(poses, "image_00: 1 0 0 0 0 1 0 0 0 0 1 0\n"); }),
            "calib_cam_to_pose.txt: has no line of the camera image_02");
  EXPECT_THAT(fault([] { drive(poses, "image_02: 1 0 0 0 0 1 0 0 0 0 1\n"); }),
              HasSubstr("calib_cam_to_pose.txt: line 1: expected a matrix"));
  EXPECT_THAT(fault([] { drive(poses, "image_02: 1 0 0 0 1 0 0 0 0 0 1 0\n"); }),
              HasSubstr("calib_cam_to_pose.txt: line 1: the matrix is singular"));
  EXPECT_THAT(fault([] { drive("\n"); }), HasSubstr("poses.txt: holds no pose"));
  EXPECT_THAT(fault([] { drive("x 1 0 0\n"); }),
              HasSubstr("poses.txt: line 1: expected the number of a frame, found 'x'"));
  EXPECT_THAT(drive("1 1 0 0\n").at(0).fault, HasSubstr("poses.txt: line 1: expected a matrix"));
  EXPECT_THAT(drive("1 1 0 0 nan 0 1 0 2 0 0 1 3\n").at(0).fault,
              HasSubstr("poses.txt: line 1: the pose has a number that is not finite"));
}

}  // namespace
}  // namespace fathom
