// glTF files that would make the program slow, large or talkative, as users meet them. Limits of
// time and memory are many times what is needed, and far below what such files used to take.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "tests/apps/run_program.h"
#include "tests/apps/test_folder.h"

namespace fathom::test {
namespace {

using nlohmann::json;
using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::Not;

/// Three vertices, as (0, 0, 1), (1, 0, 1) and (0, 1, 1) in binary32.
const std::string triangle_base64 = "AAAAAAAAAAAAAIA/AACAPwAAAAAAAIA/AAAAAAAAgD8AAIA/";

json triangle_asset() {
  return {
      {"asset", {{"version", "2.0"}}},
      {"buffers",
       {{{"byteLength", 36}, {"uri", "data:application/octet-stream;base64," + triangle_base64}}}},
      {"bufferViews", {{{"buffer", 0}, {"byteLength", 36}}}},
      {"accessors", {{{"bufferView", 0}, {"componentType", 5126}, {"count", 3}, {"type", "VEC3"}}}},
      {"meshes", {{{"primitives", {{{"attributes", {{"POSITION", 0}}}}}}}}},
      {"nodes", {{{"mesh", 0}}}},
      {"scenes", {{{"nodes", {0}}}}}};
}

/// `count` primitives with accessors of their own of 1,000 vertices, all of the same zeros.
json many_primitives(int count) {
  json asset = triangle_asset(), primitives = json::array();
  asset["accessors"] = json::array();
  for (int i = 0; i < count; ++i) {
    asset["accessors"].push_back({{"componentType", 5126}, {"count", 1000}, {"type", "VEC3"}});
    primitives.push_back({{"attributes", {{"POSITION", i}}}});
  }
  asset["meshes"][0]["primitives"] = primitives;
  return asset;
}

class HostileGltf : public ::testing::Test {
 protected:
  [[nodiscard]] Outcome run_on(const json& asset, std::vector<std::string> arguments) const {
    folder.write("a.gltf", asset.dump());
    RunOptions options{.folder = folder.path()};
    options.seconds = 60;
    options.memory = rlim_t{2} << 30;
    return run_fathom(arguments, options);
  }
  void expect_refusal(const json& asset, const std::vector<std::string>& arguments,
                      const std::string& said) const {
    const Outcome outcome = run_on(asset, arguments);
    EXPECT_EQ(outcome.status, 3);
    EXPECT_THAT(outcome.err, AllOf(HasSubstr("fathom: error: a.gltf: "), HasSubstr(said)));
    EXPECT_EQ(std::count(outcome.err.begin(), outcome.err.end(), '\n'), 1) << outcome.err;
    EXPECT_EQ(folder.names(), names_before);
  }

  TestFolder folder;
  std::vector<std::string> names_before{"a.gltf"};
  const std::vector<std::string> info{"info", "a.gltf"};
  const std::vector<std::string> render{"render", "a.gltf", "-o", "a.exr", "--size", "16x16"};
};

TEST_F(HostileGltf, ManyPrimitivesTakeLinearTime) {
  // Quadratic: each appended its 1,000 vertices to a copy of all before.
  const Outcome outcome =
      run_on(many_primitives(4000), {"info", "a.gltf", "--max-expansion", "9999"});
  EXPECT_EQ(outcome.status, 0) << outcome.err;
  EXPECT_THAT(outcome.out, HasSubstr("4000000"));
}

TEST_F(HostileGltf, ManyPrimitivesOfTheSameBytesExceedTheBudget) {
  expect_refusal(many_primitives(4000), render, "a greater --max-expansion allows it");
}

TEST_F(HostileGltf, AHundredThousandNodesAreRead) {
  json asset = triangle_asset(), nodes = json::array(), roots = json::array();
  for (int i = 0; i < 100000; ++i) {
    nodes.push_back({{"mesh", 0}, {"translation", {i % 10, i / 10 % 100, i / 1000}}});
    roots.push_back(i);
  }
  asset["nodes"] = nodes;
  asset["scenes"][0]["nodes"] = roots;
  const Outcome outcome = run_on(asset, {"info", "a.gltf", "--json"});
  EXPECT_EQ(outcome.status, 0) << outcome.err;
  EXPECT_THAT(outcome.out.substr(0, 500), HasSubstr("100000"));
}

TEST_F(HostileGltf, AChainOfAHundredThousandNodesIsRefused) {
  json asset = triangle_asset(), nodes = json::array();
  for (int i = 0; i < 100000; ++i) nodes.push_back({{"children", {i + 1}}});
  nodes.push_back({{"mesh", 0}});
  asset["nodes"] = nodes;
  expect_refusal(asset, render, "nested more than 200 deep");
}

TEST_F(HostileGltf, FiftyThousandBuffersAreRead) {
  json asset = triangle_asset(), primitives = json::array();
  const json buffer = asset["buffers"][0], accessor = asset["accessors"][0];
  for (const char* list : {"buffers", "bufferViews", "accessors"}) asset[list] = json::array();
  for (int i = 0; i < 50000; ++i) {
    asset["buffers"].push_back(buffer);
    asset["bufferViews"].push_back({{"buffer", i}, {"byteLength", 36}});
    asset["accessors"].push_back(accessor);
    asset["accessors"].back()["bufferView"] = i;
    primitives.push_back({{"attributes", {{"POSITION", i}}}});
  }
  asset["meshes"][0]["primitives"] = primitives;
  const Outcome outcome = run_on(asset, info);
  EXPECT_EQ(outcome.status, 0) << outcome.err;
  EXPECT_THAT(outcome.out, HasSubstr("150000"));
}

json overflowing() {
  json asset = triangle_asset();
  asset["nodes"] = {{{"scale", {1e300, 1e300, 1e300}}, {"children", {1, 2}}},
                    {{"mesh", 0}, {"name", "small"}},
                    {{"mesh", 0}, {"name", "huge"}, {"scale", {1e300, 1, 1}}}};
  return asset;
}

TEST_F(HostileGltf, AnOverflowingTransformIsAnUnusableInput) {
  const std::string said = "object huge: reaches beyond the largest binary64 number";
  expect_refusal(overflowing(), render, said);
  expect_refusal(overflowing(), {"camera", "orbit", "a.gltf", "--views", "2"}, said);
  json asset = overflowing();
  // Each number is finite, but no camera sees them all.
  asset["nodes"] = {{{"mesh", 0}, {"name", "wide"}, {"scale", {1.7e308, 1, 1}}}};
  expect_refusal(asset, render, "object wide: no camera with finite numbers");
}

TEST_F(HostileGltf, AnOverflowingTransformIsRenderedWhereACameraIsGiven) {
  folder.write("camera.json",
               R"({"width":8,"height":6,"fx":4,"fy":4,"cx":4,"cy":3,"pixel_centre":0.5,
                "world_to_camera":[[1,0,0,0],[0,1,0,0],[0,0,1,0]]})");
  const Outcome outcome = run_on(overflowing(), {"render", "a.gltf", "--camera", "camera.json",
                                                 "-o", "a.exr", "--verify", "all"});
  EXPECT_EQ(outcome.status, 0) << outcome.err;
}

/// A mesh below so many nodes, each of which is placed like this in the one before.
json nested(int count, const json& placement) {
  json asset = triangle_asset(), nodes = json::array();
  for (int i = 0; i < count; ++i) {
    json node = placement;
    if (i + 1 < count) node["children"] = {i + 1};
    nodes.push_back(node);
  }
  nodes.back()["mesh"] = 0;
  asset["nodes"] = nodes;
  return asset;
}

TEST_F(HostileGltf, TransformsBeyondAllBoundsAreRefused) {
  // Every pixel took milliseconds: exact numbers of 200,000 bits.
  const auto placed = [](double size) {
    return nested(190, {{"matrix", {size, 0, 0, 0, 0, size, 0, 0, 0, 0, size, 0, 1, 1, 1, 1}}});
  };
  for (const auto& command : {render, info}) {
    expect_refusal(
        placed(0x1p1000), command,
        "object node 189: is placed by a transform that reaches 2^190000, beyond 2^2048");
    expect_refusal(placed(0x1p-1000), command,
                   "object node 189: is placed by a transform of 190001 bits, more than 40000");
  }
}

TEST_F(HostileGltf, RotationsAndScalingsAtTheGreatestDepthAreRendered) {
  const json placement = {{"rotation", {0.048772580504032, 0, 0, 0.998809853231821}},
                          {"translation", {0.001, 0.002, 0.003}},
                          {"scale", {1.01, 0.99, 1.001}}};
  const Outcome outcome = run_on(nested(200, placement), render);
  EXPECT_EQ(outcome.status, 0) << outcome.err;
}

TEST_F(HostileGltf, NumbersOfTransformsAreFinite) {
  for (const char* key : {"scale", "translation", "rotation", "matrix"}) {
    std::string text = triangle_asset().dump();
    const std::string node = R"("nodes":[{"mesh":0)";
    for (const char* number : {"1e999", "-1e999", "NaN", "Infinity"}) {
      std::string bad = text;
      bad.insert(bad.find(node) + node.size(),
                 ",\"" + std::string(key) + "\":[" + number + ",0,0]");
      folder.write("a.gltf", bad);
      const Outcome outcome = run_fathom(render, {.folder = folder.path()});
      EXPECT_EQ(outcome.status, 3) << bad;
      EXPECT_THAT(outcome.err, HasSubstr("fathom: error: a.gltf: "));
    }
  }
}

TEST_F(HostileGltf, FilesOutsideItsFolderAreReadOnlyWhereAskedFor) {
  folder.write("secret.bin", "TopSecret");
  std::filesystem::create_directory(folder / "asset");
  const auto run_uri = [&](const std::string& uri, std::vector<std::string> arguments) {
    json asset = triangle_asset();
    asset["buffers"][0]["uri"] = uri;
    folder.write("asset/a.gltf", asset.dump());
    arguments.insert(arguments.begin(), {"info", "asset/a.gltf"});
    return run_fathom(arguments, {.folder = folder.path()});
  };
  for (const std::string& uri :
       {std::string("../secret.bin"), std::string("%2e%2e/secret.bin"), folder / "secret.bin",
        std::string("/proc/self/environ"), std::string("..\\secret.bin")}) {
    const Outcome refused = run_uri(uri, {});
    EXPECT_EQ(refused.status, 3) << uri;
    EXPECT_THAT(refused.err, AllOf(HasSubstr("fathom: error: asset/a.gltf: buffers[0].uri: "),
                                   HasSubstr("--outside-files"), Not(HasSubstr("TopSecret"))));
  }
  const Outcome asked = run_uri("../secret.bin", {"--outside-files"});
  EXPECT_EQ(asked.status, 3);
  EXPECT_THAT(asked.err,
              AllOf(HasSubstr("is said to have 36 bytes, found 9"), Not(HasSubstr("TopSecret"))));
  folder.write("secret.bin", std::string(36, '\0'));
  EXPECT_EQ(run_uri("../secret.bin", {"--outside-files"}).status, 0);
}

}  // namespace
}  // namespace fathom::test
