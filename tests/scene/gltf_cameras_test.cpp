// A camera and a mesh on one node of a glTF lie where the node lies, both.
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <random>
#include <string>

#include "fathom/camera/camera_import.h"
#include "fathom/numeric/rounding.h"
#include "tests/mesh_files/gltf/gltf_asset.h"

namespace fathom {
namespace {

using checks::json;

/// Nodes of which each is the child of the one before; the last has a mesh and a camera.
checks::Asset chain(const std::vector<json>& nodes) {
  checks::Asset asset;
  asset.positions({0, 0, -3, 1, 0, -3, 0, 1, -2});
  asset.tree["meshes"] = {{{"primitives", {{{"attributes", {{"POSITION", 0}}}}}}}};
  asset.tree["cameras"] = {{{"type", "perspective"}, {"perspective", {{"yfov", 1}, {"znear", 1}}}}};
  asset.tree["nodes"] = nodes;
  for (std::size_t i = 1; i < nodes.size(); ++i) asset.tree["nodes"][i - 1]["children"] = {i};
  asset.tree["nodes"].back()["mesh"] = 0;
  asset.tree["nodes"].back()["camera"] = 0;
  asset.tree["scenes"] = {{{"nodes", {0}}}};
  return asset;
}

/// Where the camera has the vertices of the mesh beside it, x right, y up, z backward, and the
/// lengths of the node's axes, which are the scale that cameras ignore.
struct Beside {
  std::vector<std::array<double, 3>> points;
  std::array<double, 3> lengths;
  double largest = 0;
};

Beside beside(const checks::Asset& asset) {
  const ScratchFolder folder;
  const std::string text = asset.done().dump();
  const Scene scene = checks::read_bytes(text).scene;
  const Camera camera = import_gltf(folder.write("a.gltf", text), 640, 480).at(0).camera;
  const auto& M = scene.objects.at(0).world_from_mesh;
  Beside result;
  for (std::size_t k = 0; k < 3; ++k) {
    Dyadic squared;
    for (const auto& row : M.rows) squared += row[k] * row[k];
    result.lengths[k] = round_sqrt_to_binary64(Ratio(squared));
  }
  for (const MeshPoint& p : scene.meshes.at(0).vertices) {
    const WorldPoint X = M(p);
    const CameraPoint c = to_camera(camera.world_to_camera, X);
    const auto rounded = [](const Dyadic& x) { return round_to_binary64(Ratio(x)); };
    result.points.push_back({rounded(c.x), -rounded(c.y), -rounded(c.z)});
    for (const Dyadic& x : {X.x, X.y, X.z})
      result.largest = std::max(result.largest, std::abs(rounded(x)));
  }
  return result;
}

/// The camera's numbers are rounded once: entries of at most `entry` times world coordinates.
void expect_same_place(const checks::Asset& asset, double entry = 2) {
  const Beside found = beside(asset);
  const std::array<std::array<double, 3>, 3> own{{{0, 0, -3}, {1, 0, -3}, {0, 1, -2}}};
  for (std::size_t i = 0; i < 3; ++i)
    for (std::size_t k = 0; k < 3; ++k)
      ASSERT_NEAR(found.points[i][k], own[i][k] * found.lengths[k],
                  8 * entry * 0x1p-53 * (1 + found.largest))
          << i << ", " << k;
}

TEST(GltfCameras, LieWhereTheMeshesOfTheirNodesLie) {
  // Six decimals, as exporters write them: of length 1 + 1.1e-7.
  expect_same_place(chain(
      {{{"rotation", {0.500228, 0.100046, 0.183083, 0.840383}}, {"translation", {1, 2, 3}}}}));
  std::mt19937 random(11);
  std::uniform_real_distribution<double> any(-1, 1), far(-20, 20);
  for (int i = 0; i < 200; ++i) {
    std::vector<json> nodes;
    for (int depth = 0; depth < 3; ++depth) {
      std::array<double, 4> q{any(random), any(random), any(random), any(random)};
      const double length = std::sqrt(q[0] * q[0] + q[1] * q[1] + q[2] * q[2] + q[3] * q[3]);
      for (double& x : q) x = static_cast<float>(x / length);
      nodes.push_back({{"rotation", q}, {"translation", {far(random), far(random), far(random)}}});
    }
    if (i % 2 == 0) nodes.back()["scale"] = {2, 0.5, 3};
    expect_same_place(chain(nodes));
  }
}

TEST(GltfCameras, AndSoFarFromLengthOne) {
  // The polynomial matrix of this quaternion scales and shears: its rows are (1, 0, 0), (0, −1,
  // −1), (0, 1, −1).
  const checks::Asset asset = chain({{{"rotation", {1, 0, 0, 0.5}}, {"translation", {4, -5, 6}}}});
  EXPECT_EQ(beside(asset).lengths[1], std::sqrt(2.0));
  expect_same_place(asset);
  // A sheared child of a scaled parent.
  expect_same_place(chain({{{"scale", {1, 2, 4}}},
                           {{"rotation", {0.6, 0, 0, 0.8}}, {"translation", {0.5, 0.25, 8}}}}),
                    8);
}

}  // namespace
}  // namespace fathom
