// Every line of "bad input" for meshes, scenes and cameras: the exit status is 3, standard error
// has exactly one line that names the file, an older output is as it was, nothing is left behind.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cstring>
#include <limits>

#include "tests/apps/run_program.h"
#include "tests/apps/sample_files.h"
#include "tests/apps/test_folder.h"

namespace fathom::test {
namespace {

using ::testing::HasSubstr;
using ::testing::Not;
using ::testing::StartsWith;

struct BadInput {
  std::string name;
  /// The file at fault, its content, and a part of what has to be said about it.
  std::string file, content, said;
};

void PrintTo(const BadInput& input, std::ostream* stream) {
  *stream << input.name;
}

std::size_t lines_of(const std::string& text) {
  return static_cast<std::size_t>(std::count(text.begin(), text.end(), '\n'));
}

std::string little_endian(std::uint32_t value) {
  std::string bytes(4, '\0');
  std::memcpy(bytes.data(), &value, 4);
  return bytes;
}

std::string little_endian(float value) {
  std::uint32_t bits = 0;
  std::memcpy(&bits, &value, 4);
  return little_endian(bits);
}

const std::string ply_start = "ply\nformat binary_little_endian 1.0\n";
const std::string ply_vertex_properties = "property float x\nproperty float y\nproperty float z\n";
const std::string ply_face_properties = "property list uchar int vertex_indices\nend_header\n";

std::string binary_ply(const std::string& vertex_count, const std::string& face_count) {
  return ply_start + "element vertex " + vertex_count + "\n" + ply_vertex_properties +
         "element face " + face_count + "\n" + ply_face_properties;
}

std::string three_points(float first = 0) {
  std::string bytes;
  for (const float x : {first, 0.F, 2.F, 1.F, 0.F, 2.F, 0.F, 1.F, 2.F}) bytes += little_endian(x);
  return bytes;
}

std::string face(std::uint32_t a, std::uint32_t b, std::uint32_t c) {
  return '\3' + little_endian(a) + little_endian(b) + little_endian(c);
}

std::string binary_stl(std::uint32_t declared, float first) {
  return std::string(80, ' ') + little_endian(declared) + std::string(12, '\0') +
         three_points(first) + std::string(2, '\0');
}

const float nan = std::numeric_limits<float>::quiet_NaN();
const float infinity = std::numeric_limits<float>::infinity();

const std::string nul(1, '\0');

std::vector<BadInput> bad_meshes() {
  const std::string points = "v 0 0 2\nv 1 0 2\nv 0 1 2\n";
  return {
      {"ObjIndexOutOfRange", "bad.obj", points + "f 1 2 4\n", "line 4"},
      {"ObjNegativeIndexOutOfRange", "bad.obj", points + "f 1 2 -4\n", "line 4"},
      {"ObjIndexZero", "bad.obj", points + "f 0 1 2\n", "line 4"},
      {"ObjNan", "bad.obj", "v 0 nan 2\n" + points + "f 1 2 3\n", "line 1"},
      {"ObjInfinity", "bad.obj", points + "v inf 0 0\nf 1 2 3\n", "line 4"},
      {"ObjOverflow", "bad.obj", points + "v 1e999 0 0\nf 1 2 3\n", "line 4"},
      {"ObjTruncatedVertex", "bad.obj", points + "f 1 2 3\nv 1 2", "line 5"},
      {"ObjGarbageNumber", "bad.obj", points + "v 1 2 x\nf 1 2 3\n", "line 4"},
      {"ObjEmpty", "bad.obj", "# nothing\n", "bad.obj"},
      {"ObjWithoutFaces", "bad.obj", points, "bad.obj"},
      {"PlyTruncatedBinary", "bad.ply", binary_ply("3", "1") + three_points() + "\3\0", "bad.ply"},
      {"PlyTruncatedHeader", "bad.ply", ply_start + "element vertex 3\n", "bad.ply"},
      {"PlyFourBillionFaces", "bad.ply",
       binary_ply("3", "4000000000") + three_points() + std::string(800, '\3'), "bad.ply"},
      {"PlyFourBillionVertices", "bad.ply", binary_ply("4000000000", "1") + std::string(800, '\0'),
       "bad.ply"},
      {"PlyCountBeyond64Bits", "bad.ply", binary_ply("99999999999999999999", "1"), "bad.ply"},
      {"PlyNan", "bad.ply", binary_ply("3", "1") + three_points(nan) + face(0, 1, 2), "bad.ply"},
      {"PlyIndexOutOfRange", "bad.ply", binary_ply("3", "1") + three_points() + face(0, 1, 3),
       "bad.ply"},
      {"PlyUnknownFormat", "bad.ply", "ply\nformat morse 1.0\nend_header\n", "bad.ply"},
      {"PlyAsciiTruncated", "bad.ply",
       "ply\nformat ascii 1.0\nelement vertex 3\n" + ply_vertex_properties + "element face 1\n" +
           ply_face_properties + "0 0 2\n1 0 2\n",
       "bad.ply"},
      {"StlTruncated", "bad.stl", binary_stl(1, 0).substr(0, 120), "bad.stl"},
      {"StlFourBillionFaces", "bad.stl", binary_stl(4000000000U, 0), "bad.stl"},
      {"StlInfinity", "bad.stl", binary_stl(1, infinity), "bad.stl"},
      {"StlAsciiTruncated", "bad.stl",
       "solid s\nfacet normal 0 0 1\nouter loop\nvertex 0 0 2\nvertex 1 0 2\n", "bad.stl"},
      {"OffFourBillionFaces", "bad.off", "OFF\n3 4000000000 0\n0 0 2\n1 0 2\n0 1 2\n3 0 1 2\n",
       "bad.off"},
      {"OffTruncated", "bad.off", "OFF\n3 1 0\n0 0 2\n1 0 2\n", "bad.off"},
      {"OffIndexOutOfRange", "bad.off", "OFF\n3 1 0\n0 0 2\n1 0 2\n0 1 2\n3 0 1 3\n", "line 6"},
      {"GlbTruncated", "bad.glb", std::string("glTF\2\0\0\0\xff\xff\0\0", 12), "bad.glb"},
      {"GltfNoJson", "bad.gltf", "{\"asset\": {\"version\": \"2.0\"}, \"meshes\": [", "bad.gltf"},
      {"GltfHugeAccessor", "bad.gltf",
       R"({"asset":{"version":"2.0"},"scenes":[{"nodes":[0]}],"scene":0,"nodes":[{"mesh":0}],
          "meshes":[{"primitives":[{"attributes":{"POSITION":0}}]}],
          "accessors":[{"componentType":5126,"count":4000000000,"type":"VEC3","bufferView":0}],
          "bufferViews":[{"buffer":0,"byteLength":36}],
          "buffers":[{"byteLength":36,"uri":"data:application/octet-stream;base64,AAAA"}]})",
       "bad.gltf"},
      {"Binary", "bad.obj", std::string("\0\1\2\xff\xfe", 5), "bad.obj"},
      {"SceneUnknownKey", "bad.json", R"({"meshes": [{"file": "square.obj", "scale": 2}]})",
       "scale"},
      {"SceneMissingFile", "bad.json", R"({"meshes": [{"file": "nowhere.obj"}]})", "nowhere.obj"},
      {"SceneWithNulBehindIt", "bad.json", R"({"meshes": [{"file": "square.obj"}]})" + nul,
       "bad.json: line 1: not JSON: a NUL character"},
      {"SceneNoJson", "bad.json", R"({"meshes": [)", "bad.json"},
      {"SceneTransformTooShort", "bad.json",
       R"({"meshes": [{"file": "square.obj", "transform": [[1,0,0,0],[0,1,0,0]]}]})", "transform"},
      {"SceneTransformText", "bad.json",
       R"({"meshes": [{"file": "square.obj", "transform": "flat"}]})", "transform"},
  };
}

std::vector<BadInput> bad_cameras() {
  return {
      {"UnknownKey", "bad.json", camera_with("focal", "4"), "focal"},
      {"ZeroWidth", "bad.json", camera_with("width", "0"), "width"},
      {"NegativeHeight", "bad.json", camera_with("height", "-6"), "height"},
      {"FractionalWidth", "bad.json", camera_with("width", "8.5"), "width"},
      {"MissingWidth", "bad.json", R"({"height": 6, "fx": 4, "fy": 4, "cx": 4, "cy": 3})", "width"},
      {"ZeroFocalLength", "bad.json", camera_with("fx", "0"), "fx"},
      {"TextFocalLength", "bad.json", camera_with("fx", "\"long\""), "fx"},
      {"Overflow", "bad.json", camera_with("cx", "1e999"), "bad.json"},
      {"NotANumber", "bad.json", camera_with("cx", "NaN"), "bad.json"},
      {"Singular", "bad.json", camera_with("world_to_camera", "[[1,2,3,0],[2,4,6,0],[0,0,1,0]]"),
       "bad.json"},
      {"MatrixTooShort", "bad.json", camera_with("world_to_camera", "[[1,0,0,0]]"),
       "world_to_camera"},
      {"NearBeyondFar", "bad.json", camera_with("far", "1, \"near\": 2"), "far"},
      {"NegativeNear", "bad.json", camera_with("near", "-1"), "near"},
      {"UnknownProjection", "bad.json", camera_with("projection", "\"fisheye\""), "projection"},
      {"NoJson", "bad.json", "{\"width\": 8,", "bad.json"},
      {"NulBehindIt", "bad.json", camera_with("cx", "4") + nul + "{",
       "bad.json: line 1: not JSON: a NUL character"},
      {"NulWithinIt", "bad.json", "{\n\"width\": 8," + nul + "}",
       "bad.json: line 2: not JSON: a NUL character"},
      {"Empty", "bad.json", "", "bad.json"},
      {"EmptyList", "bad.json", "[]", "bad.json"},
  };
}

/// Runs `arguments` in a folder that holds an older map, and checks all that holds of a failure.
void expect_refusal(const TestFolder& folder, const std::vector<std::string>& arguments,
                    const std::string& said) {
  folder.write("map.exr", "older");
  const auto before = folder.names();
  RunOptions options{.folder = folder.path()};
  options.memory = rlim_t{2} << 30;
  const Outcome outcome = run_fathom(arguments, options);
  EXPECT_EQ(outcome.status, 3);
  EXPECT_EQ(outcome.out, "");
  // Warnings may come first; the failure is one line, the last.
  std::string error = outcome.err;
  while (error.starts_with("fathom: warning: ")) error.erase(0, error.find('\n') + 1);
  EXPECT_EQ(lines_of(error), 1U) << outcome.err;
  EXPECT_THAT(error, StartsWith("fathom: error: "));
  EXPECT_THAT(error, HasSubstr(said));
  EXPECT_THAT(error, Not(HasSubstr("out of memory")));
  EXPECT_EQ(folder.read("map.exr"), "older");
  EXPECT_EQ(folder.names(), before);
}

class BadMesh : public ::testing::TestWithParam<BadInput> {};

TEST_P(BadMesh, IsRefusedInOneLine) {
  const TestFolder folder;
  folder.write("square.obj", square_obj);
  folder.write(GetParam().file, GetParam().content);
  expect_refusal(folder, {"render", GetParam().file, "-o", "map.exr"}, GetParam().said);
}

INSTANTIATE_TEST_SUITE_P(All, BadMesh, ::testing::ValuesIn(bad_meshes()),
                         [](const auto& test) { return test.param.name; });

class BadCamera : public ::testing::TestWithParam<BadInput> {};

TEST_P(BadCamera, IsRefusedInOneLine) {
  const TestFolder folder;
  folder.write("square.obj", square_obj);
  folder.write(GetParam().file, GetParam().content);
  expect_refusal(folder, {"render", "square.obj", "--camera", GetParam().file, "-o", "map.exr"},
                 GetParam().said);
}

INSTANTIATE_TEST_SUITE_P(All, BadCamera, ::testing::ValuesIn(bad_cameras()),
                         [](const auto& test) { return test.param.name; });

TEST(BadInput, DirectoryAsMesh) {
  const TestFolder folder;
  std::filesystem::create_directory(folder / "mesh.obj");
  expect_refusal(folder, {"render", "mesh.obj", "-o", "map.exr"}, "mesh.obj");
}

TEST(BadInput, DirectoryAsCamera) {
  const TestFolder folder;
  folder.write("square.obj", square_obj);
  std::filesystem::create_directory(folder / "camera.json");
  expect_refusal(folder, {"render", "square.obj", "--camera", "camera.json", "-o", "map.exr"},
                 "camera.json");
}

TEST(BadInput, MissingMesh) {
  expect_refusal(TestFolder(), {"render", "nowhere.obj", "-o", "map.exr"}, "nowhere.obj");
}

TEST(BadInput, ImageBeyondMemory) {
  const TestFolder folder;
  folder.write("square.obj", square_obj);
  std::string camera = camera_with("width", "1000000000");
  camera.replace(camera.find("\"height\":6"), 10, "\"height\":1000000000");
  folder.write("huge.json", camera);
  expect_refusal(folder, {"render", "square.obj", "--camera", "huge.json", "-o", "map.exr"}, "GB");
}

// The map takes 480 MB; its six rows are compressed together.
TEST(BadInput, WhatIsNeededToWriteAnImageCounts) {
  const TestFolder folder;
  folder.write("square.obj", square_obj);
  folder.write("wide.json", camera_with("width", "10000000"));
  expect_refusal(
      folder,
      {"render", "square.obj", "--camera", "wide.json", "--max-memory", "1G", "-o", "map.exr"},
      "an image of 10000000x6 pixels needs 1.9 GB; --max-memory allows 1.1 GB");
}

TEST(BadInput, SecondOfTwoMeshesIsNamed) {
  const TestFolder folder;
  folder.write("square.obj", square_obj);
  folder.write("bad.obj", "v 0 0 2\nf 1 1 2\n");
  expect_refusal(folder, {"render", "square.obj", "bad.obj", "-o", "map.exr"}, "bad.obj: line 2");
}

TEST(BadInput, NameWithANewlineStaysOneLine) {
  expect_refusal(TestFolder(), {"render", "no\nwhere.obj", "-o", "map.exr"}, "no where.obj");
}

}  // namespace
}  // namespace fathom::test
