#include "fathom/camera/camera_import.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <bit>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <random>
#include <sstream>

#include "fathom/camera/camera_files.h"
#include "fathom/camera/camera_import_internal.h"
#include "fathom/numeric/errors.h"
#include "fathom/numeric/rounding.h"
#include "fathom/scene/read_scene.h"
#include "tests/scene/scratch_folder.h"

// The imports are held to the projection formula of each program's own convention, written out
// here in long double without a matrix of ours.
namespace fathom {
namespace {

using testing::AllOf;
using testing::HasSubstr;
using Real = long double;
using Vector = std::array<Real, 3>;

/// Where a point lands: image position with (0, 0) in the top left corner, and depth.
struct Seen {
  Real u = 0, v = 0, depth = 0;
};

Seen seen(const Camera& camera, const Vector& X) {
  const auto exact = [](Real x) { return Dyadic(static_cast<double>(x)); };
  const CameraPoint p = to_camera(camera, {exact(X[0]), exact(X[1]), exact(X[2])});
  const auto [U, V, W] = to_image(camera, p);
  return {round_to_binary64(Ratio(U, W)), round_to_binary64(Ratio(V, W)),
          round_to_binary64(Ratio(p.z))};
}

/// Entries of ours are rounded once, by 2⁻⁵³ of themselves; coordinates and translations are below
/// 100, focal lengths and pixels below 2000, depths above 1. A point in the camera frame then errs
/// by less than 4·100·2⁻⁵³ < 1e-13 and a pixel by less than 2000·1e-13·(1 + 100) < 1e-7·½.
void expect_same(const Seen& ours, const Seen& theirs) {
  ASSERT_GT(theirs.depth, 1);
  ASSERT_NEAR(static_cast<double>(ours.u), static_cast<double>(theirs.u), 1e-7);
  ASSERT_NEAR(static_cast<double>(ours.v), static_cast<double>(theirs.v), 1e-7);
  ASSERT_NEAR(static_cast<double>(ours.depth), static_cast<double>(theirs.depth), 1e-12);
}

class Draws {
 public:
  explicit Draws(unsigned seed) : random_(seed) {}
  /// With few digits, so that it stands in a text as it is.
  double operator()(double from, double to) {
    return std::round(std::uniform_real_distribution<double>(from, to)(random_) * 1024) / 1024;
  }
  Vector point(double size) {
    return {(*this)(-size, size), (*this)(-size, size), (*this)(-size, size)};
  }

 private:
  std::mt19937 random_;
};

/// v turned by the quaternion q: q·v·q⁻¹ with Hamilton's product, no matrix.
Vector turned(const std::array<Real, 4>& q, const Vector& v) {
  using Q = std::array<Real, 4>;
  const auto times = [](const Q& a, const Q& b) {
    return Q{a[0] * b[0] - a[1] * b[1] - a[2] * b[2] - a[3] * b[3],
             a[0] * b[1] + a[1] * b[0] + a[2] * b[3] - a[3] * b[2],
             a[0] * b[2] - a[1] * b[3] + a[2] * b[0] + a[3] * b[1],
             a[0] * b[3] + a[1] * b[2] - a[2] * b[1] + a[3] * b[0]};
  };
  const Real n = q[0] * q[0] + q[1] * q[1] + q[2] * q[2] + q[3] * q[3];
  const Q r = times(times(q, {0, v[0], v[1], v[2]}), {q[0] / n, -q[1] / n, -q[2] / n, -q[3] / n});
  return {r[1], r[2], r[3]};
}

std::string text_of(double x) {
  std::ostringstream out;
  out.precision(17);
  out << x;
  return out.str();
}

template <class List>
std::string joined(const List& list, const char* separator) {
  std::ostringstream out;
  out.precision(17);
  const char* before = "";
  for (const auto x : list) {
    out << before << static_cast<double>(x);
    before = separator;
  }
  return out.str();
}

// COLMAP

std::vector<ImportedCamera> colmap_text(const std::string& cameras, const std::string& images) {
  std::istringstream c(cameras), i(images);
  return parse_colmap_text({c, "cameras.txt"}, {i, "images.txt"});
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
  return parse_colmap_binary({c, "cameras.bin"}, {i, "images.bin"});
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
    EXPECT_EQ(text[0].name, "a");
    EXPECT_EQ(binary[0].name, "a");
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
    EXPECT_EQ(cameras[0].name, "name with blanks.jpg");
    EXPECT_EQ(cameras[0].camera.fx, 3);
    EXPECT_EQ(cameras[0].camera.fy, 3);
    EXPECT_EQ(cameras[0].camera.pixel_centre, 0.5);
  }
}

TEST(ImportColmap, SortsByNameAndSharesCameras) {
  const auto cameras =
      colmap_text("1 SIMPLE_PINHOLE 4 2 3 2 1\n2 PINHOLE 8 4 1 2 3 4",
                  "1 1 0 0 0 0 0 0 2 b.png\n1.5 2.5 -1\n2 1 0 0 0 0 0 0 1 c.png\n\n"
                  "3 1 0 0 0 0 0 0 2 a.png\n");
  ASSERT_EQ(cameras.size(), 3U);
  EXPECT_EQ(cameras[0].name, "a.png");
  EXPECT_EQ(cameras[1].name, "b.png");
  EXPECT_EQ(cameras[2].name, "c.png");
  EXPECT_EQ(cameras[1].camera.width, 8U);
  EXPECT_EQ(cameras[2].camera.width, 4U);
}

TEST(ImportColmap, DistortionIsRefusedUnlessItIsZero) {
  const std::string image = "1 1 0 0 0 0 0 0 1 a.png\n";
  for (const char* zero :
       {"SIMPLE_RADIAL 4 2 3 2 1 0", "RADIAL 4 2 3 2 1 0 -0.0", "OPENCV 4 2 3 3 2 1 0 0 0 0",
        "FULL_OPENCV 4 2 3 3 2 1 0 0 0 0 0 0 0 0", "FOV 4 2 3 3 2 1 0"})
    EXPECT_EQ(colmap_text(std::string("1 ") + zero, image).at(0).camera.cx, 2) << zero;
  for (const char* not_zero :
       {"SIMPLE_RADIAL 4 2 3 2 1 1e-9", "RADIAL 4 2 3 2 1 0 1e-300", "OPENCV 4 2 3 3 2 1 0 0 0 0.1",
        "FULL_OPENCV 4 2 3 3 2 1 0 0 0 0 0 0 0 -1", "FOV 4 2 3 3 2 1 0.1",
        "OPENCV_FISHEYE 4 2 3 3 2 1 0 0 0 0", "SIMPLE_RADIAL_FISHEYE 4 2 3 2 1 0",
        "RADIAL_FISHEYE 4 2 3 2 1 0 0", "THIN_PRISM_FISHEYE 4 2 3 3 2 1 0 0 0 0 0 0 0 0"})
    EXPECT_THAT(message_of<InputError>([&] { colmap_text(std::string("1 ") + not_zero, image); }),
                AllOf(HasSubstr("cameras.txt: line 1"), HasSubstr("undistort")))
        << not_zero;
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
  const auto cameras = import_colmap(FATHOM_SOURCE_DIR "/data/cameras/colmap");
  ASSERT_EQ(cameras.size(), 2U);
  EXPECT_EQ(cameras[0].name, "left.jpg");
  const ScratchFolder folder;
  EXPECT_THAT(message_of<InputError>([&] { import_colmap(folder.path()); }),
              HasSubstr("expected a COLMAP model"));
}

// NeRF

std::vector<ImportedCamera> nerf(const std::string& text, Warnings& warnings,
                                 std::uint32_t width = 0, std::uint32_t height = 0) {
  return parse_nerf(text, "transforms.json", width, height, warnings);
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
    EXPECT_EQ(cameras[0].name, "./0001.png");
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
  EXPECT_EQ(cameras.at(0).camera.fy, 100);
  EXPECT_EQ(cameras.at(0).camera.cx, 320);
  EXPECT_EQ(cameras.at(0).camera.cy, 240);
  EXPECT_EQ(cameras.at(0).camera.pixel_centre, 0.5);
  EXPECT_EQ(cameras.at(0).name, "0");
}

TEST(ImportNerf, AnglesSpanTheImage) {
  Warnings warnings;
  // tan 45° = 1: half the width.
  const std::string frames = std::string(R"("frames": [{)") + nerf_pose + "}]}";
  const auto cameras =
      nerf(R"({"camera_angle_x": 1.5707963267948966, )" + frames, warnings, 800, 600);
  EXPECT_NEAR(cameras.at(0).camera.fx, 400, 1e-12);
  EXPECT_EQ(cameras.at(0).camera.fy, cameras.at(0).camera.fx);
  const auto both = nerf(
      R"({"camera_angle_x": 1.5707963267948966, "camera_angle_y": 0.9272952180016122, )" + frames,
      warnings, 800, 600);
  EXPECT_NEAR(both.at(0).camera.fy, 600, 1e-12);  // tan(½·atan2(4, 3)·…) = ½
  EXPECT_THAT(message_of<InputError>([&] { nerf(R"({"camera_angle_x": 1, )" + frames, warnings); }),
              HasSubstr("no image size was given"));
}

TEST(ImportNerf, WarnsOfGeometryAndRefusesDistortion) {
  Warnings warnings;
  const std::string frames =
      std::string(R"("fl_x": 100, "w": 6, "h": 4, "frames": [{)") + nerf_pose + "}]}";
  nerf(R"({"scale": 0.33, "offset": [0,0,0], "k1": 0, "camera_model": "OPENCV", )" + frames,
       warnings);
  EXPECT_THAT(warnings, testing::ElementsAre(HasSubstr("\"scale\""), HasSubstr("\"offset\"")));
  const auto fault = [&](const std::string& text) {
    return message_of<InputError>([&] { nerf(text, warnings); });
  };
  EXPECT_THAT(fault(R"({"k1": 1e-9, )" + frames), HasSubstr("k1: lens distortion"));
  EXPECT_THAT(fault(R"({"p2": -1, )" + frames), HasSubstr("p2: lens distortion"));
  EXPECT_THAT(fault(R"({"camera_model": "OPENCV_FISHEYE", )" + frames),
              HasSubstr("OPENCV_FISHEYE"));
  EXPECT_THAT(fault(R"({"is_fisheye": true, )" + frames), HasSubstr("is_fisheye"));
  EXPECT_THAT(fault("{}"), HasSubstr("\"frames\" is missing"));
  EXPECT_THAT(fault(R"({"frames": []})"), HasSubstr("no frame"));
  EXPECT_THAT(fault(std::string(R"({"w": 6, "h": 4, "frames": [{)") + nerf_pose + "}]}"),
              HasSubstr("frames[0]: the focal length is missing"));
  EXPECT_THAT(fault(R"({"fl_x": 1, "w": 6, "h": 4, "frames": [{}]})"),
              HasSubstr("\"transform_matrix\" is missing"));
  EXPECT_THAT(
      fault(
          R"({"fl_x": 1, "w": 6, "h": 4, "frames": [{"transform_matrix": [[1,2,0,0],[2,4,0,0],[0,0,1,0],[0,0,0,1]]}]})"),
      HasSubstr("frames[0].transform_matrix: the matrix is singular"));
  EXPECT_THAT(
      fault(
          R"({"fl_x": 1, "w": 6, "h": 4, "frames": [{"transform_matrix": [[1,0,0,0],[0,1,0,0],[0,0,1,0],[0,0,0,2]]}]})"),
      HasSubstr("expected the last row"));
}

TEST(ImportNerf, ReadsTheFileInTheData) {
  Warnings warnings;
  EXPECT_EQ(import_nerf(FATHOM_SOURCE_DIR "/data/cameras/transforms.json", 0, 0, warnings).size(),
            2U);
}

// BOP

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
  EXPECT_EQ(cameras[0].name, "9");
  EXPECT_EQ(cameras[1].name, "10");
  EXPECT_EQ(cameras[2].name, "100");
  EXPECT_EQ(cameras[0].camera.world_to_camera, Camera().world_to_camera);
  EXPECT_EQ(cameras[0].camera.pixel_centre, 0);
}

TEST(ImportBop, NamesFaults) {
  const auto fault = [](const std::string& text, std::uint32_t width = 6) {
    return message_of<InputError>([&] { parse_bop(text, "scene_camera.json", width, 4); });
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

TEST(ImportBop, ReadsTheFileInTheData) {
  EXPECT_EQ(import_bop(FATHOM_SOURCE_DIR "/data/cameras/scene_camera.json", 640, 480).size(), 2U);
}

// OpenGL

using Matrix4 = std::array<std::array<Real, 4>, 4>;

std::string rows_of(const Matrix4& m) {
  std::ostringstream out;
  for (int i = 0; i < 4; ++i) out << (i == 0 ? "[[" : ",[") << joined(m[i], ",") << "]";
  out << "]";
  return out.str();
}

std::string columns_of(const Matrix4& m) {
  std::array<Real, 16> list;
  for (std::size_t i = 0; i < 16; ++i) list[i] = m[i % 4][i / 4];
  std::ostringstream out;
  out << "[" << joined(list, ",") << "]";
  return out.str();
}

std::array<Real, 4> times(const Matrix4& m, const std::array<Real, 4>& v) {
  std::array<Real, 4> r{};
  for (int i = 0; i < 4; ++i)
    for (int k = 0; k < 4; ++k) r[i] += m[i][k] * v[k];
  return r;
}

/// The pipeline of the OpenGL specification up to window coordinates, with y turned down; depth is
/// the distance along −z of the eye frame.
struct Window {
  Seen seen;
  Real ndc_z = 0;
};
Window through_opengl(const Matrix4& P, const Matrix4& M, const Vector& X, int width, int height) {
  const auto eye = times(M, {X[0], X[1], X[2], 1});
  const auto clip = times(P, eye);
  const Real x = clip[0] / clip[3], y = clip[1] / clip[3];
  return {{(x + 1) * width / 2, height - (y + 1) * height / 2, -eye[2]}, clip[2] / clip[3]};
}

Matrix4 random_view(Draws& draw) {
  const std::array<Real, 4> q{draw(-1, 1), draw(-1, 1), draw(-1, 1), draw(0.25, 1)};
  Matrix4 M{};
  for (int k = 0; k < 3; ++k) {
    Vector e{};
    e[k] = 1;
    const Vector column = turned(q, e);
    for (int i = 0; i < 3; ++i) M[i][k] = static_cast<double>(column[i]);
  }
  M[0][3] = draw(-5, 5), M[1][3] = draw(-5, 5), M[2][3] = draw(-60, -40);
  M[3][3] = 1;
  return M;
}

TEST(ImportOpengl, PerspectiveProjectsAsOpenglDoes) {
  Draws draw(4);
  for (int round = 0; round < 200; ++round) {
    const Matrix4 M = random_view(draw);
    const Real n = draw(1, 2), f = draw(100, 200), k = draw(0.5, 3);
    // glFrustum with a skew, times k: clip coordinates are homogeneous.
    Matrix4 P{{{draw(1, 3) * k, draw(-0.1, 0.1) * k, draw(-0.5, 0.5) * k, 0},
               {0, draw(1, 3) * k, draw(-0.5, 0.5) * k, 0},
               {0, 0, -(f + n) / (f - n) * k, -2 * f * n / (f - n) * k},
               {0, 0, -k, 0}}};
    for (auto& row : P)
      for (Real& x : row) x = static_cast<double>(x);
    const std::string by_rows = R"({"projection": )" + rows_of(P) + R"(, "modelview": )" +
                                rows_of(M) + R"(, "viewport": [0, 0, 640, 480]})";
    const std::string by_columns = R"([{"name": "x", "projection": )" + columns_of(P) +
                                   R"(, "view": )" + columns_of(M) +
                                   R"(, "viewport": [640, 480]}])";
    const auto cameras = parse_opengl(by_rows, "gl.json");
    ASSERT_EQ(cameras.size(), 1U);
    const auto same = parse_opengl(by_columns, "gl.json");
    EXPECT_EQ(same.at(0).name, "x");
    EXPECT_EQ(same.at(0).camera.world_to_camera, cameras[0].camera.world_to_camera);
    EXPECT_EQ(same.at(0).camera.cx, cameras[0].camera.cx);
    const Camera& camera = cameras[0].camera;
    for (int i = 0; i < 5; ++i) {
      const Vector X = draw.point(8);
      expect_same(seen(camera, X), through_opengl(P, M, X, 640, 480).seen);
    }
    // The planes that OpenGL maps to −1 and 1. Entries of P are rounded by 2⁻⁵³ of themselves; far
    // divides that by 1 − f⁄n's share, at worst (f + n)/2n ≈ 100.
    EXPECT_NEAR(camera.near, static_cast<double>(n), 1e-13);
    EXPECT_NEAR(camera.far, static_cast<double>(f), 200 * 200 * 1e-15);
  }
}

TEST(ImportOpengl, OrthographicProjectsAsOpenglDoes) {
  Draws draw(5);
  for (int round = 0; round < 200; ++round) {
    const Matrix4 M = random_view(draw);
    const Real n = draw(1, 2), f = draw(100, 200);
    Matrix4 P{{{draw(0.125, 0.5), draw(-0.1, 0.1), 0, draw(-0.5, 0.5)},
               {0, draw(0.125, 0.5), 0, draw(-0.5, 0.5)},
               {0, 0, -2 / (f - n), -(f + n) / (f - n)},
               {0, 0, 0, 1}}};
    for (auto& row : P)
      for (Real& x : row) x = static_cast<double>(x);
    const auto cameras = parse_opengl(R"({"projection": )" + rows_of(P) + R"(, "modelview": )" +
                                          rows_of(M) + R"(, "viewport": [640, 480]})",
                                      "gl.json");
    const Camera& camera = cameras.at(0).camera;
    EXPECT_EQ(camera.projection, Projection::orthographic);
    for (int i = 0; i < 5; ++i) {
      const Vector X = draw.point(8);
      expect_same(seen(camera, X), through_opengl(P, M, X, 640, 480).seen);
    }
    EXPECT_NEAR(camera.near, static_cast<double>(n), 1e-12);
    EXPECT_NEAR(camera.far, static_cast<double>(f), 1e-12);
  }
}

Camera opengl(const std::string& projection, const std::string& more = "") {
  return parse_opengl(R"({"viewport": [640, 480], "projection": )" + projection + more + "}",
                      "gl.json")
      .at(0)
      .camera;
}

TEST(ImportOpengl, DepthRanges) {
  const double infinite = std::numeric_limits<double>::infinity();
  // near 1, far 3 in −1…1: a = −2, b = −3.
  Camera camera = opengl("[[1,0,0,0],[0,1,0,0],[0,0,-2,-3],[0,0,-1,0]]");
  EXPECT_EQ(camera.near, 1);
  EXPECT_EQ(camera.far, 3);
  EXPECT_EQ(camera.fx, 320);
  EXPECT_EQ(camera.fy, 240);
  EXPECT_EQ(camera.cx, 320);
  EXPECT_EQ(camera.cy, 240);
  // In 0…1: near 1, far 3: a = −1.5, b = −1.5; reversed: a = 0.5, b = 1.5.
  camera =
      opengl("[[1,0,0,0],[0,1,0,0],[0,0,-1.5,-1.5],[0,0,-1,0]]", R"(, "clip_depth": "zero-one")");
  EXPECT_EQ(camera.near, 1);
  EXPECT_EQ(camera.far, 3);
  camera =
      opengl("[[1,0,0,0],[0,1,0,0],[0,0,0.5,1.5],[0,0,-1,0]]", R"(, "clip_depth": "zero-one")");
  EXPECT_EQ(camera.near, 1);
  EXPECT_EQ(camera.far, 3);
  // Infinite, and infinite reversed.
  camera = opengl("[[1,0,0,0],[0,1,0,0],[0,0,-1,-2],[0,0,-1,0]]");
  EXPECT_EQ(camera.near, 1);
  EXPECT_EQ(camera.far, infinite);
  camera = opengl("[[1,0,0,0],[0,1,0,0],[0,0,0,2],[0,0,-1,0]]", R"(, "clip_depth": "zero-one")");
  EXPECT_EQ(camera.near, 2);
  EXPECT_EQ(camera.far, infinite);
  camera = opengl("[[1,0,0,0],[0,1,0,0],[0,0,0,0],[0,0,-1,0]]", R"(, "clip_depth": "none")");
  EXPECT_EQ(camera.near, 0);
  EXPECT_EQ(camera.far, infinite);
}

TEST(ImportOpengl, NamesFaults) {
  const auto fault = [](const std::string& text) {
    return message_of<InputError>([&] { parse_opengl(text, "gl.json"); });
  };
  const auto projection_fault = [](const std::string& projection, const std::string& more = "") {
    return message_of<InputError>([&] { opengl(projection, more); });
  };
  const std::string good = "[[1,0,0,0],[0,1,0,0],[0,0,-2,-3],[0,0,-1,0]]";
  EXPECT_THAT(fault("[]"), HasSubstr("empty"));
  EXPECT_THAT(fault("{}"), HasSubstr("\"projection\" is missing"));
  EXPECT_THAT(fault(std::string("[{\"projection\": ") + good + "}]"),
              HasSubstr("[0]: the key \"viewport\""));
  EXPECT_THAT(projection_fault(good, ", \"fov\": 3"), HasSubstr("unknown key"));
  EXPECT_THAT(projection_fault(good, ", \"view\": 3"), HasSubstr("view: expected 4 rows"));
  EXPECT_THAT(projection_fault(good, ", \"view\": " + good + ", \"modelview\": " + good),
              HasSubstr("either"));
  EXPECT_THAT(projection_fault(good, ", \"view\": " + good), HasSubstr("last row"));
  EXPECT_THAT(projection_fault(good, ", \"clip_depth\": \"x\""), HasSubstr("clip_depth: expected"));
  EXPECT_THAT(projection_fault("[1,2,3]"), HasSubstr("16 numbers"));
  EXPECT_THAT(projection_fault("[[1,0,0,0],[0,1,0,0],[0,0,-2,-3],[0,0,1,0]]"),
              HasSubstr("0 0 -1 0"));
  EXPECT_THAT(projection_fault("[[1,0,0,0],[0,1,0,0],[0,0,-2,-3],[0,0,-1,1]]"),
              HasSubstr("0 0 -1 0"));
  EXPECT_THAT(projection_fault("[[1,0,0,0],[1,1,0,0],[0,0,-2,-3],[0,0,-1,0]]"),
              HasSubstr("second row"));
  EXPECT_THAT(projection_fault("[[1,0,0,1],[0,1,0,0],[0,0,-2,-3],[0,0,-1,0]]"),
              HasSubstr("translation"));
  EXPECT_THAT(projection_fault("[[1,0,1,0],[0,1,0,0],[0,0,-1,0],[0,0,0,1]]"), HasSubstr("oblique"));
  EXPECT_THAT(projection_fault("[[1,0,0,0],[0,1,0,0],[0,0,-0.5,-3],[0,0,-1,0]]"),
              HasSubstr("near and far"));
  EXPECT_THAT(projection_fault("[[1,0,0,0],[0,1,0,0],[0,0,-1,0],[0,0,0,1]]"),
              HasSubstr("near and far"));
  EXPECT_THAT(projection_fault("[[0,0,0,0],[0,1,0,0],[0,0,-2,-3],[0,0,-1,0]]"),
              HasSubstr("fx is 0"));
}

TEST(ImportOpengl, ReadsTheFileInTheData) {
  EXPECT_EQ(import_opengl(FATHOM_SOURCE_DIR "/data/cameras/opengl.json").size(), 2U);
}

// The cameras in data/

/// The corners of data/meshes/spot.obj.
std::vector<Vector> spot() {
  std::ifstream file(FATHOM_SOURCE_DIR "/data/meshes/spot.obj");
  std::vector<Vector> corners;
  for (std::string line; std::getline(file, line);) {
    std::istringstream words(line);
    std::string kind;
    double x = 0, y = 0, z = 0;
    if (words >> kind >> x >> y >> z && kind == "v") corners.push_back({x, y, z});
  }
  return corners;
}

TEST(DataCameras, AllSeeTheWholeCow) {
  const auto corners = spot();
  ASSERT_EQ(corners.size(), 2930U);
  const std::filesystem::path folder = FATHOM_SOURCE_DIR "/data/cameras";
  std::vector<ImportedCamera> cameras;
  for (const char* name : {"look-at", "orthographic", "calibrated", "opencv", "orbit", "colmap"})
    for (const Camera& camera : read_cameras(folder / (std::string(name) + ".json")))
      cameras.push_back({name, camera});
  Warnings warnings;
  for (const auto& list :
       {import_colmap(folder / "colmap"), import_nerf(folder / "transforms.json", 0, 0, warnings),
        import_bop(folder / "scene_camera.json", 640, 480), import_opengl(folder / "opengl.json")})
    cameras.insert(cameras.end(), list.begin(), list.end());
  EXPECT_EQ(cameras.size(), 4U + 4 + 2 + 2 + 2 + 2 + 2);
  for (const auto& [name, camera] : cameras)
    for (const Vector& corner : corners) {
      const Seen at = seen(camera, corner);
      ASSERT_GT(at.depth, 1) << name;
      ASSERT_TRUE(at.u > 0 && at.u < camera.width && at.v > 0 && at.v < camera.height)
          << name << " " << at.u << " " << at.v;
    }
}

TEST(DataCameras, TheSameCameraInFourFormatsIsTheSame) {
  const std::filesystem::path folder = FATHOM_SOURCE_DIR "/data/cameras";
  Warnings warnings;
  const Camera colmap = import_colmap(folder / "colmap").at(0).camera;
  const Camera nerf = import_nerf(folder / "transforms.json", 0, 0, warnings).at(0).camera;
  const Camera bop = import_bop(folder / "scene_camera.json", 640, 480).at(0).camera;
  const Camera opengl = import_opengl(folder / "opengl.json").at(0).camera;
  for (const Vector& corner : spot()) {
    const Seen at = seen(colmap, corner);
    expect_same(seen(nerf, corner), at);
    expect_same(seen(bop, corner), at);
    expect_same(seen(opengl, corner), at);
  }
}

}  // namespace
}  // namespace fathom
