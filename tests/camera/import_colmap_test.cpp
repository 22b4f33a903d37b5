// COLMAP's cameras project as COLMAP documents it.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <array>
#include <bit>
#include <cstdint>
#include <limits>
#include <optional>
#include <sstream>
#include <string>
#include <vector>

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
using ::testing::AllOf;
using ::testing::ElementsAre;
using ::testing::HasSubstr;

std::vector<ImportedCamera> colmap_text(const std::string& cameras, const std::string& images) {
  std::istringstream c(cameras), i(images);
  return judged(parse_colmap_text({c, "cameras.txt"}, {i, "images.txt"}));
}

class BinaryText {
 public:
  template <class T>
  BinaryText& operator<<(T value) {
    const auto bytes = std::bit_cast<std::array<char, sizeof(T)>>(value);
    text.append(bytes.begin(), bytes.end());
    return *this;
  }
  std::string text;
};

std::vector<ImportedCamera> colmap_binary(const std::string& cameras, const std::string& images) {
  std::istringstream c(cameras), i(images);
  return judged(parse_colmap_binary({c, "cameras.bin"}, {i, "images.bin"}));
}

struct ColmapCase {
  std::array<double, 4> q;
  std::array<double, 3> t;
  std::array<double, 4> k;
  /// COLMAP's documentation: x = R(q)·X + t, u = fx·x/z + cx, pixel centres at half integers.
  [[nodiscard]] Seen project(const Vector& X) const {
    Vector p = turned({q[0], q[1], q[2], q[3]}, X);
    for (int i = 0; i < 3; ++i) p[i] += t[i];
    return {k[0] * p[0] / p[2] + k[2], k[1] * p[1] / p[2] + k[3], p[2]};
  }
};

TEST(ImportColmap, ProjectsAsColmapDoes) {
  Draws draw(1);
  for (int round = 0; round < 200; ++round) {
    const ColmapCase one{{draw(-1, 1), draw(-1, 1), draw(-1, 1), draw(0.1, 1)},
                         {draw(-5, 5), draw(-5, 5), draw(20, 30)},
                         {draw(300, 900), draw(300, 900), draw(100, 500), draw(100, 500)}};
    BinaryText cameras, images;
    cameras << std::uint64_t{1} << std::uint32_t{7} << std::uint32_t{1} << std::uint64_t{640}
            << std::uint64_t{480};
    for (const double x : one.k) cameras << x;
    images << std::uint64_t{1} << std::uint32_t{9};
    for (const double x : one.q) images << x;
    for (const double x : one.t) images << x;
    images << std::uint32_t{7} << 'a' << '\0' << std::uint64_t{1} << 1.0 << 2.0 << std::uint64_t{3};
    const auto binary = colmap_binary(cameras.text, images.text);
    const auto text = colmap_text(
        "# comment\n\n7 PINHOLE 640 480 " + joined(one.k, " ") + "\r\n",
        "# comment\n9 " + joined(one.q, " ") + " " + joined(one.t, " ") + " 7 a\n1 2 3\n");
    ASSERT_EQ(binary.size(), 1U);
    ASSERT_EQ(text.size(), 1U);
    EXPECT_EQ(text[0].camera.name, "a");
    EXPECT_EQ(binary[0].camera.name, "a");
    EXPECT_EQ(text[0].camera.world_to_camera, binary[0].camera.world_to_camera);
    EXPECT_EQ(text[0].camera.width, 640U);
    EXPECT_EQ(text[0].camera.height, 480U);
    for (int i = 0; i < 5; ++i) {
      const Vector X = draw.point(8);
      expect_same(seen(text[0].camera, X), one.project(X));
      expect_same(seen(binary[0].camera, X), one.project(X));
    }
  }
}

TEST(ImportColmap, QuarterTurnsAreExactWhateverTheQuaternionsLength) {
  for (const char* q : {"1 0 0 1", "3 0 0 3", "1e-200 0 0 1e-200", "1e200 0 0 1e200"}) {
    const auto cameras = colmap_text("1 SIMPLE_PINHOLE 4 2 3 2 1",
                                     "1 " + std::string(q) + " 1 2 3 1 name with blanks.jpg");
    ASSERT_EQ(cameras.size(), 1U);
    const std::array<std::array<double, 4>, 3> expected{
        {{0, -1, 0, 1}, {1, 0, 0, 2}, {0, 0, 1, 3}}};
    EXPECT_EQ(cameras[0].camera.world_to_camera, expected) << q;
    EXPECT_EQ(cameras[0].camera.name, "name with blanks.jpg");
    EXPECT_EQ(cameras[0].camera.projection.fx, 3);
    EXPECT_EQ(cameras[0].camera.projection.fy, 3);
    EXPECT_EQ(cameras[0].camera.projection.pixel_centre, 0.5);
  }
}

TEST(ImportColmap, SortsByNameAndSharesCameras) {
  const auto cameras =
      colmap_text("1 SIMPLE_PINHOLE 4 2 3 2 1\n2 PINHOLE 8 4 1 2 3 4",
                  "1 1 0 0 0 0 0 0 2 b.png\n1.5 2.5 -1\n2 1 0 0 0 0 0 0 1 c.png\n\n"
                  "3 1 0 0 0 0 0 0 2 a.png\n");
  ASSERT_EQ(cameras.size(), 3U);
  EXPECT_EQ(cameras[0].camera.name, "a.png");
  EXPECT_EQ(cameras[1].camera.name, "b.png");
  EXPECT_EQ(cameras[2].camera.name, "c.png");
  EXPECT_EQ(cameras[1].camera.width, 8U);
  EXPECT_EQ(cameras[2].camera.width, 4U);
}

TEST(ImportColmap, TakesLenses) {
  const auto lens = [](const std::string& camera) {
    const ImportedCamera one = colmap_text("1 " + camera, "1 1 0 0 0 0 0 0 1 a.png\n").at(0);
    EXPECT_EQ(one.fault + one.distortion, "") << camera;
    return one.camera.projection.lens;
  };
  const auto expect = [&](const std::string& camera, const Lens& expected) {
    EXPECT_EQ(lens(camera), std::optional(expected)) << camera;
  };
  EXPECT_EQ(lens("OPENCV 4 2 3 3 2 1 0 0 0 0"), std::nullopt);
  expect("SIMPLE_RADIAL 4 2 3 2 1 1e-9", {LensModel::simple_radial, {1e-9}});
  expect("RADIAL 4 2 3 2 1 0 1e-300", {LensModel::radial, {0, 1e-300}});
  expect("OPENCV 4 2 3 3 2 1 1 2 3 0.1", {LensModel::opencv, {1, 2, 3, 0.1}});
  expect("FULL_OPENCV 4 2 3 3 2 1 1 2 3 4 5 6 7 -1",
         {LensModel::full_opencv, {1, 2, 3, 4, 5, 6, 7, -1}});
  expect("FOV 4 2 3 3 2 1 -0.9", {LensModel::fov, {-0.9}});
  expect("SIMPLE_DIVISION 4 2 3 2 1 0.1", {LensModel::simple_division, {0.1}});
  expect("DIVISION 4 2 3 3 2 1 -0.1", {LensModel::division, {-0.1}});
  expect("EUCM 4 2 3 3 2 1 0.1 2", {LensModel::eucm, {0.1, 2}});
}

TEST(ImportColmap, DistortionIsToldUnlessItIsZero) {
  const std::string image = "1 1 0 0 0 0 0 0 1 a.png\n";
  for (const char* zero :
       {"SIMPLE_RADIAL 4 2 3 2 1 0", "RADIAL 4 2 3 2 1 0 -0.0", "OPENCV 4 2 3 3 2 1 0 0 0 0",
        "FULL_OPENCV 4 2 3 3 2 1 0 0 0 0 0 0 0 0", "FOV 4 2 3 3 2 1 0",
        "SIMPLE_DIVISION 4 2 3 2 1 0", "DIVISION 4 2 3 3 2 1 0", "EUCM 4 2 3 3 2 1 0 1"})
    EXPECT_TRUE(colmap_text(std::string("1 ") + zero, image).at(0).distortion.empty()) << zero;
  const ImportedCamera bent = colmap_text("1 EUCM 4 2 3 3 2 1 2 1", image).at(0);
  EXPECT_EQ(bent.distortion, "cameras.txt: line 1: camera 1: alpha is not between 0 and 1");
  EXPECT_EQ(bent.camera.projection.cx, 2);
}

TEST(ImportColmap, FisheyesKeepTheirLens) {
  const char* const image = "1 1 0 0 0 0 0 0 1 a.png\n\n";
  const auto expect = [&](const std::string& camera, const Lens& lens) {
    const ImportedCamera one = colmap_text("1 " + camera, image).at(0);
    EXPECT_EQ(one.absence + one.fault + one.distortion, "") << camera;
    EXPECT_EQ(one.camera.projection.lens, lens) << camera;
    EXPECT_EQ(one.camera.projection.cy, 1) << camera;
  };
  expect("SIMPLE_FISHEYE 4 2 3 2 1", {LensModel::simple_fisheye});
  expect("FISHEYE 4 2 3 5 2 1", {LensModel::fisheye});
  expect("SIMPLE_RADIAL_FISHEYE 4 2 3 2 1 0", {LensModel::simple_radial_fisheye});
  expect("RADIAL_FISHEYE 4 2 3 2 1 0.5 -1", {LensModel::radial_fisheye, {0.5, -1}});
  expect("OPENCV_FISHEYE 4 2 3 5 2 1 1 2 3 4", {LensModel::opencv_fisheye, {1, 2, 3, 4}});
  expect("THIN_PRISM_FISHEYE 4 2 3 5 2 1 1 2 3 4 5 6 7 8",
         {LensModel::thin_prism_fisheye, {1, 2, 3, 4, 5, 6, 7, 8}});
  expect("RAD_TAN_THIN_PRISM_FISHEYE 4 2 3 5 2 1 1 2 3 4 5 6 7 8 9 10 11 12",
         {LensModel::rad_tan_thin_prism_fisheye, {1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12}});
}

TEST(ImportColmap, AFisheyeHasNoPinholePart) {
  const auto imported =
      colmap_text("1 OPENCV_FISHEYE 4 2 3 3 2 1 0 0 0 0", "1 1 0 0 0 0 0 0 1 a.png\n\n");
  Warnings warnings;
  EXPECT_EQ(chosen_cameras(imported, "model", {}, warnings).size(), 1U);
  EXPECT_EQ(message_of<InputError>(
                [&] { chosen_cameras(imported, "model", {.ignore_distortion = true}, warnings); }),
            "a.png: the lens OPENCV_FISHEYE has no pinhole part to take");
}

TEST(ImportColmap, PanoramasHaveTheirMiddleInTheMiddle) {
  const ImportedCamera one =
      colmap_text("1 EQUIRECTANGULAR 8 4 8 4", "1 1 0 0 0 0 0 0 1 a.png\n\n").at(0);
  EXPECT_EQ(one.absence + one.fault + one.distortion, "");
  Projection expected{.fx = 8, .fy = 4, .cx = 4, .cy = 2};
  expected.lens = Lens{LensModel::equirectangular};
  EXPECT_EQ(one.camera.projection, expected);
  Warnings warnings;
  EXPECT_EQ(message_of<InputError>(
                [&] { chosen_cameras({one}, "model", {.ignore_distortion = true}, warnings); }),
            "a.png: the lens EQUIRECTANGULAR has no pinhole part to take");
}

// Binary files can have such numbers; they do not matter to who takes the pinhole part.
TEST(ImportColmap, LensesThatAreNoneHaveAPinholePart) {
  constexpr double infinity = std::numeric_limits<double>::infinity();
  for (const double k1 : {std::numeric_limits<double>::quiet_NaN(), infinity, -infinity}) {
    BinaryText cameras, images;
    cameras << std::uint64_t{1} << std::uint32_t{1} << std::uint32_t{4} << std::uint64_t{4}
            << std::uint64_t{2} << 3.0 << 5.0 << 2.0 << 1.0 << k1 << 0.5 << 0.0 << 0.0;
    images << std::uint64_t{1} << std::uint32_t{1} << 1.0 << 0.0 << 0.0 << 0.0 << 0.0 << 0.0 << 0.0
           << std::uint32_t{1} << 'a' << '\0' << std::uint64_t{0};
    const auto imported = colmap_binary(cameras.text, images.text);
    Warnings warnings;
    const std::vector<Camera> pinholes =
        chosen_cameras(imported, "model", {.ignore_distortion = true}, warnings);
    ASSERT_EQ(pinholes.size(), 1U) << k1;
    EXPECT_EQ(pinholes[0].projection.fy, 5) << k1;
    EXPECT_EQ(pinholes[0].projection.lens, std::nullopt) << k1;
    EXPECT_THAT(
        message_of<InputError>([&] { chosen_cameras(imported, "model", {}, warnings); }),
        AllOf(HasSubstr("cameras.bin: byte 8: camera 1: k1 is not a finite number; undistort"),
              HasSubstr("--ignore-distortion")))
        << k1;
    EXPECT_TRUE(warnings.empty()) << k1;
  }
}

/// In the order of their ids: each file has a camera of one model that no image uses, so that the
/// file can only be followed where the number of its parameters is right.
TEST(ImportColmap, KnowsTheLengthOfEveryModel) {
  const std::array<std::size_t, 18> parameters{3, 4,  4,  5, 8, 8, 12, 5, 4,
                                               5, 12, 16, 4, 5, 3, 4,  6, 2};
  for (std::uint32_t model = 0; model < parameters.size(); ++model) {
    BinaryText cameras, images;
    cameras << std::uint64_t{2} << std::uint32_t{1} << model << std::uint64_t{4}
            << std::uint64_t{2};
    for (std::size_t k = 0; k < parameters[model]; ++k) cameras << 1.0;
    cameras << std::uint32_t{2} << std::uint32_t{0} << std::uint64_t{4} << std::uint64_t{2} << 3.0
            << 2.0 << 1.0;
    images << std::uint64_t{1} << std::uint32_t{1} << 1.0 << 0.0 << 0.0 << 0.0 << 0.0 << 0.0 << 0.0
           << std::uint32_t{2} << 'a' << '\0' << std::uint64_t{0};
    EXPECT_EQ(colmap_binary(cameras.text, images.text).at(0).camera.projection.fx, 3) << model;
  }
}

TEST(ImportColmap, NamesLineAndFault) {
  const std::string camera = "1 PINHOLE 4 2 3 3 2 1", image = "1 1 0 0 0 0 0 0 1 a.png";
  const auto fault = [&](const std::string& cameras, const std::string& images) {
    return message_of<InputError>([&] { colmap_text(cameras, images); });
  };
  EXPECT_THAT(fault("#\n1 PINHOLE 4 2 3 3 2", image), HasSubstr("cameras.txt: line 2: a camera p"));
  EXPECT_THAT(fault(camera + " 5", image), HasSubstr("found more"));
  EXPECT_THAT(fault("1 PINHOLE 4 2 3 3 2 1x", image), HasSubstr("found '1x'"));
  EXPECT_THAT(fault("1 PINHOLE 4 2 3 3 2 nan", image), HasSubstr("found 'nan'"));
  EXPECT_THAT(fault("1 PINHOLE 4 2 3 3 2 1e400", image), HasSubstr("found '1e400'"));
  EXPECT_THAT(fault("1 PINHOLE 4 2 0 3 2 1", image), HasSubstr("fx is 0"));
  EXPECT_THAT(fault("1 PINHOLE 0 2 1 3 2 1", image), HasSubstr("width is 0"));
  EXPECT_THAT(fault("1 PINHOLE 4294967296 2 1 3 2 1", image), HasSubstr("too large"));
  EXPECT_THAT(fault("1 PINHOLE -4 2 1 3 2 1", image), HasSubstr("found '-4'"));
  EXPECT_THAT(fault("1 HOLE 4 2 3 3 2 1", image), HasSubstr("unknown camera model 'HOLE'"));
  EXPECT_THAT(fault(camera + "\n" + camera, image), HasSubstr("stands twice"));
  EXPECT_THAT(fault(camera, "1 1 0 0 0 0 0 0 2 a.png"), HasSubstr("images.txt: line 1: the image"));
  EXPECT_THAT(fault(camera, "1 0 0 0 0 0 0 0 1 a.png"), HasSubstr("quaternion is zero"));
  EXPECT_THAT(fault(camera, image + "\n\n#\n1 1 0 0 0 0"), HasSubstr("images.txt: line 4"));
  EXPECT_THAT(fault(camera, "1 1 0 0 0 0 0 0 1"), HasSubstr("name is missing"));
  EXPECT_THAT(fault(camera, "# nothing"), HasSubstr("no image"));
}

TEST(ImportColmap, TruncatedBinaryFilesAreRefusedAtEveryByte) {
  BinaryText cameras, images;
  cameras << std::uint64_t{1} << std::uint32_t{1} << std::uint32_t{0} << std::uint64_t{4}
          << std::uint64_t{2} << 3.0 << 2.0 << 1.0;
  images << std::uint64_t{1} << std::uint32_t{1} << 1.0 << 0.0 << 0.0 << 0.0 << 0.0 << 0.0 << 0.0
         << std::uint32_t{1} << 'a' << '\0' << std::uint64_t{0};
  ASSERT_EQ(colmap_binary(cameras.text, images.text).size(), 1U);
  for (std::size_t n = 0; n < cameras.text.size(); ++n)
    EXPECT_THAT(
        message_of<InputError>([&] { colmap_binary(cameras.text.substr(0, n), images.text); }),
        HasSubstr("cameras.bin: byte"));
  for (std::size_t n = 0; n < images.text.size(); ++n)
    EXPECT_THAT(
        message_of<InputError>([&] { colmap_binary(cameras.text, images.text.substr(0, n)); }),
        HasSubstr("images.bin: byte"));
  EXPECT_THAT(message_of<InputError>([&] { colmap_binary(cameras.text, images.text + "x"); }),
              HasSubstr("not announced"));
  // Four billion billion points are said to follow.
  std::string many = images.text;
  many.replace(many.size() - 8, 8, "\xff\xff\xff\xff\xff\xff\xff\x7f");
  EXPECT_THAT(message_of<InputError>([&] { colmap_binary(cameras.text, many); }),
              HasSubstr("ends too early"));
  std::string unknown = cameras.text;
  unknown[12] = 99;
  EXPECT_THAT(message_of<InputError>([&] { colmap_binary(unknown, images.text); }),
              HasSubstr("unknown camera model 99"));
}

TEST(ImportColmap, ReadsTheModelInTheData) {
  const auto cameras = import_colmap(source_dir() / "data/cameras/colmap");
  ASSERT_EQ(cameras.size(), 2U);
  EXPECT_EQ(cameras[0].camera.name, "left.jpg");
  const ScratchFolder folder;
  EXPECT_THAT(message_of<InputError>([&] { import_colmap(folder.path()); }),
              HasSubstr("expected a COLMAP model"));
}

}  // namespace
}  // namespace fathom
