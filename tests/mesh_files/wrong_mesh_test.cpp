// Where tolerance ends: the geometry is wrong or in doubt, and one line says where.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "fathom/failures/errors.h"
#include "tests/inputs/mesh_text.h"
#include "tests/inputs/mesh_variants.h"
#include "tests/scratch_folder.h"

namespace fathom {
namespace {

using ::testing::HasSubstr;
using ::testing::StartsWith;

struct WrongMesh {
  std::string name, bytes, message;
};
void PrintTo(const WrongMesh& wrong, std::ostream* out) {
  *out << wrong.name;
}

class WrongMeshCase : public testing::TestWithParam<WrongMesh> {};

TEST_P(WrongMeshCase, IsRefusedWithItsPlace) {
  const WrongMesh& wrong = GetParam();
  for (const bool attributes : {false, true}) {
    const std::string message = message_of<InputError>([&] {
      Warnings warnings;
      test::read_variant({wrong.name, wrong.bytes}, warnings, attributes);
    });
    EXPECT_THAT(message, StartsWith(wrong.name + ": "));
    EXPECT_THAT(message, HasSubstr(wrong.message));
  }
}

std::string utf16(const std::string& text, bool big, bool mark) {
  std::string bytes = !mark ? "" : big ? "\xFE\xFF" : "\xFF\xFE";
  for (const char c : text) bytes += big ? std::string{'\0', c} : std::string{c, '\0'};
  return bytes;
}

const std::string obj_points = "v 0 0 0\nv 1 0 0\nv 0 1 0\n";
const std::string plane_head =
    "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\n"
    "property float z\nelement face 2\nproperty list uchar int vertex_indices\nend_header\n";
const std::string square = "0 0 0\n1 0 0\n0 1 0\n";
const std::string off_head = "OFF\n3 2 0\n";
const std::string facet = "facet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex 1 0 0\n";

const WrongMesh wrong_meshes[] = {
    // OBJ
    {"weight 0.obj", "v 1 2 3 1\nv 1 2 3 0\n", "line 2: a weight w of 0"},
    {"weight -0.obj", "v 1 2 3 -0.0\n", "line 1: a weight w of 0"},
    {"weight of nan.obj", "v 1 2 3 nan\n", "line 1: weight w is not finite"},
    {"weight of a word.obj", "v 1 2 3 one\n", "line 1: expected a weight or a colour, found 'one'"},
    {"quotient too large.obj", "v 1 1e300 3 1e-10\n", "line 1: y/w is too large"},
    {"colour of words.obj", "v 1 2 3 red green blue\n", "line 1: expected a weight or a colour"},
    {"two coordinates among three.obj", "v 0 0\nv 1 0 0\nv 0 1\n", "line 1: expected coordinate z"},
    {"one coordinate.obj", "v 0 0\nv 1\n", "line 2: expected coordinate y"},
    {"plane cut short.obj", "v 0 0\nv 1 0\nv 1 \n", "line 3: expected coordinate y"},
    {"vertex 0 beside a normal.obj", obj_points + "f 0//9 1//9 2//9\n", "line 4: vertex index 0"},
    {"vertex out of range.obj", obj_points + "f 1/9/9 2/9/9 4/9/9\n", "line 4: vertex index 4"},
    {"vertex below range.obj", obj_points + "f -1 -2 -4\n", "line 4: vertex index -4"},
    {"normal of words.obj", obj_points + "f 1//x 2//x 3//x\n", "line 4: expected a corner"},
    {"texture of a sign.obj", obj_points + "f 1/- 2/- 3/-\n", "line 4: expected a corner"},
    {"zero bytes in a word.obj", obj_points + "f 1 2 3" + std::string(3, '\0'),
     "line 4: expected a corner"},
    {"number of Windows.obj", "v 0 1.#QNAN 0\n", "line 1: coordinate y is not finite"},
    {"letter D without digits.obj", "v 0 1D 0\n", "line 1: expected coordinate y, found '1D'"},
    {"exponent of D too large.obj", "v 0 1D999 0\n", "line 1: coordinate y is too large"},
    {"UTF-16.obj", utf16(obj_points + "f 1 2 3\n", false, true), "is text in UTF-16"},
    {"UTF-16 without a mark.obj", utf16(obj_points, false, false), "is text in UTF-16"},
    {"UTF-16, big.obj", utf16(obj_points, true, true), "is text in UTF-16"},
    {"UTF-16.off", utf16(off_head, false, true), "is text in UTF-16"},
    {"UTF-16.ply", utf16(plane_head, true, true), "is text in UTF-16"},
    {"UTF-16.stl", utf16("solid\n" + facet + facet, false, true), "is text in UTF-16"},
    // PLY: as many lines as rows, one of which is not as long as it should be
    {"value missing.ply", plane_head + "0 0 0\n1 0\n0 1 0\n3 0 1 2\n3 0 1 2\n",
     "line 11: expected coordinate z, found the end of the line"},
    {"value too many.ply", plane_head + "0 0 0\n1 0 0 7\n0 1 0\n3 0 1 2\n3 0 1 2\n",
     "line 11: expected the line to end, found '7'"},
    {"index missing.ply", plane_head + square + "3 0 1\n3 0 1 2\n",
     "line 13: expected the index of a vertex, found the end of the line"},
    {"row missing.ply", plane_head + square + "3 0 1 2\n",
     "the file ends after 1 of 2 rows of element face"},
    // PLY: words that do not add up
    {"value missing in a stream.ply", plane_head + "0 0 0 1 0\n0 1 0\n3 0 1 2\n3 0 1 2\n",
     "line 10: expected the line to end, found '1'; nor is the body a stream of as many words as "
     "the header says: line 12: expected a face of at least three corners, found 0"},
    {"index in a stream.ply", plane_head + "0 0\n0 1 0 0\n0 1 0\n3 0 1 2 3 0 1 3\n",
     "line 13: index 3 is out of range"},
    {"nan in a stream.ply", plane_head + "0 0\n0 1 0 0\n0 nan 0\n3 0 1 2 3 0 1 2\n",
     "line 12: coordinate y is not finite"},
    {"words left over.ply", plane_head + "0 0 0 1 0 0 0 1 0\n3 0 1 2 3 0 1 2\n1 2 3\n",
     "line 10: expected the line to end, found '1'; nor is the body a stream of as many words as "
     "the header says: line 12: there are more words"},
    {"words missing.ply", plane_head + "0 0 0 1 0 0 0 1 0\n3 0 1 2 3 0 1\n",
     "line 12: the file ends"},
    // OFF
    {"vertex cut short.off", off_head + "0 0 0\n1 0\n0 1 0\n3 0 1 2\n3 0 1 2\n",
     "line 4: expected coordinate z, found the end of the line"},
    {"face cut short.off", off_head + square + "3 0 1 2\n3 0 1\n",
     "line 7: expected the index of a vertex, found the end of the line"},
    {"words left over.off", off_head + square + "3 0 1\n2 3 0 1\n2 7\n",
     "line 6: expected the index of a vertex, found the end of the line; nor is the body a stream "
     "of as many words as the counts say: line 8: expected the file to end, found '7'"},
    {"index in a stream.off", off_head + "0 0\n0 1\n0 0\n0 1 0\n3 0 1 2\n3 0 1 3\n",
     "line 8: index 3 is out of range, expected 0 to 2"},
    {"nan in a stream.off", off_head + "0 0\n0 1\n0 nan\n0 1 0\n3 0 1 2\n3 0 1 2\n",
     "line 5: coordinate z is not finite"},
    {"two corners in a stream.off", off_head + square + "3\n0 1 2\n2 0 1\n",
     "line 8: expected at least three corners, found 2"},
    {"colour of words.off", "OFF\n1 0 0\n0 0 0 red 0 0\n", "line 3: expected a number"},
    {"colours over lines.off",
     off_head + "0 0 0\n9 9 9\n1 0 0\n9 9 9\n0 1 0\n9 9 9\n3 0 1 2\n"
                "3 0 1 2\n",
     "line 6: index 9 is out of range"},
    {"binary.off", "OFF BINARY\n", "line 1: binary OFF is not supported"},
    {"binary in small letters.off", "off binary\n", "line 1: binary OFF is not supported"},
    {"nOFF.off", "nOFF 3\n3 1 0\n", "line 1: nOFF is not supported"},
    {"C4OFF.off", "C4OFF\n1 0 0\n0 0 0 1\n", "line 1: C4OFF is not supported"},
    // STL
    {"two corners.stl", "solid\n" + facet + "endloop\nendfacet\nendsolid\n",
     "line 6: expected 'vertex'"},
    {"four corners.stl",
     "solid\n" + facet + "vertex 1 1 0\nvertex 0 1 0\nendloop\nendfacet\nendsolid\n",
     "line 7: expected 'endloop'"},
    {"cut within a facet.stl", "solid\n" + facet + "vertex 0 1 0\nendloop\n",
     "the file ends, expected 'endfacet'"},
    {"cut within a vertex.stl", "solid\n" + facet + "vertex 0 1",
     "the file ends, expected coordinate z"},
    {"no loop.stl", "solid\nfacet normal 0 0 1\nvertex 0 0 0\n", "line 3: expected 'outer loop'"},
    {"words behind endsolid.stl", "solid\nendsolid\nmore\n", "line 3: expected 'solid' or 'facet'"},
};
INSTANTIATE_TEST_SUITE_P(All, WrongMeshCase, testing::ValuesIn(wrong_meshes), [](const auto& test) {
  std::string name = test.param.name;
  for (char& c : name)
    if (std::isalnum(static_cast<unsigned char>(c)) == 0) c = '_';
  return name;
});

/// A coordinate or an index too few is never made up for by the next row, nor is one too many.
TEST(WrongMesh, AWordTooFewOrTooMany) {
  const std::string ply =
      "ply\nformat ascii 1.0\nelement vertex 6\nproperty float x\nproperty float y\nproperty float "
      "z\nelement face 5\nproperty list uchar int vertex_indices\nend_header\n";
  const Mesh mesh = test::sample_mesh();
  std::vector<std::string> rows;
  for (const MeshPoint& p : mesh.vertices) rows.push_back(test::point(p));
  for (const auto& [a, b, c] : mesh.triangles)
    rows.push_back("3 " + std::to_string(a) + " " + std::to_string(b) + " " + std::to_string(c));
  int files = 0;
  for (const std::string& head : {ply, std::string("OFF\n6 5 0\n")}) {
    for (const char between : {'\n', ' '}) {
      for (std::size_t row = 0; row < rows.size(); ++row) {
        for (std::size_t at = rows[row].find(' '); at != std::string::npos;
             at = rows[row].find(' ', at + 1)) {
          for (const bool few : {false, true}) {
            std::string body;
            for (std::size_t i = 0; i < rows.size(); ++i) {
              std::string text = rows[i];
              const std::size_t end = text.find(' ', at + 1);
              if (i == row && few) text.erase(at, end == text.npos ? end : end - at);
              if (i == row && !few) text.insert(at, " 0");
              body += text + between;
            }
            // Behind the words of its line, a word is no coordinate and no index in an OFF.
            if (!few && head != ply && between == '\n') continue;
            Warnings warnings;
            EXPECT_THROW(
                test::read_variant({head == ply ? "a.ply" : "a.off", head + body}, warnings),
                InputError)
                << body;
            ++files;
          }
        }
      }
    }
  }
  EXPECT_EQ(files, 189);
}

}  // namespace
}  // namespace fathom
