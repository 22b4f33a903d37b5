// Lines and points of files, where they are asked for.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "fathom/failures/errors.h"
#include "fathom/scene/read_scene.h"
#include "fathom/scene/scene_fault.h"
#include "tests/scratch_folder.h"

namespace fathom {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;
using Lines = std::vector<std::array<std::uint32_t, 2>>;
using Points = std::vector<std::uint32_t>;

class LinesAndPoints : public testing::Test {
 protected:
  Mesh read(const std::string& name, const std::string& text, bool asked = true) {
    warnings.clear();
    ReadOptions options;
    options.primitives = asked;
    return read_scene({folder.write(name, text)}, options, warnings).meshes.at(0);
  }
  std::string failure(const std::string& name, const std::string& text) {
    return message_of<InputError>([&] { read(name, text); });
  }
  ScratchFolder folder;
  Warnings warnings;
};

const std::string vertices = "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 1 1 1\n";

TEST_F(LinesAndPoints, OfObj) {
  const std::string text = vertices + "vt 0 0\nf 1 2 3\nl 1 2 4\np 3\nl 1/1 -1\np 1 2 4\n";
  const Mesh mesh = read("a.obj", text);
  EXPECT_EQ(mesh.lines, (Lines{{0, 1}, {1, 3}, {0, 3}}));
  EXPECT_EQ(mesh.points, (Points{2, 0, 1, 3}));
  EXPECT_EQ(mesh.triangles.size(), 1U);
  EXPECT_THAT(warnings, IsEmpty());
  const Mesh without = read("a.obj", text, false);
  EXPECT_TRUE(without.lines.empty() && without.points.empty());
  EXPECT_THAT(warnings, ElementsAre(HasSubstr("4 lines and points (l, p) are ignored")));
}

TEST_F(LinesAndPoints, OfObjAlone) {
  EXPECT_EQ(read("a.obj", vertices + "l 2 3\n").lines, (Lines{{1, 2}}));
  EXPECT_THAT(warnings, IsEmpty());
  EXPECT_TRUE(read("a.obj", vertices + "l 2\n").lines.empty());
  EXPECT_THAT(warnings, ElementsAre(HasSubstr("1 line of fewer than two corners is skipped"),
                                    HasSubstr("has no faces")));
}

/// Pieces of a large file are read in parallel, each into its place.
TEST_F(LinesAndPoints, OfAnObjInPieces) {
  std::string text;
  Lines lines;
  Points points;
  for (std::uint32_t i = 0; i < 60'000; ++i) {
    text += "v " + std::to_string(i) + " 0 0\nv 0 " + std::to_string(i) + " 0\nl -1 -2\np -2 -1\n";
    lines.push_back({2 * i + 1, 2 * i});
    points.insert(points.end(), {2 * i, 2 * i + 1});
  }
  ASSERT_GT(text.size(), std::size_t{2} << 20);
  const Mesh mesh = read("a.obj", text);
  EXPECT_TRUE(mesh.lines == lines);
  EXPECT_TRUE(mesh.points == points);
}

TEST_F(LinesAndPoints, OfObjOutOfRange) {
  EXPECT_THAT(failure("a.obj", vertices + "l 1 5\n"), HasSubstr("line 5: vertex index 5"));
  EXPECT_THAT(failure("a.obj", vertices + "p 0\n"), HasSubstr("line 5: vertex index 0"));
  EXPECT_THAT(failure("a.obj", vertices + "l 1 x\n"), HasSubstr("line 5"));
}

std::string ply(const std::string& edges, const std::string& rows) {
  return "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\n"
         "property float z\nelement edge 2\n" +
         edges + "end_header\n0 0 0\n1 0 0\n0 1 0\n" + rows;
}

TEST_F(LinesAndPoints, OfPly) {
  const std::string text =
      ply("property uchar red\nproperty int vertex2\nproperty int vertex1\n", "9 0 1\n9 1 2\n");
  EXPECT_EQ(read("a.ply", text).lines, (Lines{{1, 0}, {2, 1}}));
  EXPECT_TRUE(read("a.ply", text, false).lines.empty());
  EXPECT_THAT(failure("a.ply", ply("property int vertex1\nproperty int vertex2\n", "0 1\n1 3\n")),
              HasSubstr("index 3 is out of range, expected 0 to 2"));
  EXPECT_TRUE(read("a.ply", ply("property int vertex1\n", "0\n1\n")).lines.empty());
  EXPECT_THAT(warnings, testing::Contains(HasSubstr("element edge lacks vertex1 or vertex2")));
}

/// Four vertices at (0,0,0), (1,0,0), (2,0,0), (3,0,0), and a primitive of each mode.
std::string gltf(int mode) {
  return R"({"asset": {"version": "2.0"}, "scenes": [{"nodes": [0]}], "scene": 0,
    "nodes": [{"mesh": 0}],
    "meshes": [{"primitives": [{"attributes": {"POSITION": 0}, "mode": )" +
         std::to_string(mode) + R"(}]}],
    "accessors": [{"bufferView": 0, "componentType": 5121, "count": 4, "type": "VEC3",
                   "min": [0, 0, 0], "max": [3, 0, 0]}],
    "bufferViews": [{"buffer": 0, "byteLength": 16, "byteStride": 4}],
    "extensionsUsed": ["KHR_mesh_quantization"],
    "buffers": [{"byteLength": 16,
                 "uri": "data:application/octet-stream;base64,AAAAAAEAAAACAAAAAwAAAA=="}]})";
}

TEST_F(LinesAndPoints, OfGltf) {
  EXPECT_EQ(read("a.gltf", gltf(0)).points, (Points{0, 1, 2, 3}));
  EXPECT_EQ(read("a.gltf", gltf(1)).lines, (Lines{{0, 1}, {2, 3}}));
  EXPECT_EQ(read("a.gltf", gltf(2)).lines, (Lines{{0, 1}, {1, 2}, {2, 3}, {3, 0}}));
  EXPECT_EQ(read("a.gltf", gltf(3)).lines, (Lines{{0, 1}, {1, 2}, {2, 3}}));
  EXPECT_THAT(warnings, IsEmpty());
  EXPECT_TRUE(read("a.gltf", gltf(3), false).is_empty());
  EXPECT_THAT(warnings, testing::Contains(HasSubstr("1 primitive is of points or lines")));
}

TEST_F(LinesAndPoints, ThatSomebodyFilledInAreLookedAt) {
  Scene scene;
  scene.meshes.resize(1);
  scene.meshes[0].vertices.resize(3);
  scene.objects.resize(1);
  scene.meshes[0].lines = {{0, 2}};
  scene.meshes[0].points = {2};
  EXPECT_EQ(find_fault(scene), std::nullopt);
  scene.meshes[0].lines = {{0, 3}};
  EXPECT_THAT(find_fault(scene).value_or(""), HasSubstr("the end of a line is beyond"));
  scene.meshes[0].lines = {};
  scene.meshes[0].points = {3};
  EXPECT_THAT(find_fault(scene).value_or(""), HasSubstr("a point is beyond"));
}

}  // namespace
}  // namespace fathom
