// glTF's cameras project as its specification does (3.10): by the projection matrix of its lens,
// and the node's global transform without its scale.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <cstdint>
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
using ::testing::HasSubstr;

std::vector<ImportedCamera> gltf(const std::string& text) {
  return judged(parse_gltf_cameras(text, "a.gltf", 640, 480));
}

const std::string lens =
    R"("cameras": [{"type": "perspective", "perspective": {"yfov": 0.75, "znear": 0.5}}])";

/// A quaternion at length 1, up to its rounding.
std::array<double, 4> unit(const std::array<double, 4>& q) {
  const double length = std::sqrt(q[0] * q[0] + q[1] * q[1] + q[2] * q[2] + q[3] * q[3]);
  return {q[0] / length, q[1] / length, q[2] / length, q[3] / length};
}

/// Where NDC lie in an image of 640×480, y down.
Seen in_image(Real x_ndc, Real y_ndc, Real depth) {
  return {320 * (1 + x_ndc), 240 * (1 - y_ndc), depth};
}

TEST(ImportGltf, PerspectiveProjectsAsGltfDoes) {
  Draws draw(7);
  for (int round = 0; round < 100; ++round) {
    // A parent that turns and moves, and a scaled camera below it.
    const std::array<double, 4> q = unit({draw(-1, 1), draw(-1, 1), draw(-1, 1), draw(0.25, 1)}),
                                own_q =
                                    unit({draw(-1, 1), draw(-1, 1), draw(0.25, 1), draw(-1, 1)});
    const std::array<double, 3> t{draw(-5, 5), draw(-5, 5), draw(-5, 5)},
        own_t{draw(-5, 5), draw(-5, 5), draw(-5, 5)};
    const auto cameras =
        gltf("{" + lens + R"(, "nodes": [{"children": [1], "rotation": [)" + joined(q, ",") +
             R"(], "translation": [)" + joined(t, ",") +
             R"(]}, {"name": "eye", "camera": 0, "scale": [2, 3, 4],
                              "rotation": [)" +
             joined(own_q, ",") + R"(], "translation": [)" + joined(own_t, ",") + "]}]}");
    ASSERT_EQ(cameras.size(), 1U);
    EXPECT_EQ(cameras[0].camera.name, "eye");
    EXPECT_EQ(cameras[0].camera.near, 0.5);
    EXPECT_EQ(cameras[0].camera.far, std::numeric_limits<double>::infinity());
    for (int i = 0; i < 5; ++i) {
      const Vector own{draw(-5, 5), draw(-5, 5), draw(-30, -10)};
      Vector X = turned({own_q[3], own_q[0], own_q[1], own_q[2]}, own);
      for (std::size_t k = 0; k < 3; ++k) X[k] += own_t[k];
      X = turned({q[3], q[0], q[1], q[2]}, X);
      for (std::size_t k = 0; k < 3; ++k) X[k] = static_cast<double>(X[k] + t[k]);
      const Real f = 1 / std::tan(0.375L), aspect = 4.0L / 3, depth = -own[2];
      expect_same(seen(cameras[0].camera, X),
                  in_image(f / aspect * own[0] / depth, f * own[1] / depth, depth));
    }
  }
}

TEST(ImportGltf, OrthographicProjectsAsGltfDoes) {
  const auto cameras = gltf(R"({"cameras": [{"name": "top", "type": "orthographic",
      "orthographic": {"xmag": 4, "ymag": 3, "znear": 0, "zfar": 100}}],
      "nodes": [{"camera": 0, "matrix": [1,0,0,0, 0,0,-1,0, 0,1,0,0, 1,20,3,1]}]})");
  ASSERT_EQ(cameras.size(), 1U);
  EXPECT_EQ(cameras[0].camera.name, "top");
  EXPECT_EQ(cameras[0].camera.projection.model, ProjectionModel::orthographic);
  EXPECT_EQ(cameras[0].camera.far, 100);
  // Right is x, up is −z, back is y; the eye is at (1, 20, 3).
  const Camera& camera = cameras[0].camera;
  const CameraPoint p = to_camera(camera.world_to_camera, {2.0, 5.0, 1.0});
  const auto [U, V, W] = to_image(camera.projection, p);
  EXPECT_EQ(round_to_binary64(Ratio(U, W)), 400);  // 320·(1 + (2 − 1)/4)
  EXPECT_EQ(round_to_binary64(Ratio(V, W)), 80);   // 240·(1 − (3 − 1)/3)
  EXPECT_EQ(round_to_binary64(Ratio(p.z)), 20 - 5);
}

std::string glb(const std::string& json) {
  const auto word = [](std::uint32_t number) {
    std::string bytes;
    for (int k = 0; k < 4; ++k) bytes += static_cast<char>(number >> 8 * k & 0xFF);
    return bytes;
  };
  const auto size = static_cast<std::uint32_t>(json.size());
  return "glTF" + word(2) + word(size + 20) + word(size) + "JSON" + json;
}

TEST(ImportGltf, ReadsGlbAtEveryLength) {
  const std::string json = "{" + lens + R"(, "nodes": [{"camera": 0}]})", whole = glb(json);
  EXPECT_EQ(gltf(whole).at(0).camera.name, "node 0");
  for (std::size_t n = 4; n < whole.size(); ++n)
    EXPECT_THAT(message_of<InputError>([&] { gltf(whole.substr(0, n)); }),
                HasSubstr("a.gltf: not a GLB file"));
}

TEST(ImportGltf, NamesPlaceAndFault) {
  const auto fault = [](const std::string& text) {
    return message_of<InputError>([&] { gltf("{" + text + "}"); });
  };
  EXPECT_THAT(fault(lens), HasSubstr("no node has a camera"));
  EXPECT_THAT(fault(R"("nodes": [{"camera": 0}])"), HasSubstr("the file has no cameras"));
  EXPECT_THAT(fault(lens + R"(, "nodes": [{"camera": 1}])"), HasSubstr("nodes[0].camera"));
  EXPECT_THAT(fault(lens + R"(, "nodes": [{"camera": 0, "rotation": [0,0,0,1],
      "matrix": [1,0,0,0, 0,1,0,0, 0,0,1,0, 0,0,0,1]}])"),
              HasSubstr("nodes[0].rotation: appears together with a matrix"));
  EXPECT_THAT(fault(lens + R"(, "nodes": [{"camera": 0, "scale": [1,0,1]}])"),
              HasSubstr("nodes[0]: its transform is singular"));
  EXPECT_THAT(fault(lens + R"(, "nodes": [{"camera": 0, "children": [0]}])"),
              HasSubstr("has more than 64 nodes above it"));
  EXPECT_THAT(fault(lens + R"(, "nodes": [{"children": [1, 1]}, {"camera": 0}])"),
              HasSubstr("the node is a child of two nodes"));
  EXPECT_THAT(
      fault(lens + R"(, "nodes": [{"name": "a", "camera": 0}, {"name": "a", "camera": 0}])"),
      HasSubstr("two images have the name 'a'"));
  const auto of_lens = [&](const std::string& text) {
    return fault(R"("cameras": [)" + text + R"(], "nodes": [{"camera": 0}])");
  };
  EXPECT_THAT(of_lens(R"({"type": "fisheye"})"), HasSubstr("cameras[0].type: expected \"persp"));
  EXPECT_THAT(of_lens(R"({"type": "perspective", "perspective": {"yfov": 4, "znear": 1}})"),
              HasSubstr("cameras[0].perspective.yfov: expected an angle"));
  EXPECT_THAT(of_lens(R"({"type": "perspective", "perspective": {"yfov": 1, "znear": 1,
      "aspectRatio": 1.5}})"),
              HasSubstr("aspectRatio: the aspect ratio 1.5"));
  EXPECT_THAT(of_lens(R"({"type": "perspective", "perspective": {"yfov": 1, "znear": 1,
      "zfar": 1}})"),
              HasSubstr("far is not greater than near"));
}

}  // namespace
}  // namespace fathom
