#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstring>
#include <random>

#include "fathom/mesh_files/read_mesh.h"
#include "fathom/numeric/rounding.h"
#include "tests/effort.h"
#include "tests/mesh_files/gltf/gltf_asset.h"
#include "tests/places.h"

namespace fathom {
namespace {

using namespace checks;
using ::testing::AllOf;
using ::testing::ElementsAre;
using ::testing::HasSubstr;

TEST(Gltf, ModesAreThoseOfTheSpecification) {
  EXPECT_EQ(read(five({}).done()).scene.meshes[0].triangles, (Triangles{{0, 1, 2}}));
  EXPECT_EQ(read(five({{"mode", 5}}).done()).scene.meshes[0].triangles,
            (Triangles{{0, 1, 2}, {1, 3, 2}, {2, 3, 4}}));
  EXPECT_EQ(read(five({{"mode", 6}}).done()).scene.meshes[0].triangles,
            (Triangles{{1, 2, 0}, {2, 3, 0}, {3, 4, 0}}));
  EXPECT_THAT(read(five({}).done()).warnings, ElementsAre(HasSubstr("2 indices are left over")));
  for (const int mode : {0, 1, 2, 3}) {
    const Read points = read(five({{"mode", mode}}).done());
    EXPECT_TRUE(points.scene.meshes[0].triangles.empty());
    EXPECT_THAT(points.warnings, ElementsAre(HasSubstr("1 primitive is of points or lines")));
  }
  EXPECT_THAT(fault_of(five({{"mode", 7}}).done()), HasSubstr("mode: expected an integer"));
}

TEST(Gltf, IndicesOfEveryType) {
  const auto check = [](auto number, int component) {
    using T = decltype(number);
    Asset asset = five({{"indices", 1}});
    asset.add(std::vector<T>{4, 3, 2, 0, 1, 4}, "SCALAR", component);
    const Scene scene = read(asset.done()).scene;
    EXPECT_EQ(scene.meshes[0].triangles, (Triangles{{4, 3, 2}, {0, 1, 4}}));
    EXPECT_EQ(scene.meshes[0].face_count, 2U);
    EXPECT_TRUE(scene.meshes[0].face_of_triangle.empty());
    Asset bad = five({{"indices", 1}});
    bad.add(std::vector<T>{4, 3, 5}, "SCALAR", component);
    EXPECT_THAT(fault_of(bad.done()),
                AllOf(HasSubstr("meshes[0].primitives[0]"), HasSubstr("index 5 at place 2")));
    bad = five({{"indices", 1}});
    bad.add(std::vector<T>{0, 1, static_cast<T>(-1)}, "SCALAR", component);
    EXPECT_THAT(fault_of(bad.done()), HasSubstr("out of range"));
  };
  check(std::uint8_t{}, 5121);
  check(std::uint16_t{}, 5123);
  check(std::uint32_t{}, 5125);
  for (const int component : {5120, 5122, 5126, 5124, 5127}) {
    Asset asset = five({{"indices", 1}});
    asset.add(std::vector<std::uint32_t>{0, 1, 2}, "SCALAR", component);
    EXPECT_THAT(fault_of(asset.done()), HasSubstr("accessors[1]")) << component;
  }
}

TEST(Gltf, PrimitivesFollowEachOtherAndShareVertices) {
  Asset asset = five({{"mode", 5}});
  json& primitives = asset.tree["meshes"][0]["primitives"];
  primitives.push_back({{"attributes", {{"POSITION", 0}}}});
  primitives.push_back(
      {{"attributes", {{"POSITION", asset.positions({7, 7, 7, 8, 8, 8, 9, 9, 9})}}}});
  const Mesh mesh = read(asset.done()).scene.meshes[0];
  EXPECT_EQ(mesh.vertices.size(), 8U);
  EXPECT_EQ(mesh.triangles, (Triangles{{0, 1, 2}, {1, 3, 2}, {2, 3, 4}, {0, 1, 2}, {5, 6, 7}}));
}

/// Of the object, its map as doubles that must be exact.
std::array<std::array<double, 4>, 3> rows_of(const Object& object) {
  std::array<std::array<double, 4>, 3> rows;
  for (int i = 0; i < 3; ++i)
    for (int k = 0; k < 4; ++k) {
      rows[i][k] = round_to_binary64(Ratio(object.world_from_mesh.rows[i][k]));
      EXPECT_EQ(Dyadic(rows[i][k]), object.world_from_mesh.rows[i][k]);
    }
  return rows;
}
using Rows = std::array<std::array<double, 4>, 3>;

Object placed(const json& node) {
  Asset asset = five({});
  asset.tree["nodes"][0].update(node);
  return read(asset.done()).scene.objects.at(0);
}

TEST(Gltf, TransformsAreExact) {
  EXPECT_TRUE(placed(json::object()).placed_as_is);
  EXPECT_TRUE(placed({{"scale", {1, 1, 1}}, {"rotation", {0, 0, 0, 1}}}).placed_as_is);
  EXPECT_FALSE(placed({{"translation", {0, 0, 1e-300}}}).placed_as_is);
  EXPECT_EQ(rows_of(placed({{"translation", {1, 2, 3}}})),
            (Rows{{{1, 0, 0, 1}, {0, 1, 0, 2}, {0, 0, 1, 3}}}));
  EXPECT_EQ(rows_of(placed({{"scale", {2, 3, -4}}})),
            (Rows{{{2, 0, 0, 0}, {0, 3, 0, 0}, {0, 0, -4, 0}}}));
  // Half a turn about y and (not normalised) the polynomial matrix of (½, 0, 0, ½).
  EXPECT_EQ(rows_of(placed({{"rotation", {0, 1, 0, 0}}})),
            (Rows{{{-1, 0, 0, 0}, {0, 1, 0, 0}, {0, 0, -1, 0}}}));
  EXPECT_EQ(rows_of(placed({{"rotation", {0.5, 0, 0, 0.5}}})),
            (Rows{{{1, 0, 0, 0}, {0, 0.5, -0.5, 0}, {0, 0.5, 0.5, 0}}}));
  EXPECT_EQ(rows_of(placed({{"rotation", {1, 2, 3, 4}}})),
            (Rows{{{-25, -20, 22, 0}, {28, -19, 4, 0}, {-10, 20, -9, 0}}}));
  // T·R·S, and the matrix column by column.
  EXPECT_EQ(
      rows_of(placed(
          {{"translation", {1, 2, 3}}, {"rotation", {0.5, 0.5, 0.5, 0.5}}, {"scale", {2, 3, 4}}})),
      (Rows{{{0, 0, 4, 1}, {2, 0, 0, 2}, {0, 3, 0, 3}}}));
  EXPECT_EQ(rows_of(placed({{"matrix", {1, 2, 3, 0, 4, 5, 6, 0, 7, 8, 9, 0, 10, 11, 12, 1}}})),
            (Rows{{{1, 4, 7, 10}, {2, 5, 8, 11}, {3, 6, 9, 12}}}));
  // 0.1 means the double next to it, and nothing is rounded on the way.
  const Object object = placed({{"scale", {0.1, 1, 1}}, {"rotation", {0, 0.1, 0, 1}}});
  const Dyadic tenth = 0.1, two = 2.0;
  EXPECT_EQ(object.world_from_mesh.rows[0][0], (Dyadic(1.0) - two * tenth * tenth) * tenth);
  EXPECT_EQ(object.world_from_mesh.rows[2][0], -(two * tenth) * tenth);
}

TEST(Gltf, TransformsCompose) {
  Asset asset = five({});
  asset.tree["nodes"] = {{{"translation", {1, 0, 0}}, {"children", {1}}, {"mesh", 0}},
                         {{"scale", {0.1, 2, 2}}, {"children", {2}}},
                         {{"translation", {0.1, 5, 0}}, {"mesh", 0}, {"name", "leaf"}}};
  const Scene scene = read(asset.done()).scene;
  ASSERT_EQ(scene.objects.size(), 2U);
  const auto& rows = scene.objects[1].world_from_mesh.rows;
  EXPECT_EQ(rows[0][3], Dyadic(1.0) + Dyadic(0.1) * Dyadic(0.1));
  EXPECT_EQ(rows[1][3], Dyadic(10.0));
  EXPECT_EQ(scene.objects[1].name, "leaf");
}

TEST(Gltf, ObjectsAreNodesDepthFirstAndShareMeshes) {
  Asset asset = five({{"mode", 5}});
  asset.tree["meshes"].push_back(
      {{"name", "other"}, {"primitives", {{{"attributes", {{"POSITION", 0}}}, {"mode", 6}}}}});
  asset.tree["nodes"] = {{{"name", "a"}, {"mesh", 1}, {"children", {3, 1}}},
                         {{"name", "b"}, {"mesh", 0}},
                         {{"name", "c"}, {"mesh", 0}},
                         {{"children", {4}}},
                         {{"mesh", 1}},
                         {{"mesh", 0}}};
  asset.tree["scenes"] = {{{"nodes", {5}}}, {{"nodes", {2, 0}}}};
  asset.tree["scene"] = 1;
  Scene scene = read(asset.done()).scene;
  std::vector<std::string> names;
  std::vector<std::uint64_t> faces;
  for (const Object& object : scene.objects) {
    names.push_back(object.name);
    faces.push_back(object.first_face);
  }
  EXPECT_THAT(names, ElementsAre("c", "a", "other", "b"));
  EXPECT_THAT(faces, ElementsAre(0U, 3U, 6U, 9U));
  EXPECT_EQ(scene.meshes.size(), 2U);
  EXPECT_EQ(scene.objects[0].mesh, scene.objects[3].mesh);
  EXPECT_EQ(scene.objects[1].mesh, scene.objects[2].mesh);
  // Without a default scene the first; without any, all nodes that have no parent.
  asset.tree.erase("scene");
  scene = read(asset.done()).scene;
  ASSERT_EQ(scene.objects.size(), 1U);
  EXPECT_EQ(scene.objects[0].name, "node 5");
  asset.tree.erase("scenes");
  const Read all = read(asset.done());
  EXPECT_EQ(all.scene.objects.size(), 5U);
  EXPECT_THAT(all.warnings, ElementsAre(HasSubstr("no scene")));
}

TEST(Gltf, BrokenTreesAreRefused) {
  const auto fault = [](const json& nodes, const json& roots) {
    Asset asset = five({});
    asset.tree["nodes"] = nodes;
    asset.tree["scenes"] = {{{"nodes", roots}}};
    return fault_of(asset.done());
  };
  EXPECT_THAT(fault({{{"children", {0}}}}, {0}), HasSubstr("reached twice"));
  EXPECT_THAT(fault({{{"children", {1}}}, {{"children", {0}}}}, {0}), HasSubstr("reached twice"));
  EXPECT_THAT(fault({{{"children", {2}}}, {{"children", {2}}}, {{"mesh", 0}}}, {0, 1}),
              HasSubstr("nodes[2]: the node is reached twice"));
  EXPECT_THAT(fault({{{"mesh", 0}}}, {0, 0}), HasSubstr("reached twice"));
  EXPECT_THAT(fault({{{"mesh", 1}}}, {0}), HasSubstr("nodes[0].mesh: there is no mesh 1"));
  EXPECT_THAT(fault({{{"children", {7}}}}, {0}), HasSubstr("there is no node 7"));
  EXPECT_THAT(fault({{{"mesh", 0}}}, {-1}), HasSubstr("expected an integer"));
  EXPECT_THAT(fault({{{"mesh", 0}, {"scale", {1, 2}}}}, {0}),
              HasSubstr("scale: expected a list of 3"));
  json matrix = json::array();
  for (int i = 0; i < 16; ++i) matrix.push_back(1);
  EXPECT_THAT(fault({{{"mesh", 0}, {"matrix", matrix}}}, {0}), HasSubstr("last row"));
  EXPECT_THAT(
      fault({{{"matrix", {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1}}, {"scale", {1, 1, 1}}}},
            {0}),
      HasSubstr("together with a matrix"));
  constexpr int deep = 100000 / checks::effort;
  json chain = json::array();
  for (int i = 0; i < deep; ++i) chain.push_back({{"children", {i + 1}}});
  chain.push_back({{"mesh", 0}});
  EXPECT_THAT(fault(chain, {0}), HasSubstr("deep"));
  Asset asset = five({});
  asset.tree["scene"] = 3;
  EXPECT_THAT(fault_of(asset.done()), HasSubstr("there is no scene 3"));
}

TEST(Gltf, StridesAndOffsets) {
  // 4 bytes of offset in the view, 8 in the accessor, 20 from one vertex to the next.
  Asset asset = five({});
  asset.buffer.assign(4 + 8 + 2 * 20 + 12, '\x7f');
  for (int i = 0; i < 3; ++i) {
    const std::array<float, 3> p{static_cast<float>(i), static_cast<float>(i + 10), -1.5F};
    std::memcpy(asset.buffer.data() + 12 + 20 * i, p.data(), 12);
  }
  asset.tree["bufferViews"][0] = {
      {"buffer", 0}, {"byteOffset", 4}, {"byteLength", 60}, {"byteStride", 20}};
  asset.tree["accessors"][0]["byteOffset"] = 8;
  asset.tree["accessors"][0]["count"] = 3;
  const Mesh mesh = read(asset.done()).scene.meshes[0];
  EXPECT_EQ(mesh.vertices, (std::vector<MeshPoint>{{0, 10, -1.5}, {1, 11, -1.5}, {2, 12, -1.5}}));
  // One byte less than the last vertex needs.
  asset.tree["bufferViews"][0]["byteLength"] = 59;
  EXPECT_THAT(fault_of(asset.done()), HasSubstr("accessors[0]: its 3 elements reach beyond"));
  asset.tree["bufferViews"][0]["byteLength"] = 61;
  EXPECT_THAT(fault_of(asset.done()), HasSubstr("bufferViews[0]: reaches beyond"));
  asset.tree["bufferViews"][0]["byteLength"] = 60;
  asset.tree["bufferViews"][0]["byteStride"] = 8;
  EXPECT_THAT(fault_of(asset.done()), HasSubstr("byteStride: is less"));
}

TEST(Gltf, HugeClaimsAreRefusedWithoutMemory) {
  const auto fault = [](const char* pointer, const json& value) {
    Asset asset = five({});
    json tree = asset.done();
    tree[json::json_pointer(pointer)] = value;
    return fault_of(tree);
  };
  EXPECT_THAT(fault("/accessors/0/count", 4000000000U), HasSubstr("reach beyond"));
  EXPECT_THAT(fault("/accessors/0/count", 18446744073709551615U), HasSubstr("count: expected"));
  EXPECT_THAT(fault("/accessors/0/byteOffset", 18446744073709551615U), HasSubstr("reach beyond"));
  EXPECT_THAT(fault("/bufferViews/0/byteOffset", 18446744073709551615U),
              HasSubstr("reaches beyond"));
  EXPECT_THAT(fault("/bufferViews/0/byteLength", 18446744073709551615U),
              HasSubstr("reaches beyond"));
  EXPECT_THAT(fault("/buffers/0/byteLength", 18446744073709551615U),
              HasSubstr("buffers[0]: is said"));
  EXPECT_THAT(fault("/bufferViews/0/buffer", 1), HasSubstr("there is no buffer 1"));
  EXPECT_THAT(fault("/accessors/0/bufferView", 1), HasSubstr("there is no entry 1 in bufferViews"));
  EXPECT_THAT(fault("/meshes/0/primitives/0/attributes/POSITION", 9), HasSubstr("no entry 9"));
  EXPECT_THAT(fault("/buffers/0/uri", "data:,abc"), HasSubstr("base64"));
  EXPECT_THAT(fault("/buffers/0/uri", "data:;base64,A*=="), HasSubstr("base64"));
  EXPECT_THAT(fault("/buffers/0/uri", "data:;base64,AAAAA"), HasSubstr("base64"));
  EXPECT_THAT(fault("/buffers/0/uri", "https://example.org/a.bin"), HasSubstr("relative URI"));
  EXPECT_THAT(fault("/buffers/0/uri", "none.bin"), HasSubstr("there is no file"));
  EXPECT_THAT(fault("/buffers/0/uri", "/dev/zero"), HasSubstr("leads out of the folder"));
  EXPECT_THAT(fault("/buffers/0/uri", "%0"), HasSubstr("relative URI"));
  EXPECT_THAT(fault("/accessors/0/type", "VEC2"), HasSubstr("VEC3 of floats"));
  EXPECT_THAT(fault("/accessors/0/type", "MAT4"), HasSubstr("type: expected"));
  EXPECT_THAT(fault("/asset/version", "1.0"), HasSubstr("expected glTF 2, found 1.0"));
  EXPECT_THAT(fault("/extensionsRequired", {"EXT_unheard_of"}), HasSubstr("EXT_unheard_of"));
  // Zeros that no buffer holds.
  Asset asset = five({});
  asset.tree["accessors"][0].erase("bufferView");
  EXPECT_EQ(read(asset.done()).scene.meshes[0].vertices[4], (MeshPoint{0, 0, 0}));
  asset.tree["accessors"][0]["count"] = 4000000000U;
  EXPECT_THAT(fault_of(asset.done()), HasSubstr("a greater --max-expansion allows it"));
}

TEST(Gltf, NumbersThatAreNotFiniteAreRefused) {
  for (const float bad :
       {std::numeric_limits<float>::infinity(), std::numeric_limits<float>::quiet_NaN()}) {
    Asset asset = five({});
    std::memcpy(asset.buffer.data() + 4 * 7, &bad, 4);
    EXPECT_THAT(fault_of(asset.done()), HasSubstr("accessors[0]: element 2 is not finite"));
  }
}

TEST(Gltf, SparseAccessorsReplaceElements) {
  Asset asset = five({});
  asset.buffer += std::string("\x01\x00\x04\x00", 4);
  asset.tree["bufferViews"].push_back({{"buffer", 0}, {"byteOffset", 60}, {"byteLength", 4}});
  const std::array<float, 6> values{-1, -2, -3, -4, -5, -6};
  asset.buffer.append(reinterpret_cast<const char*>(values.data()), 24);
  asset.tree["bufferViews"].push_back({{"buffer", 0}, {"byteOffset", 64}, {"byteLength", 24}});
  asset.tree["accessors"][0]["sparse"] = {{"count", 2},
                                          {"indices", {{"bufferView", 1}, {"componentType", 5123}}},
                                          {"values", {{"bufferView", 2}}}};
  const std::vector<MeshPoint> expected{
      {0, 0, 0}, {-1, -2, -3}, {2, 4, 0}, {3, 9, 0}, {-4, -5, -6}};
  EXPECT_EQ(read(asset.done()).scene.meshes[0].vertices, expected);
  Asset zeros = asset;
  zeros.tree["accessors"][0].erase("bufferView");
  EXPECT_EQ(read(zeros.done()).scene.meshes[0].vertices,
            (std::vector<MeshPoint>{{0, 0, 0}, {-1, -2, -3}, {0, 0, 0}, {0, 0, 0}, {-4, -5, -6}}));
  const auto broken = [&](char first, char second) {
    Asset bad = asset;
    bad.buffer[60] = first;
    bad.buffer[62] = second;
    return fault_of(bad.done());
  };
  EXPECT_THAT(broken(1, 5), HasSubstr("increasing indices below 5"));
  EXPECT_THAT(broken(1, 1), HasSubstr("increasing indices"));
  EXPECT_THAT(broken(4, 1), HasSubstr("increasing indices"));
  asset.tree["accessors"][0]["sparse"]["count"] = 4;
  EXPECT_THAT(fault_of(asset.done()), HasSubstr("sparse"));
  asset.tree["accessors"][0]["sparse"]["count"] = 6;
  EXPECT_THAT(fault_of(asset.done()), HasSubstr("count: expected"));
}

TEST(Gltf, AttributesAreKeptWhereTheyAre) {
  Asset asset = five({{"mode", 6}});
  json& attributes = asset.tree["meshes"][0]["primitives"][0]["attributes"];
  attributes["TEXCOORD_0"] =
      asset.add(std::vector<std::uint8_t>{0, 255, 51, 0, 0, 0, 0, 0, 0, 0}, "VEC2", 5121, true);
  attributes["NORMAL"] = asset.positions({0, 0, 1, 0, 1, 0, 1, 0, 0, 0, 0, 1, 0, 0, 1});
  attributes["COLOR_0"] =
      asset.add(std::vector<float>{2, 0, 0, 0, .5F, 0, 0, 0, 1, 0, 0, 0, 0, 0, 0}, "VEC3", 5126);
  Mesh mesh = read(asset.done()).scene.meshes[0];
  ASSERT_EQ(mesh.texture_coordinates.size(), 5U);
  EXPECT_EQ(mesh.texture_coordinates[0], (std::array<double, 2>{0, 1}));
  EXPECT_EQ(mesh.texture_coordinates[1], (std::array<double, 2>{0.2, 0}));
  EXPECT_EQ(mesh.normals[2], (std::array<double, 3>{1, 0, 0}));
  EXPECT_EQ(mesh.colours[0], (std::array<float, 4>{1, 0, 0, 1}));
  EXPECT_EQ(mesh.colours[1], (std::array<float, 4>{0, .5F, 0, 1}));
  EXPECT_TRUE(mesh.texture_triangles.empty());
  EXPECT_TRUE(mesh.normal_triangles.empty());
  // A second primitive without them: its corners have none, and white is glTF's default.
  asset.tree["meshes"][0]["primitives"].push_back(
      {{"attributes", {{"POSITION", asset.positions({7, 7, 7, 8, 8, 8, 9, 9, 9})}}}});
  mesh = read(asset.done()).scene.meshes[0];
  EXPECT_EQ(mesh.vertices.size(), 8U);
  EXPECT_EQ(mesh.texture_triangles,
            (Triangles{{1, 2, 0}, {2, 3, 0}, {3, 4, 0}, {no_index, no_index, no_index}}));
  EXPECT_EQ(mesh.normal_triangles, mesh.texture_triangles);
  ASSERT_EQ(mesh.colours.size(), 8U);
  EXPECT_EQ(mesh.colours[7], (std::array<float, 4>{1, 1, 1, 1}));
  // Not asked for: not kept, and vertices shared again.
  const Mesh plain = read_bytes(asset.done().dump(), "test.gltf", false).scene.meshes[0];
  EXPECT_TRUE(plain.texture_coordinates.empty());
  EXPECT_TRUE(plain.normals.empty());
  EXPECT_TRUE(plain.colours.empty());
  EXPECT_EQ(plain.triangles, mesh.triangles);
}

TEST(Gltf, WarnsOfWhatItIgnores) {
  Asset asset = five({{"mode", 5}});
  asset.tree["meshes"][0]["weights"] = {0.5};
  asset.tree["nodes"][0]["skin"] = 0;
  asset.tree["meshes"][0]["primitives"].push_back({{"attributes", {{"NORMAL", 0}}}});
  EXPECT_THAT(read(asset.done()).warnings,
              ElementsAre(HasSubstr("1 node has skin"), HasSubstr("1 node has morph targets"),
                          HasSubstr("1 primitive has no positions")));
}

TEST(Gltf, ExternalBuffersAreSources) {
  const ScratchFolder folder;
  const Asset asset = five({{"mode", 5}});
  folder.write("a b.bin", asset.buffer + "more");
  json tree = asset.done();
  tree["buffers"][0]["uri"] = "a%20b.bin";
  const Read result = read_bytes(tree.dump(), folder.path() / "x.gltf");
  EXPECT_EQ(result.scene.meshes[0].triangles.size(), 3U);
  ASSERT_EQ(result.scene.sources.size(), 1U);
  EXPECT_EQ(result.scene.sources[0].path, (folder.path() / "a b.bin").string());
  EXPECT_EQ(result.scene.sources[0].sha256.size(), 64U);
  folder.write("a b.bin", asset.buffer.substr(1));
  EXPECT_THAT(message_of<InputError>([&] { read_bytes(tree.dump(), folder.path() / "x.gltf"); }),
              HasSubstr("is said to have 60 bytes, found 59"));
}

std::string whole(const std::string& name) {
  std::ifstream file(test::source_dir() / "data/meshes" / name, std::ios::binary);
  return {std::istreambuf_iterator<char>(file), {}};
}

TEST(Gltf, BothContainersGiveTheSame) {
  const Read text = read_bytes(whole("house.gltf")), binary = read_bytes(whole("house.glb"));
  ASSERT_EQ(text.scene.objects.size(), 4U);
  ASSERT_EQ(binary.scene.objects.size(), 4U);
  for (std::size_t i = 0; i < 4; ++i) {
    const Object &a = text.scene.objects[i], &b = binary.scene.objects[i];
    EXPECT_EQ(a.name, b.name);
    EXPECT_EQ(a.first_face, b.first_face);
    EXPECT_EQ(a.world_from_mesh.rows, b.world_from_mesh.rows);
    EXPECT_EQ(text.scene.meshes[a.mesh].vertices, binary.scene.meshes[b.mesh].vertices);
    EXPECT_EQ(text.scene.meshes[a.mesh].triangles, binary.scene.meshes[b.mesh].triangles);
  }
  // The walls: walls 12, roof 4, ground 4, shed 12.
  EXPECT_EQ(text.scene.objects[3].first_face, 20U);
  EXPECT_EQ(text.scene.objects[0].mesh, text.scene.objects[3].mesh);
  EXPECT_TRUE(text.warnings.empty());
}

TEST(Gltf, TruncatedFilesAreRefusedAtEveryByte) {
  for (const char* name : {"house.glb", "house.gltf"}) {
    const std::string bytes = whole(name);
    // The text ends with a line feed, which may be missing.
    const std::size_t end = name == std::string("house.gltf") ? bytes.size() - 1 : bytes.size();
    ASSERT_GT(end, 1000U);
    for (std::size_t n = 0; n < end; ++n)
      ASSERT_THAT(fault_in_bytes(bytes.substr(0, n)), HasSubstr("test.gltf: ")) << name << " " << n;
  }
}

TEST(Gltf, BrokenChunksNameTheByte) {
  std::string bytes = whole("house.glb");
  const auto with = [&](std::size_t at, char value) {
    std::string changed = bytes;
    changed[at] = value;
    return fault_in_bytes(changed);
  };
  EXPECT_THAT(with(4, 1), HasSubstr("byte 4: expected version 2"));
  EXPECT_THAT(with(11, 127), HasSubstr("byte 8: the file is said"));
  EXPECT_THAT(with(15, 127), HasSubstr("byte 12: a chunk reaches"));
  EXPECT_THAT(with(16, 'X'), HasSubstr("byte 16: expected the first chunk"));
  EXPECT_THAT(with(20, '!'), HasSubstr("line 1: not JSON"));
}

TEST(Gltf, DamagedFilesNeverDoMoreThanFail) {
  std::mt19937 random(6);
  for (const char* name : {"house.glb", "house.gltf"}) {
    const std::string bytes = whole(name);
    for (int round = 0; round < 3000; ++round) {
      std::string changed = bytes;
      for (unsigned k = 1 + random() % 3; k > 0; --k)
        changed[random() % changed.size()] = static_cast<char>(random());
      try {
        const Read result = read_bytes(changed);
        for (const Mesh& mesh : result.scene.meshes)
          for (const CornerIndices& triangle : mesh.triangles)
            for (const std::uint32_t corner : triangle) ASSERT_LT(corner, mesh.vertices.size());
      } catch (const InputError& e) {
        ASSERT_EQ(std::string(e.what()).find('\n'), std::string::npos) << e.what();
      }
    }
  }
}

}  // namespace
}  // namespace fathom
