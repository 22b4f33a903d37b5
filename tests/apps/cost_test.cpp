// Small files that would cost much: time, memory, or the stack.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <nlohmann/json.hpp>

#include "fathom/image/map_files.h"
#include "run_program.h"
#include "sample_files.h"
#include "small_cost.h"
#include "test_folder.h"

namespace fathom::test {
namespace {

using ::testing::HasSubstr;

/// Lists in lists, far more than a stack holds of calls.
std::string nested_lists() {
  constexpr std::size_t depth = 100'000;
  return std::string(depth, '[') + std::string(depth, ']');
}

/// {"0":0,"1":0,…}
std::string object_of(int keys) {
  std::string text = "{";
  for (int i = 0; i < keys; ++i) text += (i == 0 ? "\"" : ",\"") + std::to_string(i) + "\":0";
  return text + "}";
}

/// A map of one pixel that carries a text.
void write_map_with(const std::string& file, const std::string& key, const std::string& text) {
  DepthMap map;
  map.width = map.height = 1;
  const bool png = file.ends_with(".png");
  if (png) {
    map.channels.push_back({"Z", Samples<std::uint16_t>(1)});
    map.png_scale = 1000;
  } else {
    map.channels.push_back({"Z", Samples<float>(1)});
  }
  map.texts[key] = text;
  write_map(map, file, png ? MapFormat::png : MapFormat::exr);
}

class TextInAMap : public ::testing::TestWithParam<std::string> {};

TEST_P(TextInAMap, NestedJsonIsAnyText) {
  const TestFolder folder;
  const std::string file = GetParam();
  for (const char* key : {"fathom.camera", "fathom.sources", "fathom.objects", "anything"}) {
    write_map_with(folder / file, key, nested_lists());
    for (const bool json : {false, true}) {
      std::vector<std::string> arguments{"info", file};
      if (json) arguments.emplace_back("--json");
      const Outcome outcome = run_fathom(arguments, at_small_cost(folder));
      EXPECT_EQ(outcome.status, 0) << key << outcome.err;
      EXPECT_THAT(outcome.out, HasSubstr("Z")) << key;
    }
  }
}

TEST_P(TextInAMap, NestedCameraIsRefused) {
  const TestFolder folder;
  write_map_with(folder / GetParam(), "fathom.camera", nested_lists());
  const Outcome outcome =
      run_fathom({"convert", GetParam(), "-o", "points.ply"}, at_small_cost(folder));
  expect_one_line(outcome, 3);
  EXPECT_THAT(outcome.err, HasSubstr("fathom.camera: nested more than 100 deep"));
}

TEST_P(TextInAMap, ManyKeysAreRead) {
  const TestFolder folder;
  write_map_with(folder / GetParam(), "fathom.camera", object_of(200'000));
  const Outcome outcome = run_fathom({"info", GetParam(), "--json"}, at_small_cost(folder));
  ASSERT_EQ(outcome.status, 0) << outcome.err;
  EXPECT_EQ(nlohmann::json::parse(outcome.out)["attributes"]["fathom.camera"].size(), 200'000U);
}

INSTANTIATE_TEST_SUITE_P(EachFormat, TextInAMap, ::testing::Values("map.png", "map.exr"),
                         [](const auto& test) { return test.param.substr(4); });

TEST(JsonCost, NestedFilesAreRefused) {
  const TestFolder folder;
  folder.write("square.obj", square_obj);
  folder.write("nested.json", nested_lists());
  folder.write("object.json", "{\"a\":" + nested_lists() + "}");
  folder.write("scene.json", "{\"meshes\":" + nested_lists() + "}");
  folder.write("asset.gltf", "{\"asset\":" + nested_lists() + "}");
  for (const char* file : {"nested.json", "object.json", "scene.json", "asset.gltf"}) {
    const Outcome outcome = run_fathom({"info", file}, at_small_cost(folder));
    expect_one_line(outcome, 3);
    EXPECT_THAT(outcome.err, HasSubstr(std::string(file) + ": nested more than 100 deep"));
  }
  for (const char* scene : {"scene.json", "asset.gltf"})
    expect_one_line(run_fathom({"render", scene, "-o", "map.exr"}, at_small_cost(folder)), 3);
  expect_one_line(run_fathom({"render", "square.obj", "--camera", "nested.json", "-o", "map.exr"},
                             at_small_cost(folder)),
                  3);
}

TEST(JsonCost, ManyKeysAreRead) {
  const TestFolder folder;
  folder.write("camera.json", object_of(200'000));
  const Outcome outcome = run_fathom({"info", "camera.json"}, at_small_cost(folder));
  expect_one_line(outcome, 3);
  EXPECT_THAT(outcome.err, HasSubstr("camera.json: unknown key"));
}

/// 200,000 objects in a list.
TEST(JsonCost, ManyNodesAreRead) {
  std::string nodes;
  for (int i = 0; i < 200'000; ++i) nodes += nodes.empty() ? "{}" : ",{}";
  const TestFolder folder;
  folder.write("nodes.gltf", R"({"asset":{"version":"2.0"},"nodes":[)" + nodes + "]}");
  const Outcome outcome = run_fathom({"info", "nodes.gltf"}, at_small_cost(folder));
  EXPECT_EQ(outcome.status, 0) << outcome.err;
}

/// A map of a pixel for each of 4,000 cameras.
/// A scene file that places t.obj so often.
std::string placements(int count) {
  std::string text;
  for (int i = 0; i < count; ++i)
    text += std::string(i == 0 ? R"({"meshes":[)" : ",") + R"({"file":"t.obj"})";
  return text + "]}";
}

TEST(SceneCost, ManyPlacementsAreRead) {
  const TestFolder folder;
  folder.write("t.obj", "v 0 0 1\nv 1 0 1\nv 0 1 1\nf 1 2 3\n");
  // Their triangles were counted anew with each.
  folder.write("s.json", placements(300'000));
  const Outcome outcome = run_fathom({"info", "s.json"}, at_small_cost(folder));
  EXPECT_EQ(outcome.status, 0) << outcome.err;
  EXPECT_THAT(outcome.out, HasSubstr("300000"));
}

/// Three million triangles in a scene file of 10 KB. Exact numbers of each took 40 s.
TEST(SceneCost, ProbeLooksExactlyAtFewTriangles) {
  constexpr int side = 70;
  std::string mesh, scene;
  for (int y = 0; y <= side; ++y)
    for (int x = 0; x <= side; ++x)
      mesh += "v " + std::to_string(x) + " " + std::to_string(y) + " 0.1\n";
  for (int y = 0; y < side; ++y) {
    for (int x = 0; x < side; ++x) {
      const int corner = y * (side + 1) + x + 1;
      mesh += "f " + std::to_string(corner) + " " + std::to_string(corner + 1) + " " +
              std::to_string(corner + side + 2) + " " + std::to_string(corner + side + 1) + "\n";
    }
  }
  const TestFolder folder;
  folder.write("t.obj", mesh);
  folder.write("s.json", placements(300));
  const Outcome outcome = run_fathom({"probe", "s.json", "--view", "10,20", "--size", "64x48",
                                      "--pixel", "31,22", "--max-expansion", "4000000000"},
                                     at_small_cost(folder));
  ASSERT_EQ(outcome.status, 0) << outcome.err;
  EXPECT_THAT(outcome.out, HasSubstr("299"));
}

TEST(SceneCost, TrianglesThatArePlacedTooOftenAreRefused) {
  const TestFolder folder;
  std::string mesh = "v 0 0 1\nv 1 0 1\nv 0 1 1\n";
  for (int i = 0; i < 10'000; ++i) mesh += "f 1 2 3\n";
  folder.write("t.obj", mesh);
  folder.write("s.json", placements(10'000));
  const Outcome outcome =
      run_fathom({"render", "s.json", "-o", "a.exr", "--size", "8x8"}, at_small_cost(folder));
  expect_one_line(outcome, 3);
  EXPECT_THAT(outcome.err, HasSubstr("s.json: its "));
  EXPECT_THAT(outcome.err, HasSubstr("a greater --max-expansion allows it"));
}

TEST(SceneCost, ObjectsWithLongNamesAreRefused) {
  const TestFolder folder;
  std::string nodes, roots;
  for (int i = 0; i < 10'000; ++i) {
    nodes += std::string(i == 0 ? "" : ",") + R"({"mesh":0})";
    roots += (i == 0 ? "" : ",") + std::to_string(i);
  }
  folder.write(
      "t.gltf",
      R"({"asset":{"version":"2.0"},"meshes":[{"primitives":[{"attributes":{}}]}],"nodes":[)" +
          nodes + R"(],"scenes":[{"nodes":[)" + roots + "]}]}");
  folder.write("s.json",
               R"({"meshes":[{"file":"t.gltf","name":")" + std::string(300'000, 'x') + R"("}]})");
  const Outcome outcome = run_fathom({"info", "s.json"}, at_small_cost(folder));
  expect_one_line(outcome, 3);
  EXPECT_THAT(outcome.err, HasSubstr("a greater --max-expansion allows it"));
}

TEST(CameraPathCost, OutputsAreClaimedInLinearTime) {
  const TestFolder folder;
  folder.write("square.obj", square_obj);
  std::string camera = camera_with("width", "1"), path;
  for (int i = 0; i < 4000; ++i) path += (path.empty() ? "[" : ",") + camera;
  folder.write("path.json", path + "]");
  std::filesystem::create_directory(folder / "maps");
  const Outcome outcome =
      run_fathom({"render", "square.obj", "--camera", "path.json", "-o", "maps/{index:04}.pfm"},
                 at_small_cost(folder));
  EXPECT_EQ(outcome.status, 0) << outcome.err;
  EXPECT_TRUE(std::filesystem::exists(folder / "maps/3999.pfm"));
}

/// Corners of faces whose triangles hold many others.
struct Outline {
  std::string name;
  void (*corner)(int k, int n, double& x, double& y);
};

void star_corner(int k, int n, double& x, double& y) {
  const double angle = 6.283185307179586 * k / n, radius = 1 + (k * 7919LL) % 1000 / 250.0;
  x = radius * std::cos(angle);
  y = radius * std::sin(angle);
}

void comb_corner(int k, int n, double& x, double& y) {
  x = k < n - 2 ? k : k == n - 2 ? n : -1;
  y = k >= n - 2 ? -1 : k % 2 == 0 ? 0 : 1000 + (k * 7919LL) % 13;
}

/// A road that winds inwards, and out again along its other side.
void spiral_corner(int k, int n, double& x, double& y) {
  const bool back = k >= n / 2;
  const double angle = 0.05 * (back ? n - 1 - k : k), radius = 100 + 0.2 * angle + (back ? 0.5 : 0);
  x = radius * std::cos(angle);
  y = radius * std::sin(angle);
}

class FaceCost : public ::testing::TestWithParam<Outline> {};

TEST_P(FaceCost, ManyCornersAreCut) {
  constexpr int corners = 200'000;
  std::string vertices, face = "f";
  for (int k = 0; k < corners; ++k) {
    double x = 0, y = 0;
    GetParam().corner(k, corners, x, y);
    vertices += "v " + std::to_string(x) + " " + std::to_string(y) + " 0\n";
    face += " " + std::to_string(k + 1);
  }
  const TestFolder folder;
  folder.write("face.obj", vertices + face + "\n");
  const Outcome outcome = run_fathom({"info", "face.obj"}, at_small_cost(folder));
  EXPECT_EQ(outcome.status, 0) << outcome.err;
  EXPECT_EQ(outcome.err, "");
  EXPECT_THAT(outcome.out, HasSubstr("triangles  199998"));
}

INSTANTIATE_TEST_SUITE_P(EachOutline, FaceCost,
                         ::testing::Values(Outline{"Star", star_corner},
                                           Outline{"Comb", comb_corner},
                                           Outline{"Spiral", spiral_corner}),
                         [](const auto& test) { return test.param.name; });

}  // namespace
}  // namespace fathom::test
