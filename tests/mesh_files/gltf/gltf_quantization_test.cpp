// KHR_mesh_quantization: positions and attributes that are integers.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstring>
#include <limits>

#include "fathom/numeric/rounding.h"
#include "tests/mesh_files/gltf/gltf_asset.h"

namespace fathom {
namespace {

using namespace checks;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

/// One triangle whose vertices' coordinates are these numbers.
template <class T>
Asset quantized(const std::vector<T>& numbers, int component, bool normalized,
                json node = json::object()) {
  Asset asset;
  asset.add(numbers, "VEC3", component, normalized);
  asset.tree["extensionsUsed"] = {"KHR_mesh_quantization"};
  asset.tree["extensionsRequired"] = {"KHR_mesh_quantization"};
  asset.tree["meshes"] = {{{"primitives", {{{"attributes", {{"POSITION", 0}}}}}}}};
  node["mesh"] = 0;
  asset.tree["nodes"] = json::array({node});
  asset.tree["scenes"] = {{{"nodes", {0}}}};
  return asset;
}

template <class T>
std::vector<T> hard_numbers() {
  using Limits = std::numeric_limits<T>;
  return {Limits::min(),     Limits::max(),     static_cast<T>(Limits::min() + 1),
          static_cast<T>(1), static_cast<T>(3), static_cast<T>(100),
          static_cast<T>(7), static_cast<T>(5), 0};
}

template <class T>
void expect_integers_to_be_read(int component) {
  const std::vector<T> stored = hard_numbers<T>();
  const Read exact = read(quantized(stored, component, false).done());
  const Read fractions = read(quantized(stored, component, true).done());
  EXPECT_THAT(exact.warnings, IsEmpty());
  for (std::size_t i = 0; i < 3; ++i) {
    const MeshPoint& p = exact.scene.meshes[0].vertices[i];
    const MeshPoint& q = fractions.scene.meshes[0].vertices[i];
    const double number[] = {p.x, p.y, p.z}, fraction[] = {q.x, q.y, q.z};
    for (std::size_t k = 0; k < 3; ++k) {
      const double c = stored[3 * i + k], most = std::numeric_limits<T>::max();
      EXPECT_EQ(number[k], c);
      // The nearest binary64 number to the exact quotient.
      EXPECT_EQ(fraction[k], c < -most ? -1 : round_to_binary64(Ratio(c, most))) << c;
    }
  }
}

TEST(GltfQuantization, PositionsMayBeBytesAndShorts) {
  expect_integers_to_be_read<std::int8_t>(5120);
  expect_integers_to_be_read<std::uint8_t>(5121);
  expect_integers_to_be_read<std::int16_t>(5122);
  expect_integers_to_be_read<std::uint16_t>(5123);
}

TEST(GltfQuantization, TheLeastIntegersBothMeanMinusOne) {
  const Read read_one =
      read(quantized<std::int8_t>({-128, -127, 127, 0, 0, 0, 0, 0, 0}, 5120, true).done());
  EXPECT_EQ(read_one.scene.meshes[0].vertices[0], (MeshPoint{-1, -1, 1}));
}

TEST(GltfQuantization, ElementsArePaddedToFourBytes) {
  Asset asset = quantized<std::int16_t>({1, 2, 3, 99, 4, 5, 6, 99, 7, 8, 9, 99}, 5122, false);
  asset.tree["accessors"][0]["count"] = 3;
  asset.tree["bufferViews"][0]["byteStride"] = 8;
  EXPECT_EQ(read(asset.done()).scene.meshes[0].vertices,
            (std::vector<MeshPoint>{{1, 2, 3}, {4, 5, 6}, {7, 8, 9}}));
}

TEST(GltfQuantization, NodesPlaceIntegersExactly) {
  const Read one =
      read(quantized<std::uint16_t>({65535, 3, 1, 0, 0, 0, 1, 1, 1}, 5123, false,
                                    {{"scale", {0.1, 0.2, 0.3}}, {"translation", {0.7, 0, 0}}})
               .done());
  const WorldPoint p = to_world(one.scene.objects[0], one.scene.meshes[0].vertices[0]);
  EXPECT_EQ(p.x, Dyadic(65535.0) * Dyadic(0.1) + Dyadic(0.7));
  EXPECT_EQ(p.y, Dyadic(3.0) * Dyadic(0.2));
  EXPECT_EQ(p.z, Dyadic(0.3));
}

TEST(GltfQuantization, IsReadWithAWarningWhereItIsNotDeclared) {
  Asset asset = quantized<std::int8_t>({1, 2, 3, 4, 5, 6, 7, 8, 9}, 5120, false);
  asset.tree.erase("extensionsUsed");
  asset.tree.erase("extensionsRequired");
  const Read undeclared = read(asset.done());
  EXPECT_EQ(undeclared.scene.meshes[0].vertices[2], (MeshPoint{7, 8, 9}));
  EXPECT_THAT(undeclared.warnings, ElementsAre(HasSubstr("KHR_mesh_quantization")));
  // Floats need no declaration.
  EXPECT_THAT(read(five({{"mode", 5}}).done()).warnings, IsEmpty());
}

TEST(GltfQuantization, OtherTypesOfPositionsAreRefused) {
  EXPECT_THAT(fault_of(quantized<std::uint32_t>({1, 2, 3, 4, 5, 6, 7, 8, 9}, 5125, false).done()),
              HasSubstr("accessors[0]: expected positions to be VEC3 of floats, bytes or shorts"));
  Asset pairs = quantized<std::int8_t>({1, 2, 3, 4, 5, 6}, 5120, false);
  pairs.tree["accessors"][0]["type"] = "VEC2";
  EXPECT_THAT(fault_of(pairs.done()), HasSubstr("VEC3"));
}

TEST(GltfQuantization, SparseIntegersReplaceIntegers) {
  Asset asset = quantized<std::int8_t>({1, 2, 3, 4, 5, 6, 7, 8, 9}, 5120, true);
  asset.add<std::uint8_t>({1}, "SCALAR", 5121);
  asset.add<std::int8_t>({127, -127, 0}, "VEC3", 5120);
  asset.tree["accessors"][0]["sparse"] = {{"count", 1},
                                          {"indices", {{"bufferView", 1}, {"componentType", 5121}}},
                                          {"values", {{"bufferView", 2}}}};
  const Mesh mesh = read(asset.done()).scene.meshes[0];
  EXPECT_EQ(mesh.vertices[1], (MeshPoint{1, -1, 0}));
  EXPECT_EQ(mesh.vertices[2].x, 7.0 / 127);
}

TEST(GltfQuantization, NormalsAndTextureCoordinatesMayBeIntegers) {
  const auto with = [](const char* name, auto numbers, const char* type, int component,
                       bool normalized) {
    Asset asset = five({{"mode", 6}});
    asset.tree["extensionsUsed"] = {"KHR_mesh_quantization"};
    asset.tree["meshes"][0]["primitives"][0]["attributes"][name] =
        asset.add(numbers, type, component, normalized);
    return asset.done();
  };
  using Bytes = std::vector<std::int8_t>;
  using Shorts = std::vector<std::int16_t>;
  using Words = std::vector<std::uint16_t>;
  const Bytes normals{0, 0, 127, -127, 0, 0, -128, 0, 0, 1, 0, 0, 0, 1, 0};
  Mesh mesh = read(with("NORMAL", normals, "VEC3", 5120, true)).scene.meshes[0];
  EXPECT_EQ(mesh.normals[0], (std::array<double, 3>{0, 0, 1}));
  EXPECT_EQ(mesh.normals[2], (std::array<double, 3>{-1, 0, 0}));
  EXPECT_EQ(mesh.normals[3], (std::array<double, 3>{1.0 / 127, 0, 0}));
  EXPECT_TRUE(read(with("NORMAL", normals, "VEC3", 5120, false)).scene.meshes[0].normals.empty());
  // Texture coordinates also as the integers that they are, for KHR_texture_transform to scale.
  const Words uv{65535, 0, 1, 2, 3, 4, 5, 6, 7, 8};
  mesh = read(with("TEXCOORD_0", uv, "VEC2", 5123, false)).scene.meshes[0];
  EXPECT_EQ(mesh.texture_coordinates[0], (std::array<double, 2>{65535, 0}));
  mesh = read(with("TEXCOORD_0", uv, "VEC2", 5123, true)).scene.meshes[0];
  EXPECT_EQ(mesh.texture_coordinates[1], (std::array<double, 2>{1.0 / 65535, 2.0 / 65535}));
  const Shorts negative{-32768, 32767, 0, 0, 0, 0, 0, 0, 0, 0};
  mesh = read(with("TEXCOORD_0", negative, "VEC2", 5122, true)).scene.meshes[0];
  EXPECT_EQ(mesh.texture_coordinates[0], (std::array<double, 2>{-1, 1}));
}

}  // namespace
}  // namespace fathom
