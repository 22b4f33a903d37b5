// What small glTF files may cost: bytes that are said many times over, transforms that grow.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "fathom/mesh_files/expansion_budget.h"
#include "tests/mesh_files/gltf/gltf_asset.h"

namespace fathom {
namespace {

using namespace checks;
using mesh_files::ExpansionBudget;
using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::StartsWith;

const auto is_over_budget =
    AllOf(StartsWith("test.gltf: its "), HasSubstr("a greater --max-expansion allows it"));

TEST(ExpansionBudgetTest, IsAMultipleOfTheFilesAndAFreePart) {
  constexpr std::uint64_t free = ExpansionBudget::free_bytes;
  ExpansionBudget budget("a.gltf", 3);
  budget.take(1, free);
  EXPECT_THROW(budget.take(1, 1), InputError);
  budget.add_input(100);
  budget.take(3, 99);
  budget.take(3, 1);
  EXPECT_EQ(message_of<InputError>([&] { budget.take(1, 1); }),
            "a.gltf: its 100 bytes would take more than 67109164 bytes of memory, 3 times as many "
            "and 64 MiB; a greater --max-expansion allows it");
  // What was refused is not taken.
  budget.take(0, 1);
}

TEST(ExpansionBudgetTest, ClaimsBeyond64BitsAreRefused) {
  constexpr std::uint64_t most = ~std::uint64_t{0};
  ExpansionBudget budget("a.gltf", 64);
  EXPECT_THROW(budget.take(most, 2), InputError);
  EXPECT_THROW(budget.take(most / 2 + 2, 2), InputError);
  budget.take(1, 1);
  EXPECT_THROW(budget.take(1, most), InputError);
  // As much as can be said is allowed by a factor without end.
  ExpansionBudget endless("a.gltf", most);
  endless.add_input(most);
  endless.add_input(most);
  endless.take(most / 2, 2);
}

/// `count` primitives of one mesh, each with accessors of its own of the same bytes.
json primitives_of_the_same_bytes(std::size_t count, std::size_t vertices) {
  Asset asset;
  std::vector<float> positions(3 * vertices, 1);
  asset.positions(positions);
  const json accessor = asset.tree["accessors"][0];
  json primitives = json::array();
  asset.tree["accessors"] = json::array();
  for (std::size_t i = 0; i < count; ++i) {
    asset.tree["accessors"].push_back(accessor);
    primitives.push_back({{"attributes", {{"POSITION", i}}}});
  }
  asset.tree["meshes"] = {{{"primitives", primitives}}};
  asset.tree["nodes"] = {{{"mesh", 0}}};
  asset.tree["scenes"] = {{{"nodes", {0}}}};
  return asset.done();
}

ReadOptions with_expansion(std::uint64_t factor) {
  ReadOptions options;
  options.max_expansion = factor;
  return options;
}

TEST(GltfExpansion, AccessorsOfTheSameBytesAreCounted) {
  // 4 vertices in 4 kB, then 300 times as many in the same bytes: 72 MB, of half a megabyte.
  const json modest = primitives_of_the_same_bytes(1000, 4);
  EXPECT_EQ(read(modest).scene.meshes[0].vertices.size(), 4000U);
  const std::string large = primitives_of_the_same_bytes(2500, 1200).dump();
  ASSERT_LT(large.size(), 500000U);
  EXPECT_THAT(message_of<InputError>([&] { read_bytes(large, "test.gltf", with_expansion(8)); }),
              is_over_budget);
  EXPECT_EQ(read_bytes(large, "test.gltf", with_expansion(200)).scene.meshes[0].vertices.size(),
            3000000U);
}

TEST(GltfExpansion, AnAccessorThatPrimitivesShareIsReadOnce) {
  json tree = primitives_of_the_same_bytes(2500, 1200);
  for (json& primitive : tree["meshes"][0]["primitives"]) primitive["attributes"]["POSITION"] = 0;
  const Scene scene = read_bytes(tree.dump(), "test.gltf", with_expansion(1)).scene;
  EXPECT_EQ(scene.meshes[0].vertices.size(), 1200U);
  EXPECT_EQ(scene.meshes[0].triangles.size(), 2500U * 400U);
}

TEST(GltfExpansion, IndicesThatPrimitivesShareAreCounted) {
  Asset asset = five({});
  asset.add(std::vector<std::uint8_t>(60000, 3), "SCALAR", 5121);
  json primitives = json::array();
  for (int i = 0; i < 300; ++i)
    primitives.push_back({{"attributes", {{"POSITION", 0}}}, {"indices", 1}, {"mode", 5}});
  asset.tree["meshes"][0]["primitives"] = primitives;
  EXPECT_THAT(fault_of(asset.done()), is_over_budget);
}

TEST(GltfExpansion, ZerosThatNoBufferHoldsAreCounted) {
  for (const bool sparse : {false, true}) {
    Asset asset = five({});
    asset.tree["accessors"][0].erase("bufferView");
    if (sparse) {
      asset.add<std::uint8_t>({1}, "SCALAR", 5121);
      asset.tree["accessors"][0]["sparse"] = {
          {"count", 1},
          {"indices", {{"bufferView", 1}, {"componentType", 5121}}},
          {"values", {{"bufferView", 0}}}};
    }
    asset.tree["accessors"][0]["count"] = 100000;
    EXPECT_EQ(read(asset.done()).scene.meshes[0].vertices.size(), 100000U);
    asset.tree["accessors"][0]["count"] = 1000000000;
    EXPECT_THAT(fault_of(asset.done()), is_over_budget);
  }
  Asset indices = five({{"indices", 1}});
  indices.tree["accessors"].push_back(
      {{"componentType", 5125}, {"type", "SCALAR"}, {"count", 4000000000U}});
  EXPECT_THAT(fault_of(indices.done()), is_over_budget);
}

TEST(GltfExpansion, SparseIndicesThatAccessorsShareAreCounted) {
  constexpr std::uint32_t count = 100000;
  Asset asset = five({});
  std::vector<std::uint32_t> order(count);
  for (std::uint32_t i = 0; i < count; ++i) order[i] = i;
  asset.add(order, "SCALAR", 5125);
  asset.positions(std::vector<float>(3 * count, 1));
  const json sparse{{"componentType", 5126},
                    {"type", "VEC3"},
                    {"count", count},
                    {"sparse",
                     {{"count", count},
                      {"indices", {{"bufferView", 1}, {"componentType", 5125}}},
                      {"values", {{"bufferView", 2}}}}}};
  // Normals that are too many are opened, at the cost of a look at all indices, and not read.
  json accessors = json::array({asset.tree["accessors"][0]}), primitives = json::array();
  for (int i = 1; i <= 1000; ++i) {
    accessors.push_back(sparse);
    primitives.push_back({{"attributes", {{"POSITION", 0}, {"NORMAL", i}}}});
  }
  asset.tree["accessors"] = accessors;
  asset.tree["meshes"][0]["primitives"] = primitives;
  EXPECT_THAT(fault_of(asset.done()), is_over_budget);
}

/// `count` nodes below one root; each shows the mesh.
json forest(std::size_t count, const json& node = json::object()) {
  Asset asset = five({});
  json nodes = json::array(), roots = json::array();
  for (std::size_t i = 0; i < count; ++i) {
    nodes.push_back({{"mesh", 0}});
    nodes.back().update(node);
    roots.push_back(i);
  }
  asset.tree["nodes"] = nodes;
  asset.tree["scenes"][0]["nodes"] = roots;
  return asset.done();
}

TEST(GltfExpansion, NodesOfOneMeshShareIt) {
  const Scene scene = read(forest(20000, {{"translation", {1, 2, 3}}})).scene;
  EXPECT_EQ(scene.objects.size(), 20000U);
  EXPECT_EQ(scene.meshes.size(), 1U);
}

TEST(GltfExpansion, TrianglesThatNodesShareAreCounted) {
  const auto placed = [](std::size_t times) {
    json tree = forest(times);
    Asset asset = five({{"indices", 1}});
    asset.add(std::vector<std::uint8_t>(60000, 3), "SCALAR", 5121);
    const json mesh = asset.done();
    for (const char* key : {"accessors", "bufferViews", "buffers", "meshes"}) tree[key] = mesh[key];
    return tree;
  };
  const Scene scene = read(placed(1000)).scene;
  EXPECT_EQ(triangle_count(scene), 20000000U);
  EXPECT_THAT(fault_of(placed(2000)), is_over_budget);
}

TEST(GltfExpansion, NamesThatNodesShareAreCounted) {
  json tree = forest(10000);
  tree["meshes"][0]["name"] = std::string(100000, 'x');
  EXPECT_THAT(fault_of(tree), is_over_budget);
}

TEST(GltfExpansion, InstancesOfTwelveBytesAreAllowed) {
  // More than the free part holds: each takes a translation in the file, and an Object.
  Asset asset = five({});
  constexpr std::size_t count = 200000;
  std::vector<float> places(3 * count);
  for (std::size_t i = 0; i < places.size(); ++i) places[i] = 0.1F * static_cast<float>(i + 1);
  asset.tree["nodes"][0]["name"] = "one of many trees";
  asset.tree["nodes"][0]["extensions"]["EXT_mesh_gpu_instancing"]["attributes"]["TRANSLATION"] =
      asset.positions(places);
  static_assert(count * sizeof(Object) > ExpansionBudget::free_bytes);
  EXPECT_EQ(read(asset.done()).scene.objects.size(), count);
}

TEST(GltfExpansion, InstancesThatNodesShareAreCounted) {
  Asset asset = five({});
  asset.positions(std::vector<float>(3 * 1000, 1));
  json tree = asset.tree;
  const json node{
      {"mesh", 0},
      {"extensions", {{"EXT_mesh_gpu_instancing", {{"attributes", {{"TRANSLATION", 1}}}}}}}};
  json nodes = json::array(), roots = json::array();
  for (int i = 0; i < 1000; ++i) {
    nodes.push_back(node);
    roots.push_back(i);
  }
  asset.tree["nodes"] = nodes;
  asset.tree["scenes"][0]["nodes"] = roots;
  EXPECT_THAT(fault_of(asset.done()), is_over_budget);
  // And those of zeros that no buffer holds.
  asset.tree["scenes"][0]["nodes"] = {0};
  asset.tree["accessors"][1].erase("bufferView");
  asset.tree["accessors"][1]["count"] = 4000000000U;
  EXPECT_THAT(fault_of(asset.done()), is_over_budget);
}

TEST(GltfExpansion, TransformsThatGrowWithEveryLevelAreCounted) {
  // Each level makes a number of the product 2,000 bits longer; 2,000 leaves have the longest.
  const json wide{1e300,  1e-300, 1e10,  0, 1e-300, 1e300,  1e-10, 0,
                  3e-300, 1e300,  1e300, 0, 1e300,  1e-300, 7,     1};
  Asset asset = five({});
  json nodes = json::array(), leaves = json::array();
  constexpr int levels = 190, leaf_count = 2000;
  for (int i = 0; i < levels; ++i) nodes.push_back({{"matrix", wide}, {"children", {i + 1}}});
  for (int i = 0; i < leaf_count; ++i) {
    leaves.push_back(levels + 1 + i);
  }
  nodes.push_back({{"matrix", wide}, {"children", leaves}});
  for (int i = 0; i < leaf_count; ++i) nodes.push_back({{"matrix", wide}, {"mesh", 0}});
  asset.tree["nodes"] = nodes;
  EXPECT_THAT(fault_of(asset.done()), is_over_budget);
  // One such leaf is read.
  asset.tree["nodes"][levels]["children"] = {levels + 1};
  EXPECT_EQ(read(asset.done()).scene.objects.size(), 1U);
}

TEST(GltfExpansion, AFileThatManyBuffersNameIsReadOnce) {
  const ScratchFolder folder;
  const Asset asset = five({{"mode", 5}});
  folder.write("a.bin", asset.buffer);
  std::filesystem::create_symlink("a.bin", folder.path() / "link.bin");
  json tree = asset.done();
  tree["buffers"] = json::array();
  tree["bufferViews"] = json::array();
  tree["accessors"] = json::array();
  json primitives = json::array();
  const char* names[] = {"a.bin", "./a.bin", "%61.bin", "link.bin"};
  for (int i = 0; i < 1000; ++i) {
    tree["buffers"].push_back({{"byteLength", 60}, {"uri", names[i % 4]}});
    tree["bufferViews"].push_back({{"buffer", i}, {"byteLength", 60}});
    tree["accessors"].push_back(
        {{"bufferView", i}, {"componentType", 5126}, {"count", 5}, {"type", "VEC3"}});
    primitives.push_back({{"attributes", {{"POSITION", i}}}});
  }
  tree["meshes"][0]["primitives"] = primitives;
  const Read all = read_bytes(tree.dump(), folder.path() / "x.gltf");
  EXPECT_EQ(all.scene.meshes[0].vertices.size(), 5000U);
  EXPECT_EQ(all.scene.sources.size(), 1U);
}

}  // namespace
}  // namespace fathom
