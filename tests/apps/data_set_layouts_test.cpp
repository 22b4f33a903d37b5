// The layouts of `fathom dataset`, each of a small data set as its authors hand it out, read back
// by OpenCV.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <array>
#include <fstream>
#include <nlohmann/json.hpp>

#include "fathom/files/input_file.h"
#include "tests/apps/run_program.h"
#include "tests/apps/test_folder.h"
#include "tests/places.h"

namespace fathom::test {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;
using ::testing::HasSubstr;

/// Each code of a depth image is the exact depth, rounded once, or stands for none.
constexpr const char* judge = R"(
import sys
import cv2
import numpy as np
image, truth, scale, none = sys.argv[1], sys.argv[2], float(sys.argv[3]), int(sys.argv[4])
codes = cv2.imread(image, cv2.IMREAD_UNCHANGED)
Z = np.load(truth)
assert codes.dtype == np.uint16 and codes.shape == Z.shape, (codes.dtype, codes.shape)
seen = np.isfinite(Z)
assert 10 < seen.sum() < Z.size, seen.sum()
assert (codes[~seen] == none).all()
assert np.abs(codes[seen] - scale * Z[seen]).max() <= 0.5 + 1e-9
)";

/// What the layouts below say of their two cameras, worked out by hand: 4 units from the origin,
/// looking at it, the second one beside the first.
using Views = std::array<std::string, 2>;
const Views along_z{"[[1,0,0,0],[0,1,0,0],[0,0,1,4]]", "[[1,0,0,-0.25],[0,1,0,0],[0,0,1,4]]"};
const Views against_z{"[[1,0,0,0],[0,-1,0,0],[0,0,-1,4]]", "[[1,0,0,-0.25],[0,-1,0,0],[0,0,-1,4]]"};

std::string camera_file(const Views& world_to_camera) {
  std::string text;
  for (const std::string& matrix : world_to_camera) {
    text += (text.empty() ? "[" : ",") +
            (R"({"width":64,"height":48,"fx":60,"fy":60,"cx":31.5,"cy":23.5,"pixel_centre":0,)"
             R"("world_to_camera":)" +
             matrix + "}");
  }
  return text + "]";
}

struct Layout {
  std::string name;
  /// Files below the folder: names and texts.
  std::vector<std::pair<std::string, std::string>> files;
  std::string input;
  std::vector<std::string> options;
  /// Of the two images.
  std::vector<std::string> images;
  std::string scale, none;
  /// A list, and what stands in it.
  std::string list, words;
  /// World to camera.
  Views views = along_z;
};

void PrintTo(const Layout& layout, std::ostream* stream) {
  *stream << layout.name;
}

// Camera to world: 4 units before the origin, looking at it; spot turns its back.
const std::string before = "1 0 0 0\n0 1 0 0\n0 0 1 -4\n0 0 0 1\n";
const std::string beside = "1 0 0 0.25\n0 1 0 0\n0 0 1 -4\n0 0 0 1\n";
const std::string opengl_before = "[[1,0,0,0],[0,1,0,0],[0,0,1,4],[0,0,0,1]]";
const std::string opengl_beside = "[[1,0,0,0.25],[0,1,0,0],[0,0,1,4],[0,0,0,1]]";
const std::vector<std::string> small{"--K", "60,60,31.5,23.5", "--size", "64x48"};

class DepthImages : public ::testing::TestWithParam<Layout> {
 protected:
  void SetUp() override {
    for (const auto& [name, text] : GetParam().files) {
      fs::create_directories((folder_.path() / name).parent_path());
      std::ofstream(folder_.path() / name) << text;
    }
  }
  Outcome fathom(std::vector<std::string> first, const std::vector<std::string>& more = {}) {
    first.insert(first.end(), more.begin(), more.end());
    return run_fathom(first, {.folder = folder_.path()});
  }
  const std::string spot_ = (source_dir() / "data/meshes/spot.obj").string();
  TestFolder folder_;
};

TEST_P(DepthImages, HoldExactDepthsInTheirPlaces) {
  const Layout& layout = GetParam();
  const Outcome made = fathom(
      {"dataset", layout.name, layout.input, "--mesh", spot_, "--out", "exact"}, layout.options);
  ASSERT_EQ(made.status, 0) << made.err;
  EXPECT_EQ(made.out, "exact: 2 depth images, 2 made now\n");
  std::ofstream(folder_.path() / "cameras.json") << camera_file(layout.views);
  ASSERT_EQ(fathom({"render", spot_, "--camera", "cameras.json", "--dtype", "float64", "-o",
                    "{index}.npy"})
                .status,
            0);
  for (std::size_t i = 0; i < 2; ++i) {
    const Outcome judged = run({python, "-c", judge, "exact/" + layout.images[i],
                                std::to_string(i) + ".npy", layout.scale, layout.none},
                               {.folder = folder_.path()});
    EXPECT_EQ(judged.status, 0) << layout.images[i] << ": " << judged.err;
  }
  if (layout.list.empty()) return;
  EXPECT_THAT(std::string(files::InputFile(folder_.path() / "exact" / layout.list).text()),
              HasSubstr(layout.words));
}

INSTANTIATE_TEST_SUITE_P(
    All, DepthImages,
    ::testing::Values(
        Layout{"tum",
               {{"groundtruth.txt",
                 "# ground truth\n1305031102.1758 0 0 -4 0 0 0 1\n1305031102.1858 0.25 0 -4 0 0 0 "
                 "1\n"}},
               "groundtruth.txt",
               small,
               {"depth/1305031102.1758.png", "depth/1305031102.1858.png"},
               "5000",
               "0",
               "depth.txt",
               "\n1305031102.1858 depth/1305031102.1858.png\n"},
        Layout{"7scenes",
               {{"seq-01/frame-000000.pose.txt", before}, {"seq-01/frame-000001.pose.txt", beside}},
               "seq-01",
               small,
               {"frame-000000.depth.png", "frame-000001.depth.png"},
               "1000",
               "65535",
               "",
               ""},
        Layout{
            "scannet",
            {{"s/pose/0.txt", before},
             {"s/pose/10.txt", beside},
             {"s/intrinsic/intrinsic_depth.txt", "60 0 31.5 0\n0 60 23.5 0\n0 0 1 0\n0 0 0 1\n"}},
            "s",
            {"--size", "64x48"},
            {"depth/0.png", "depth/10.png"},
            "1000",
            "0",
            "",
            ""},
        Layout{"scannetpp",
               {{"iphone/pose_intrinsic_imu.json",
                 R"({"frame_000010":{"aligned_pose":[[1,0,0,0.25],[0,1,0,0],[0,0,1,-4],[0,0,0,1]],)"
                 R"("intrinsic":[[60,0,31.5],[0,60,23.5],[0,0,1]]},)"
                 R"("frame_000000":{"aligned_pose":[[1,0,0,0],[0,1,0,0],[0,0,1,-4],[0,0,0,1]],)"
                 R"("intrinsic":[[60,0,31.5],[0,60,23.5],[0,0,1]]}})"}},
               "iphone/pose_intrinsic_imu.json",
               {"--size", "64x48"},
               {"depth/frame_000000.png", "depth/frame_000010.png"},
               "1000",
               "0",
               "",
               ""},
        Layout{"replica",
               {{"r/traj.txt",
                 "1 0 0 0 0 1 0 0 0 0 1 -4 0 0 0 1\n1 0 0 0.25 0 1 0 0 0 0 1 -4 0 0 "
                 "0 1\n"}},
               "r",
               small,
               {"results/depth000000.png", "results/depth000001.png"},
               "6553.5",
               "0",
               "",
               ""},
        Layout{"kitti",
               {{"calib.txt",
                 "P0: 60 0 31.5 0 0 60 23.5 0 0 0 1 0\nP1: 60 0 31.5 -6 0 60 23.5 0 0 0 1 0\n"},
                {"00.txt", "1 0 0 0 0 1 0 0 0 0 1 -4\n1 0 0 0.25 0 1 0 0 0 0 1 -4\n"}},
               "calib.txt",
               {"--poses", "00.txt", "--camera", "1", "--size", "64x48"},
               {"000000.png", "000001.png"},
               "256",
               "0",
               "",
               "",
               // Camera 1 is 6/60 beside camera 0, whose poses these are.
               {"[[1,0,0,-0.1],[0,1,0,0],[0,0,1,4]]", "[[1,0,0,-0.35],[0,1,0,0],[0,0,1,4]]"}},
        Layout{"nerf",
               {{"transforms.json",
                 R"({"w":64,"h":48,"fl_x":60,"fl_y":60,"cx":32,"cy":24,"frames":[)"
                 R"({"file_path":"images/a.jpg","transform_matrix":)" +
                     opengl_before + R"(},{"file_path":"images/b.jpg","transform_matrix":)" +
                     opengl_beside + "}]}"}},
               "transforms.json",
               {},
               {"depth/a.png", "depth/b.png"},
               "1000",
               "0",
               "transforms.json",
               "\"depth_file_path\": \"depth/b.png\"",
               against_z}),
    [](const auto& layout) { return "of_" + layout.param.name; });

/// Layouts whose files are called as the data set calls its own, by names that are no UTF-8.
TEST(DataSetsOfAnyNames, GoOnWhereTheyWereInterrupted) {
  const std::string spot = (source_dir() / "data/meshes/spot.obj").string(), odd = "caf\xe9";
  struct Named {
    std::string name, input;
    std::vector<std::pair<std::string, std::string>> files;
    std::vector<std::string> options, images;
  };
  const std::string odd_again = odd + "\xff";
  const std::vector<Named> layouts{
      {"7scenes",
       "seq",
       {{"seq/" + odd + ".pose.txt", before}, {"seq/" + odd_again + ".pose.txt", beside}},
       small,
       {odd + ".depth.png", odd_again + ".depth.png"}},
      {"tum",
       "groundtruth.txt",
       {{"groundtruth.txt", "1 0 0 -4 0 0 0 1\n2 0.25 0 -4 0 0 0 1\n"},
        {"rgb.txt", "1 rgb/" + odd + ".png\n2 rgb/" + odd_again + ".png\n"}},
       {"--K", "60,60,31.5,23.5", "--size", "64x48", "--images", "rgb.txt"},
       {"depth/" + odd + ".png", "depth/" + odd_again + ".png"}},
      {"colmap",
       "sparse",
       {{"sparse/cameras.txt", "1 PINHOLE 64 48 60 60 32 24\n"},
        {"sparse/images.txt",
         "1 1 0 0 0 0 0 4 1 " + odd + ".jpg\n\n2 1 0 0 0 0 0 4 1 " + odd_again + ".jpg\n\n"}},
       {},
       {"stereo/depth_maps/" + odd + ".jpg.geometric.bin",
        "stereo/normal_maps/" + odd_again + ".jpg.geometric.bin"}}};
  for (const Named& layout : layouts) {
    SCOPED_TRACE(layout.name);
    const TestFolder folder;
    for (const auto& [name, text] : layout.files) {
      fs::create_directories((folder.path() / name).parent_path());
      std::ofstream(folder.path() / name) << text;
    }
    std::vector<std::string> command{"dataset", layout.name, layout.input, "--mesh",
                                     spot,      "--out",     "exact"};
    command.insert(command.end(), layout.options.begin(), layout.options.end());
    const auto make = [&] { return run_fathom(command, {.folder = folder.path()}); };
    const Outcome made = make();
    ASSERT_EQ(made.status, 0) << made.err;
    EXPECT_THAT(made.out, HasSubstr(", 2 made now"));
    const fs::path out = folder.path() / "exact";
    for (const std::string& image : layout.images) EXPECT_TRUE(fs::exists(out / image)) << image;
    const Outcome again = make();
    ASSERT_EQ(again.status, 0) << again.err;
    EXPECT_EQ(again.err, made.err);
    EXPECT_THAT(again.out, HasSubstr(", 0 made now"));
    fs::remove(out / layout.images[1]);
    EXPECT_THAT(make().out, HasSubstr(", 1 made now"));
    EXPECT_TRUE(fs::exists(out / layout.images[1]));
    std::string manifest(files::InputFile(out / "fathom-manifest.jsonl").text());
    std::ofstream(out / "fathom-manifest.jsonl", std::ios::trunc)
        << manifest.substr(0, manifest.find('\n') + 1);
    const Outcome of_others = make();
    EXPECT_EQ(of_others.status, 2);  // the manifest names no file, so the files are not its own
    std::ofstream(out / "fathom-manifest.jsonl", std::ios::trunc) << manifest;
    EXPECT_THAT(make().out, HasSubstr(", 0 made now"));
  }
}

/// A plate of 4 by 4 millimetres around the origin, z = 0.
constexpr const char* plate = R"(ply
format ascii 1.0
element vertex 4
property float x
property float y
property float z
element face 1
property list uchar int vertex_indices
end_header
-2 -2 0
2 -2 0
2 2 0
-2 2 0
4 0 1 2 3
)";

/// Masks as OpenCV reads them: the columns and rows of what they show.
constexpr const char* boxes = R"(
import json
import sys
import cv2
import numpy as np
for name in sys.argv[1:]:
    mask = cv2.imread(name, cv2.IMREAD_UNCHANGED)
    assert mask.dtype == np.uint8 and mask.shape == (10, 20), (mask.dtype, mask.shape)
    assert set(np.unique(mask)) <= {0, 255}
    y, x = mask.nonzero()
    print(json.dumps([int(v) for v in (x.min(), x.max(), y.min(), y.max(), len(x))]))
)";

class BopScenes : public ::testing::Test {
 protected:
  // One pixel is a millimetre at a distance of 100: the plate covers 4 by 4 pixels there. The
  // principal point (9.5, 4.5) is the middle of 20 by 10 pixels, the first of which has its centre
  // at 0.
  BopScenes() {
    write("models/obj_000001.ply", plate);
    write("000001/scene_camera.json",
          R"({"7": {"cam_K": [100,0,9.5, 0,100,4.5, 0,0,1], "depth_scale": 0.5}})");
    write_poses(R"([{"cam_R_m2c":[1,0,0,0,1,0,0,0,1],"cam_t_m2c":[0,0,100],"obj_id":1},
                    {"cam_R_m2c":[1,0,0,0,1,0,0,0,1],"cam_t_m2c":[1.1,0,50],"obj_id":1},
                    {"cam_R_m2c":[1,0,0,0,1,0,0,0,1],"cam_t_m2c":[10,0,100],"obj_id":1},
                    {"cam_R_m2c":[1,0,0,0,1,0,0,0,1],"cam_t_m2c":[0,0,200],"obj_id":1}])");
  }
  void write(const fs::path& file, const std::string& text) {
    fs::create_directories((folder_.path() / file).parent_path());
    std::ofstream(folder_.path() / file) << text;
  }
  void write_poses(const std::string& poses) {
    write("000001/scene_gt.json", R"({"7": )" + poses + "}");
  }
  Outcome make(const std::vector<std::string>& more = {"--areas"}) {
    std::vector<std::string> arguments{"dataset", "bop",   "000001", "--models", "models",
                                       "--size",  "20x10", "--out",  "exact"};
    arguments.insert(arguments.end(), more.begin(), more.end());
    return run_fathom(arguments, {.folder = folder_.path()});
  }
  TestFolder folder_;
};

// COLMAP's workspace has undistorted images.
TEST(ColmapLayout, WarnsOfLenses) {
  const TestFolder folder;
  fs::create_directories(folder / "sparse");
  folder.write("sparse/cameras.txt", "1 PINHOLE 8 6 6 6 4 3\n2 SIMPLE_RADIAL 8 6 6 4 3 -0.1\n");
  folder.write("sparse/images.txt", "1 1 0 0 0 0 0 4 1 a.jpg\n\n2 1 0 0 0 0 0 4 2 b.jpg\n\n");
  const auto warnings = [&](const std::vector<std::string>& more) {
    std::vector<std::string> command{"dataset", "colmap", "sparse", "--mesh",
                                     source_dir() / "data/meshes/cube.obj"};
    command.insert(command.end(), more.begin(), more.end());
    const Outcome outcome = run_fathom(command, {.folder = folder.path()});
    EXPECT_EQ(outcome.status, 0) << outcome.err;
    return outcome.err;
  };
  EXPECT_THAT(warnings({"--out", "with"}),
              HasSubstr("1 of 2 cameras has lens distortion, but stereo/ belongs to undistorted "
                        "images: take the model that 'colmap image_undistorter' makes"));
  EXPECT_THAT(warnings({"--out", "without", "--ignore-distortion"}),
              testing::Not(HasSubstr("lens distortion")));
}

TEST_F(BopScenes, HaveTheMasksAndCountsThatAreWorkedOutByHand) {
  const Outcome made = make();
  ASSERT_EQ(made.status, 0) << made.err;
  EXPECT_EQ(made.out, "exact: 1 image, 1 made now\n");
  const json info =
      json::parse(files::InputFile(folder_.path() / "exact/scene_gt_info.json").text()).at("7");
  ASSERT_EQ(info.size(), 4U);
  // The first covers [8, 12] × [3, 7] of the image, 4 by 4 pixels; the second, twice as large,
  // [8.2, 16.2] × [1, 9], before it: 0.2 by 4 pixels of the first are seen, but no centre of a
  // pixel.
  EXPECT_EQ(info[0], json::parse(R"({"bbox_obj":[-1,-1,-1,-1],"bbox_visib":[-1,-1,-1,-1],
      "px_count_all":16,"px_count_valid":16,"px_count_visib":0,"visib_fract":0.0,
      "area_all":16.0,"area_visib":)" +
                                 info[0].at("area_visib").dump() + R"(,"visib_area_fract":)" +
                                 info[0].at("visib_area_fract").dump() + "}"));
  EXPECT_NEAR(info[0].at("area_visib").get<double>(), 0.8, 1e-12);
  EXPECT_NEAR(info[0].at("visib_area_fract").get<double>(), 0.05, 1e-13);
  EXPECT_EQ(info[1].at("px_count_all"), 64);
  EXPECT_EQ(info[1].at("px_count_visib"), 64);
  EXPECT_EQ(info[1].at("bbox_obj"), json({8, 1, 7, 7}));
  EXPECT_EQ(info[1].at("visib_fract"), 1.0);
  // The third covers [18, 22]: half of it is beyond the image.
  EXPECT_EQ(info[2].at("px_count_all"), 16);
  EXPECT_EQ(info[2].at("px_count_valid"), 8);
  EXPECT_EQ(info[2].at("px_count_visib"), 8);
  EXPECT_EQ(info[2].at("visib_fract"), 0.5);
  EXPECT_EQ(info[2].at("bbox_obj"), json({18, 3, 3, 3}));
  EXPECT_EQ(info[2].at("bbox_visib"), json({18, 3, 1, 3}));
  EXPECT_EQ(info[2].at("area_all"), 16.0);
  EXPECT_EQ(info[2].at("area_visib"), 8.0);
  // The last is behind the first, half as large: [9, 11] × [4, 6], hidden by the second.
  EXPECT_EQ(info[3].at("px_count_all"), 4);
  EXPECT_EQ(info[3].at("px_count_visib"), 0);
  EXPECT_EQ(info[3].at("area_visib"), 0.0);

  const Outcome seen = run({python, "-c", boxes, "exact/mask/000007_000000.png",
                            "exact/mask/000007_000002.png", "exact/mask_visib/000007_000001.png"},
                           {.folder = folder_.path()});
  EXPECT_EQ(seen.out, "[8, 11, 3, 6, 16]\n[18, 19, 3, 6, 8]\n[8, 15, 1, 8, 64]\n") << seen.err;
  const Outcome depths =
      run({python, "-c",
           "import cv2; d = cv2.imread('exact/depth/000007.png', -1); print(d.dtype, d[0, 0], "
           "d[5, 10], d[4, 19])"},
          {.folder = folder_.path()});
  EXPECT_EQ(depths.out, "uint16 0 100 200\n") << depths.err;
}

/// Plates in front of cameras with principal points of four decimals. Their left and upper edges go
/// exactly through centres of pixels, which they have; the others through quarters. The numbers of
/// X and Y are exact.
constexpr const char* plates_at_centres = R"(
import json
import pathlib
import random
from fractions import Fraction

draw = random.Random(7)
cameras, poses, truth = {}, {}, {}
for i in range(40):
    cx, cy = round(draw.uniform(20, 44), 4), round(draw.uniform(15, 33), 4)
    left, top = draw.randrange(5, 30), draw.randrange(5, 20)
    right, bottom = left + draw.randrange(2, 20) + 0.25, top + draw.randrange(2, 20) + 0.25
    x = [float(Fraction(edge) - Fraction(cx)) for edge in (left, right)]
    y = [float(Fraction(edge) - Fraction(cy)) for edge in (top, bottom)]
    for edge, at, c in zip((left, right, top, bottom), x + y, (cx, cx, cy, cy)):
        assert Fraction(at) + Fraction(c) == edge
    corners = [(x[0], y[0]), (x[1], y[0]), (x[1], y[1]), (x[0], y[1])]
    pathlib.Path(f"models/obj_{i + 1:06}.ply").write_text(
        "ply\nformat ascii 1.0\nelement vertex 4\n" +
        "".join(f"property double {a}\n" for a in "xyz") +
        "element face 1\nproperty list uchar int vertex_indices\nend_header\n" +
        "".join(f"{a!r} {b!r} 0\n" for a, b in corners) + "4 0 1 2 3\n")
    cameras[i] = {"cam_K": [1, 0, cx, 0, 1, cy, 0, 0, 1], "depth_scale": 0.001}
    poses[i] = [{"cam_R_m2c": [1, 0, 0, 0, 1, 0, 0, 0, 1], "cam_t_m2c": [0, 0, 1], "obj_id": i + 1}]
    truth[i] = left, int(right), top, int(bottom), (right - left) * (bottom - top)
pathlib.Path("000001/scene_camera.json").write_text(json.dumps(cameras))
pathlib.Path("000001/scene_gt.json").write_text(json.dumps(poses))
pathlib.Path("truth.json").write_text(json.dumps(truth))
)";
constexpr const char* judge_plates = R"(
import json
import cv2
import numpy as np

found = json.load(open("exact/scene_gt_info.json"))
for i, (left, right, top, bottom, area) in json.load(open("truth.json")).items():
    expected = np.zeros((48, 64), np.uint8)
    expected[top:bottom + 1, left:right + 1] = 255
    for kind in ("mask", "mask_visib"):
        mask = cv2.imread(f"exact/{kind}/{int(i):06}_000000.png", cv2.IMREAD_UNCHANGED)
        assert np.array_equal(mask, expected), (kind, i)
    info, = found[i]
    count = int((expected != 0).sum())
    counts = info["px_count_all"], info["px_count_visib"], info["visib_fract"]
    assert counts == (count, count, 1), info
    assert info["bbox_obj"] == info["bbox_visib"] == [left, top, right - left, bottom - top], info
    areas = info["area_all"], info["area_visib"], info["visib_area_fract"]
    assert areas == (area, area, 1), (info, area)
)";

// In binary64, cx + width is another principal point: masks were shifted against mask_visib/, and
// visib_fract above 1.
TEST_F(BopScenes, MasksAreOfTheSameCameraAsTheImage) {
  const Outcome written = run({python, "-c", plates_at_centres}, {.folder = folder_.path()});
  ASSERT_EQ(written.status, 0) << written.err;
  const Outcome made = run_fathom({"dataset", "bop", "000001", "--models", "models", "--size",
                                   "64x48", "--out", "exact", "--areas"},
                                  {.folder = folder_.path()});
  ASSERT_EQ(made.status, 0) << made.err;
  const Outcome judged = run({python, "-c", judge_plates}, {.folder = folder_.path()});
  EXPECT_EQ(judged.status, 0) << judged.err;
}

/// A plate at depths that lie within two ulp of ties between codes.
constexpr const char* depths_near_ties = R"(
import json
import math
import pathlib
import random
from fractions import Fraction

draw = random.Random(8)
cameras, poses, truth = {}, {}, {}
for i in range(150):
    scale = [0.1, 0.01, 0.3, 1, 0.7][i % 5]
    depth = (draw.randrange(500, 60000) + 0.5) * scale
    for _ in range(draw.randrange(3)):
        depth = math.nextafter(depth, draw.choice((0, math.inf)))
    if i == 0:
        depth = 1000.75
    cameras[i] = {"cam_K": [100, 0, 9.5, 0, 100, 4.5, 0, 0, 1], "depth_scale": scale}
    poses[i] = [{"cam_R_m2c": [9999, 0, 0, 0, 9999, 0, 0, 0, 1], "cam_t_m2c": [0, 0, depth],
                 "obj_id": 1}]
    truth[i] = round(Fraction(depth) / Fraction(scale))  # ties to even
pathlib.Path("000001/scene_camera.json").write_text(json.dumps(cameras))
pathlib.Path("000001/scene_gt.json").write_text(json.dumps(poses))
pathlib.Path("truth.json").write_text(json.dumps(truth))
)";
constexpr const char* judge_codes = R"(
import json
import cv2

truth = json.load(open("truth.json"))
assert truth["0"] == 10007
wrong = {i: (code, int(depth)) for i, code in truth.items()
         if (depth := cv2.imread(f"exact/depth/{int(i):06}.png",
                                 cv2.IMREAD_UNCHANGED)[5, 10]) != code}
assert not wrong, wrong
)";

TEST_F(BopScenes, DepthCodesAreTheExactQuotientRoundedOnce) {
  const Outcome written = run({python, "-c", depths_near_ties}, {.folder = folder_.path()});
  ASSERT_EQ(written.status, 0) << written.err;
  const Outcome made = make({});
  ASSERT_EQ(made.status, 0) << made.err;
  const Outcome judged = run({python, "-c", judge_codes}, {.folder = folder_.path()});
  EXPECT_EQ(judged.status, 0) << judged.err;
}

TEST_F(BopScenes, WhatIsWrongIsToldInOneLine) {
  const auto told = [&](const std::string& words) {
    const Outcome refused = make({});
    EXPECT_EQ(refused.status, 3) << refused.err;
    EXPECT_THAT(refused.err, HasSubstr(words));
    EXPECT_EQ(std::ranges::count(refused.err, '\n'), 1);
  };
  write_poses(R"([{"cam_R_m2c":[1,0,0,0,1,0,0,0,1],"cam_t_m2c":[0,0,100],"obj_id":2}])");
  told("obj_000002.ply");
  write_poses(R"([{"cam_R_m2c":[1,0,0,0,1,0,0,0],"cam_t_m2c":[0,0,100],"obj_id":1}])");
  told("cam_R_m2c");
  write_poses("3");
  told("scene_gt.json");
  write("000001/scene_gt.json", R"({"8": []})");
  told("has no image of");
  write("000001/scene_gt.json", "{");
  told("scene_gt.json");
  write_poses(R"([{"cam_R_m2c":[1,0,0,0,1,0,0,0,1],"cam_t_m2c":[0,0,100],"obj_id":1}])");
  write("models/obj_000001.ply", "ply\n");
  told("obj_000001.ply");
  fs::remove(folder_.path() / "000001/scene_camera.json");
  told("scene_camera.json");
}

TEST_F(BopScenes, AFolderWithoutCamerasIsToldSo) {
  fs::remove(folder_.path() / "000001/scene_camera.json");
  for (const std::vector<std::string>& command :
       {std::vector<std::string>{"dataset", "bop", "000001", "--models", "models", "--out",
                                 "exact"},
        {"dataset", "bop", "nowhere", "--models", "models", "--out", "exact"},
        {"camera", "import", "bop", "000001"}}) {
    const Outcome refused = run_fathom(command, {.folder = folder_.path()});
    EXPECT_EQ(refused.status, 3) << refused.err;
    EXPECT_EQ(refused.err, "fathom: error: " + command[command[0] == "camera" ? 3 : 2] +
                               ": has no scene_camera.json: give the folder of a scene, as "
                               "test/000001\n");
  }
}

// With 0.001 millimetres a code, 65535 codes reach to 65.535: the second plate at 50 has the code
// 50000, and those at 100 and 200 have none.
TEST_F(BopScenes, DepthsBeyondTheLastCodeAreAnErrorOrNone) {
  write("000001/scene_camera.json",
        R"({"7": {"cam_K": [100,0,9.5, 0,100,4.5, 0,0,1], "depth_scale": 0.001}})");
  const Outcome refused = make({});
  EXPECT_EQ(refused.status, 4);
  EXPECT_THAT(refused.err, HasSubstr("exact/depth/000007.png: pixel (18, 3): "));
  const Outcome made = make({"--png-beyond", "none"});
  ASSERT_EQ(made.status, 0) << made.err;
  EXPECT_EQ(made.err,
            "fathom: warning: 8 pixels in 1 map lie beyond the last code and are stored as 0\n");
  const json info =
      json::parse(files::InputFile(folder_.path() / "exact/scene_gt_info.json").text()).at("7");
  EXPECT_EQ(info[0].at("px_count_valid"), 16);  // where the second is before it
  EXPECT_EQ(info[1].at("px_count_valid"), 64);
  EXPECT_EQ(info[2].at("px_count_valid"), 0);
  EXPECT_EQ(info[2].at("px_count_visib"), 8);
  const Outcome depths =
      run({python, "-c",
           "import cv2; d = cv2.imread('exact/depth/000007.png', -1); print(d[5, 10], d[4, 19])"},
          {.folder = folder_.path()});
  EXPECT_EQ(depths.out, "50000 0\n") << depths.err;
}

TEST_F(BopScenes, AnImageWithoutInstancesIsBackground) {
  write_poses("[]");
  const Outcome made = make();
  EXPECT_EQ(made.status, 0) << made.err;
  EXPECT_TRUE(fs::exists(folder_.path() / "exact/depth/000007.png"));
}

}  // namespace
}  // namespace fathom::test
