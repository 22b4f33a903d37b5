// Mistakes that many make: the message says what to do instead, or the program does what was meant.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "run_program.h"
#include "sample_files.h"
#include "test_folder.h"

namespace fathom::test {
namespace {

using ::testing::AllOf;
using ::testing::EndsWith;
using ::testing::HasSubstr;
using ::testing::StartsWith;

class Mistakes : public ::testing::Test {
 protected:
  void SetUp() override {
    folder_.write("square.obj", square_obj);
    folder_.write("camera.json", square_camera);
  }
  Outcome fathom(const std::vector<std::string>& arguments) const {
    return run_fathom(arguments, {.folder = folder_.path()});
  }
  void expect_done(const std::vector<std::string>& arguments) const {
    const Outcome outcome = fathom(arguments);
    EXPECT_EQ(outcome.status, 0);
    EXPECT_EQ(outcome.err, "");
  }
  /// The one line of an error, without "fathom: error: ".
  std::string refusal(const std::vector<std::string>& arguments, int status) const {
    const Outcome outcome = fathom(arguments);
    EXPECT_EQ(outcome.status, status) << outcome.err;
    EXPECT_EQ(std::count(outcome.err.begin(), outcome.err.end(), '\n'), 1) << outcome.err;
    const std::string start = "fathom: error: ";
    EXPECT_THAT(outcome.err, StartsWith(start));
    return outcome.err.substr(std::min(start.size(), outcome.err.size()));
  }

  TestFolder folder_;
};

TEST_F(Mistakes, AMapAsTheCameraGivesItsCamera) {
  expect_done({"render", "square.obj", "--camera", "camera.json", "-o", "map.exr"});
  expect_done({"render", "square.obj", "--camera", "map.exr", "-o", "again.exr"});
  const Outcome same = fathom({"compare", "map.exr", "again.exr"});
  EXPECT_EQ(same.status, 0) << same.out;
  const Outcome probe = fathom({"probe", "square.obj", "--camera", "map.exr", "--pixel", "3,3"});
  EXPECT_EQ(probe.status, 0) << probe.err;
  EXPECT_EQ(probe.out,
            fathom({"probe", "square.obj", "--camera", "camera.json", "--pixel", "3,3"}).out);
  // One without a camera.
  expect_done({"convert", "map.exr", "-o", "map.npy"});
  EXPECT_EQ(refusal({"render", "square.obj", "--camera", "map.npy", "-o", "no.exr"}, 3),
            "map.npy: the map carries no camera, expected a camera file\n");
}

TEST_F(Mistakes, AMeshAsTheCameraIsNamed) {
  EXPECT_EQ(refusal({"render", "square.obj", "--camera", "square.obj", "-o", "no.exr"}, 3),
            "square.obj: is a mesh, expected a camera file or a map that contains its camera\n");
  folder_.write("bad.json", "{\"width\": 5,");
  EXPECT_THAT(refusal({"render", "square.obj", "--camera", "bad.json", "-o", "no.exr"}, 3),
              HasSubstr("bad.json: line 1: not JSON"));
}

TEST_F(Mistakes, UnitsAreLeftOut) {
  const auto render = [&](const std::string& option, const std::string& value) {
    return refusal({"render", "square.obj", option, value, "-o", "no.exr"}, 2);
  };
  EXPECT_EQ(render("--fov", "0.7rad"),
            "--fov: '0.7rad' is not a finite number; leave out 'rad': lengths are in units of the "
            "scene, angles in degrees\n");
  EXPECT_THAT(render("--near", "10cm"), HasSubstr("leave out 'cm'"));
  EXPECT_EQ(render("--near", "10x"), "--near: '10x' is not a finite number\n");
  EXPECT_EQ(refusal({"compare", "a.exr", "b.exr", "--relative", "1%"}, 2),
            "--relative: '1%' is not a finite number; 1% is a fraction: 0.01\n");
}

TEST_F(Mistakes, OptionsGivenTwiceAreCounted) {
  EXPECT_EQ(refusal({"render", "square.obj", "--camera", "camera.json", "--camera", "camera.json",
                     "-o", "no.exr"},
                    2),
            "--camera is given 2 times, expected once; see 'fathom render --help'\n");
}

TEST_F(Mistakes, NamesOfOtherPlacesLeadToFathoms) {
  EXPECT_THAT(refusal({"explain"}, 2),
              StartsWith("there is no command 'explain': did you mean 'probe' or 'validate'?"));
  EXPECT_THAT(refusal({"render", "square.obj", "--channels", "Z,Zfight", "-o", "no.exr"}, 2),
              AllOf(StartsWith("--channels: Zfight is a channel of a depth buffer: "),
                    HasSubstr("--against-exact")));
  EXPECT_EQ(refusal({"depth", "encode", "--near", "1", "--far", "9", "--storage", "unorm24",
                     "--mapping", "log", "--c", "0", "5"},
                    2),
            "--c: 0 is not positive; expected the constant C of --mapping log, e.g. 1\n");
}

TEST_F(Mistakes, ConvertStoresTheCameraThatItIsGiven) {
  expect_done({"render", "square.obj", "--camera", "camera.json", "-o", "map.npy"});
  const Outcome truth =
      fathom({"probe", "square.obj", "--camera", "camera.json", "--pixel", "3,3"});
  for (const std::string name : {"map.exr", "map.npz", "map.png"}) {
    expect_done({"convert", "map.npy", "--camera", "camera.json", "-o", name});
    const Outcome probe = fathom({"probe", "square.obj", "--camera", name, "--pixel", "3,3"});
    EXPECT_EQ(probe.status, 0) << probe.err;
    EXPECT_EQ(probe.out, truth.out);
  }
}

TEST_F(Mistakes, AMapAsTheSceneIsRefusedWithTheWayToItsCamera) {
  expect_done({"render", "square.obj", "--camera", "camera.json", "-o", "map.exr"});
  EXPECT_EQ(
      refusal({"probe", "map.exr", "--pixel", "3,3"}, 3),
      "map.exr: is a map, expected a mesh or a scene file; '--camera map.exr' takes the camera "
      "that a map carries\n");
}

TEST_F(Mistakes, ACameraFileAsTheScene) {
  folder_.write("path.json", "[" + square_camera + "," + square_camera + "]");
  for (const std::string file : {"camera.json", "path.json"}) {
    EXPECT_EQ(refusal({"render", "square.obj", file, "-o", "no.exr"}, 3),
              file +
                  ": is a camera file, expected a mesh or a scene file; give it as the camera "
                  "(--camera)\n");
  }
}

TEST_F(Mistakes, FoldersAroundAColmapModelNameIt) {
  std::filesystem::create_directories(folder_ / "dense/sparse");
  std::filesystem::create_directories(folder_ / "sparse/0");
  for (const char* model : {"dense/sparse/", "sparse/0/"}) {
    folder_.write(model + std::string("cameras.txt"), "1 PINHOLE 8 6 4 4 4 3\n");
    folder_.write(model + std::string("images.txt"), "1 1 0 0 0 0 0 0 1 a.jpg\n\n");
  }
  EXPECT_THAT(refusal({"camera", "import", "colmap", "sparse", "-o", "c.json"}, 3),
              AllOf(StartsWith("sparse: expected a COLMAP model"),
                    EndsWith("; did you mean 'sparse/0'?\n")));
  EXPECT_THAT(refusal({"camera", "import", "colmap", "dense", "-o", "c.json"}, 3),
              EndsWith("; did you mean 'dense/sparse'?\n"));
  EXPECT_THAT(refusal({"camera", "import", "colmap", ".", "-o", "c.json"}, 3),
              EndsWith("; did you mean './dense/sparse' or './sparse/0'?\n"));
  EXPECT_EQ(refusal({"render", "square.obj", "--camera", "sparse/0", "-o", "no.exr"}, 3),
            "sparse/0: is a COLMAP model, expected a camera file; 'fathom camera import colmap "
            "sparse/0 -o cameras.json' makes one\n");
  expect_done({"camera", "import", "colmap", "sparse/0", "-o", "c.json"});
}

TEST_F(Mistakes, ATransformsJsonAsTheCameraFile) {
  folder_.write("transforms.json",
                R"({"w": 8, "h": 6, "fl_x": 9, "frames": [{"file_path": "a.jpg", "transform_matrix":
                [[1, 0, 0, 0], [0, 1, 0, 0], [0, 0, 1, 9], [0, 0, 0, 1]]}]})");
  EXPECT_EQ(refusal({"render", "square.obj", "--camera", "transforms.json", "-o", "no.exr"}, 3),
            "transforms.json: is a transforms.json of NeRF, expected a camera file; 'fathom camera "
            "import nerf transforms.json -o cameras.json' makes one\n");
  expect_done({"camera", "import", "nerf", "transforms.json", "-o", "cameras.json"});
}

TEST_F(Mistakes, CommandsWithoutLensesNameTheOnesThatTakeThem) {
  folder_.write("lens.json", R"({"width": 8, "height": 6, "model": "SIMPLE_RADIAL", "f": 9, "cx": 4,
      "cy": 3, "pixel_centre": 0.5, "k": -0.1,
      "world_to_camera": [[1, 0, 0, 0], [0, -1, 0, 0], [0, 0, -1, 4]]})");
  expect_done({"render", "square.obj", "--camera", "lens.json", "-o", "map.exr"});
  for (const auto& arguments : std::vector<std::vector<std::string>>{
           {"evaluate", "square.obj", "--truth", "square.obj", "--camera", "lens.json"},
           {"convert", "map.exr", "--camera", "lens.json", "-o", "map.npz"}}) {
    EXPECT_THAT(refusal(arguments, 2),
                AllOf(StartsWith("the lens SIMPLE_RADIAL: this command takes no lens; 'fathom "
                                 "render' and 'fathom probe' do"),
                      EndsWith("--ignore-distortion' leaves the lens out; see docs/lenses.md)\n")));
  }
  EXPECT_THAT(
      refusal({"convert", "map.exr", "--camera", "lens.json", "-o", "cloud.ply"}, 2),
      StartsWith("the lens SIMPLE_RADIAL: a map is not unprojected with it: render with channels Z "
                 "and P ('fathom render --channels Z,P'), and make the points of that map (for "
                 "undistorted images, "));
  EXPECT_THAT(refusal({"visible", "square.obj", "--camera", "lens.json"}, 2),
              EndsWith("--ignore-distortion' leaves the lens out; see docs/lenses.md)\n"));
  folder_.write("k1.json", R"({"width": 8, "height": 6, "fx": 9, "fy": 9, "cx": 4, "cy": 3,
      "k1": 0,
      "world_to_camera": [[1, 0, 0, 0], [0, -1, 0, 0], [0, 0, -1, 4]]})");
  EXPECT_THAT(
      refusal({"render", "square.obj", "--camera", "k1.json", "-o", "no.exr"}, 3),
      HasSubstr("unknown key \"k1\", expected one of width, height, projection, fx, fy, cx, "
                "cy, skew, K, model,"));
}

TEST_F(Mistakes, SizesBesideACamera) {
  EXPECT_EQ(
      refusal({"render", "square.obj", "--camera", "camera.json", "--size", "9x9", "-o", "no.exr"},
              2),
      "--camera: the camera has a size, so that --size has no place; --scale FACTOR scales "
      "it\n");
  const Outcome outcome = fathom(
      {"render", "square.obj", "--camera", "camera.json", "--scale", "0.7", "-o", "small.exr"});
  EXPECT_EQ(outcome.status, 0);
  EXPECT_THAT(outcome.err, HasSubstr("--scale: 8x6 pixels become 6x4, so that fx is scaled by 0.75 "
                                     "and fy by 0.666667"));
}

TEST_F(Mistakes, APathWhereOneCameraIsNeeded) {
  folder_.write("path.json", "[" + square_camera + "," + square_camera + "]");
  EXPECT_THAT(refusal({"probe", "square.obj", "--camera", "path.json", "--pixel", "3,3"}, 2),
              AllOf(StartsWith("--camera: a path of 2 cameras; probe takes a single one"),
                    HasSubstr("--image NAME")));
}

TEST_F(Mistakes, MapsFindTheirCameraOfAPathByName) {
  const auto named = [](const std::string& name) {
    return "{\"name\": \"" + name + "\"," + square_camera.substr(1);
  };
  folder_.write("path.json", "[" + named("images/a.jpg") + "," + named("images/b.jpg") + "]");
  expect_done(
      {"render", "square.obj", "--camera", "path.json", "--channels", "Z", "-o", "{stem}.npy"});
  expect_done({"convert", "b.npy", "--camera", "path.json", "-o", "b.ply"});
  std::filesystem::rename(folder_ / "b.npy", folder_ / "c.npy");
  EXPECT_THAT(refusal({"convert", "c.npy", "--camera", "path.json", "-o", "c.ply"}, 2),
              StartsWith("--camera: 2 cameras, but none is named like the map 'c.npy'"));
}

TEST_F(Mistakes, NamesOfChannels) {
  expect_done(
      {"render", "square.obj", "--camera", "camera.json", "--channels", "Z,N", "-o", "map.exr"});
  EXPECT_THAT(refusal({"render", "square.obj", "--channels", "coverage", "-o", "no.exr"}, 2),
              EndsWith("; did you mean 'A'?\n"));
  EXPECT_THAT(refusal({"render", "square.obj", "--channels", "normals", "-o", "no.exr"}, 2),
              EndsWith("; did you mean 'normal'?\n"));
  EXPECT_THAT(refusal({"render", "square.obj", "--channels", "seg", "-o", "no.exr"}, 2),
              EndsWith(", valid, depth, normal, camera-normal, segmentation and mask; did you mean "
                       "'object'?\n"));
  EXPECT_THAT(refusal({"render", "square.obj", "--channels", "rgb", "-o", "no.exr"}, 2),
              EndsWith(", valid, depth, normal, camera-normal, segmentation and mask\n"));
  expect_done({"preview", "map.exr", "--channel", "depth", "-o", "depth.png"});
  expect_done({"preview", "map.exr", "--channel", "normal", "-o", "normal.png"});
  EXPECT_EQ(refusal({"preview", "map.exr", "--channel", "z", "-o", "no.png"}, 2),
            "the map has no channel 'z', only N, Z; did you mean 'Z'?\n");
  expect_done({"compare", "map.exr", "map.exr", "--channel", "depth"});
  expect_done({"convert", "map.exr", "--channel", "depth", "-o", "depth.npy"});
  expect_done({"convert", "map.exr", "--channel", "normal", "-o", "normal.npy"});
  EXPECT_EQ(refusal({"compare", "map.exr", "map.exr", "--channel", "z"}, 2),
            "the first map has no channel 'z', only N, Z; did you mean 'Z'?\n");
  EXPECT_EQ(refusal({"convert", "map.exr", "--channel", "id", "-o", "no.npy"}, 2),
            "the map has no channel 'id', only N, Z\n");
}

TEST_F(Mistakes, AChannelOfSeveralPartsWhereOneIsNeeded) {
  expect_done(
      {"render", "square.obj", "--camera", "camera.json", "--channels", "Z,N", "-o", "map.exr"});
  const std::string parts = "N is N.X, N.Y, N.Z; name one\n";
  EXPECT_EQ(refusal({"compare", "map.exr", "map.exr", "--channel", "N"}, 2), parts);
  EXPECT_EQ(refusal({"validate", "square.obj", "--camera", "camera.json", "--map", "map.exr",
                     "--channel", "N"},
                    3),
            "map.exr: " + parts);
  expect_done({"compare", "map.exr", "map.exr", "--channel", "N.X"});
}

TEST_F(Mistakes, AChannelOfSeveralPartsInAFormatOfOne) {
  expect_done(
      {"render", "square.obj", "--camera", "camera.json", "--channels", "Z,N", "-o", "map.exr"});
  const std::string parts =
      "--channel: this format holds one channel, and N is N.X, N.Y, N.Z; name "
      "the one to write, or write .exr, .npy or .npz\n";
  EXPECT_EQ(refusal({"convert", "map.exr", "--channel", "N", "-o", "no.pfm"}, 2), parts);
  EXPECT_THAT(refusal({"convert", "map.exr", "--channel", "N.X", "-o", "no.png"}, 4),
              EndsWith("write .exr, .npy or .npz\n"));
  expect_done({"convert", "map.exr", "--channel", "N.X", "-o", "n.pfm"});
}

TEST_F(Mistakes, UnknownFieldsOfAnOutputAreRefused) {
  EXPECT_THAT(
      refusal({"render", "square.obj", "-o", "v/{stme}.exr"}, 2),
      StartsWith("-o: there is no field '{stme}': did you mean '{stem}'?; the fields are "));
  EXPECT_THAT(refusal({"render", "square.obj", "-o", "{index:4}.exr"}, 2), StartsWith("-o: "));
  EXPECT_FALSE(std::filesystem::exists(folder_ / "v"));
}

TEST_F(Mistakes, TheProgramByItselfListsItsCommands) {
  const Outcome outcome = fathom({});
  EXPECT_EQ(outcome.status, 0);
  EXPECT_EQ(outcome.out, fathom({"--help"}).out);
  EXPECT_EQ(
      refusal({"camera"}, 2),
      "'fathom camera' needs a command: look-at, orbit, directions, shutter or import; see 'fathom "
      "camera --help'\n");
}

TEST_F(Mistakes, TheOtherSpellingOfOutput) {
  expect_done({"render", "square.obj", "--camera", "camera.json", "--out", "map.exr"});
  expect_done({"convert", "map.exr", "--out", "map.npy"});
  expect_done({"dataset", "maps", "camera.json", "--mesh", "square.obj", "--output", "room"});
  EXPECT_TRUE(std::filesystem::exists(folder_ / "room/000000.exr"));
}

}  // namespace
}  // namespace fathom::test
