// BOP's cameras project as BOP documents it.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <array>
#include <filesystem>
#include <fstream>
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

TEST(ImportBop, ProjectsAsBopDoes) {
  Draws draw(3);
  for (int round = 0; round < 100; ++round) {
    const double fx = draw(300, 900), s = draw(-3, 3), cx = draw(0, 600), fy = draw(300, 900),
                 cy = draw(0, 400);
    std::array<double, 9> R;
    for (double& x : R) x = draw(-1, 1);
    for (int i = 0; i < 3; ++i) R[static_cast<std::size_t>(4 * i)] += 2;  // far from singular
    const std::array<double, 3> t{draw(-5, 5), draw(-5, 5), draw(60, 90)};
    const auto cameras = parse_bop(
        R"({"10": {"cam_K": [)" + joined(std::array{fx, s, cx, 0.0, fy, cy, 0.0, 0.0, 1.0}, ",") +
            R"(], "depth_scale": 0.1, "cam_R_w2c": [)" + joined(R, ",") + R"(], "cam_t_w2c": [)" +
            joined(t, ",") + "]}}",
        "scene_camera.json", 640, 480);
    ASSERT_EQ(cameras.size(), 1U);
    for (int i = 0; i < 5; ++i) {
      const Vector X = draw.point(8);
      Vector p;
      for (std::size_t k = 0; k < 3; ++k)
        p[k] = R[3 * k] * X[0] + R[3 * k + 1] * X[1] + R[3 * k + 2] * X[2] + t[k];
      // OpenCV: (0, 0) is the centre of the first pixel, which we give (½, ½).
      const Real half = 0.5L;
      expect_same(seen(cameras[0].camera, X),
                  {(fx * p[0] + s * p[1]) / p[2] + cx + half, fy * p[1] / p[2] + cy + half, p[2]});
    }
  }
}

TEST(ImportBop, OrdersByNumberAndDefaultsToTheCameraFrame) {
  const std::string K = R"("cam_K": [100,0,3,0,100,2,0,0,1])";
  const auto cameras =
      parse_bop(std::string("{\"10\": {") + K + "}, \"9\": {" + K + "}, \"100\": {" + K + "}}",
                "scene_camera.json", 6, 4);
  ASSERT_EQ(cameras.size(), 3U);
  EXPECT_EQ(cameras[0].camera.name, "9");
  EXPECT_EQ(cameras[1].camera.name, "10");
  EXPECT_EQ(cameras[2].camera.name, "100");
  EXPECT_EQ(cameras[0].camera.world_to_camera, Camera().world_to_camera);
  EXPECT_EQ(cameras[0].camera.projection.pixel_centre, 0);
}

TEST(ImportBop, NamesFaults) {
  const auto fault = [](const std::string& text, std::uint32_t width = 6) {
    return message_of<InputError>([&] { judged(parse_bop(text, "scene_camera.json", width, 4)); });
  };
  const std::string K = R"("cam_K": [100,0,3,0,100,2,0,0,1])";
  EXPECT_THAT(fault("{}"), HasSubstr("no image"));
  EXPECT_THAT(fault("[]"), HasSubstr("expected an object"));
  EXPECT_THAT(fault("{\"1\": {}}"), HasSubstr("1: the key \"cam_K\" is missing"));
  EXPECT_THAT(fault(std::string("{\"x\": {") + K + "}}"), HasSubstr("integers"));
  EXPECT_THAT(fault(std::string("{\"1\": {") + K + "}}", 0), HasSubstr("width is 0"));
  EXPECT_THAT(fault(R"({"1": {"cam_K": [1,0,3,1,1,2,0,0,1]}})"),
              HasSubstr("1.cam_K: expected fx s"));
  EXPECT_THAT(fault(R"({"1": {"cam_K": [1,0,3,0,1,2,0,0]}})"), HasSubstr("a list of 9"));
  EXPECT_THAT(fault(std::string("{\"1\": {") + K + R"(, "cam_t_w2c": [1,2,3]}})"),
              HasSubstr("expected both"));
  EXPECT_THAT(fault(std::string("{\"1\": {") + K +
                    R"(, "cam_R_w2c": [0,0,0,0,0,0,0,0,0], "cam_t_w2c": [1,2,3]}})"),
              HasSubstr("singular"));
}

TEST(ImportBop, TheImageSizeIsTheDataSets) {
  const ScratchFolder folder;
  const auto scene = folder.path() / "test" / "000001";
  std::filesystem::create_directories(scene);
  std::ofstream(scene / "scene_camera.json") << R"({"3": {"cam_K": [100,0,3,0,100,2,0,0,1]}})";
  EXPECT_THAT(message_of<InputError>([&] { import_bop(scene, 0, 0); }),
              HasSubstr("the image size is unknown: there is no camera.json"));
  std::ofstream(folder.path() / "camera.json")
      << R"({"cx": 3, "cy": 2, "fx": 1, "fy": 1, "depth_scale": 0.1, "width": 720, "height": 540})";
  for (const auto& input : {scene, scene / "scene_camera.json"}) {
    EXPECT_EQ(import_bop(input, 0, 0).at(0).camera.width, 720U);
    EXPECT_EQ(import_bop(input, 0, 0).at(0).camera.height, 540U);
  }
  EXPECT_EQ(import_bop(scene, 8, 6).at(0).camera.width, 8U);
  std::ofstream(scene / "camera.json") << R"({"width": 0, "height": 540})";
  EXPECT_THAT(message_of<InputError>([&] { import_bop(scene, 0, 0); }), HasSubstr("width"));
}

TEST(ImportBop, ReadsTheFileInTheData) {
  EXPECT_EQ(import_bop(source_dir() / "data/cameras/scene_camera.json", 640, 480).size(), 2U);
}

}  // namespace
}  // namespace fathom
