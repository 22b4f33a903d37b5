// Maps in the formats of data sets, COLMAP and geographic programs, as commands write and read
// them.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>

#include "tests/apps/run_program.h"
#include "tests/apps/sample_files.h"
#include "tests/apps/test_folder.h"

namespace fathom::test {
namespace {

using ::testing::HasSubstr;

const std::string python = "/usr/bin/python3";

/// The square at z = 2, and another at z = 4, of which the camera sees the column 6 in the rows 2
/// and 3: it spans columns 5 and 6, and the first one hides column 5.
std::string storeys_obj() {
  return square_obj + "v 1 -1 4\nv 3 -1 4\nv 3 1 4\nv 1 1 4\nf 5 6 7 8\n";
}

/// 8×6 pixels of half a unit, that look down from z = 10; the middle of the image is (1, 2).
const std::string plan_camera = R"({"width": 8, "height": 6, "projection": "orthographic",
  "fx": 2, "fy": 2, "cx": 4, "cy": 3, "pixel_centre": 0.5,
  "world_to_camera": [[1, 0, 0, -1], [0, -1, 0, 2], [0, 0, -1, 10]]})";

class ExchangeFormats : public ::testing::Test {
 protected:
  void SetUp() override {
    folder_.write("square.obj", square_obj);
    folder_.write("storeys.obj", storeys_obj());
    folder_.write("camera.json", square_camera);
    folder_.write("plan.json", plan_camera);
  }
  Outcome fathom(const std::vector<std::string>& arguments) const {
    return run_fathom(arguments, {.folder = folder_.path()});
  }
  void expect_done(const std::vector<std::string>& arguments) const {
    const Outcome outcome = fathom(arguments);
    EXPECT_EQ(outcome.status, 0) << ::testing::PrintToString(arguments);
    EXPECT_EQ(outcome.err, "") << ::testing::PrintToString(arguments);
  }
  void expect_refused(const std::vector<std::string>& arguments, int status,
                      const std::string& said) const {
    const auto before = folder_.names();
    const Outcome outcome = fathom(arguments);
    EXPECT_EQ(outcome.status, status) << ::testing::PrintToString(arguments);
    EXPECT_EQ(std::count(outcome.err.begin(), outcome.err.end(), '\n'), 1) << outcome.err;
    EXPECT_THAT(outcome.err, HasSubstr(said));
    EXPECT_EQ(folder_.names(), before);
  }
  std::string python_says(const std::string& script) const {
    const Outcome outcome = run({python, "-c", "import json\nimport numpy as np\n" + script},
                                {.folder = folder_.path()});
    EXPECT_EQ(outcome.status, 0) << outcome.err;
    return outcome.out;
  }

  TestFolder folder_;
};

TEST_F(ExchangeFormats, ColmapsMapsAreWrittenAndReadByEveryCommand) {
  expect_done({"render", "square.obj", "--camera", "camera.json", "-o", "z.bin"});
  expect_done(
      {"render", "square.obj", "--camera", "camera.json", "--channels", "Nc", "-o", "nc.bin"});
  expect_done(
      {"render", "square.obj", "--camera", "camera.json", "--channels", "Z,Nc", "-o", "map.exr"});
  expect_done({"convert", "map.exr", "-o", "again.bin"});
  EXPECT_EQ(folder_.read("again.bin"), folder_.read("z.bin"));
  expect_done({"convert", "map.exr", "--channel", "Nc", "-o", "again.bin"});
  EXPECT_EQ(folder_.read("again.bin"), folder_.read("nc.bin"));
  expect_done({"convert", "z.bin", "-o", "again.npy"});
  expect_done({"convert", "nc.bin", "-o", "normals.npz"});
  EXPECT_EQ(fathom({"compare", "map.exr", "z.bin"}).status, 0);
  EXPECT_EQ(fathom({"compare", "map.exr", "nc.bin", "--channel", "Nc.Z"}).status, 0);
  expect_done({"preview", "z.bin", "-o", "z.png"});
  EXPECT_THAT(fathom({"info", "z.bin"}).out, HasSubstr("8x6"));
  EXPECT_THAT(fathom({"info", "nc.bin"}).out, HasSubstr("Nc"));
  python_says(R"(
inside = np.zeros((6, 8), bool)
inside[1:5, 2:6] = True
data = open('z.bin', 'rb').read()
assert data[:6] == b'8&6&1&'
assert np.array_equal(np.frombuffer(data[6:], '<f4').reshape(6, 8), np.where(inside, 2, 0))
data = open('nc.bin', 'rb').read()
assert data[:6] == b'8&6&3&'
normal = np.frombuffer(data[6:], '<f4').reshape(3, 6, 8)
assert np.array_equal(normal[2], np.where(inside, -1, 0)) and not normal[:2].any()
assert np.array_equal(np.load('again.npy'), np.where(inside, 2, np.inf))
assert np.array_equal(np.load('normals.npz')['Nc'], np.moveaxis(normal, 0, 2))
)");
}

TEST_F(ExchangeFormats, WhatColmapHasNoPlaceForIsRefused) {
  const std::vector<std::string> render{"render",      "square.obj", "--camera",
                                        "camera.json", "-o",         "m.bin"};
  const auto refused = [&](std::vector<std::string> more, const std::string& said) {
    more.insert(more.begin(), render.begin(), render.end());
    expect_refused(more, 2, said);
  };
  refused({"--channels", "distance"}, "a COLMAP map holds Z or Nc, not 'distance'");
  refused({"--channels", "Z,Nc"}, "a COLMAP map holds Z or Nc");
  refused({"--background", "nan"}, "--background: it is always 0 in a .bin");
  refused({"--png-scale", "10"}, "--png-scale is for .png, not for m.bin");
}

TEST_F(ExchangeFormats, AGeoTiffOfAPlanIsReadByGdal) {
  // The third part of P is the height.
  expect_done(
      {"render", "square.obj", "--camera", "plan.json", "--channels", "Z,P", "-o", "dem.tif"});
  expect_done(
      {"render", "square.obj", "--camera", "plan.json", "--channels", "Z,P", "-o", "dem.exr"});
  expect_done({"convert", "dem.exr", "-o", "converted.tiff"});
  expect_done({"render", "square.obj", "--camera", "plan.json", "-o", "z.tif"});
  python_says(R"(
from osgeo import gdal
gdal.UseExceptions()
# The square is [-1, 1]^2; the image begins at (1 - 4/2, 2 + 3/2), and a pixel is 1/2.
inside = np.zeros((6, 8), bool)
inside[5:, 0:4] = True
for name in ('dem.tif', 'converted.tiff'):
    file = gdal.Open(name)
    assert file.GetGeoTransform() == (-1, 0.5, 0, 3.5, 0, -0.5), file.GetGeoTransform()
    bands = [file.GetRasterBand(i + 1) for i in range(file.RasterCount)]
    if name == 'dem.tif':
        assert [band.GetDescription() for band in bands] == ['Z', 'P.X', 'P.Y', 'P.Z']
    # An EXR has its channels by name.
    arrays = {band.GetDescription(): band.ReadAsArray() for band in bands}
    depth, x, y, height = [arrays[name] for name in ('Z', 'P.X', 'P.Y', 'P.Z')]
    assert np.array_equal(depth, np.where(inside, 8, np.nan), True), depth
    assert np.array_equal(height, np.where(inside, 2, np.nan), True), height
    # Of each pixel its centre.
    j, i = np.mgrid[:6, :8] + 0.5
    assert np.array_equal(x[inside], (-1 + i / 2)[inside])
    assert np.array_equal(y[inside], (3.5 - j / 2)[inside])
    assert json.loads(file.GetMetadataItem('fathom.camera'))['fx'] == 2
assert gdal.Open('z.tif').RasterCount == 1
)");
}

TEST_F(ExchangeFormats, NoGeoTiffIsWithoutItsPlace) {
  const std::string needs = "needs an orthographic camera that looks straight down or up";
  expect_refused({"render", "square.obj", "--camera", "camera.json", "-o", "m.tif"}, 4, needs);
  expect_done({"render", "square.obj", "--camera", "camera.json", "-o", "map.exr"});
  expect_refused({"convert", "map.exr", "-o", "m.tif"}, 4, needs);
  expect_done({"render", "square.obj", "--camera", "plan.json", "-o", "plan.npy"});
  expect_refused({"convert", "plan.npy", "-o", "m.tif"}, 3,
                 "carries no camera; expected --camera FILE");
  expect_done({"convert", "plan.npy", "--camera", "plan.json", "-o", "m.tif"});
  expect_refused({"info", "m.tif"}, 3, "m.tif: TIFF is written, not read");
  expect_refused(
      {"render", "square.obj", "--camera", "plan.json", "-o", "n.tif", "--channel-name", "Z=Y"}, 2,
      "is for .exr and .npz");
}

TEST_F(ExchangeFormats, DepthsBeyondTheCodesAreNoneWhereThatIsAskedFor) {
  const std::vector<std::string> render{"render",      "storeys.obj", "--camera", "camera.json",
                                        "--png-scale", "20000",       "-o",       "m.png"};
  expect_refused(render, 4, "m.png: pixel (6, 2): depth 4.00000e0 would be the code above 65535");
  for (const std::string engine : {"fast", "reference"}) {
    std::vector<std::string> more = render;
    more.insert(more.end(), {"--png-beyond", "none", "--png-sidecar", "--engine", engine});
    const Outcome outcome = fathom(more);
    EXPECT_EQ(outcome.status, 0);
    EXPECT_EQ(outcome.err,
              "fathom: warning: m.png: 2 of 48 pixels lie deeper than 3.27675 and are "
              "stored as 0\n");
    EXPECT_EQ(
        folder_.read("m.json"),
        "{\"channel\": \"Z\", \"unit\": \"codes per scene unit\", \"scale\": 20000, \"none\": 0, "
        "\"beyond\": 2, \"width\": 8, \"height\": 6}\n");
    python_says(R"(
import cv2
codes = cv2.imread('m.png', cv2.IMREAD_UNCHANGED)
inside = np.zeros((6, 8), bool)
inside[1:5, 2:6] = True
assert np.array_equal(codes, np.where(inside, 40000, 0)), codes
)");
    folder_.write(engine + ".png", folder_.read("m.png"));
  }
  // The same of a map that is converted.
  expect_done({"render", "storeys.obj", "--camera", "camera.json", "-o", "map.exr"});
  const Outcome converted = fathom({"convert", "map.exr", "--png-scale", "20000", "--png-beyond",
                                    "none", "--png-sidecar", "-o", "converted.png"});
  EXPECT_EQ(converted.status, 0);
  EXPECT_THAT(converted.err, HasSubstr("converted.png: 2 of 48 pixels lie deeper than 3.27675"));
  EXPECT_EQ(folder_.read("converted.json"), folder_.read("m.json"));
  EXPECT_EQ(fathom({"compare", "fast.png", "converted.png"}).status, 0);
  EXPECT_EQ(fathom({"compare", "fast.png", "reference.png"}).status, 0);
}

TEST_F(ExchangeFormats, ASidecarTakesNoOtherFilesPlace) {
  const auto with = [](std::vector<std::string> more) {
    more.insert(more.begin(), {"render", "square.obj", "--png-sidecar"});
    return more;
  };
  expect_refused(with({"--camera", "camera.json", "-o", "camera.png"}), 2, "camera.json");
  expect_refused(with({"--camera", "camera.json", "--stats", "m.json", "-o", "m.png"}), 2,
                 "m.json");
  expect_refused(with({"--camera", "camera.json", "-o", "m.exr"}), 2,
                 "--png-sidecar is for .png, not for m.exr");
  expect_refused(with({"--camera", "camera.json", "-o", "m.npy", "--png-beyond", "none"}), 2,
                 "is for .png");
  expect_done({"render", "square.obj", "--camera", "camera.json", "-o", "map.exr"});
  expect_refused({"convert", "map.exr", "-o", "points.ply", "--png-sidecar"}, 2,
                 "do not go with a point cloud");
}

}  // namespace
}  // namespace fathom::test
