// NeRF's cameras project as NeRF does.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <array>
#include <string>

#include "fathom/camera/camera_import_internal.h"
#include "fathom/failures/errors.h"
#include "tests/camera/judged.h"
#include "tests/camera/seen_points.h"
#include "tests/places.h"
#include "tests/scratch_folder.h"

namespace fathom {
namespace {

using namespace camera;
using namespace test;
using ::testing::HasSubstr;

std::vector<ImportedCamera> nerf(const std::string& text, Warnings& warnings,
                                 std::uint32_t width = 0, std::uint32_t height = 0) {
  return judged(parse_nerf(text, "transforms.json", width, height, warnings));
}

TEST(ImportNerf, ProjectsAsNerfDoes) {
  Draws draw(2);
  Warnings warnings;
  for (int round = 0; round < 200; ++round) {
    // A camera to world matrix with OpenGL's axes: columns right, up, backward, eye. Its columns
    // are turned and stretched unit vectors, so it is not even orthogonal.
    std::array<Vector, 3> axes;
    const std::array<Real, 4> q{draw(-1, 1), draw(-1, 1), draw(-1, 1), draw(0.25, 1)};
    for (int k = 0; k < 3; ++k) {
      Vector e{};
      e[k] = 1;
      axes[k] = turned(q, e);
      for (Real& x : axes[k]) x = static_cast<double>(x);
    }
    const Vector eye = draw.point(5);
    std::string rows;
    for (int i = 0; i < 3; ++i)
      rows += std::string("[") + text_of(static_cast<double>(axes[0][i])) + "," +
              text_of(static_cast<double>(axes[1][i])) + "," +
              text_of(static_cast<double>(axes[2][i])) + "," +
              text_of(static_cast<double>(eye[i])) + "],";
    const double fx = draw(300, 900), fy = draw(300, 900), cx = draw(0, 600), cy = draw(0, 400);
    const auto cameras = nerf(R"({"fl_x": )" + text_of(fx) + R"(, "w": 640, "h": 480, "cy": )" +
                                  text_of(cy) + R"(, "frames": [{"file_path": "./0001.png", )" +
                                  R"("fl_y": )" + text_of(fy) + R"(, "cx": )" + text_of(cx) +
                                  R"(, "transform_matrix": [)" + rows + "[0,0,0,1]]}]}",
                              warnings);
    ASSERT_EQ(cameras.size(), 1U);
    EXPECT_EQ(cameras[0].camera.name, "./0001.png");
    EXPECT_EQ(cameras[0].camera.width, 640U);
    // The other way round: a point that is given in the camera's own axes.
    for (int i = 0; i < 5; ++i) {
      const Vector own{draw(-5, 5), draw(-5, 5), draw(-30, -10)};
      Vector X = eye;
      for (int k = 0; k < 3; ++k)
        for (int j = 0; j < 3; ++j) X[k] += axes[j][k] * own[j];
      for (Real& x : X) x = static_cast<double>(x);  // moves it by 2⁻⁵³·40, as the others
      // Seen along −z, y up; the image's y points down.
      const Real depth = -own[2];
      expect_same(seen(cameras[0].camera, X),
                  {fx * own[0] / depth + cx, -fy * own[1] / depth + cy, depth});
    }
  }
  EXPECT_TRUE(warnings.empty());
}

constexpr const char* nerf_pose =
    R"("transform_matrix": [[1,0,0,1],[0,1,0,2],[0,0,1,3],[0,0,0,1]])";

TEST(ImportNerf, ExactWhereTheInverseIs) {
  Warnings warnings;
  const auto cameras =
      nerf(std::string(R"({"fl_x": 100, "w": 640, "h": 480, "frames": [{)") + nerf_pose + "}]}",
           warnings);
  const std::array<std::array<double, 4>, 3> expected{
      {{1, 0, 0, -1}, {0, -1, 0, 2}, {0, 0, -1, 3}}};
  EXPECT_EQ(cameras.at(0).camera.world_to_camera, expected);
  EXPECT_EQ(cameras.at(0).camera.projection.fy, 100);
  EXPECT_EQ(cameras.at(0).camera.projection.cx, 320);
  EXPECT_EQ(cameras.at(0).camera.projection.cy, 240);
  EXPECT_EQ(cameras.at(0).camera.projection.pixel_centre, 0.5);
  EXPECT_EQ(cameras.at(0).camera.name, "0");
}

TEST(ImportNerf, AnglesSpanTheImage) {
  Warnings warnings;
  // tan 45° = 1: half the width.
  const std::string frames = std::string(R"("frames": [{)") + nerf_pose + "}]}";
  const auto cameras =
      nerf(R"({"camera_angle_x": 1.5707963267948966, )" + frames, warnings, 800, 600);
  EXPECT_NEAR(cameras.at(0).camera.projection.fx, 400, 1e-12);
  EXPECT_EQ(cameras.at(0).camera.projection.fy, cameras.at(0).camera.projection.fx);
  const auto both = nerf(
      R"({"camera_angle_x": 1.5707963267948966, "camera_angle_y": 0.9272952180016122, )" + frames,
      warnings, 800, 600);
  EXPECT_NEAR(both.at(0).camera.projection.fy, 600, 1e-12);  // tan(½·atan2(4, 3)·…) = ½
  EXPECT_THAT(message_of<InputError>([&] { nerf(R"({"camera_angle_x": 1, )" + frames, warnings); }),
              HasSubstr("no image size was given"));
}

// instant-ngp: degrees, before all other keys; one of the two is that of both axes.
TEST(ImportNerf, DegreesSpanTheImage) {
  Warnings warnings;
  const std::string frames = std::string(R"("frames": [{)") + nerf_pose + "}]}";
  const auto focal_lengths = [&](const std::string& keys) {
    const Camera camera = nerf("{" + keys + frames, warnings, 800, 600).at(0).camera;
    return std::array{camera.projection.fx, camera.projection.fy};
  };
  EXPECT_EQ(focal_lengths(R"("x_fov": 90, )"), (std::array{400.0, 400.0}));
  EXPECT_EQ(focal_lengths(R"("y_fov": 90, )"), (std::array{300.0, 300.0}));
  EXPECT_EQ(focal_lengths(R"("x_fov": 90, "y_fov": 90, "fl_x": 7, )"), (std::array{400.0, 300.0}));
  EXPECT_EQ(focal_lengths(R"("x_fov": 90, "fl_x": 7, "fl_y": 8, )"), (std::array{400.0, 8.0}));
  EXPECT_THAT(message_of<InputError>([&] { focal_lengths(R"("x_fov": 180, )"); }),
              HasSubstr("x_fov: expected an angle in degrees between 0 and 180"));
}

TEST(ImportNerf, WarnsOfGeometryTellsDistortionAndNamesFaults) {
  Warnings warnings;
  const std::string frames =
      std::string(R"("fl_x": 100, "w": 6, "h": 4, "frames": [{)") + nerf_pose + "}]}";
  nerf(R"({"scale": 0.33, "offset": [0,0,0], "k1": 0, "camera_model": "OPENCV", )" + frames,
       warnings);
  EXPECT_THAT(warnings, testing::ElementsAre(HasSubstr("\"scale\""), HasSubstr("\"offset\"")));
  const auto fault = [&](const std::string& text) {
    return message_of<InputError>([&] { nerf(text, warnings); });
  };
  const auto distortion = [&](const std::string& text) {
    return nerf(text, warnings).at(0).distortion;
  };
  for (const char* pinhole : {"PINHOLE", "SIMPLE_PINHOLE", "OPENCV", "RADIAL", "SIMPLE_RADIAL"})
    EXPECT_EQ(distortion(std::string(R"({"camera_model": ")") + pinhole + "\", " + frames), "");
  EXPECT_EQ(distortion(R"({"k5": 1e-9, "p2": 1, )" + frames),
            "transforms.json: k5: lens distortion");
  const auto lens = [&](const std::string& text) {
    return nerf(text, warnings).at(0).camera.projection.lens;
  };
  EXPECT_EQ(lens(R"({"k1": 0, "p1": 0, )" + frames), std::nullopt);
  EXPECT_EQ(lens(R"({"k1": 1e-9, "k2": 2, "p1": 3, "p2": 1, )" + frames),
            (Lens{LensModel::opencv, {1e-9, 2, 3, 1}}));
  EXPECT_EQ(lens(R"({"k1": 1, "k2": 2, "k3": 3, "k4": 4, "p1": 5, "p2": 6, )" + frames),
            (Lens{LensModel::brown, {1, 2, 3, 4, 5, 6}}));
  EXPECT_THAT(fault(R"({"equirectangular": true, )" + frames),
              HasSubstr("equirectangular: instant-ngp's panorama with rows of equal area is not"));
  const Lens fisheye{LensModel::opencv_fisheye, {1, 2, 3, 4}};
  const std::string numbers = R"("k1": 1, "k2": 2, "k3": 3, "k4": 4, )" + frames;
  EXPECT_EQ(lens(R"({"camera_model": "OPENCV_FISHEYE", )" + numbers), fisheye);
  EXPECT_EQ(lens(R"({"is_fisheye": true, )" + numbers), fisheye);
  EXPECT_EQ(lens(R"({"is_fisheye": true, )" + frames), Lens{LensModel::opencv_fisheye});
  EXPECT_EQ(lens(R"({"is_fisheye": false, )" + frames), std::nullopt);
  EXPECT_THAT(fault(R"({"camera_model": "VR180_L", )" + frames),
              HasSubstr("VR180_L is not supported; undistort the images, or expected EQUIRECT"));
  EXPECT_THAT(fault(R"({"camera_model": "FISHEYE624", )" + frames),
              HasSubstr("the numbers of FISHEYE624 are missing: expected distortion_params"));
  EXPECT_THAT(fault(R"({"camera_model": "FISHEYE624", "distortion_params": [1], )" + frames),
              HasSubstr("distortion_params: expected"));
  EXPECT_THAT(fault("{}"), HasSubstr("\"frames\" is missing"));
  EXPECT_THAT(fault(R"({"frames": []})"), HasSubstr("no frame"));
  EXPECT_THAT(fault(std::string(R"({"w": 6, "h": 4, "frames": [{)") + nerf_pose + "}]}"),
              HasSubstr("frames[0]: the focal length is missing"));
  for (const char* angle : {"0", "-1", "3.2", "40"}) {
    EXPECT_THAT(fault(std::string(R"({"w": 6, "h": 4, "camera_angle_x": )") + angle +
                      R"(, "frames": [{)" + nerf_pose + "}]}"),
                HasSubstr("camera_angle_x: expected an angle in radians between 0 and π"));
  }
  EXPECT_THAT(fault(R"({"fl_x": 1, "w": 6, "h": 4, "frames": [{}]})"),
              HasSubstr("\"transform_matrix\" is missing"));
  EXPECT_THAT(fault(R"({"fl_x": 1, "w": 6, "h": 4, "frames": [{"transform_matrix": )"
                    R"([[1,2,0,0],[2,4,0,0],[0,0,1,0],[0,0,0,1]]}]})"),
              HasSubstr("frames[0].transform_matrix: the matrix is singular"));
  EXPECT_THAT(fault(R"({"fl_x": 1, "w": 6, "h": 4, "frames": [{"transform_matrix": )"
                    R"([[1,0,0,0],[0,1,0,0],[0,0,1,0],[0,0,0,2]]}]})"),
              HasSubstr("expected the last row"));
}

TEST(ImportNerf, ReadsTheFileInTheData) {
  Warnings warnings;
  EXPECT_EQ(import_nerf(source_dir() / "data/cameras/transforms.json", 0, 0, warnings).size(), 2U);
}

}  // namespace
}  // namespace fathom
