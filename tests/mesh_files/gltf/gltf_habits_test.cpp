// What exporters write that the specification of glTF does not quite allow, or allows and few do.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstring>
#include <limits>

#include "tests/mesh_files/gltf/gltf_asset.h"

namespace fathom {
namespace {

using namespace checks;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::Not;

Read read_requiring(const char* extension, bool attributes) {
  Asset asset = five({{"mode", 5}});
  asset.tree["extensionsUsed"] = {extension};
  asset.tree["extensionsRequired"] = {extension};
  return read_bytes(asset.done().dump(), "test.gltf", attributes);
}

TEST(GltfHabits, ExtensionsThatLeaveTheGeometryAloneMayBeRequired) {
  for (const char* extension :
       {"KHR_materials_unlit", "KHR_materials_variants", "KHR_materials_pbrSpecularGlossiness",
        "KHR_lights_punctual", "KHR_xmp_json_ld", "KHR_animation_pointer", "EXT_mesh_features",
        "EXT_structural_metadata", "KHR_mesh_quantization", "EXT_mesh_gpu_instancing"}) {
    const Read one = read_requiring(extension, true);
    EXPECT_EQ(one.scene.meshes[0].triangles.size(), 3U) << extension;
    EXPECT_THAT(one.warnings, IsEmpty()) << extension;
  }
}

TEST(GltfHabits, ExtensionsOfTexturesMayBeRequiredAndAreNotRead) {
  for (const char* extension : {"KHR_texture_basisu", "KHR_texture_transform", "EXT_texture_webp",
                                "EXT_texture_avif", "MSFT_texture_dds"}) {
    EXPECT_THAT(read_requiring(extension, false).warnings, IsEmpty()) << extension;
    EXPECT_THAT(read_requiring(extension, true).warnings,
                ElementsAre(HasSubstr(std::string(extension) + " is about textures")));
  }
}

TEST(GltfHabits, OtherExtensionsMayNotBeRequired) {
  for (const char* extension : {"CESIUM_RTC", "KHR_node_visibility", "KHR_techniques_webgl",
                                "KHR_accessor_float64", "ACME_mesh", "KHR_material", ""})
    EXPECT_THAT(message_of<InputError>([&] { read_requiring(extension, false); }),
                HasSubstr("extensionsRequired[0]: the required extension " +
                          std::string(extension) + " is not supported"));
  EXPECT_THAT(message_of<InputError>([] { read_requiring("two\nlines", false); }),
              HasSubstr("two?lines"));
}

TEST(GltfHabits, ExtensionsThatAreOnlyUsedAreIgnored) {
  Asset asset = five({{"mode", 5}});
  asset.tree["extensionsUsed"] = {"ACME_mesh", "CESIUM_RTC"};
  EXPECT_THAT(read(asset.done()).warnings, IsEmpty());
}

TEST(GltfHabits, AccessorsMayBeEmpty) {
  Asset asset = five({{"mode", 5}});
  asset.tree["accessors"].push_back({{"componentType", 5126}, {"type", "VEC3"}, {"count", 0}});
  asset.tree["accessors"].push_back(
      {{"componentType", 5123}, {"type", "SCALAR"}, {"count", 0}, {"bufferView", 1}});
  asset.tree["bufferViews"].push_back({{"buffer", 0}, {"byteLength", 0}});
  json& primitives = asset.tree["meshes"][0]["primitives"];
  primitives.push_back({{"attributes", {{"POSITION", 1}}}});
  primitives.push_back({{"attributes", {{"POSITION", 0}}}, {"indices", 2}});
  primitives.push_back({{"attributes", {{"POSITION", 1}}}, {"indices", 2}, {"mode", 6}});
  const Scene scene = read(asset.done()).scene;
  EXPECT_EQ(scene.meshes[0].triangles.size(), 3U);
  EXPECT_EQ(scene.meshes[0].vertices.size(), 5U);
  // No vertex is no vertex for an index to name.
  primitives = {{{"attributes", {{"POSITION", 1}}}, {"indices", 3}}};
  asset.add<std::uint8_t>({0, 0, 0}, "SCALAR", 5121);
  EXPECT_THAT(fault_of(asset.done()), HasSubstr("out of range"));
}

TEST(GltfHabits, BoundsOfAccessorsAreNotTrusted) {
  Asset asset = five({{"mode", 5}});
  asset.tree["accessors"][0]["min"] = {100, 100, 100};
  asset.tree["accessors"][0]["max"] = {-1e300, 0};
  EXPECT_EQ(read(asset.done()).scene.meshes[0].vertices[4], (MeshPoint{4, 16, 0}));
}

TEST(GltfHabits, AttributesThatCannotBeUsedAreLeftOut) {
  const auto with = [](const char* name, std::vector<float> numbers, const char* type) {
    Asset asset = five({{"mode", 5}});
    json& primitives = asset.tree["meshes"][0]["primitives"];
    primitives[0]["attributes"][name] = asset.add(numbers, type, 5126);
    // Another primitive, of which the same is in order.
    primitives.push_back(primitives[0]);
    primitives[1]["attributes"] = {
        {"POSITION", asset.positions({7, 7, 7, 8, 8, 8, 9, 9, 9})},
        {"TEXCOORD_0", asset.add<float>({1, 2, 3, 4, 5, 6}, "VEC2", 5126)},
        {"NORMAL", asset.positions({0, 0, 1, 0, 1, 0, 1, 0, 0})},
        {"COLOR_0", asset.add<float>({1, 0, 0, 0, 1, 0, 0, 0, 1}, "VEC3", 5126)}};
    return asset.done();
  };
  const float nan = std::numeric_limits<float>::quiet_NaN();
  const CornerIndices none{no_index, no_index, no_index};
  struct Case {
    const char* name;
    std::vector<float> numbers;
    const char* type;
  };
  for (const Case& bad :
       {Case{"NORMAL", std::vector<float>(12, 1), "VEC3"},  // one too few
        Case{"NORMAL", std::vector<float>(10, 1), "VEC2"},  // of the wrong type
        Case{"NORMAL", {1, 1, 1, 1, 1, 1, 1, 1, 1, 1, 1, 1, 1, nan, 1}, "VEC3"},
        Case{"TEXCOORD_0", std::vector<float>(12, 1), "VEC2"},
        Case{"TEXCOORD_0", {1, 1, 1, 1, 1, 1, 1, 1, 1, nan}, "VEC2"},
        Case{"COLOR_0", std::vector<float>(18, 1), "VEC3"},
        Case{"COLOR_0", {0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, nan, 1}, "VEC3"}}) {
    const Read one = read(with(bad.name, bad.numbers, bad.type));
    EXPECT_THAT(one.warnings,
                ElementsAre(HasSubstr("1 list of normals, texture coordinates or colours")));
    const Mesh& mesh = one.scene.meshes[0];
    ASSERT_EQ(mesh.triangles.size(), 4U);
    EXPECT_EQ(mesh.texture_triangles.at(0), none);
    EXPECT_EQ(mesh.normal_triangles.at(0), none);
    EXPECT_EQ(mesh.normal_triangles.at(3), (CornerIndices{5, 6, 7}));
    // Nothing is left of the elements before the one at fault, and colours are white.
    EXPECT_EQ(mesh.normals.at(0), (std::array<double, 3>{}));
    EXPECT_EQ(mesh.texture_coordinates.at(0), (std::array<double, 2>{}));
    EXPECT_EQ(mesh.colours.at(0), (std::array<float, 4>{1, 1, 1, 1}));
    EXPECT_EQ(mesh.colours.at(5), (std::array<float, 4>{1, 0, 0, 1}));
    // Depth maps do not ask.
    EXPECT_THAT(
        read_bytes(with(bad.name, bad.numbers, bad.type).dump(), "test.gltf", false).warnings,
        IsEmpty());
  }
  json tree = with("COLOR_0", std::vector<float>(18, 1), "VEC3");
  tree["meshes"][0]["primitives"].erase(1);
  EXPECT_TRUE(read(tree).scene.meshes[0].colours.empty());
}

TEST(GltfHabits, PrimitivesWithoutPositionsAreSkipped) {
  Asset asset = five({{"mode", 5}});
  asset.tree["meshes"][0]["primitives"].push_back({{"attributes", json::object()}});
  asset.tree["meshes"][0]["primitives"].push_back({{"material", 0}});
  const Read one = read(asset.done());
  EXPECT_EQ(one.scene.meshes[0].triangles.size(), 3U);
  EXPECT_THAT(one.warnings, ElementsAre(HasSubstr("2 primitives have no positions")));
}

TEST(GltfHabits, TrianglesMayBeDegenerateAndIncomplete) {
  Asset asset = five({{"indices", 1}});
  asset.add<std::uint8_t>({1, 1, 1, 0, 2, 2, 0, 1}, "SCALAR", 5121);
  const Read one = read(asset.done());
  EXPECT_EQ(one.scene.meshes[0].triangles, (Triangles{{1, 1, 1}, {0, 2, 2}}));
  EXPECT_THAT(one.warnings, ElementsAre(HasSubstr("2 indices are left over")));
}

TEST(GltfHabits, AnAssetMayHaveNoSceneAndNoMesh) {
  const auto objects = [](json tree) {
    tree["asset"]["version"] = "2.0";
    return read(tree).scene.objects.size();
  };
  EXPECT_EQ(objects(json::object()), 0U);
  EXPECT_EQ(objects({{"scenes", json::array()}, {"nodes", {json::object()}}}), 0U);
  EXPECT_EQ(objects({{"scenes", {json::object()}}}), 0U);
  Asset asset = five({{"mode", 5}});
  asset.tree["scenes"] = json::array();
  EXPECT_EQ(read(asset.done()).scene.objects.size(), 1U);
}

TEST(GltfHabits, NothingButListsIsAList) {
  for (const char* pointer : {"/meshes/0/primitives", "/scenes/0/nodes", "/nodes/0/children",
                              "/extensionsRequired", "/nodes", "/meshes", "/accessors"}) {
    for (const json& value : {json::object({{"a", 1}}), json("text"), json(1)}) {
      json tree = five({}).done();
      tree[json::json_pointer(pointer)] = value;
      EXPECT_THAT(fault_of(tree), HasSubstr("list")) << pointer << value;
    }
  }
}

std::string word(std::uint32_t value) {
  std::string bytes(4, '\0');
  std::memcpy(bytes.data(), &value, 4);
  return bytes;
}

std::string chunk(const char* type, const std::string& content) {
  return word(static_cast<std::uint32_t>(content.size())) + std::string(type, 4) + content;
}

/// A binary asset; `change` is added to the length in its header.
std::string glb(const std::string& chunks, int change = 0) {
  return "glTF" + word(2) +
         word(static_cast<std::uint32_t>(12 + chunks.size()) + static_cast<std::uint32_t>(change)) +
         chunks;
}

class GltfContainers : public ::testing::Test {
 protected:
  GltfContainers() {
    const Asset asset = five({{"mode", 5}});
    json tree = asset.tree;
    tree["buffers"] = {{{"byteLength", asset.buffer.size()}}};
    text = tree.dump();
    while (text.size() % 4 != 0) text += ' ';
    buffer = asset.buffer;
  }
  static void expect_read(const std::string& bytes) {
    EXPECT_EQ(read_bytes(bytes, "test.glb").scene.meshes[0].triangles.size(), 3U);
  }

  std::string text, buffer;
};

TEST_F(GltfContainers, MayBePadded) {
  expect_read(glb(chunk("JSON", text) + chunk("BIN\0", buffer)));
  expect_read(glb(chunk("JSON", text + "    ") + chunk("BIN\0", buffer + std::string(3, '\0'))));
  // Zeros for the spaces, as some exporters write.
  expect_read(glb(chunk("JSON", text + std::string(3, '\0')) + chunk("BIN\0", buffer)));
}

TEST_F(GltfContainers, MayHaveChunksOfOtherKindsAndMore) {
  expect_read(glb(chunk("JSON", text) + chunk("ACME", "abcd") + chunk("BIN\0", buffer) +
                  chunk("BIN\0", "abcd") + chunk("ACME", "")));
  expect_read(glb(chunk("JSON", text) + chunk("BIN\0", buffer)) + "trailing bytes");
  expect_read(glb(chunk("JSON", text) + chunk("BIN\0", buffer) + "abc"));
}

TEST_F(GltfContainers, MaySayThatTheyAreShorterThanTheyAre) {
  // By less than the last chunk: it is there.
  expect_read(glb(chunk("JSON", text) + chunk("BIN\0", buffer), -4));
  EXPECT_THAT(fault_in_bytes(glb(chunk("JSON", text) + chunk("BIN\0", buffer), 4)),
              HasSubstr("byte 8: the file is said to be"));
  EXPECT_THAT(fault_in_bytes(glb(chunk("JSON", text) + chunk("BIN\0", buffer).substr(0, 40))),
              HasSubstr("a chunk reaches beyond the end of the file"));
}

TEST_F(GltfContainers, NeedTheirBinaryChunkOnlyForBuffersThatNameNone) {
  EXPECT_THAT(fault_in_bytes(glb(chunk("JSON", text))), HasSubstr("there is no binary chunk"));
  const std::string whole = five({{"mode", 5}}).done().dump();
  expect_read(glb(chunk("JSON", whole)));
}

}  // namespace
}  // namespace fathom
