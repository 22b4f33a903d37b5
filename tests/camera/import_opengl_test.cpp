// Projection and view matrices of OpenGL project as its pipeline does.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <array>
#include <limits>
#include <sstream>
#include <string>
#include <utility>

#include "fathom/camera/camera_files.h"
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
    EXPECT_EQ(same.at(0).camera.name, "x");
    EXPECT_EQ(same.at(0).camera.world_to_camera, cameras[0].camera.world_to_camera);
    EXPECT_EQ(same.at(0).camera.projection.cx, cameras[0].camera.projection.cx);
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
    EXPECT_EQ(camera.projection.model, ProjectionModel::orthographic);
    for (int i = 0; i < 5; ++i) {
      const Vector X = draw.point(8);
      expect_same(seen(camera, X), through_opengl(P, M, X, 640, 480).seen);
    }
    EXPECT_NEAR(camera.near, static_cast<double>(n), 1e-12);
    EXPECT_NEAR(camera.far, static_cast<double>(f), 1e-12);
  }
}

Camera opengl(const std::string& projection, const std::string& more = "") {
  return judged(parse_opengl(R"({"viewport": [640, 480], "projection": )" + projection + more + "}",
                             "gl.json"))
      .at(0)
      .camera;
}

TEST(ImportOpengl, DepthRanges) {
  const double infinite = std::numeric_limits<double>::infinity();
  // near 1, far 3 in −1…1: a = −2, b = −3.
  Camera camera = opengl("[[1,0,0,0],[0,1,0,0],[0,0,-2,-3],[0,0,-1,0]]");
  EXPECT_EQ(camera.near, 1);
  EXPECT_EQ(camera.far, 3);
  EXPECT_EQ(camera.projection.fx, 320);
  EXPECT_EQ(camera.projection.fy, 240);
  EXPECT_EQ(camera.projection.cx, 320);
  EXPECT_EQ(camera.projection.cy, 240);
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
    return message_of<InputError>([&] { judged(parse_opengl(text, "gl.json")); });
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

/// Numbers at hand say what a file of them says, fault for fault.
TEST(ImportOpengl, MatricesAtHandAreThoseOfAFile) {
  using Numbers = std::array<double, 16>;
  constexpr Numbers P{1.5, 0.25, 0.125, 0, 0, 2, -0.5, 0, 0, 0, -1.5, -0.1, 0, 0, -1, 0};
  constexpr Numbers M{0.6, 0, 0.8, 1, 0, 1, 0, 0.1, -0.8, 0, 0.6, -3, 0, 0, 0, 1};
  const auto with = [](Numbers numbers, std::size_t place, double number) {
    numbers.at(place) = number;
    return numbers;
  };
  const auto rows = [](const Numbers& numbers) {
    std::ostringstream out;
    out.precision(17);
    for (std::size_t i = 0; i < 16; ++i)
      out << (i == 0 ? "[[" : i % 4 == 0 ? "],[" : ",") << numbers.at(i);
    return out.str() + "]]";
  };
  const auto of_file = [&](const Numbers& projection, const Numbers& modelview) {
    Camera camera = judged(parse_opengl("{\"projection\":" + rows(projection) + ",\"modelview\":" +
                                            rows(modelview) + ",\"viewport\":[640,480]}",
                                        "camera"))
                        .at(0)
                        .camera;
    camera.name.clear();
    return camera;
  };
  EXPECT_EQ(to_json(camera_from_opengl(P, M, 640, 480)), to_json(of_file(P, M)));
  const std::pair<Numbers, Numbers> faulty[] = {{with(P, 12, 1), M}, {with(P, 4, 1), M},
                                                {with(P, 3, 1), M},  {with(P, 10, -0.5), M},
                                                {with(P, 0, 0), M},  {P, with(M, 15, 2)}};
  for (const auto& [projection, modelview] : faulty) {
    const auto expected =
        message_of<InputError>([&, &p = projection, &m = modelview] { (void)of_file(p, m); });
    EXPECT_EQ(message_of<InputError>([&, &p = projection, &m = modelview] {
                (void)camera_from_opengl(p, m, 640, 480);
              }),
              expected);
  }
  constexpr double nan = std::numeric_limits<double>::quiet_NaN();
  EXPECT_EQ(message_of<InputError>([&] { (void)camera_from_opengl(with(P, 9, nan), M, 4, 4); }),
            "camera: projection: has a number that is not finite");
  EXPECT_EQ(message_of<InputError>([&] {
              (void)camera_from_opengl(P, with(M, 3, std::numeric_limits<double>::infinity()), 4,
                                       4);
            }),
            "camera: modelview: has a number that is not finite");
  EXPECT_EQ(message_of<InputError>([&] { (void)camera_from_opengl(P, M, 0, 4); }),
            "camera: width is 0, expected at least 1");
}

TEST(ImportOpengl, ReadsTheFileInTheData) {
  EXPECT_EQ(import_opengl(source_dir() / "data/cameras/opengl.json").size(), 2U);
}

}  // namespace
}  // namespace fathom
