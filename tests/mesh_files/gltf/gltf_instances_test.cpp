// EXT_mesh_gpu_instancing: one node shows its mesh in many places.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "tests/mesh_files/gltf/gltf_asset.h"

namespace fathom {
namespace {

using namespace checks;
using ::testing::ElementsAre;
using ::testing::HasSubstr;

/// A node that shows a triangle; its instances' attributes are accessors that a test adds.
struct Instanced {
  Asset asset = five({});
  json attributes = json::object();

  void add(const char* name, const std::vector<float>& numbers, const char* type = "VEC3") {
    attributes[name] = asset.add(numbers, type, 5126);
  }
  [[nodiscard]] json done(const json& node = json::object()) {
    json& shown = asset.tree["nodes"][0];
    shown.update(node);
    shown["extensions"]["EXT_mesh_gpu_instancing"]["attributes"] = attributes;
    asset.tree["extensionsUsed"] = {"EXT_mesh_gpu_instancing"};
    asset.tree["extensionsRequired"] = {"EXT_mesh_gpu_instancing"};
    return asset.done();
  }
};

TEST(GltfInstances, EachIsAnObjectOfTheSameMesh) {
  Instanced trees;
  trees.add("TRANSLATION", {0, 0, 0, 1, 2, 3, -4, 0, 0});
  const Scene scene = read(trees.done({{"name", "tree"}})).scene;
  std::vector<std::string> names;
  std::vector<std::uint64_t> faces;
  for (const Object& object : scene.objects) {
    names.push_back(object.name);
    faces.push_back(object.first_face);
    EXPECT_EQ(object.mesh, 0U);
  }
  EXPECT_THAT(names, ElementsAre("tree[0]", "tree[1]", "tree[2]"));
  EXPECT_THAT(faces, ElementsAre(0U, 1U, 2U));
  EXPECT_EQ(scene.meshes.size(), 1U);
  EXPECT_TRUE(scene.objects[0].placed_as_is);
  EXPECT_FALSE(scene.objects[1].placed_as_is);
  EXPECT_EQ(scene.objects[1].world_from_mesh.rows[2][3], Dyadic(3.0));
}

TEST(GltfInstances, ArePlacedExactlyWithinTheirNode) {
  Instanced one;
  one.add("TRANSLATION", {0.1F, 0, 0});
  one.add("ROTATION", {0, 0.1F, 0, 1}, "VEC4");
  one.add("SCALE", {2, 3, 0.3F});
  const Scene scene = read(one.done({{"scale", {0.1, 1, 1}}, {"translation", {0.7, 0, 0}}})).scene;
  const auto& rows = scene.objects.at(0).world_from_mesh.rows;
  const Dyadic tenth = 0.1, tenth_float = static_cast<double>(0.1F), two = 2.0;
  const Dyadic cosine = Dyadic(1.0) - two * tenth_float * tenth_float;
  EXPECT_EQ(rows[0][0], tenth * (cosine * two));
  EXPECT_EQ(rows[0][3], tenth * tenth_float + Dyadic(0.7));
  EXPECT_EQ(rows[1][1], Dyadic(3.0));
  EXPECT_EQ(rows[2][0], -(two * tenth_float) * two);
  EXPECT_EQ(rows[2][2], cosine * Dyadic(static_cast<double>(0.3F)));
}

TEST(GltfInstances, RotationsMayBeBytesAndShorts) {
  Instanced bytes;
  bytes.attributes["ROTATION"] =
      bytes.asset.add<std::int8_t>({0, 0, 0, 127, 0, 0, -128, 0, 1, 0, 0, 127}, "VEC4", 5120, true);
  Scene scene = read(bytes.done()).scene;
  ASSERT_EQ(scene.objects.size(), 3U);
  EXPECT_TRUE(scene.objects[0].placed_as_is);
  EXPECT_EQ(scene.objects[1].world_from_mesh.rows[0][0], Dyadic(-1.0));
  // 1/127 is rounded once, and the matrix is exact in it.
  EXPECT_EQ(scene.objects[2].world_from_mesh.rows[2][1], Dyadic(2.0) * Dyadic(1.0 / 127));
  Instanced shorts;
  shorts.attributes["ROTATION"] =
      shorts.asset.add<std::int16_t>({0, 32767, 0, 0}, "VEC4", 5122, true);
  scene = read(shorts.done()).scene;
  EXPECT_EQ(scene.objects.at(0).world_from_mesh.rows[2][2], Dyadic(-1.0));
}

TEST(GltfInstances, OfTwoNodesMayShareTheirAttributes) {
  Instanced two;
  two.add("TRANSLATION", {0, 0, 0, 1, 2, 3});
  json tree = two.done();
  tree["nodes"].push_back(tree["nodes"][0]);
  tree["nodes"][1]["scale"] = {2, 2, 2};
  tree["scenes"][0]["nodes"] = {0, 1};
  const Scene scene = read(tree).scene;
  ASSERT_EQ(scene.objects.size(), 4U);
  EXPECT_EQ(scene.objects[3].world_from_mesh.rows[0][3], Dyadic(2.0));
  EXPECT_EQ(scene.objects[3].name, "node 1[1]");
}

TEST(GltfInstances, ThatMakeNoSenseAreRefused) {
  Instanced uneven;
  uneven.add("TRANSLATION", {0, 0, 0, 1, 2, 3});
  uneven.add("SCALE", {1, 1, 1});
  EXPECT_THAT(fault_of(uneven.done()),
              HasSubstr("EXT_mesh_gpu_instancing.attributes.SCALE: has 1 element, expected 2"));
  Instanced none;
  EXPECT_THAT(fault_of(none.done()), HasSubstr("expected TRANSLATION, ROTATION or SCALE"));
  Instanced pairs;
  pairs.add("SCALE", {1, 1}, "VEC2");
  EXPECT_THAT(fault_of(pairs.done()), HasSubstr("VEC3 of floats"));
  Instanced raw;
  raw.attributes["ROTATION"] = raw.asset.add<std::int8_t>({0, 0, 0, 1}, "VEC4", 5120, false);
  EXPECT_THAT(fault_of(raw.done()), HasSubstr("normalized bytes or shorts"));
  Instanced bytes;
  bytes.attributes["TRANSLATION"] = bytes.asset.add<std::int8_t>({0, 0, 0}, "VEC3", 5120, true);
  EXPECT_THAT(fault_of(bytes.done()), HasSubstr("VEC3 of floats"));
  for (const float bad :
       {std::numeric_limits<float>::infinity(), std::numeric_limits<float>::quiet_NaN()}) {
    Instanced wild;
    wild.add("TRANSLATION", {0, 0, 0, 1, 2, bad});
    EXPECT_THAT(fault_of(wild.done()), HasSubstr("accessors[1]: element 1 is not finite"));
  }
}

TEST(GltfInstances, OfANodeWithoutMeshAreNone) {
  Instanced empty;
  empty.add("TRANSLATION", {0, 0, 0});
  json tree = empty.done();
  tree["nodes"][0].erase("mesh");
  EXPECT_TRUE(read(tree).scene.objects.empty());
}

}  // namespace
}  // namespace fathom
