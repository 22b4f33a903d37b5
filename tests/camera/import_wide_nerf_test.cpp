// The wide lenses of Nerfstudio, ScanNet++ and instant-ngp: their rays, as
// nerfstudio/cameras/cameras.py (_generate_rays_from_coords), scannetpp/common/utils/nerfstudio.py
// and instant-ngp's nerf_loader.cu (read_lens) and common_device.cuh (uv_to_ray) have them.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <cstdint>
#include <numbers>
#include <optional>
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
using std::numbers::pi;
using ::testing::ElementsAre;
using ::testing::HasSubstr;

std::string frame(const std::string& name, const std::string& more = "") {
  return R"({"file_path": ")" + name + R"(", "mask_path": "m.png", "is_bad": false)" + more +
         R"(, "transform_matrix": [[1,0,0,1],[0,1,0,2],[0,0,1,3],[0,0,0,1]]})";
}

std::vector<ImportedCamera> import(const std::string& keys, const std::string& lists) {
  Warnings warnings;
  return judged(parse_nerf("{" + keys + ", " + lists + "}", "transforms.json", 0, 0, warnings));
}

Camera only_camera(const std::string& keys) {
  return import(keys, R"("frames": [)" + frame("a.jpg") + "]").at(0).camera;
}

// Nerfstudio: coord = ((x − cx)/fx, −(y − cy)/fy), theta = −π·coord.x, phi = π·(0.5 − coord.y);
// direction (−sin theta·sin phi, cos phi, −cos theta·sin phi) with y up and z backward. Its tool
// writes fl_x = fl_y = height for 2:1 images.
TEST(ImportWideNerf, EquirectangularShowsATurn) {
  const Camera camera = only_camera(
      R"("camera_model": "EQUIRECTANGULAR", "fl_x": 8, "fl_y": 8, "cx": 8, "cy": 4, "w": 16,
          "h": 8)");
  EXPECT_EQ(camera.projection.lens, Lens{LensModel::equirectangular});
  EXPECT_EQ(camera.projection.pixel_centre, 0.5);
  expect_rays(camera, 0.5, [](const Direction& d) {
    // Ours is x right, y down, z forward.
    const double x = d[0], up = -d[1], back = -d[2];
    const double theta = std::atan2(-x, -back);
    const double phi = std::atan2(std::hypot(x, back), up);
    return PixelPoint{8 - 8 * theta / pi, 4 - 8 * (0.5 - phi / pi)};
  });
}

TEST(ImportWideNerf, PanoramasMayBeParts) {
  const Camera camera =
      only_camera(R"("camera_model": "EQUIRECTANGULAR", "fl_x": 20, "fl_y": 12, "cx": 7, "cy": 2.5,
          "w": 10, "h": 5, "k1": 0.5)");
  EXPECT_EQ(camera.projection.fx, 40);
  EXPECT_EQ(camera.projection.fy, 12);
  EXPECT_EQ(camera.projection.cx, 7);
  EXPECT_EQ(camera.projection.cy, 2.5);
  EXPECT_THAT(message_of<InputError>(
                  [] { only_camera(R"("camera_model": "EQUIRECTANGULAR", "w": 8, "h": 4)"); }),
              HasSubstr("the focal length is missing"));
}

// As ScanNet++ has it: one lens for all frames, which are in two lists.
TEST(ImportWideNerf, ScanNetppHasTwoListsOfFrames) {
  const auto cameras = import(
      R"("fl_x": 5, "fl_y": 6, "cx": 4, "cy": 3, "w": 8, "h": 6, "k1": 0.01, "k2": -0.02,
         "k3": 0.03, "k4": -0.004, "camera_model": "OPENCV_FISHEYE", "has_mask": true)",
      R"("frames": [)" + frame("DSC1.JPG") + "," + frame("DSC3.JPG") + R"(], "test_frames": [)" +
          frame("DSC2.JPG", R"(, "fl_x": 7)") + "]");
  std::vector<std::string> names;
  for (const ImportedCamera& each : cameras) names.push_back(each.camera.name);
  EXPECT_THAT(names, ElementsAre("DSC1.JPG", "DSC3.JPG", "DSC2.JPG"));
  EXPECT_EQ(cameras[2].camera.projection.fx, 7);  // a frame's own keys come first
  expect_rays(cameras[0].camera, 0.5, [](const Direction& d) {
    const double r = std::hypot(d[0], d[1]), theta = std::atan2(r, d[2]), t = theta * theta;
    const double s =
        theta * (1 + 0.01 * t - 0.02 * t * t + 0.03 * t * t * t - 0.004 * t * t * t * t) / r;
    return PixelPoint{5 * d[0] * s + 4, 6 * d[1] * s + 3};
  });
}

// Nerfstudio undistorts the coordinates of a fisheye by all six numbers (camera_utils.py,
// radial_and_tangential_undistort); their length is the angle then.
TEST(ImportWideNerf, NerfstudiosFisheyeMayBeDecentred) {
  const Camera camera = only_camera(
      R"("camera_model": "OPENCV_FISHEYE", "fl_x": 5, "fl_y": 6, "cx": 4, "cy": 3, "w": 8, "h": 6,
         "k1": 0.01, "k2": -0.02, "k3": 0.03, "k4": -0.004, "p1": 0.005, "p2": -0.003)");
  EXPECT_EQ(camera.projection.lens,
            (Lens{LensModel::thin_prism_fisheye, {0.01, -0.02, 0.005, -0.003, 0.03, -0.004}}));
  expect_rays(camera, 0.5, [](const Direction& d) {
    const double sine = std::hypot(d[0], d[1]), theta = std::atan2(sine, d[2]);
    const double x = theta * d[0] / sine, y = theta * d[1] / sine, r = x * x + y * y;
    const double radial = 1 + r * (0.01 + r * (-0.02 + r * (0.03 - r * 0.004)));
    return PixelPoint{4 + 5 * (radial * x + 2 * 0.005 * x * y - 0.003 * (r + 2 * x * x)),
                      3 + 6 * (radial * y - 2 * 0.003 * x * y + 0.005 * (r + 2 * y * y))};
  });
}

TEST(ImportWideNerf, InstantNgpsFisheyeIsNotDecentred) {
  const std::string fisheye = R"("is_fisheye": true, "fl_x": 5, "w": 8, "h": 6, "k1": 0.01, )";
  EXPECT_EQ(only_camera(fisheye + R"("k3": 0.5, "p1": 0, "p2": 0)").projection.lens,
            (Lens{LensModel::opencv_fisheye, {0.01, 0, 0.5}}));
  for (const std::string key : {"p1", "p2"}) {
    EXPECT_THAT(
        message_of<InputError>([&] { only_camera(fisheye + "\"" + key + R"(": 0.001)"); }),
        HasSubstr(key + ": Nerfstudio and instant-ngp read p1 and p2 of a fisheye in different"));
  }
}

// The keys of read_lens() and the rays of uv_to_ray(), whose y points down.
TEST(ImportWideNerf, InstantNgpsFThetaIsAPolynomialOfPixels) {
  const std::string keys =
      R"("ftheta_p0": 0.01, "ftheta_p1": 0.2, "ftheta_p2": 0.002, "ftheta_p3": -1e-4,
         "ftheta_p4": 1e-5, "w": 16, "h": 12, "cx": 7.25, "cy": 6.5)";
  const Camera camera = only_camera(keys);
  expect_directions(camera, [](std::uint32_t column, std::uint32_t row) {
    const double x = ((column + 0.5) / 16 - 7.25 / 16) * 16, y = ((row + 0.5) / 12 - 6.5 / 12) * 12;
    const double r = std::sqrt(x * x + y * y);
    const double alpha = 0.01 + r * (0.2 + r * (0.002 + r * (-1e-4 + r * 1e-5)));
    std::optional<Direction> ray;
    if (std::cos(alpha) > 0 && r != 0)
      ray = Direction{std::sin(alpha) * x / r, std::sin(alpha) * y / r, std::cos(alpha)};
    return ray;
  });
  EXPECT_EQ(only_camera(keys + R"(, "fl_x": 7, "k1": 0.5)").projection, camera.projection);
  EXPECT_EQ(message_of<InputError>([] { only_camera(R"("ftheta_p0": 0, "w": 8, "h": 4)"); }),
            "transforms.json: frames[0]: the f-theta lens has no ftheta_p1: expected ftheta_p0 to "
            "p4");
}

TEST(ImportWideNerf, InstantNgpsLatlongShowsAllDirections) {
  const Camera camera = only_camera(R"("latlong": true, "fl_x": 5, "cx": 1, "w": 16, "h": 8)");
  expect_directions(camera, [](std::uint32_t column, std::uint32_t row) {
    const double theta = ((row + 0.5) / 8 - 0.5) * pi, phi = ((column + 0.5) / 16 - 0.5) * pi * 2;
    return std::optional(Direction{std::sin(phi) * std::cos(theta), std::sin(theta),
                                   std::cos(phi) * std::cos(theta)});
  });
}

// Project Aria's lens: distortion_params are k0 to k5, p0, p1, s0 to s3.
TEST(ImportWideNerf, Fisheye624HasAListOfNumbers) {
  const std::string keys =
      R"("camera_model": "FISHEYE624", "fl_x": 5, "fl_y": 6, "cx": 4, "cy": 3, "w": 8, "h": 6,
         "distortion_params": [0.01, -0.02, 0.03, -0.01, 0.002, 0.001, 0.003, -0.004, 0.005, -0.002,
                               0.001, 0.006])";
  Warnings warnings;
  const ImportedCamera imported =
      parse_nerf("{" + keys + R"(, "frames": [)" + frame("a.jpg") + "]}", "transforms.json", 0, 0,
                 warnings)
          .at(0);
  EXPECT_EQ(imported.fault, "");
  if (!lens_model_named("RAD_TAN_THIN_PRISM_FISHEYE")) {
    EXPECT_EQ(imported.absence,
              "transforms.json: distortion_params: the lens model RAD_TAN_THIN_PRISM_FISHEYE is "
              "not available");
    return;
  }
  EXPECT_EQ(imported.absence, "");
  const auto& numbers = imported.camera.projection.lens->distortion;
  EXPECT_EQ(std::vector(numbers.begin(), numbers.begin() + 12),
            (std::vector{0.01, -0.02, 0.03, -0.01, 0.002, 0.001, 0.003, -0.004, 0.005, -0.002,
                         0.001, 0.006}));
}

}  // namespace
}  // namespace fathom
