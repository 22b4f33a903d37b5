// What exporters write that the specification of glTF does not quite allow, or allows and few do.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstring>

#include "tests/mesh_files/gltf_asset.h"

namespace fathom {
namespace {

using namespace testing;
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
