// The cameras of data sets project as these document them: a point that is given in the camera's
// own axes, taken to the world by the pose, is seen where K has it. All of them count the first
// pixel's centre as 0, which ours has at ½.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <array>
#include <fstream>
#include <string>

#include "fathom/camera/camera_import_internal.h"
#include "fathom/failures/errors.h"
#include "tests/camera/judged.h"
#include "tests/camera/seen_points.h"
#include "tests/scratch_folder.h"

namespace fathom {
namespace {

using namespace camera;
using namespace test;
using ::testing::AllOf;
using ::testing::ElementsAre;
using ::testing::HasSubstr;

/// A turn by a quarter around the world's y axis and a step, exact in every format: camera x is
/// −z, y is y, and z is x of the world.
constexpr const char* four_rows = "0 0 1 2\n0 1 0 3\n-1 0 0 4\n0 0 0 1\n";
constexpr const char* one_row = "0 0 1 2 0 1 0 3 -1 0 0 4 0 0 0 1\n";

/// Camera point (x, y, z) in the world, by those rows.
Vector in_world(const Vector& p) {
  return {p[2] + 2, p[1] + 3, -p[0] + 4};
}

/// K = [fx 0 cx; 0 fy cy; 0 0 1] with pixel centres at integers.
Seen by_K(const std::array<Real, 4>& K, const Vector& p) {
  return {K[0] * p[0] / p[2] + K[2] + 0.5L, K[1] * p[1] / p[2] + K[3] + 0.5L, p[2]};
}

void expect_seen(const Camera& camera, const std::array<Real, 4>& K) {
  for (const Vector& p : {Vector{0, 0, 2}, Vector{0.5L, -0.25L, 4}, Vector{-1, 2, 8}})
    expect_same(seen(camera, in_world(p)), by_K(K, p));
}

std::vector<std::string> names(const std::vector<ImportedCamera>& cameras) {
  std::vector<std::string> result;
  for (const ImportedCamera& one : cameras) result.push_back(one.camera.name);
  return result;
}

template <class Read>
std::string fault(const Read& read) {
  return message_of<InputError>([&] { judged(read()); });
}

TEST(ImportMatrices, BothDirectionsAndAxes) {
  const std::vector<IntrinsicMatrix> K{{500, 0, 320, 0, 510, 240, 0, 0, 1}};
  const auto import = [&](const char* text, PoseDirection direction, CameraAxes axes) {
    return judged(import_matrices(parse_poses(text, "poses.txt", "poses"), K, {direction, axes, 0},
                                  640, 480, "poses.txt"))
        .at(0)
        .camera;
  };
  const std::array<Real, 4> numbers{500, 510, 320, 240};
  const Camera one = import(four_rows, PoseDirection::camera_to_world, CameraAxes::opencv);
  EXPECT_EQ(one.name, "poses");
  expect_seen(one, numbers);
  // The same with y and z of the camera the other way round.
  expect_seen(
      import("0 0 -1 2\n0 -1 0 3\n-1 0 0 4", PoseDirection::camera_to_world, CameraAxes::opengl),
      numbers);
  // The inverse of four_rows, by hand: the transposed rotation, and minus it times (2, 3, 4).
  expect_seen(
      import("0 0 -1 4\n0 1 0 -3\n1 0 0 -2", PoseDirection::world_to_camera, CameraAxes::opencv),
      numbers);
  expect_seen(
      import("0,0,-1,4\n0,-1,0,3\n-1,0,0,2", PoseDirection::world_to_camera, CameraAxes::opengl),
      numbers);
}

TEST(ImportMatrices, OneOnEachLineAndAKForEach) {
  const auto poses = parse_poses(std::string(one_row) + "0 0 1 2 0 1 0 3 -1 0 0 4\n", "p.txt", "p");
  const auto K = parse_intrinsic_matrices("1 0 2 0 3 4 0 0 1\n500,0,320,0,510,240,0,0,1", "K.txt");
  const auto cameras = judged(import_matrices(
      poses, K, {PoseDirection::camera_to_world, CameraAxes::opencv, 0.5}, 6, 4, "p"));
  EXPECT_THAT(names(cameras), ElementsAre("0", "1"));
  EXPECT_EQ(cameras[0].camera.world_to_camera, cameras[1].camera.world_to_camera);
  EXPECT_EQ(cameras[0].camera.projection.fy, 3);
  EXPECT_EQ(cameras[1].camera.projection.fx, 500);
  EXPECT_EQ(cameras[1].camera.projection.pixel_centre, 0.5);
}

TEST(ImportMatrices, NamesLineAndFault) {
  const auto text = [](const char* poses, const char* K = "1 0 2\n0 3 4\n0 0 1") {
    return fault([&] {
      return import_matrices(parse_poses(poses, "p.txt", "p"), parse_intrinsic_matrices(K, "K.txt"),
                             {PoseDirection::camera_to_world, CameraAxes::opencv, 0}, 6, 4,
                             "p.txt");
    });
  };
  EXPECT_EQ(text("# nothing"), "p.txt: holds no matrix");
  EXPECT_THAT(text("1 0 0 0\n0 1 0"),
              HasSubstr("p.txt: line 2: expected a row of 4 numbers, found 3"));
  EXPECT_THAT(text("1 0 0 0\n0 1 0 0"), HasSubstr("p.txt: expected a matrix of 3 or 4 rows"));
  EXPECT_THAT(text("1 0 0 0 0 1 0 0 0 0 1 0\n\n1 2"),
              HasSubstr("p.txt: line 3: expected a matrix"));
  EXPECT_THAT(text("1 0 0 0 0 1 0 0 0 0 1 x"), HasSubstr("line 1: expected a number, found 'x'"));
  EXPECT_THAT(text("1 0 0 0 0 1 0 0 0 0 1 nan"),
              HasSubstr("pose 0: the pose has a number that is"));
  EXPECT_THAT(text("1 0 0 0 0 1 0 0 0 0 0 0"), HasSubstr("pose 0: the matrix is singular"));
  EXPECT_THAT(text("1 0 0 0 0 1 0 0 0 0 1 0 1 2 3 1"), HasSubstr("last row to be 0 0 0 1"));
  EXPECT_THAT(text(four_rows, "1 0 2\n0 3 4"), HasSubstr("K.txt: expected 3 rows"));
  EXPECT_THAT(text(four_rows, "1 0 2\n0 3 4 5\n"), HasSubstr("K.txt: line 2: expected a row"));
  EXPECT_THAT(text(four_rows, "1 0 2\n7 3 4\n0 0 1"), HasSubstr("pose p: K: expected fx s cx"));
  EXPECT_THAT(text(four_rows, "1 0 2\n0 0 4\n0 0 1"), HasSubstr("pose p: fy is 0"));
  EXPECT_THAT(text(one_row, "1 0 2 0 3 4 0 0 1\n1 0 2 0 3 4 0 0 1"),
              HasSubstr("there are 2 matrices K and 1 poses"));
}

TEST(ImportMatrices, AFolderIsReadByName) {
  const ScratchFolder folder;
  for (const char* name : {"b.txt", "a.txt", "a.jpg"})
    std::ofstream(folder.path() / name) << four_rows;
  const auto poses = read_poses(folder.path());
  ASSERT_EQ(poses.size(), 2U);
  EXPECT_EQ(poses[0].name, "a");
  EXPECT_EQ(poses[1].name, "b");
  std::ofstream(folder.path() / "c.txt") << one_row << one_row;
  EXPECT_THAT(message_of<InputError>([&] { read_poses(folder.path()); }),
              HasSubstr("c.txt: expected one matrix in each file"));
  EXPECT_THAT(message_of<InputError>([&] { read_poses(folder.path() / "none"); }),
              HasSubstr("none"));
}

/// "timestamp tx ty tz qx qy qz qw": position of the optical centre and its orientation.
TEST(ImportTum, ProjectsAsTheBenchmarkDoes) {
  Draws draw(5);
  for (int round = 0; round < 100; ++round) {
    const std::array<double, 3> t{draw(-5, 5), draw(-5, 5), draw(-5, 5)};
    const std::array<double, 4> q{draw(-1, 1), draw(-1, 1), draw(-1, 1), draw(0.1, 1)};
    const std::string text = "# timestamp tx ty tz qx qy qz qw\n1305031102.1758 " + joined(t, " ") +
                             " " + joined(q, " ");
    const auto cameras = judged(parse_tum({text, "g.txt"}, std::nullopt, *tum_lens("ros")));
    ASSERT_EQ(cameras.size(), 1U);
    EXPECT_EQ(cameras[0].camera.name, "1305031102.1758");
    EXPECT_EQ(cameras[0].camera.width, 640U);
    for (int i = 0; i < 5; ++i) {
      const Vector p{draw(-5, 5), draw(-5, 5), draw(10, 30)};
      Vector X = turned({q[3], q[0], q[1], q[2]}, p);
      for (std::size_t k = 0; k < 3; ++k)
        X[k] = static_cast<double>(X[k] + t[k]);  // moves it by 2⁻⁵³·40
      expect_same(seen(cameras[0].camera, X), by_K({525, 525, 319.5L, 239.5L}, p));
    }
  }
}

TEST(ImportTum, ImagesHaveThePoseThatIsNearestInTime) {
  const std::string poses = "2.00 2 0 0 0 0 0 1\n1.00 1 0 0 0 0 0 1\n1.03 1.5 0 0 0 0 0 1\n";
  const std::string images =
      "# color images\n0.985 rgb/a.png\n1.014 rgb/b.png\n1.016 rgb/c.png\n1.5 rgb/d.png\n2.0201 "
      "e\n";
  const auto cameras = parse_tum({poses, "g.txt"}, NamedText{images, "rgb.txt"}, *tum_lens("ros"));
  EXPECT_THAT(names(cameras), ElementsAre("rgb/a.png", "rgb/b.png", "rgb/c.png", "rgb/d.png", "e"));
  for (const auto& [i, x] : {std::pair{0, -1.0}, {1, -1.0}, {2, -1.5}}) {
    EXPECT_EQ(cameras[i].absence, "");
    EXPECT_EQ(cameras[i].camera.world_to_camera[0][3], x) << i;
  }
  EXPECT_EQ(cameras[3].absence, "rgb.txt: line 5: the trajectory has no pose within 0.02 s of 1.5");
  EXPECT_THAT(cameras[4].absence, HasSubstr("line 6"));
}

TEST(ImportTum, Lenses) {
  EXPECT_EQ(tum_lens("ros")->distortion, "");
  EXPECT_EQ(tum_lens("freiburg3")->distortion, "");
  EXPECT_EQ(tum_lens("freiburg3")->camera.projection.cy, 247.6);
  EXPECT_THAT(tum_lens("freiburg1")->distortion, HasSubstr("freiburg1"));
  EXPECT_THAT(tum_lens("freiburg2")->distortion, HasSubstr("distortion"));
  EXPECT_FALSE(tum_lens("freiburg4"));
  EXPECT_THROW(tum_lens(GivenLens{}), UsageError);
  const ImportedCamera given = tum_lens({.width = 8,
                                         .height = 6,
                                         .K = IntrinsicMatrix{1, 0, 2, 0, 3, 4, 0, 0, 1},
                                         .pixel_centre = 0.5});
  EXPECT_EQ(given.camera.width, 8U);
  EXPECT_EQ(given.camera.projection.pixel_centre, 0.5);
}

TEST(ImportTum, NamesLineAndFault) {
  const auto text = [](const std::string& poses) {
    return fault([&] { return parse_tum({poses, "g.txt"}, std::nullopt, *tum_lens("ros")); });
  };
  EXPECT_THAT(text("1 0 0 0 0 0 0"), HasSubstr("g.txt: line 1: expected time tx ty tz"));
  EXPECT_THAT(text("1 0 0 0 0 0 0 0"), HasSubstr("g.txt: line 1: the quaternion is zero"));
  EXPECT_THAT(text("1 0 0 0 0 0 0 nan"), HasSubstr("g.txt: line 1: the pose has a number"));
  EXPECT_THAT(text("inf 0 0 0 0 0 0 1"), HasSubstr("expected a time in seconds, found 'inf'"));
  EXPECT_THAT(text("#"), HasSubstr("g.txt: holds no pose"));
  EXPECT_THAT(text("1 0 0 0 0 0 0 1\n1 0 0 0 0 0 0 1"), HasSubstr("two images have the name '1'"));
  EXPECT_THAT(fault([&] {
                return parse_tum({"1 0 0 0 0 0 0 1", "g.txt"}, NamedText{"1.0", "rgb.txt"},
                                 *tum_lens("ros"));
              }),
              HasSubstr("rgb.txt: line 1: the image's file is missing"));
}

TEST(Import7Scenes, ProjectsAsKinectFusionDid) {
  const ImportedCamera one = judged({parse_7scenes({four_rows, "f"}, "frame-000007", {})}).at(0);
  EXPECT_EQ(one.camera.name, "frame-000007");
  EXPECT_EQ(one.camera.width, 640U);
  expect_seen(one.camera, {585, 585, 320, 240});
  const ScratchFolder folder;
  for (const char* name :
       {"frame-000001.pose.txt", "frame-000000.pose.txt", "frame-000000.depth.png"})
    std::ofstream(folder.path() / name) << four_rows;
  EXPECT_THAT(names(import_7scenes(folder.path(), {})),
              ElementsAre("frame-000000", "frame-000001"));
  EXPECT_THAT(fault([&] { return import_7scenes(folder.path() / "none", {}); }), HasSubstr("none"));
}

TEST(ImportScanNet, ProjectsAsItsReaderDoes) {
  const ScratchFolder folder;
  std::filesystem::create_directories(folder.path() / "pose");
  std::filesystem::create_directories(folder.path() / "intrinsic");
  const auto write = [&](const char* name, const std::string& text) {
    std::ofstream(folder.path() / name) << text;
  };
  write("intrinsic/intrinsic_depth.txt",
        "577.5 0.0 319.5 0.0\n0.0 578.5 239.5 0.0\n0.0 0.0 1.0 0.0\n0.0 0.0 0.0 1.0\n");
  write("intrinsic/intrinsic_color.txt",
        "1170.5 0.0 647.5 0.0\n0.0 1171.5 483.5 0.0\n0.0 0.0 1.0 0.0\n0.0 0.0 0.0 1.0\n");
  write("pose/10.txt", four_rows);
  write("pose/9.txt",
        "-inf -inf -inf -inf\n-inf -inf -inf -inf\n-inf -inf -inf -inf\n"
        "-inf -inf -inf -inf\n");
  const auto depth = import_scannet(folder.path(), ScanNetStream::depth, {});
  ASSERT_THAT(names(depth), ElementsAre("9", "10"));
  EXPECT_THAT(depth[0].absence, HasSubstr("9.txt: the frame was not tracked"));
  expect_seen(depth[1].camera, {577.5L, 578.5L, 319.5L, 239.5L});
  EXPECT_EQ(depth[1].camera.height, 480U);
  const auto colour = import_scannet(folder.path(), ScanNetStream::colour, {});
  expect_seen(colour[1].camera, {1170.5L, 1171.5L, 647.5L, 483.5L});
  EXPECT_EQ(colour[1].camera.width, 1296U);
  Warnings warnings;
  EXPECT_EQ(chosen_cameras(depth, "scene", {}, warnings).size(), 1U);
  EXPECT_THAT(warnings, ElementsAre(HasSubstr("1 of 2 cameras is left out")));
  write("pose/010.txt", four_rows);
  EXPECT_THAT(fault([&] { return import_scannet(folder.path(), ScanNetStream::depth, {}); }),
              HasSubstr("two images have the name '10'"));
}

TEST(ImportScanNetpp, ReadsTheIphonesPoses) {
  const std::string pose = "[[0,0,1,2],[0,1,0,3],[-1,0,0,4],[0,0,0,1]]";
  const std::string text = R"({"frame_000000": {"timestamp": 1.5, "imu": {}, "pose": [],
      "intrinsic": [[1500,0,960.5],[0,1501,720],[0,0,1]], "aligned_pose": )" +
                           pose + R"(}, "frame_000010": {"intrinsic": [[1,0,0],[0,1,0],[0,0,1]]}})";
  const auto cameras = parse_scannetpp({text, "pose.json"}, {});
  ASSERT_THAT(names(cameras), ElementsAre("frame_000000", "frame_000010"));
  expect_seen(cameras[0].camera, {1500, 1501, 960.5L, 720});
  EXPECT_EQ(cameras[0].camera.width, 1920U);
  EXPECT_EQ(cameras[1].fault, "pose.json: frame_000010: the key \"aligned_pose\" is missing");
  EXPECT_THAT(fault([] {
                return parse_scannetpp({"{}", "pose.json"}, {});
              }),
              HasSubstr("there is no frame"));
}

TEST(ImportReplica, ProjectsAsNiceSlamDoes) {
  const std::string parameters =
      R"({"camera": {"w": 1200, "h": 680, "fx": 600.0, "fy": 601.0, "cx": 599.5, "cy": 339.5,
      "scale": 6553.5}})";
  const auto cameras = judged(parse_replica({std::string(one_row) + one_row, "traj.txt"},
                                            NamedText{parameters, "cam_params.json"}, {}));
  ASSERT_THAT(names(cameras), ElementsAre("frame000000", "frame000001"));
  expect_seen(cameras[1].camera, {600, 601, 599.5L, 339.5L});
  EXPECT_EQ(cameras[1].camera.height, 680U);
  const auto text = [&](const std::string& poses) {
    return fault([&] {
      return parse_replica({poses, "traj.txt"}, NamedText{parameters, "c"}, {});
    });
  };
  EXPECT_THAT(text("1 2 3"), HasSubstr("traj.txt: line 1: expected a matrix"));
  EXPECT_THAT(text(""), HasSubstr("holds no pose"));
  const ScratchFolder folder;
  std::filesystem::create_directories(folder.path() / "room0");
  std::ofstream(folder.path() / "room0/traj.txt") << one_row;
  EXPECT_THAT(fault([&] { return import_replica(folder.path() / "room0", {}); }),
              HasSubstr("cam_params.json is neither here nor in the folder above"));
  std::ofstream(folder.path() / "cam_params.json") << parameters;
  EXPECT_EQ(judged(import_replica(folder.path() / "room0", {})).size(), 1U);
}

}  // namespace
}  // namespace fathom
