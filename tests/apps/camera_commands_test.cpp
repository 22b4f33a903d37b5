// fathom camera …: points are projected with the formulas of the other program and with ours.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <nlohmann/json.hpp>
#include <sstream>

#include "run_program.h"
#include "sample_files.h"
#include "test_folder.h"
#include "tests/places.h"

namespace fathom::test {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;

/// Our camera file's formula (specification, section 2), as Python. Pixels are of the order of
/// 1000 and every entry was rounded to binary64 once, so a few roundings in between move an image
/// point by less than 1e-9 pixels.
const std::string our_projection = R"(
import json
import numpy as np
def load(name):
    cameras = json.load(open(name))
    return cameras if isinstance(cameras, list) else [cameras]
def ours(camera, X):
    M = np.array(camera['world_to_camera'])
    x, y, z = M[:3, :3] @ X + M[:3, 3]
    shift = 0.5 - camera.get('pixel_centre', 0.5)
    w = 1 if camera.get('projection') == 'orthographic' else z
    u = camera['fx'] * x + camera.get('skew', 0) * y + (camera['cx'] + shift) * w
    v = camera['fy'] * y + (camera['cy'] + shift) * w
    return np.array([u / w, v / w]), z
def close(a, b):
    assert np.abs(np.array(a) - np.array(b)).max() < 1e-9, (a, b)
points = [np.array(p) for p in ((0.1, 0.2, 0.3), (-0.4, 0.25, 0.1), (0.3, -0.2, -0.35))]
)";

class CameraCommands : public ::testing::Test {
 protected:
  void fathom(const std::vector<std::string>& arguments) const {
    const Outcome outcome = run_fathom(arguments, {.folder = folder_.path()});
    EXPECT_EQ(outcome.status, 0);
    EXPECT_EQ(outcome.err, "");
  }
  void run_python(const std::string& script) const {
    const Outcome outcome =
        run({python, "-c", our_projection + script}, {.folder = folder_.path()});
    EXPECT_EQ(outcome.status, 0) << outcome.err;
  }

  TestFolder folder_;
};

TEST_F(CameraCommands, LookAtPutsTheTargetInTheMiddle) {
  fathom({"camera", "look-at", "--eye", "2,1,3", "--target", "0.5,0,-1", "--size", "640x480",
          "--fov", "60", "--near", "0.1", "--far", "50", "-o", "camera.json"});
  run_python(R"(
camera, = load('camera.json')
image, depth = ours(camera, np.array([0.5, 0, -1]))
close(image, [320, 240])
close(depth, np.sqrt(1.5**2 + 1 + 16))
close(camera['fy'], 240 / np.tan(np.radians(30)))
above, _ = ours(camera, np.array([0.5, 0.1, -1]))
assert above[1] < 240 and abs(above[0] - 320) < 1e-9   # up is up
assert (camera['near'], camera['far']) == (0.1, 50)
)");
}

TEST_F(CameraCommands, UpIsAWordOrADirectionEverywhere) {
  folder_.write("square.obj", square_obj);
  const std::vector<std::pair<std::string, std::array<double, 3>>> ups{
      {"x", {1, 0, 0}},   {"y", {0, 1, 0}},   {"z", {0, 0, 1}},          {"-x", {-1, 0, 0}},
      {"-y", {0, -1, 0}}, {"-z", {0, 0, -1}}, {"1,-2,0.5", {1, -2, 0.5}}};
  for (const auto& [text, up] : ups) {
    SCOPED_TRACE(text);
    fathom({"camera", "look-at", "--eye", "3,1,2", "--up", text, "-o", "look.json"});
    fathom(
        {"camera", "orbit", "--views", "1", "--distance", "2", "--up", text, "-o", "orbit.json"});
    fathom({"render", "square.obj", "--size", "8x8", "--up=" + text, "--save-camera", "frame.json",
            "-o", "map.exr"});
    for (const char* file : {"look.json", "orbit.json", "frame.json"}) {
      auto camera = nlohmann::json::parse(folder_.read(file));
      if (camera.is_array()) camera = camera[0];
      const auto& pose = camera["world_to_camera"];
      double right = 0, down = 0;  // of the image, along what is up in the world
      for (int k = 0; k < 3; ++k) {
        right += pose[0][k].get<double>() * up[k];
        down += pose[1][k].get<double>() * up[k];
      }
      EXPECT_NEAR(right, 0, 1e-15) << file;
      EXPECT_LT(down, -0.1) << file;
    }
  }
}

TEST_F(CameraCommands, FramingTakesTheWholeLens) {
  folder_.write("square.obj", square_obj);
  fathom({"render", "square.obj", "--size", "64x48", "--orthographic", "4", "--far", "inf",
          "--save-camera", "flat.json", "-o", "map.exr"});
  const auto flat = nlohmann::json::parse(folder_.read("flat.json"));
  EXPECT_EQ(flat["projection"], "orthographic");
  EXPECT_EQ(flat["fy"], 12);  // 48 pixels for 4 units
  fathom({"render", "square.obj", "--size", "64x48", "--focal", "77", "--save-camera", "long.json",
          "-o", "map.exr"});
  EXPECT_EQ(nlohmann::json::parse(folder_.read("long.json"))["fx"], 77);
}

TEST_F(CameraCommands, CamerasOfAFileAreScaledAndGetADepthRange) {
  folder_.write("square.obj", square_obj);
  folder_.write("opencv.json", R"([{"width": 641, "height": 480, "fx": 600, "fy": 500, "cx": 319.5,
    "cy": 239.5, "skew": 3, "pixel_centre": 0, "near": 1, "far": 9,
    "world_to_camera": [[1, 0, 0, 0], [0, 1, 0, 0], [0, 0, 1, 4]]}])");
  fathom({"render", "square.obj", "--camera", "opencv.json", "--scale", "0.5", "--far", "inf",
          "--quiet", "--save-camera", "half.json", "-o", "half.exr"});
  const auto half = nlohmann::json::parse(folder_.read("half.json"));
  // 320.5 is a tie: 320 is even.
  EXPECT_EQ(half["width"], 320);
  EXPECT_EQ(half["height"], 240);
  EXPECT_EQ(half["fx"].get<double>(), 600 * 320 / 641.0);
  EXPECT_EQ(half["skew"].get<double>(), 3 * 320 / 641.0);
  EXPECT_EQ(half["fy"], 250);
  EXPECT_NEAR(half["cx"].get<double>(), (319.5 + 0.5) * 320 / 641 - 0.5, 1e-13);
  EXPECT_EQ(half["cy"], 119.5);
  EXPECT_EQ(half["near"], 1);
  EXPECT_FALSE(half.contains("far") && half["far"].is_number());
  // The map has the changed camera, and a command that takes its camera from the map keeps it.
  fathom({"render", "square.obj", "--camera", "half.exr", "--near", "2", "--save-camera",
          "again.json", "-o", "again.exr"});
  auto again = nlohmann::json::parse(folder_.read("again.json"));
  EXPECT_EQ(again["near"], 2);
  again["near"] = 1;
  EXPECT_EQ(again, half);
  const Outcome empty = run_fathom(
      {"render", "square.obj", "--camera", "opencv.json", "--near", "9", "-o", "map.exr"},
      {.folder = folder_.path()});
  EXPECT_EQ(empty.status, 2);
  EXPECT_THAT(empty.err, HasSubstr("--near and --far: far is not greater than near: from 9 to 9"));
}

TEST_F(CameraCommands, LookAtWithParallelProjectionGoesToStandardOutput) {
  const Outcome outcome = run_fathom(
      {"camera", "look-at", "--eye", "0,0,5", "--orthographic", "2", "--size", "300x200"});
  const auto camera = nlohmann::json::parse(outcome.out);
  EXPECT_EQ(camera["projection"], "orthographic");
  EXPECT_EQ(camera["fx"], 100);
}

TEST_F(CameraCommands, OrbitGoesAroundAPoint) {
  fathom({"camera", "orbit", "--views", "4", "--centre", "1,2,3", "--distance", "5", "--view",
          "0,30", "-o", "path.json"});
  run_python(R"(
cameras = load('path.json')
assert len(cameras) == 4
eyes = []
for camera in cameras:
    image, depth = ours(camera, np.array([1, 2, 3]))
    close(image, [640, 360])
    close(depth, 5)
    M = np.array(camera['world_to_camera'])
    eyes.append(-M[:, :3].T @ M[:, 3])
# From azimuth 0 on the +z side, counter-clockwise from above, at a height of 5·sin 30°.
r = 5 * np.cos(np.radians(30))
for eye, offset in zip(eyes, ((0, r), (r, 0), (0, -r), (-r, 0))):
    close(eye, [1 + offset[0], 4.5, 3 + offset[1]])
)");
}

TEST_F(CameraCommands, OrbitFramesAScene) {
  folder_.write("square.obj", square_obj);
  fathom({"camera", "orbit", "square.obj", "--views", "5", "-o", "path.json"});
  run_python(R"(
for camera in load('path.json'):
    for corner in ((-1, -1, 2), (1, -1, 2), (1, 1, 2), (-1, 1, 2)):
        (u, v), depth = ours(camera, np.array(corner))
        assert depth > 0 and 0 < u < 1280 and 0 < v < 720
)");
}

TEST_F(CameraCommands, ImportColmap) {
  folder_.write("cameras.txt", "# comment\n1 PINHOLE 640 480 525.5 526.25 320.25 239.75\n");
  folder_.write("images.txt",
                "# comment\n"
                "1 0.9 0.1 -0.2 0.3 0.125 -0.25 2.5 1 b.jpg\n\n"
                "2 1 0 0 0 0 0 3 1 a.jpg\n\n");
  fathom({"camera", "import", "colmap", ".", "--image", "b.jpg", "-o", "camera.json"});
  run_python(R"(
camera, = load('camera.json')
w, x, y, z = np.array([0.9, 0.1, -0.2, 0.3]) / np.linalg.norm([0.9, 0.1, -0.2, 0.3])
R = np.array([[1 - 2*y*y - 2*z*z, 2*x*y - 2*w*z, 2*z*x + 2*w*y],
              [2*x*y + 2*w*z, 1 - 2*x*x - 2*z*z, 2*y*z - 2*w*x],
              [2*z*x - 2*w*y, 2*y*z + 2*w*x, 1 - 2*x*x - 2*y*y]])
for X in points:
    a, b, c = R @ X + [0.125, -0.25, 2.5]
    close(ours(camera, X)[0], [525.5 * a / c + 320.25, 526.25 * b / c + 239.75])
)");
  const Outcome names = run_fathom({"camera", "import", "colmap", folder_.path(), "--list"});
  EXPECT_EQ(names.out, "a.jpg\nb.jpg\n");
}

TEST_F(CameraCommands, ImportNerf) {
  folder_.write("transforms.json", R"({"fl_x": 500, "fl_y": 501, "cx": 321, "cy": 239, "w": 640,
      "h": 480, "frames": [{"file_path": "a.png", "transform_matrix":
      [[0, 0, 1, 3], [1, 0, 0, 0.5], [0, 1, 0, 0.25], [0, 0, 0, 1]]}]})");
  fathom({"camera", "import", "nerf", "transforms.json", "-o", "camera.json"});
  run_python(R"(
camera, = load('camera.json')
c2w = np.array([[0, 0, 1, 3], [1, 0, 0, 0.5], [0, 1, 0, 0.25], [0, 0, 0, 1.0]])
for X in points:
    x, y, z, _ = np.linalg.inv(c2w) @ np.append(X, 1)     # x right, y up, z backward
    close(ours(camera, X)[0], [321 + 500 * x / -z, 239 - 501 * y / -z])
    close(ours(camera, X)[1], -z)
)");
}

TEST_F(CameraCommands, ImportBop) {
  folder_.write("scene_camera.json", R"({"7": {"cam_K": [572.4, 0, 325.3, 0, 573.6, 242, 0, 0, 1],
      "cam_R_w2c": [0, 1, 0, 0, 0, -1, -1, 0, 0], "cam_t_w2c": [10, 20, 900],
      "depth_scale": 1.0}})");
  fathom({"camera", "import", "bop", "scene_camera.json", "--size", "640x480", "-o", "c.json"});
  run_python(R"(
camera, = load('c.json')
R = np.array([[0, 1, 0], [0, 0, -1], [-1, 0, 0]])
for X in points:
    x, y, z = R @ X + [10, 20, 900]
    # BOP's images have pixel centres at integers; Fathom's image begins half a pixel earlier.
    close(ours(camera, X)[0], [572.4 * x / z + 325.3 + 0.5, 573.6 * y / z + 242 + 0.5])
)");
}

TEST_F(CameraCommands, ImportOpenGl) {
  folder_.write("matrices.json", R"({"projection": [[1.5, 0, 0.1, 0], [0, 2, -0.05, 0],
      [0, 0, -1.002, -0.2002], [0, 0, -1, 0]],
      "modelview": [[0, 0, 1, 0.5], [1, 0, 0, 0.25], [0, 1, 0, -4], [0, 0, 0, 1]],
      "viewport": [0, 0, 800, 600]})");
  fathom({"camera", "import", "opengl", "matrices.json", "-o", "camera.json"});
  run_python(R"(
camera, = load('camera.json')
P = np.array([[1.5, 0, 0.1, 0], [0, 2, -0.05, 0], [0, 0, -1.002, -0.2002], [0, 0, -1, 0]])
V = np.array([[0, 0, 1, 0.5], [1, 0, 0, 0.25], [0, 1, 0, -4], [0, 0, 0, 1]])
for X in points:
    clip = P @ V @ np.append(X, 1)
    ndc = clip[:3] / clip[3]
    # The window's y grows up, the image's v down.
    close(ours(camera, X)[0], [400 * (ndc[0] + 1), 600 - 300 * (ndc[1] + 1)])
    close(ours(camera, X)[1], clip[3])
)");
}

TEST_F(CameraCommands, DistortedCamerasAreLeftOutUnlessTheyAreTaken) {
  folder_.write("cameras.txt",
                "1 FOV 640 480 525 525 320 240 4\n2 PINHOLE 640 480 525 525 320 240\n");
  folder_.write("images.txt", "1 1 0 0 0 0 0 3 1 a.jpg\n\n2 1 0 0 0 0 0 3 2 b.jpg\n\n");
  const std::vector<std::string> command{"camera", "import", "colmap", "."};
  const auto with = [&](const std::vector<std::string>& more) {
    std::vector<std::string> arguments = command;
    arguments.insert(arguments.end(), more.begin(), more.end());
    return run_fathom(arguments, {.folder = folder_.path()});
  };
  const Outcome rest = with({});
  EXPECT_EQ(rest.status, 0);
  EXPECT_THAT(rest.err, AllOf(HasSubstr("1 of 2 cameras has lens distortion and is left out"),
                              HasSubstr("--ignore-distortion")));
  EXPECT_EQ(nlohmann::json::parse(rest.out)["name"], "b.jpg");
  const Outcome refused = with({"--image", "a.jpg"});
  EXPECT_EQ(refused.status, 3);
  EXPECT_THAT(refused.err, HasSubstr("distortion"));
  EXPECT_EQ(refused.out, "");
  const Outcome taken = with({"--ignore-distortion"});
  EXPECT_EQ(taken.status, 0);
  EXPECT_EQ(taken.err, "");
  EXPECT_EQ(nlohmann::json::parse(taken.out).size(), 2U);
}

TEST_F(CameraCommands, LensesOfColmapAreRenderedAsTheyAre) {
  folder_.write("square.obj", square_obj);
  folder_.write("cameras.txt", "1 SIMPLE_RADIAL 16 12 10 8 6 -0.1\n");
  folder_.write("images.txt", "1 1 0 0 0 0 0 3 1 a.jpg\n\n");
  fathom({"camera", "import", "colmap", ".", "-o", "cameras.json"});
  fathom({"camera", "import", "colmap", ".", "--ignore-distortion", "-o", "pinhole.json"});
  const auto file = [&](const char* name) { return nlohmann::json::parse(folder_.read(name)); };
  EXPECT_EQ(file("cameras.json")["model"], "SIMPLE_RADIAL");
  EXPECT_EQ(file("cameras.json")["k"], -0.1);
  EXPECT_FALSE(file("pinhole.json").contains("model"));
  fathom({"render", "square.obj", "--camera", "cameras.json", "--channels", "P", "-o", "lens.exr"});
  fathom(
      {"render", "square.obj", "--camera", "pinhole.json", "--channels", "P", "-o", "pinhole.exr"});
  const Outcome same =
      run_fathom({"compare", "lens.exr", "pinhole.exr"}, {.folder = folder_.path()});
  EXPECT_EQ(same.status, 1);
  // The map carries its camera, and is drawn again by it.
  fathom({"render", "square.obj", "--camera", "lens.exr", "--channels", "P", "-o", "again.exr"});
  EXPECT_EQ(run_fathom({"compare", "lens.exr", "again.exr"}, {.folder = folder_.path()}).status, 0);
}

TEST_F(CameraCommands, MapsHaveTheNamesOfTheirImages) {
  folder_.write("square.obj", square_obj);
  folder_.write("cameras.txt", "1 PINHOLE 16 12 10 10 8 6\n");
  folder_.write("images.txt", "1 1 0 0 0 0 0 3 1 left/a.jpg\n\n2 1 0 0 0 0 0 4 1 b.jpg\n\n");
  fathom({"camera", "import", "colmap", ".", "-o", "cameras.json"});
  fathom({"render", "square.obj", "--camera", "cameras.json", "-o", "{stem}.exr"});
  const Outcome info = run_fathom({"info", "a.exr", "--json"}, {.folder = folder_.path()});
  EXPECT_THAT(info.out, HasSubstr("left/a.jpg"));
  const Outcome camera = run_fathom({"info", "cameras.json"}, {.folder = folder_.path()});
  EXPECT_EQ(camera.out,
            "cameras.json: a path of 2 cameras\n"
            "  number  name        size   field of view  eye         looks along  near, far\n"
            "  0       b.jpg       16x12  77.32 x 61.93  (0, 0, -4)  (0, 0, 1)    0, inf\n"
            "  1       left/a.jpg  16x12  77.32 x 61.93  (0, 0, -3)  (0, 0, 1)    0, inf\n");
}

// By hand: 0.9 = 1 − 0.1·1³ is the image of 45°; a fisheye has 1 radian for each f pixels, up to
// 180° from its axis.
TEST_F(CameraCommands, LensesHaveAFieldOfView) {
  const std::string rest = R"("pixel_centre": 0.5,
      "world_to_camera": [[1, 0, 0, 0], [0, 1, 0, 0], [0, 0, 1, 4]]})";
  const std::string fisheye =
      R"({"width": 300, "height": 200, "model": "SIMPLE_FISHEYE", "cx": 150, "cy": 100, )";
  folder_.write("lenses.json", R"([{"width": 180, "height": 180, "model": "SIMPLE_RADIAL", "f": 100,
      "cx": 90, "cy": 90, "k": -0.1, )" +
                                   rest + ",\n" +
                                   R"({"width": 360, "height": 180, "model": "EQUIRECTANGULAR",
      "w": 360, "h": 180, "cx": 180, "cy": 90, )" +
                                   rest + ",\n" + fisheye + R"("f": 100, )" + rest + ",\n" +
                                   fisheye + R"("f": 40, )" + rest + "]");
  const Outcome info = run_fathom({"info", "lenses.json"}, {.folder = folder_.path()});
  EXPECT_EQ(
      info.out,
      "lenses.json: a path of 4 cameras\n"
      "  number  size     field of view    lens             eye         looks along  near, far\n"
      "  0       180x180  90.00 x 90.00    SIMPLE_RADIAL    (0, 0, -4)  (0, 0, 1)    0, inf\n"
      "  1       360x180  360.00 x 180.00  EQUIRECTANGULAR  (0, 0, -4)  (0, 0, 1)    0, inf\n"
      "  2       300x200  171.89 x 114.59  SIMPLE_FISHEYE   (0, 0, -4)  (0, 0, 1)    0, inf\n"
      "  3       300x200  360.00 x 286.48  SIMPLE_FISHEYE   (0, 0, -4)  (0, 0, 1)    0, inf\n");
}

TEST_F(CameraCommands, InfoShowsTheCameraOfAMapAsACameraFile) {
  folder_.write("square.obj", square_obj);
  fathom({"camera", "look-at", "--eye", "1,2,-3", "--target", "0,0,0", "-o", "camera.json"});
  fathom({"render", "square.obj", "--camera", "camera.json", "-o", "map.exr"});
  const Outcome info = run_fathom({"info", "map.exr"}, {.folder = folder_.path()});
  std::istringstream file(folder_.read("camera.json"));
  for (std::string line; std::getline(file, line);) EXPECT_THAT(info.out, HasSubstr(line + "\n"));
}

TEST_F(CameraCommands, NamesAreShownWithoutWhatMovesTheCursor) {
  folder_.write("named.json",
                R"({"name": "\u001b[2Ja\nb", "width": 4, "height": 3, "fx": 1, "fy": 1,
      "cx": 2, "cy": 1.5, "pixel_centre": 0.5,
      "world_to_camera": [[1, 0, 0, 0], [0, 1, 0, 0], [0, 0, 1, 4]]})");
  const Outcome info = run_fathom({"info", "named.json"}, {.folder = folder_.path()});
  EXPECT_THAT(info.out, HasSubstr("    name          ?[2Ja?b\n"));
}

/// The same camera, by each layout that says no more than K and a pose.
TEST_F(CameraCommands, ImportMatrices) {
  folder_.write("poses.txt", "0 0 1 3 1 0 0 0.5 0 1 0 0.25\n");
  folder_.write("K.txt", "500 0 320\n0 501 240\n0 0 1\n");
  fathom({"camera", "import", "matrices", "poses.txt", "--K", "K.txt", "--size", "640x480",
          "--poses", "camera-to-world", "--axes", "opencv", "--pixel-centre", "0", "-o",
          "text.json"});
  run_python(R"(
np.save('poses.npy', np.loadtxt('poses.txt').reshape(1, 3, 4))
np.save('one.npy', np.vstack([np.loadtxt('poses.txt').reshape(3, 4), [0, 0, 0, 1]]))
np.save('K.npy', np.loadtxt('K.txt')[None])
np.save('wrong.npy', np.zeros((2, 3)))
np.savez('one.npz', poses=np.load('poses.npy'))
np.savez_compressed('both.npz', poses=np.load('poses.npy'), K=np.load('K.npy'),
                    names=np.array(['a']))
camera, = load('text.json')
c2w = np.vstack([np.loadtxt('poses.txt').reshape(3, 4), [0, 0, 0, 1]])
for p in ((0.1, 0.2, 3), (-0.4, 0.25, 2)):
    X = (c2w @ np.append(p, 1))[:3]
    # OpenCV's pixel centres are integers; Fathom's image begins half a pixel earlier.
    close(ours(camera, X)[0], [320 + 500 * p[0] / p[2] + 0.5, 240 + 501 * p[1] / p[2] + 0.5])
)");
  for (const char* poses : {"poses.npy", "one.npy", "one.npz", "both.npz:poses"})
    for (const char* K : {"K.npy", "500,501,320,240", "both.npz:K"}) {
      fathom({"camera", "import", "matrices", poses, "--K", K, "--size", "640x480", "--poses",
              "camera-to-world", "--axes", "opencv", "--pixel-centre", "0", "-o", "array.json"});
      auto text = nlohmann::json::parse(folder_.read("text.json")),
           array = nlohmann::json::parse(folder_.read("array.json"));
      EXPECT_EQ(text, array) << poses << " " << K;
    }
  const auto status = [&](const std::vector<std::string>& arguments) {
    return run_fathom(arguments, {.folder = folder_.path()});
  };
  const Outcome wrong =
      status({"camera", "import", "matrices", "wrong.npy", "--K", "1,1,1,1", "--size", "4x4",
              "--poses", "camera-to-world", "--axes", "opencv", "--pixel-centre", "0"});
  EXPECT_EQ(wrong.status, 3);
  EXPECT_THAT(wrong.err, HasSubstr("wrong.npy: expected an array of the shape (N, 4, 4)"));
  for (const auto& [file, message] : std::map<std::string, std::string>{
           {"both.npz",
            "both.npz: holds several arrays, poses, K, names: say which, as in both.npz:poses"},
           {"both.npz:c2w", "both.npz: has no array 'c2w', but poses, K, names"},
           {"both.npz:names", "both.npz: 'names': "},
           {"none.npz", "none.npz: "}}) {
    const Outcome archive =
        status({"camera", "import", "matrices", file, "--K", "1,1,1,1", "--size", "4x4", "--poses",
                "camera-to-world", "--axes", "opencv", "--pixel-centre", "0"});
    EXPECT_EQ(archive.status, 3);
    EXPECT_THAT(archive.err, HasSubstr(message));
    EXPECT_EQ(std::count(archive.err.begin(), archive.err.end(), '\n'), 1) << archive.err;
  }
  // What is not in the files has to be said.
  const Outcome silent = status({"camera", "import", "matrices", "poses.txt", "--K", "1,1,1,1",
                                 "--size", "4x4", "--axes", "opencv", "--pixel-centre", "0"});
  EXPECT_EQ(silent.status, 2);
  EXPECT_THAT(silent.err, HasSubstr("--poses"));
}

TEST_F(CameraCommands, ImportLayoutsOfDataSets) {
  const auto names = [&](const std::vector<std::string>& arguments) {
    std::vector<std::string> all{"camera", "import"};
    all.insert(all.end(), arguments.begin(), arguments.end());
    all.emplace_back("--list");
    const Outcome outcome = run_fathom(all, {.folder = folder_.path()});
    EXPECT_EQ(outcome.status, 0) << outcome.err;
    return outcome.out;
  };
  folder_.write("groundtruth.txt", "1.5 0 0 0 0 0 0 1\n");
  folder_.write("depth.txt", "1.51 depth/1.51.png\n");
  EXPECT_EQ(names({"tum", "groundtruth.txt", "--K", "ros"}), "1.5\n");
  EXPECT_EQ(names({"tum", ".", "--K", "525,525,319.5,239.5", "--images", "depth.txt"}),
            "depth/1.51.png\n");
  folder_.write("frame-000000.pose.txt", "1 0 0 0\n0 1 0 0\n0 0 1 0\n0 0 0 1\n");
  EXPECT_EQ(names({"7scenes", "."}), "frame-000000\n");
  folder_.write("traj.txt", "1 0 0 0 0 1 0 0 0 0 1 0 0 0 0 1\n");
  EXPECT_EQ(names({"replica", ".", "--K", "600,600,599.5,339.5", "--size", "1200x680"}),
            "frame000000\n");
  folder_.write("calib.txt", "P0: 1 0 2 0 0 1 2 0 0 0 1 0\n");
  EXPECT_EQ(names({"kitti", "calib.txt", "--size", "4x4"}), "image_0\n");
  EXPECT_EQ(names({"kitti", "calib.txt", "--poses", "traj.txt", "--camera", "0", "--size", "4x4"}),
            "000000\n");
  folder_.write("a.gltf", R"({"cameras": [{"type": "perspective", "perspective":
      {"yfov": 1, "znear": 1}}], "nodes": [{"name": "eye", "camera": 0}]})");
  EXPECT_EQ(names({"gltf", "a.gltf", "--size", "4x4"}), "eye\n");
  folder_.write("a.sfm", R"({"version": ["1", "2", "11"], "views": [{"viewId": "1",
      "intrinsicId": "1", "path": "/x/a.jpg"}]})");
  EXPECT_EQ(names({"sfmdata", "a.sfm"}), "a.jpg\n");
  const Outcome no_lens = run_fathom(
      {"camera", "import", "tum", "groundtruth.txt", "--K", "kinect"}, {.folder = folder_.path()});
  EXPECT_EQ(no_lens.status, 2);
  EXPECT_THAT(no_lens.err, HasSubstr("--K: expected fx,fy,cx,cy in pixels, found 'kinect'"));
}

TEST_F(CameraCommands, WhatLooksThroughOneCameraRefusesAPath) {
  const std::string cube = source_dir() / "data/meshes/cube.obj";
  fathom({"camera", "orbit", cube, "--views", "3", "-o", "path.json"});
  const std::vector<std::vector<std::string>> commands{
      {"probe", "--pixel", "1,1"}, {"coplanar"}, {"visible"}, {"pipeline", "trace"}};
  for (std::vector<std::string> command : commands) {
    command.insert(command.end(), {cube, "--camera", "path.json"});
    const Outcome outcome = run_fathom(command, {.folder = folder_.path()});
    EXPECT_EQ(outcome.status, 2) << command[0];
    EXPECT_THAT(outcome.err, HasSubstr("a path of 3 cameras")) << command[0];
  }
}

}  // namespace
}  // namespace fathom::test
