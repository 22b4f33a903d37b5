// fathom render, probe and info, read by other programs.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "run_program.h"
#include "sample_files.h"
#include "test_folder.h"

namespace fathom::test {
namespace {

using ::testing::HasSubstr;
using Json = nlohmann::json;

class Rendering : public ::testing::Test {
 protected:
  void SetUp() override {
    folder_.write("square.obj", square_obj);
    folder_.write("camera.json", square_camera);
  }

  Outcome fathom(const std::vector<std::string>& arguments, const std::string& input = "") const {
    return run_fathom(arguments, {.folder = folder_.path(), .input = input});
  }
  /// Runs fathom, which has to succeed without a word on standard error.
  std::string answer(const std::vector<std::string>& arguments,
                     const std::string& input = "") const {
    const Outcome outcome = fathom(arguments, input);
    EXPECT_EQ(outcome.status, 0);
    EXPECT_EQ(outcome.err, "");
    return outcome.out;
  }
  /// Renders the square through its camera.
  void render(const std::string& map, std::vector<std::string> more = {}) const {
    more.insert(more.begin(), {"render", "square.obj", "--camera", "camera.json", "-o", map});
    answer(more);
  }
  void expect_same_depth(const std::string& a, const std::string& b) const {
    EXPECT_EQ(fathom({"compare", a, b, "--channel", "Z"}).status, 0) << a << " and " << b;
  }
  /// Runs a Python script in the folder. Its assertions are the test.
  void run_python(const std::string& script) const {
    const Outcome outcome = run({python, "-c", script}, {.folder = folder_.path()});
    EXPECT_EQ(outcome.status, 0) << outcome.err;
  }

  TestFolder folder_;
};

/// The square's pixels: columns 2 to 5, rows 1 to 4 (sample_files.h).
const std::string inside_in_python = R"(
import numpy as np
inside = np.zeros((6, 8), bool)
inside[1:5, 2:6] = True
)";

/// Before any work: an image of 2³⁰ pixels takes minutes, and more memory than many machines have.
TEST_F(Rendering, SidesThatTheFileCannotHoldAreRefusedAtOnce) {
  for (const std::vector<std::string>& more : {std::vector<std::string>{}, {"--deep"}}) {
    std::vector<std::string> command{"render",       "square.obj", "--size",
                                     "1073741824x1", "-o",         "a.exr"};
    command.insert(command.end(), more.begin(), more.end());
    const Outcome outcome = run_fathom(command, {.folder = folder_.path(), .memory = 1 << 30});
    EXPECT_EQ(outcome.status, 4);
    EXPECT_EQ(outcome.err, "fathom: error: a.exr: EXR holds fewer than 2^30 pixels a side\n");
  }
}

TEST_F(Rendering, ExrWithEveryChannelIsReadByOpenImageIo) {
  render("map.exr", {"--channels", "Z,Zlow,distance,id,face,object,N,P,bary"});
  run_python(inside_in_python + R"(
import json, math
import OpenImageIO as oiio
image = oiio.ImageInput.open('map.exr')
spec = image.spec()
assert (spec.width, spec.height) == (8, 6)
names = list(spec.channelnames)
def channel(name, kind):
    i = names.index(name)
    return np.asarray(image.read_image(0, 0, i, i + 1, kind)).reshape(6, 8)
depth = channel('Z', oiio.FLOAT)
assert (depth[inside] == 2).all() and np.isposinf(depth[~inside]).all()
assert (channel('Zlow', oiio.FLOAT) == 0).all()
number = channel('id', oiio.UINT)
assert (number[~inside] == 0xFFFFFFFF).all()
# Samples of the diagonal lie on the edge that the triangles share: each belongs to one of them.
j, i = np.mgrid[0:6, 0:8]
above = (i - 2 > j - 1) & inside
below = (i - 2 < j - 1) & inside
assert (number[above] == 0).all() and (number[below] == 1).all()
assert (number[inside] <= 1).all()
assert (channel('object', oiio.UINT)[inside] == 0).all()
assert (channel('face', oiio.UINT) == number).all()
# Closed form: the ray through the sample is ((i + 1/2 - 4)/4, (j + 1/2 - 3)/4, 1).
x, y = (i + 0.5 - 4) / 4, (j + 0.5 - 3) / 4
assert (channel('P.X', oiio.FLOAT)[inside] == (2 * x)[inside]).all()
assert (channel('P.Y', oiio.FLOAT)[inside] == (2 * y)[inside]).all()
assert (channel('P.Z', oiio.FLOAT)[inside] == 2).all()
# numpy computes 4 + X*X + Y*Y without error here, and its square root is correctly rounded in
# binary64; rounding that to binary32 once more could differ only at a near-tie, and there is none.
distance = np.sqrt(4 * (1 + x * x + y * y)).astype(np.float32)
assert (channel('distance', oiio.FLOAT)[inside] == distance[inside]).all()
assert (abs(channel('N.Z', oiio.FLOAT)[inside]) == 1).all()
assert (channel('N.Z', oiio.FLOAT)[inside] == -1).all()
camera = json.loads(spec.getattribute('fathom.camera'))
assert camera['fx'] == 4 and camera['width'] == 8
sources = spec.getattribute('fathom.sources')
import hashlib
assert hashlib.sha256(open('square.obj', 'rb').read()).hexdigest() in sources
)");
}

TEST_F(Rendering, ExrIsListedByOiiotool) {
  render("map.exr");
  const Outcome listing = run({"oiiotool", "--info", "-v", folder_ / "map.exr"});
  EXPECT_EQ(listing.status, 0);
  EXPECT_THAT(listing.out, HasSubstr("8 x    6, 2 channel, float openexr"));
  EXPECT_THAT(listing.out, HasSubstr("channel list: A, Z"));
  EXPECT_THAT(listing.out, HasSubstr("compression: \"zip\""));
}

TEST_F(Rendering, PfmNpyAndPngAreReadByPython) {
  render("map.pfm");
  render("map32.npy");
  render("map64.npy", {"--dtype", "float64"});
  render("distance.npy", {"--channels", "distance", "--dtype", "float64"});
  render("map.png", {"--png-scale", "250"});
  render("id.png", {"--channels", "id"});
  run_python(inside_in_python + R"(
import OpenImageIO as oiio
data = open('map.pfm', 'rb').read()
header = b'Pf\n8 6\n-1'
assert data.startswith(header), data[:20]
pfm = np.frombuffer(data[-8 * 6 * 4:], '<f4').reshape(6, 8)[::-1]
for depth, kind in ((pfm, np.float32), (np.load('map32.npy'), np.float32),
                    (np.load('map64.npy'), np.float64)):
    assert depth.shape == (6, 8) and depth.dtype == kind
    assert (depth[inside] == 2).all() and np.isposinf(depth[~inside]).all()
j, i = np.mgrid[0:6, 0:8]
x, y = (i + 0.5 - 4) / 4, (j + 0.5 - 3) / 4
# 4·(1 + x² + y²) has few bits, so numpy's root is the exact number rounded once.
assert (np.load('distance.npy')[inside] == np.sqrt(4 * (1 + x * x + y * y))[inside]).all()
def png(name):
    image = oiio.ImageInput.open(name)
    assert image.spec().format == oiio.UINT16 and image.spec().nchannels == 1
    return np.asarray(image.read_image(oiio.UINT16)).reshape(6, 8)
assert (png('map.png') == np.where(inside, 500, 0)).all()
assert (png('id.png')[inside] <= 1).all()
)");
}

TEST_F(Rendering, PngThatCannotHoldADepthIsRefused) {
  for (const char* scale : {"40000", "0.0001"}) {
    const Outcome outcome = fathom(
        {"render", "square.obj", "--camera", "camera.json", "-o", "map.png", "--png-scale", scale});
    EXPECT_EQ(outcome.status, 4);
    EXPECT_THAT(outcome.err, ::testing::StartsWith("fathom: error: "));
    EXPECT_FALSE(std::filesystem::exists(folder_ / "map.png"));
  }
}

TEST_F(Rendering, StandardInputGivesTheSameMap) {
  render("file.exr");
  answer({"render", "-", "--mesh-format", "obj", "--camera", "camera.json", "-o", "input.exr"},
         square_obj);
  expect_same_depth("file.exr", "input.exr");
}

TEST_F(Rendering, TheSavedCameraGivesTheSameMap) {
  answer({"render", "square.obj", "--view", "200,-15", "--up", "z", "--size", "64x48", "--fov",
          "33", "--save-camera", "saved.json", "-o", "first.exr"});
  answer({"render", "square.obj", "--camera", "saved.json", "-o", "second.exr"});
  expect_same_depth("first.exr", "second.exr");
  run_python(inside_in_python + R"(
import OpenImageIO as oiio
map = oiio.ImageInput.open('first.exr')
channels = np.asarray(map.read_image(oiio.FLOAT)).reshape(48, 64, 2)
depth = channels[:, :, map.spec().channelindex('Z')]
seen = np.isfinite(depth)
# The whole square is framed: something is seen, and nothing touches the border.
assert seen.any() and not (seen[0].any() or seen[-1].any() or seen[:, 0].any() or seen[:, -1].any())
)");
}

TEST_F(Rendering, ACameraPathGivesAMapPerCamera) {
  std::filesystem::create_directory(folder_ / "maps");
  answer({"camera", "orbit", "square.obj", "--views", "3", "--size", "16x12", "-o", "path.json"});
  answer({"render", "square.obj", "--camera", "path.json", "-o", "maps/{index:04}.exr", "--stats",
          "stats.json"});
  EXPECT_EQ(Json::parse(folder_.read("stats.json")).size(), 3U);
  EXPECT_TRUE(std::filesystem::exists(folder_ / "maps/0000.exr"));
  EXPECT_TRUE(std::filesystem::exists(folder_ / "maps/0002.exr"));
  const Json path = Json::parse(folder_.read("path.json"));
  folder_.write("third.json", path[2].dump());
  answer({"render", "square.obj", "--camera", "third.json", "-o", "third.exr"});
  expect_same_depth("third.exr", "maps/0002.exr");
}

TEST_F(Rendering, ASceneFilePlacesItsMeshes) {
  folder_.write("scene.json", R"({"meshes": [
      {"file": "square.obj", "name": "near"},
      {"file": "square.obj", "transform": [[2,0,0,0],[0,2,0,0],[0,0,2,0.5]], "name": "far"}]})");
  answer({"render", "scene.json", "--camera", "camera.json", "--channels", "Z,object", "-o",
          "map.exr"});
  run_python(inside_in_python + R"(
import OpenImageIO as oiio
image = oiio.ImageInput.open('map.exr')
names = list(image.spec().channelnames)
def channel(name, kind):
    i = names.index(name)
    return np.asarray(image.read_image(0, 0, i, i + 1, kind)).reshape(6, 8)
# The far square is [-2, 2]² at z = 4.5: u from 4 - 16/9 > 2 to 4 + 16/9 < 6, hidden by the near one
# in rows 1 to 4; v from 3 - 16/9 > 1. So it is nowhere seen.
assert (channel('object', oiio.UINT)[inside] == 0).all()
assert (channel('Z', oiio.FLOAT)[inside] == 2).all()
assert np.isposinf(channel('Z', oiio.FLOAT)[~inside]).all()
)");
  const Json info = Json::parse(answer({"info", "scene.json", "--json"}));
  EXPECT_EQ(info["kind"], "scene");
  EXPECT_EQ(info["triangles"], 4);
  EXPECT_EQ(info["bounds"], Json::parse("[[-2, -2, 2], [2, 2, 4.5]]"));
}

/// JSON has to be UTF-8, names of files need not be.
TEST_F(Rendering, AnswersInJsonShowNamesThatAreNotUtf8) {
  const std::string camera = "camera\xff.json", map = "map\xfe.exr";
  folder_.write(camera, square_camera);
  const Json info = Json::parse(answer({"info", camera, "--json"}));
  EXPECT_EQ(info["kind"], "camera");
  EXPECT_EQ(info["file"], "camera\uFFFD.json");
  const Json report =
      Json::parse(answer({"render", "square.obj", "--camera", camera, "-o", map, "--stats", "-"}));
  EXPECT_EQ(report["map"], "map\uFFFD.exr");
}

TEST_F(Rendering, AnEmptySceneThroughACameraIsBackgroundWithAWarning) {
  folder_.write("empty.obj", "v 0 0 1\n");
  const std::vector<std::string> arguments{"render",      "empty.obj", "--camera",
                                           "camera.json", "-o",        "map.npy"};
  const Outcome outcome = fathom(arguments);
  EXPECT_EQ(outcome.status, 0);
  EXPECT_THAT(outcome.err, HasSubstr("fathom: warning: the scene has no triangle"));
  run_python("import numpy as np\nassert np.isposinf(np.load('map.npy')).all()");

  std::vector<std::string> quiet = arguments;
  quiet.emplace_back("--quiet");
  EXPECT_EQ(fathom(quiet).err, "");
  quiet = arguments;
  quiet.insert(quiet.begin(), "--quiet");
  EXPECT_EQ(fathom(quiet).err, "");
}

TEST_F(Rendering, DegenerateTrianglesAreOneWarningWithTheirCount) {
  folder_.write("square.obj", square_obj + "f 1 1 2\nf 3 3 3\n");
  for (const char* engine : {"reference", "fast"}) {
    const Outcome outcome = fathom(
        {"render", "square.obj", "--camera", "camera.json", "--engine", engine, "-o", "map.exr"});
    EXPECT_EQ(outcome.status, 0);
    EXPECT_THAT(outcome.err, HasSubstr("fathom: warning: 2 of 4 triangles")) << engine;
  }
}

TEST_F(Rendering, CullingByFacing) {
  // y points down in this camera: the square's corners turn clockwise as displayed.
  for (const auto& [cull, pixels] : {std::pair{"back", 0}, {"front", 16}, {"none", 16}}) {
    const Json stats = Json::parse(answer({"render", "square.obj", "--camera", "camera.json", "-o",
                                           "map.exr", "--cull", cull, "--stats", "-"}));
    EXPECT_EQ(stats["pixels_with_surface"], pixels) << cull;
    EXPECT_EQ(stats["triangles"], 2);
    EXPECT_EQ(stats["engine"], "fast");
  }
}

TEST_F(Rendering, TheEngineChangesNothing) {
  const auto map_by = [&](const std::string& engine) {
    const std::string file = engine + ".npy";
    const Json stats = Json::parse(answer({"render", "square.obj", "--size", "90x70", "--engine",
                                           engine, "-o", file, "--stats", "-"}));
    EXPECT_EQ(stats["engine"], engine);
    EXPECT_GT(stats["pixels_with_surface"], 100);
    return folder_.read(file);
  };
  EXPECT_EQ(map_by("fast"), map_by("reference"));
}

TEST_F(Rendering, TheNumberOfThreadsChangesNothing) {
  answer({"render", "square.obj", "--size", "90x70", "--threads", "1", "-o", "one.npy"});
  answer({"render", "square.obj", "--size", "90x70", "--threads", "7", "-o", "seven.npy"});
  EXPECT_EQ(folder_.read("one.npy"), folder_.read("seven.npy"));
}

TEST_F(Rendering, ProbeExplainsATieOnAnEdge) {
  // Sample (2.5, 1.5) lies on the diagonal, which is the shared edge.
  const Json probe = Json::parse(
      answer({"probe", "square.obj", "--camera", "camera.json", "--pixel", "2,1", "--json"}));
  ASSERT_EQ(probe["triangles"].size(), 1U);
  const Json triangle = probe["triangles"][0];
  EXPECT_EQ(triangle["depth"]["exact"], "2");
  EXPECT_THAT(triangle["depth"]["decimal"].get<std::string>(),
              ::testing::StartsWith("2.000000000000000000000000000000000000000"));
  int on_edge = 0;
  for (const auto& edge : triangle["edges"]) {
    if (edge["sign"] == 0) {
      ++on_edge;
      EXPECT_EQ(edge["left_or_top"], true);
    }
  }
  EXPECT_EQ(on_edge, 1);
  EXPECT_EQ(triangle["visible"], true);
  EXPECT_EQ(triangle["file"], "square.obj");
}

// The corners of the shared edge are doubles whose differences are not: an interval about e = 0 has
// a width.
TEST_F(Rendering, ProbeNamesTheArithmeticThatDecided) {
  folder_.write("diagonal.obj",
                "v -0.7 -0.7 1\nv 1.9 1.9 1\nv -1 3 1\nv 3 -1 1\nf 1 2 3\nf 1 4 2\n");
  folder_.write(
      "front.json",
      R"({"width": 2, "height": 2, "projection": "orthographic", "fx": 1, "fy": 1, "cx": 0,
                    "cy": 0, "pixel_centre": 0.5,
                    "world_to_camera": [[1, 0, 0, 0], [0, 1, 0, 0], [0, 0, 1, 0]]})");
  const std::vector<std::string> asked{"probe",      "diagonal.obj", "--camera",
                                       "front.json", "--pixel",      "0,0"};
  std::vector<std::string> as_json = asked;
  as_json.emplace_back("--json");
  const Json triangles = Json::parse(answer(as_json))["triangles"];
  ASSERT_EQ(triangles.size(), 1U);
  const Json decided = triangles[0]["decided_by"];
  EXPECT_EQ(decided["facing"], "CGAL::determinant over CGAL::Interval_nt");
  int by_dyadic = 0;
  for (const char* edge : {"e_A", "e_B", "e_C"}) {
    const bool is_zero = triangles[0]["edges"][edge]["sign"] == 0;
    by_dyadic += is_zero ? 1 : 0;
    EXPECT_EQ(decided[edge], is_zero ? "dyadic numbers" : "a linear form over CGAL::Interval_nt");
  }
  EXPECT_EQ(by_dyadic, 1);
  EXPECT_THAT(answer(asked),
              HasSubstr("  decided Δ by CGAL::determinant over CGAL::Interval_nt; "));
  EXPECT_THAT(answer(asked), HasSubstr(" by dyadic numbers\n"));
}

TEST_F(Rendering, StatisticsNameTheArithmeticThatDecided) {
  const auto stats = [&](const std::string& engine) {
    return Json::parse(answer({"render", "square.obj", "--camera", "camera.json", "--engine",
                               engine, "-o", "map.exr", "--stats", "-"}));
  };
  const Json reference = stats("reference"), fast = stats("fast");
  EXPECT_EQ(reference["decided_by"]["facing"]["interval"],
            "CGAL::determinant over CGAL::Interval_nt");
  EXPECT_EQ(reference["decided_by"]["facing"]["exact"], "dyadic numbers");
  EXPECT_EQ(fast["decided_by"]["facing"]["interval"], "Fathom's bounds");
  for (const Json& report : {reference, fast}) {
    for (const auto& [decision, by] : report["decided_by"].items())
      EXPECT_TRUE(report["decisions"].contains(decision)) << decision;
  }
}

TEST_F(Rendering, ProbeNamesTheRuleThatDecided) {
  folder_.write("pair.obj", square_obj + "v -1 -1 3\nv 1 -1 3\nv 1 1 3\nf 5 6 7\nf 1 2 3\n");
  const auto probe = [&](std::vector<std::string> more) {
    more.insert(more.begin(), {"probe", "pair.obj", "--camera", "camera.json", "--pixel", "4,2"});
    return answer(more);
  };
  const std::string text = probe({});
  EXPECT_THAT(text, HasSubstr("each of 3 triangles covers it"));
  EXPECT_THAT(text, HasSubstr("visible: the lowest number among equal depths"));
  EXPECT_THAT(text, HasSubstr("hidden: exactly as deep as triangle 0, whose number is lower"));
  EXPECT_THAT(text, HasSubstr("hidden: deeper than triangle 0"));
  EXPECT_THAT(text, HasSubstr("stored  2 = 0x1p+1"));
  EXPECT_THAT(probe({"--cull", "back"}), HasSubstr("does not count: culled: it is back-facing"));
}

TEST_F(Rendering, InfoDescribesMeshCameraAndMap) {
  const Json mesh = Json::parse(answer({"info", "square.obj", "--json"}));
  EXPECT_EQ(mesh["vertices"], 4);
  EXPECT_EQ(mesh["triangles"], 2);
  EXPECT_EQ(mesh["bounds"], Json::parse("[[-1, -1, 2], [1, 1, 2]]"));
  EXPECT_THAT(answer({"info", "square.obj"}), HasSubstr("triangles  2"));

  const Json camera = Json::parse(answer({"info", "camera.json", "--json"}));
  EXPECT_EQ(camera["kind"], "camera");
  EXPECT_EQ(camera["cameras"][0]["width"], 8);
  EXPECT_EQ(camera["cameras"][0]["eye"], Json::parse("[0, 0, 0]"));
  EXPECT_EQ(camera["cameras"][0]["forward"], Json::parse("[0, 0, 1]"));
  EXPECT_THAT(answer({"info", "camera.json"}), HasSubstr("perspective camera of 8x6 pixels"));

  render("map.exr", {"--channels", "Z,id"});
  const Json map = Json::parse(answer({"info", "map.exr", "--json"}));
  EXPECT_EQ(map["width"], 8);
  EXPECT_EQ(map["channels"]["Z"]["min"], 2);
  EXPECT_EQ(map["channels"]["Z"]["surface_pixels"], 16);
  EXPECT_EQ(map["channels"]["id"]["max"], 1);
  EXPECT_EQ(map["attributes"]["fathom.camera"]["fx"], 4);
  EXPECT_THAT(answer({"info", "map.exr"}), HasSubstr("a map of 8x6 pixels"));
}

std::string turned_away() {
  return camera_with("world_to_camera", "[[1,0,0,0],[0,-1,0,0],[0,0,-1,0]]");
}

TEST_F(Rendering, ACameraThatSeesNothingIsWarnedOf) {
  folder_.write("away.json", turned_away());
  const std::vector<std::string> render{"render", "square.obj", "--camera", "away.json", "-o"};
  const auto warned = [&](const std::string& map, const std::vector<std::string>& more) {
    std::vector<std::string> arguments = render;
    arguments.push_back(map);
    arguments.insert(arguments.end(), more.begin(), more.end());
    const Outcome outcome = fathom(arguments);
    EXPECT_EQ(outcome.status, 0);
    return outcome.err;
  };
  const std::string expected =
      "fathom: warning: nothing of the scene is in front of the camera: its middle lies at "
      "(0, 0, -2) in the camera's frame (x right, y down, z forward); with OpenGL's axes (y up, z "
      "backward) the scene would be seen: negate the second and third rows of world_to_camera\n";
  EXPECT_EQ(warned("a.exr", {}), expected);
  EXPECT_EQ(warned("b.exr", {"--deep"}), expected);
  EXPECT_EQ(warned("c.exr", {"--engine", "reference"}), expected);
  EXPECT_EQ(warned("d.exr", {"--channels", "A"}), expected);
  EXPECT_EQ(warned("e.exr", {"--quiet"}), "");
}

TEST_F(Rendering, AStreamedSceneThatIsNotSeenIsWarnedOf) {
  folder_.write("away.json", turned_away());
  answer({"info", "square.obj"});
  run_python(R"(
import struct
open('square.stl', 'wb').write(bytes(80) + struct.pack('<I', 1) + struct.pack(
    '<12fH', 0, 0, 1, -1, -1, 2, 1, -1, 2, 1, 1, 2, 0))
)");
  const Outcome outcome =
      fathom({"render", "square.stl", "--stream", "--camera", "away.json", "-o", "a.exr"});
  EXPECT_EQ(outcome.status, 0);
  EXPECT_THAT(outcome.err, HasSubstr("nothing of the scene is in front of the camera: its middle "
                                     "lies at (0, 0, -2)"));
}

TEST_F(Rendering, APathIsWarnedOfOnce) {
  folder_.write("path.json", "[" + square_camera + "," + turned_away() + "," +
                                 camera_with("cx", "7") + "," + turned_away() + "]");
  const Outcome outcome =
      fathom({"render", "square.obj", "--camera", "path.json", "-o", "{index}.exr"});
  EXPECT_EQ(outcome.status, 0);
  EXPECT_THAT(outcome.err,
              ::testing::MatchesRegex(
                  "fathom: warning: camera 1: nothing of the scene [^\n]*"
                  "\\(likewise 2 of 4 cameras\\)\n"
                  "fathom: warning: camera 2: the principal point \\(7, 3\\) [^\n]*\n"));
}

TEST_F(Rendering, ACameraFileWithoutPixelCentreIsWarnedOf) {
  std::string silent = square_camera;
  const std::string said = R"("pixel_centre": 0.5,)";
  silent.replace(silent.find(said), said.size(), "");
  folder_.write("silent.json", silent);
  folder_.write("path.json", "[" + silent + "," + silent + "]");
  const std::string expected =
      "fathom: warning: FILE: does not say \"pixel_centre\", so that 0.5 is taken; write 0.5 "
      "(COLMAP, OpenGL), or 0 if cx and cy are from OpenCV\n";
  const auto of = [&](const std::string& file) {
    return std::string(expected).replace(expected.find("FILE"), 4, file);
  };
  EXPECT_EQ(fathom({"render", "square.obj", "--camera", "silent.json", "-o", "a.exr"}).err,
            of("silent.json"));
  EXPECT_EQ(fathom({"render", "square.obj", "--camera", "path.json", "-o", "{index}.exr"}).err,
            of("path.json"));
  EXPECT_EQ(fathom({"info", "silent.json"}).err, of("silent.json"));
  EXPECT_EQ(fathom({"convert", "a.exr", "--camera", "silent.json", "-o", "a.ply"}).err,
            of("silent.json"));
  EXPECT_EQ(fathom({"probe", "square.obj", "--camera", "silent.json", "--pixel", "3,3"}).err,
            of("silent.json"));
  // What the program writes says it.
  EXPECT_EQ(fathom({"convert", "a.exr", "-o", "b.ply"}).err, "");
  answer({"camera", "look-at", "--eye", "0,0,-5", "-o", "made.json"});
  EXPECT_EQ(fathom({"info", "made.json"}).err, "");
}

}  // namespace
}  // namespace fathom::test
