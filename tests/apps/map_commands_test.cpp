// fathom preview, compare and convert, read by other programs.

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

class MapCommands : public ::testing::Test {
 protected:
  void SetUp() override {
    folder_.write("square.obj", square_obj);
    // The same square 2⁻²² farther: one unit in the last place of binary32 at 2.
    folder_.write("farther.json", R"({"meshes": [{"file": "square.obj",
        "transform": [[1,0,0,0],[0,1,0,0],[0,0,1,2.384185791015625e-7]]}]})");
    folder_.write("camera.json", square_camera);
    for (const std::string scene : {"square.obj", "farther.json"}) {
      const Outcome outcome = fathom({"render", scene, "--camera", "camera.json", "--channels",
                                      "Z,id", "-o", scene.substr(0, scene.find('.')) + ".exr"});
      ASSERT_EQ(outcome.status, 0) << outcome.err;
    }
  }

  Outcome fathom(const std::vector<std::string>& arguments) const {
    return run_fathom(arguments, {.folder = folder_.path()});
  }
  void expect_done(const std::vector<std::string>& arguments) const {
    const Outcome outcome = fathom(arguments);
    EXPECT_EQ(outcome.status, 0);
    EXPECT_EQ(outcome.err, "");
  }
  void run_python(const std::string& script) const {
    const Outcome outcome = run({python, "-c", script}, {.folder = folder_.path()});
    EXPECT_EQ(outcome.status, 0) << outcome.err;
  }

  TestFolder folder_;
};

TEST_F(MapCommands, PreviewIsAPictureForOpenImageIo) {
  for (const std::string colours : {"viridis", "magma", "turbo", "grey"}) {
    expect_done({"preview", "square.exr", "-o", "p.png", "--colormap", colours});
    const Outcome info = run({"oiiotool", "--info", folder_ / "p.png"});
    EXPECT_THAT(info.out, HasSubstr("3 channel, uint8 png"));
  }
  expect_done({"preview", "square.exr", "-o", "id.png", "--channel", "id"});
  run_python(R"(
import numpy as np
import OpenImageIO as oiio
def pixels(name):
    image = oiio.ImageInput.open(name)
    s = image.spec()
    return np.asarray(image.read_image(oiio.UINT8)).reshape(s.height, s.width, 3)
# The two triangles have colours of their own; a depth map of one depth has not.
assert len(np.unique(pixels('id.png').reshape(-1, 3), axis=0)) >= 3
)");
}

TEST_F(MapCommands, CompareSaysYes) {
  const Outcome same = fathom({"compare", "square.exr", "square.exr", "--json", "-"});
  EXPECT_EQ(same.status, 0);
  const Json report = Json::parse(same.out);
  EXPECT_EQ(report["within_tolerance"], true);
  EXPECT_EQ(report["channels"][0]["bit_equal"], 16);
  EXPECT_THAT(fathom({"compare", "square.exr", "square.exr"}).out, HasSubstr("the maps agree"));
}

TEST_F(MapCommands, CompareSaysNoByOneUnitInTheLastPlace) {
  const Outcome far = fathom({"compare", "square.exr", "farther.exr", "--channel", "Z", "--json",
                              "report.json", "--heatmap", "heat.png"});
  EXPECT_EQ(far.status, 1);
  EXPECT_EQ(far.err, "");
  EXPECT_THAT(far.out, HasSubstr("do not agree"));
  const Json depth = Json::parse(folder_.read("report.json"))["channels"][0];
  EXPECT_EQ(depth["ulp"]["max"], 1);
  EXPECT_EQ(depth["absolute"]["max"], 0x1p-22);
  EXPECT_EQ(depth["bit_equal"], 0);
  EXPECT_THAT(run({"oiiotool", "--info", folder_ / "heat.png"}).out, HasSubstr("uint8 png"));
  const auto with_tolerance = [&](const char* ulps) {
    return fathom(
        {"compare", "square.exr", "farther.exr", "--channel", "Z", "--tolerance-ulp", ulps});
  };
  EXPECT_EQ(with_tolerance("1").status, 0);
  EXPECT_EQ(with_tolerance("0.5").status, 1);
}

TEST_F(MapCommands, CompareShowsCoverageLast) {
  expect_done(
      {"render", "square.obj", "--camera", "camera.json", "--channels", "A,Z,id", "-o", "all.exr"});
  const std::string text = fathom({"compare", "all.exr", "all.exr"}).out;
  EXPECT_LT(text.find("channel Z"), text.find("channel id"));
  EXPECT_LT(text.find("channel id"), text.find("channel A"));
  EXPECT_LT(text.find("channel A"), text.size());
}

TEST_F(MapCommands, CompareCountsNoUlpsOfNormals) {
  folder_.write("tilted.json", R"({"meshes": [{"file": "square.obj",
      "transform": [[1,0,0,0],[0,1,0,0],[0.125,0,1,0]]}]})");
  for (const std::string scene : {"square.obj", "tilted.json"}) {
    expect_done({"render", scene, "--camera", "camera.json", "--channels", "Z,N", "-o",
                 scene.substr(0, 6) + ".exr"});
  }
  const std::string text = fathom({"compare", "square.exr", "tilted.exr"}).out;
  const std::size_t normals = text.find("channel N.X"), depths = text.find("channel Z");
  ASSERT_LT(normals, depths);
  ASSERT_LT(depths, text.size());
  EXPECT_EQ(text.substr(normals, depths - normals).find("ulp"), std::string::npos) << text;
  EXPECT_THAT(text.substr(normals, depths - normals), HasSubstr("  greatest  "));
  EXPECT_THAT(text.substr(depths), HasSubstr(" ulp at "));
}

TEST_F(MapCommands, CompareDrawsTheUnitThatIsAskedFor) {
  for (const char* unit : {"scene", "relative", "ulp"}) {
    EXPECT_EQ(fathom({"compare", "square.exr", "farther.exr", "--heatmap",
                      unit + std::string(".png"), "--heatmap-unit", unit})
                  .status,
              1);
  }
  // They differ in their titles and in what stands beside the bar.
  EXPECT_NE(folder_.read("scene.png"), folder_.read("relative.png"));
  EXPECT_NE(folder_.read("scene.png"), folder_.read("ulp.png"));
}

/// Columns 2 to 5 of rows 1 to 4 show the square: 16 of 48 pixels.
TEST_F(MapCommands, InfoCountsPixelsWithASurfaceByCoverage) {
  Json camera = Json::parse(square_camera);
  camera["near"] = 1;
  camera["far"] = 4;
  folder_.write("ranged.json", camera.dump());
  expect_done({"render", "square.obj", "--camera", "ranged.json", "--channels", "Z,A,N",
               "--depth-format", "unorm16", "--against-exact", "-o", "all.exr"});
  const Json channels = Json::parse(fathom({"info", "all.exr", "--json"}).out)["channels"];
  ASSERT_GE(channels.size(), 9U);
  for (const auto& [name, channel] : channels.items())
    EXPECT_EQ(channel["surface_pixels"], 16) << name;
}

TEST_F(MapCommands, InfoOfAPointCloud) {
  folder_.write("cloud.ply",
                "ply\nformat ascii 1.0\nelement vertex 2\nproperty float x\nproperty float "
                "y\nproperty float z\nend_header\n0 1 2\n-3 4 0.5\n");
  const Outcome text = fathom({"info", "cloud.ply"});
  EXPECT_EQ(text.err, "");
  EXPECT_THAT(text.out,
              HasSubstr("cloud.ply: a point cloud\n  vertices   2\n  faces      0\n  triangles  0\n"
                        "  bounds     (-3, 1, 0.5) to (0, 4, 2)\n"));
  const Json cloud = Json::parse(fathom({"info", "cloud.ply", "--json"}).out);
  EXPECT_EQ(cloud["kind"], "point cloud");
  EXPECT_EQ(cloud["bounds"], Json::parse("[[-3, 1, 0.5], [0, 4, 2]]"));
  EXPECT_EQ(Json::parse(fathom({"info", "square.obj", "--json"}).out)["kind"], "mesh");
}

TEST_F(MapCommands, CompareOfDifferentSizesIsAnInputError) {
  folder_.write("wide.json", camera_with("width", "9"));
  expect_done({"render", "square.obj", "--camera", "wide.json", "-o", "wide.exr"});
  EXPECT_EQ(fathom({"compare", "square.exr", "wide.exr"}).status, 3);
}

TEST_F(MapCommands, ConvertBetweenTheFormatsIsReadByPython) {
  expect_done({"convert", "square.exr", "-o", "z.npy", "--dtype", "float64"});
  expect_done({"convert", "square.exr", "-o", "z.pfm"});
  expect_done({"convert", "square.exr", "-o", "z.png", "--png-scale", "100"});
  expect_done({"convert", "z.png", "-o", "back.exr"});
  expect_done({"convert", "square.exr", "-o", "id.npy", "--channel", "id"});
  run_python(R"(
import numpy as np
import OpenImageIO as oiio
inside = np.zeros((6, 8), bool)
inside[1:5, 2:6] = True
z = np.load('z.npy')
assert z.dtype == np.float64 and (z[inside] == 2).all() and np.isposinf(z[~inside]).all()
pfm = np.frombuffer(open('z.pfm', 'rb').read()[-192:], '<f4').reshape(6, 8)[::-1]
assert (pfm[inside] == 2).all() and np.isposinf(pfm[~inside]).all()
png = np.asarray(oiio.ImageInput.open('z.png').read_image(oiio.UINT16)).reshape(6, 8)
assert (png == np.where(inside, 200, 0)).all()
back = np.asarray(oiio.ImageInput.open('back.exr').read_image(oiio.FLOAT)).reshape(6, 8)
assert (back[inside] == 2).all() and np.isposinf(back[~inside]).all()
number = np.load('id.npy')
assert number.dtype == np.uint32 and (number[~inside] == 0xFFFFFFFF).all()
)");
}

TEST_F(MapCommands, ConvertBetweenTheQuantitiesIsReadByPython) {
  expect_done({"convert", "square.exr", "--to", "distance", "-o", "distance.npy"});
  expect_done({"convert", "distance.npy", "--from", "distance", "--to", "Z", "--camera",
               "camera.json", "-o", "z.npy"});
  expect_done({"convert", "square.exr", "--to", "disparity", "--baseline", "0.5", "-o", "d.npy"});
  run_python(R"(
import numpy as np
inside = np.zeros((6, 8), bool)
inside[1:5, 2:6] = True
j, i = np.mgrid[0:6, 0:8]
x, y = (i + 0.5 - 4) / 4, (j + 0.5 - 3) / 4
distance = np.load('distance.npy')
# The program computes 2·√(1 + x² + y²) in binary64 and rounds to binary32, numpy likewise but in
# another order: two roundings of 2⁻⁵³ relative cannot cross more than one binary32 number.
assert (abs(distance - 2 * np.sqrt(1 + x * x + y * y))[inside] <= 2**-22).all()
assert np.isposinf(distance[~inside]).all()
# There and back: each step is off by at most ½ ulp of a number below 4.
assert (abs(np.load('z.npy') - 2)[inside] <= 2**-21).all()
assert (np.load('d.npy')[inside] == 4 * 0.5 / 2).all()   # |fx|·baseline/Z
)");
  EXPECT_EQ(
      fathom({"convert", "distance.npy", "--from", "distance", "--to", "Z", "-o", "z.npy"}).status,
      3);
}

TEST_F(MapCommands, ConvertToAPointCloudIsReadByPython) {
  expect_done({"convert", "square.exr", "-o", "points.ply"});
  expect_done(
      {"convert", "square.exr", "-o", "points32.ply", "--dtype", "float32", "--frame", "camera"});
  run_python(R"(
import numpy as np
def read(name, kind):
    header, body = open(name, 'rb').read().split(b'end_header\n', 1)
    assert b'format binary_little_endian 1.0' in header and b'element vertex 16' in header
    fields = [line.split()[1:] for line in header.decode().splitlines()
              if line.startswith('property')]
    types = {'double': '<f8', 'float': '<f4', 'uint': '<u4', 'int': '<i4', 'uint32': '<u4'}
    points = np.frombuffer(body, [(n, types[t]) for t, n in fields])
    assert len(points) == 16 and points['x'].dtype == kind
    return points
for points in (read('points.ply', np.float64), read('points32.ply', np.float32)):
    assert (points['z'] == 2).all()
    # Row by row: the first row is y = 2·(1.5 - 3)/4.
    assert (points['y'][:4] == -0.75).all()
    assert (points['x'][:4] == [-0.75, -0.25, 0.25, 0.75]).all()
    assert set(points['id']) <= {0, 1}
)");
}

}  // namespace
}  // namespace fathom::test
