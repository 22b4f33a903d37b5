// Files as other programs write them, as users meet them: `info` has the right figures and one line
// for each warning, or refuses the file in one line.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstring>
#include <nlohmann/json.hpp>

#include "tests/apps/run_program.h"
#include "tests/apps/test_folder.h"

namespace fathom::test {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;
using Json = nlohmann::json;

struct TolerantMesh {
  std::string name, file, content;
  std::size_t vertices = 0, faces = 0, triangles = 0;
  std::vector<double> lower, upper;
  /// Parts of the lines on standard error, one for each.
  std::vector<std::string> warnings;
};

void PrintTo(const TolerantMesh& mesh, std::ostream* stream) {
  *stream << mesh.name;
}

template <class T>
std::string bytes_of(T value) {
  std::string bytes(sizeof value, '\0');
  std::memcpy(bytes.data(), &value, sizeof value);
  return bytes;
}

const std::string square = "v 0 0 2\nv 1 0 2\nv 1 1 2\nv 0 1 2\n";
const std::string ply_vertices = "property float x\nproperty float y\nproperty float z\n";
const std::string facet =
    "outer loop\nvertex 0 0 2\nvertex 1 0 2\nvertex 0 1 2\nendloop\nendfacet\n";

/// A strip of four points and, after −1, one of three.
std::string strips_in_binary() {
  std::string bytes = "ply\nformat binary_little_endian 1.0\nelement vertex 4\n" + ply_vertices +
                      "element tristrips 1\nproperty list int int vertex_indices\nend_header\n";
  for (const float x : {0.F, 0.F, 2.F, 1.F, 0.F, 2.F, 0.F, 1.F, 2.F, 1.F, 1.F, 2.F})
    bytes += bytes_of(x);
  for (const int i : {8, 0, 1, 2, 3, -1, 1, 3, 2}) bytes += bytes_of(std::int32_t{i});
  return bytes;
}

std::string stl_in_binary(const std::string& behind) {
  std::string bytes = "solid by a program";
  bytes.resize(80, ' ');
  bytes += bytes_of(std::uint32_t{1}) + std::string(12, '\0');
  for (const float x : {0.F, 0.F, 2.F, 1.F, 0.F, 2.F, 0.F, 1.F, 2.F}) bytes += bytes_of(x);
  return bytes + "\xFF\x7F" + behind;
}

const std::vector<double> low{0, 0, 2}, high{1, 1, 2};

const TolerantMesh meshes[] = {
    {"ObjWithoutItsNormals",
     "a.obj",
     square + "f 1//1 2//1 3//1 4//1\n",
     4,
     1,
     2,
     low,
     high,
     {"4 corners name a normal that is not in the file, the first on line 5"}},
    {"ObjWithoutItsTexture",
     "a.obj",
     square + "vt 0 0\nf 1/1 2/2 3/3 4/4\n",
     4,
     1,
     2,
     low,
     high,
     {"3 corners name a texture coordinate that is not in the file, the first on line 6"}},
    {"ObjIndexZeroOfAttributes",
     "a.obj",
     square + "vt 0 0\nvn 0 0 1\nf 1/0/0 2/0/0 3/0/0\n",
     4,
     1,
     1,
     low,
     high,
     {"3 corners name a texture coordinate", "3 corners name a normal"}},
    {"ObjColoursOfNan",
     "a.obj",
     "v 0 0 2 nan nan nan\nv 1 0 2 0 0 inf\nv 1 1 2 1\nf 1 2 3\n",
     3,
     1,
     1,
     low,
     high,
     {"2 vertices have numbers behind x, y, z"}},
    {"ObjHalfAColour",
     "a.obj",
     "v 0 0 2 1 1\nv 1 0 2 1 1\nv 1 1 2 1 1\nf 1 2 3\n",
     3,
     1,
     1,
     low,
     high,
     {"3 vertices have numbers behind x, y, z"}},
    {"ObjInThePlane",
     "a.obj",
     "v 0 0\nv 1 0\nv 1 1\nf 1 2 3\n",
     3,
     1,
     1,
     {0, 0, 0},
     {1, 1, 0},
     {"its 3 vertices have two coordinates: read with z = 0"}},
    {"ObjWeights",
     "a.obj",
     "v 0 0 4 2\nv 3 0 6 3\nv -1 -1 -2 -1\nf 1 2 3\n",
     3,
     1,
     1,
     low,
     high,
     {"3 vertices have a weight w other than 1, the first on line 1"}},
    {"ObjOtherElements",
     "a.obj",
     "mtllib\n" + square + "usemtl\np 1\nl 1 2\ncurv 0 1 1 2\nf 1 2 3 \\\n 4 # all\n\f\n" +
         std::string(1, '\0'),
     4,
     1,
     2,
     low,
     high,
     {"2 lines and points (l, p) are ignored", "unknown keyword 'curv'"}},
    {"PlyWordsOnOneLine",
     "a.ply",
     "ply\nformat ascii 1.0\nelement vertex 3\n" + ply_vertices +
         "element face 1\nproperty list uchar int vertex_indices\nend_header\n"
         "0 0 2 1 0 2 1 1 2 3 0 1 2\n",
     3,
     1,
     1,
     low,
     high,
     {}},
    {"PlyOfBlender24",
     "a.ply",
     "ply\nformat ascii 1.0\nCreated by Blender3D 247 - www.blender.org, source file: \n"
     "element vertex 3\n" +
         ply_vertices +
         "element face 1\nproperty list uchar int vertex_indices\nend_header\n"
         "0 0 2\n1 0 2\n1 1 2\n3 0 1 2\n",
     3,
     1,
     1,
     low,
     high,
     {"1 line of the header begins with no keyword and is ignored, the first is line 3"}},
    {"PlyStripsInText",
     "a.ply",
     "ply\nformat ascii 1.0\nelement vertex 4\n" + ply_vertices +
         "element tristrips 1\nproperty list int int vertex_indices\nend_header\n"
         "0 0 2\n1 0 2\n0 1 2\n1 1 2\n8 0 1 2 3 -1 1 3 2\n",
     4,
     3,
     3,
     low,
     high,
     {}},
    {"PlyStripsInBinary", "a.ply", strips_in_binary(), 4, 3, 3, low, high, {}},
    {"OffColoursWithoutC",
     "a.off",
     "OFF\n3 1 0\n0 0 2 255 0 0\n1 0 2 0 255 0\n1 1 2 0 0 255\n3 0 1 2 0.5 0.5 0.5\n",
     3,
     1,
     1,
     low,
     high,
     {}},
    {"OffFacesOverLines",
     "a.off",
     "OFF\n3 1 0\n0 0 2\n1 0 2\n1 1 2\n3\n0 1\n2\n",
     3,
     1,
     1,
     low,
     high,
     {}},
    {"OffVerticesOverLines",
     "a.off",
     "OFF\n3 1 0\n0 0\n2 1 0\n2\n1 1 2\n3 0 1 2\n",
     3,
     1,
     1,
     low,
     high,
     {}},
    {"OffCountsBehindKeyword",
     "a.off",
     "OFF3 1 0\n0 0 2\n1 0 2\n1 1 2\n3 0 1 2\n",
     3,
     1,
     1,
     low,
     high,
     {}},
    {"OffNumbersBehindPoints",
     "a.off",
     "OFF\n3 1 0\n0 0 2 7\n1 0 2 7\n1 1 2 7\n3 0 1 2\n",
     3,
     1,
     1,
     low,
     high,
     {"3 vertices have numbers behind x, y, z that are no colour"}},
    {"StlWithoutNormals",
     "a.stl",
     "solid\nfacet\n" + facet + "endsolid\n",
     3,
     1,
     1,
     low,
     high,
     {"1 facet has no normal of three numbers, on line 2"}},
    {"StlWithoutEndsolid",
     "a.stl",
     "solid\nfacet normal 0 0 1\n" + facet,
     3,
     1,
     1,
     low,
     high,
     {"the file ends without endsolid"}},
    {"StlWithComments",
     "a.stl",
     "# by hand\nSOLID of\n; one\nfacet normal -1.#IND 0 1.0D+00 // flat\n" + facet + "endsolid\n",
     3,
     1,
     1,
     low,
     high,
     {}},
    {"StlBinaryWithColours", "a.stl", stl_in_binary(""), 3, 1, 1, low, high, {}},
    {"StlBinaryWithMore",
     "a.stl",
     stl_in_binary("more"),
     3,
     1,
     1,
     low,
     high,
     {"4 bytes after the last triangle are ignored"}},
};

std::vector<std::string> lines_of(std::string text) {
  std::vector<std::string> lines;
  for (std::size_t end = text.find('\n'); end != text.npos; end = text.find('\n')) {
    lines.push_back(text.substr(0, end));
    text.erase(0, end + 1);
  }
  if (!text.empty()) lines.push_back("no line: " + text);
  return lines;
}

void expect_warnings(const std::string& said, const TolerantMesh& mesh) {
  const std::vector<std::string> lines = lines_of(said);
  ASSERT_EQ(lines.size(), mesh.warnings.size()) << said;
  for (std::size_t i = 0; i < lines.size(); ++i) {
    EXPECT_THAT(lines[i], ::testing::StartsWith("fathom: warning: " + mesh.file + ": "));
    EXPECT_THAT(lines[i], HasSubstr(mesh.warnings[i]));
  }
}

class TolerantMeshes : public ::testing::TestWithParam<TolerantMesh> {};

TEST_P(TolerantMeshes, AreReadWithTheirFigures) {
  const TolerantMesh& mesh = GetParam();
  const TestFolder folder;
  folder.write(mesh.file, mesh.content);
  const Outcome outcome = run_fathom({"info", mesh.file, "--json"}, {.folder = folder.path()});
  ASSERT_EQ(outcome.status, 0) << outcome.err;
  const Json answer = Json::parse(outcome.out);
  EXPECT_EQ(answer["vertices"], mesh.vertices);
  EXPECT_EQ(answer["faces"], mesh.faces);
  EXPECT_EQ(answer["triangles"], mesh.triangles);
  EXPECT_EQ(answer["bounds"], (Json{mesh.lower, mesh.upper}));
  expect_warnings(outcome.err, mesh);
}

/// What needs no attribute says the same as what does.
TEST_P(TolerantMeshes, AreDrawnByThePipelineToo) {
  const TolerantMesh& mesh = GetParam();
  if (mesh.lower[2] == 0) GTEST_SKIP() << "the plane z = 0 is seen edge on or not at all";
  const TestFolder folder;
  folder.write(mesh.file, mesh.content);
  const Outcome outcome =
      run_fathom({"render", mesh.file, "--engine", "pipeline", "--size", "16x16", "-o", "a.exr"},
                 {.folder = folder.path()});
  EXPECT_EQ(outcome.status, 0) << outcome.err;
}

INSTANTIATE_TEST_SUITE_P(All, TolerantMeshes, ::testing::ValuesIn(meshes),
                         [](const auto& test) { return test.param.name; });

/// A stream of triangle strips gives the map of the ordinary reader, bit for bit.
TEST(TolerantMeshes, StripsAreStreamedAlike) {
  const TestFolder folder;
  folder.write("a.ply", strips_in_binary());
  const RunOptions options{.folder = folder.path()};
  for (const std::string name : {"whole.pfm", "streamed.pfm"}) {
    std::vector<std::string> arguments{"render", "a.ply", "--size", "32x32", "-o", name};
    if (name == "streamed.pfm") arguments.emplace_back("--stream");
    const Outcome outcome = run_fathom(arguments, options);
    ASSERT_EQ(outcome.status, 0) << outcome.err;
  }
  EXPECT_EQ(folder.read("whole.pfm"), folder.read("streamed.pfm"));
}

struct WrongFile {
  std::string name, file, content, said;
};

void PrintTo(const WrongFile& wrong, std::ostream* stream) {
  *stream << wrong.name;
}

const WrongFile wrong_files[] = {
    {"ObjVertexBesideNormal", "a.obj", square + "f 1//9 2//9 9//9\n",
     "a.obj: line 5: vertex index 9"},
    {"ObjWeightZero", "a.obj", "v 1 2 3 0\n", "a.obj: line 1: a weight w of 0"},
    {"ObjWeightTooSmall", "a.obj", square + "v 1e300 0 0 1e-300\n",
     "a.obj: line 5: x/w is too large"},
    {"ObjOneVertexInThePlane", "a.obj", square + "v 1 2\nf 1 2 5\n",
     "a.obj: line 5: expected coordinate z"},
    {"ObjInUtf16", "a.obj", std::string("\xFF\xFEv\0 \0\x30\0", 8), "a.obj: is text in UTF-16"},
    {"PlyAWordTooFew", "a.ply",
     "ply\nformat ascii 1.0\nelement vertex 3\n" + ply_vertices +
         "element face 1\nproperty list uchar int vertex_indices\nend_header\n"
         "0 0 2 1 0 2 1 1 2 3 0 1\n",
     "a.ply: line 10: expected the line to end"},
    {"OffBinary", "a.off", "OFF BINARY\n", "a.off: line 1: binary OFF is not supported"},
    {"OffFourDimensions", "a.off", "4OFF\n1 0 0\n0 0 0 1\n",
     "a.off: line 1: 4OFF is not supported"},
    {"StlFourCorners", "a.stl",
     "solid\nfacet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex 1 0 0\nvertex 1 1 0\n"
     "vertex 0 1 0\nendloop\nendfacet\nendsolid\n",
     "a.stl: line 7: expected 'endloop'"},
    {"StlBinaryCutShort", "a.stl", stl_in_binary("").substr(0, 133),
     "a.stl: byte 133: the file ends"},
};

class WrongFiles : public ::testing::TestWithParam<WrongFile> {};

TEST_P(WrongFiles, AreRefusedInOneLine) {
  const WrongFile& wrong = GetParam();
  const TestFolder folder;
  folder.write(wrong.file, wrong.content);
  const Outcome outcome = run_fathom({"info", wrong.file, "--json"}, {.folder = folder.path()});
  EXPECT_EQ(outcome.status, 3);
  EXPECT_EQ(outcome.out, "");
  EXPECT_THAT(lines_of(outcome.err), ElementsAre(HasSubstr("fathom: error: " + wrong.said)));
}

INSTANTIATE_TEST_SUITE_P(All, WrongFiles, ::testing::ValuesIn(wrong_files),
                         [](const auto& test) { return test.param.name; });

}  // namespace
}  // namespace fathom::test
