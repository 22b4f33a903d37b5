// Files with something that cannot be used, or that the format does not have, and whose geometry is
// clear all the same.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "fathom/mesh_files/read_mesh.h"
#include "tests/inputs/mesh_habits.h"

namespace fathom {
namespace {

using test::read_variant;
using test::soup_of;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::StartsWith;

TEST(ToleratedMesh, WarnedVariantsAreTheSameMesh) {
  const Mesh truth = test::sample_mesh();
  for (const auto& [file, warning] : test::warned_variants_of(truth)) {
    for (const bool attributes : {false, true}) {
      Warnings warnings;
      Mesh mesh;
      ASSERT_NO_THROW(mesh = read_variant(file, warnings, attributes)) << file.name;
      EXPECT_THAT(warnings, ElementsAre(HasSubstr(warning))) << file.name;
      EXPECT_THAT(warnings, ElementsAre(StartsWith(file.name + ": "))) << file.name;
      for (const std::string& line : warnings) EXPECT_EQ(line.find('\n'), line.npos);
      if (file.name == "one texture coordinate out of range.obj") {
        EXPECT_EQ(mesh.triangles.size(), 6U);
        continue;
      }
      EXPECT_EQ(soup_of(mesh), soup_of(truth)) << file.name;
      EXPECT_EQ(mesh.face_count, 5U) << file.name;
      EXPECT_TRUE(mesh.face_of_triangle.empty()) << file.name;
    }
  }
}

/// The mesh, and its warnings through `warnings`.
Mesh read_warned(const std::string& name, const std::string& bytes, Warnings& warnings) {
  return read_variant({name, bytes}, warnings, true);
}

const std::string triangle = "v 0 0 0\nv 1 0 0\nv 0 1 0\n";

TEST(ToleratedMesh, ObjKeepsTheAttributesThatAreThere) {
  Warnings warnings;
  const Mesh mesh = read_warned("a.obj",
                                triangle +
                                    "vt 0.5 0.25\nvn 0 0 1\nf 1/1/1 2/2/1 3/1/0\n"
                                    "f 1/-1/-1 2/-2/1 3/0/-2\n",
                                warnings);
  EXPECT_THAT(mesh.texture_triangles,
              ElementsAre(CornerIndices{0, no_index, 0}, CornerIndices{0, no_index, no_index}));
  EXPECT_THAT(mesh.normal_triangles,
              ElementsAre(CornerIndices{0, 0, no_index}, CornerIndices{0, 0, no_index}));
  EXPECT_THAT(mesh.texture_coordinates, ElementsAre(std::array{0.5, 0.25}));
  EXPECT_THAT(mesh.normals, ElementsAre(std::array{0.0, 0.0, 1.0}));
  EXPECT_THAT(
      warnings,
      ElementsAre("a.obj: 3 corners name a texture coordinate that is not in the file, the first "
                  "on line 6: they have none",
                  "a.obj: 2 corners name a normal that is not in the file, the first on line 6: "
                  "they have none"));
}

/// Without any vn or vt in the file nobody may take the numbers of vertices for theirs.
TEST(ToleratedMesh, ObjWithoutAttributesHasNone) {
  Warnings warnings;
  const Mesh mesh = read_warned("a.obj", triangle + "f 1/1/1 2/2/2 3/3/3\n", warnings);
  EXPECT_TRUE(mesh.texture_triangles.empty() && mesh.texture_coordinates.empty());
  EXPECT_TRUE(mesh.normal_triangles.empty() && mesh.normals.empty());
  EXPECT_EQ(warnings.size(), 2U);
}

/// The count and the first line do not depend on the pieces that are read in parallel.
TEST(ToleratedMesh, ObjCountsOverAllPieces) {
  std::string text = triangle;
  while (text.size() < std::size_t{3} << 20) text += "f 1//1 2//1 3//1\n";
  for (const int threads : {1, 4}) {
    Warnings warnings;
    const Mesh mesh = mesh_files::read_obj(text, "a.obj", {.threads = threads}, warnings);
    EXPECT_THAT(warnings, ElementsAre("a.obj: " + std::to_string(3 * mesh.triangles.size()) +
                                      " corners name a normal that is not in the file, the first "
                                      "on line 4: they have none"));
  }
}

TEST(ToleratedMesh, ObjColoursThatAreNoneAreWhite) {
  Warnings warnings;
  const Mesh mesh = read_warned("a.obj",
                                "v 0 0 0 0 0.5 1\nv 1 0 0 nan 0 0\nv 0 1 0 0.25 0\n"
                                "v 0 0 1 1 0 0 0.5\nf 1 2 3\n",
                                warnings);
  EXPECT_THAT(mesh.colours,
              ElementsAre(std::array{0.0F, 0.5F, 1.0F, 1.0F}, std::array{1.0F, 1.0F, 1.0F, 1.0F},
                          std::array{1.0F, 1.0F, 1.0F, 1.0F}, std::array{1.0F, 0.0F, 0.0F, 0.5F}));
  EXPECT_THAT(
      warnings,
      ElementsAre("a.obj: 2 vertices have numbers behind x, y, z that are neither a weight "
                  "nor a colour of 3 or 4 finite components, the first on line 2: ignored"));
}

/// x/w, y/w and z/w are each rounded once: 1/3, 2/3 and 1/49 in binary64, from their expansions.
TEST(ToleratedMesh, ObjWeightsDivide) {
  Warnings warnings;
  const Mesh mesh =
      read_warned("a.obj",
                  "v 1 2 -1 3\nv 1 49 0 49\nv 4.9406564584124654e-324 3e-323 1e308 2\n"
                  "v -0.5 0.5 2 -0.5\nv 1 2 3 1.0\nf 1 2 3\n",
                  warnings);
  EXPECT_EQ(mesh.vertices[0],
            (MeshPoint{0x1.5555555555555p-2, 0x1.5555555555555p-1, -0x1.5555555555555p-2}));
  EXPECT_EQ(mesh.vertices[1], (MeshPoint{0x1.4e5e0a72f0539p-6, 1, 0}));
  // Half the least subnormal is a tie, and goes to the even 0; 6 of them halved are 3.
  EXPECT_EQ(mesh.vertices[2], (MeshPoint{0, 0x3p-1074, 5e307}));
  EXPECT_EQ(mesh.vertices[3], (MeshPoint{1, -1, -4}));
  EXPECT_EQ(mesh.vertices[4], (MeshPoint{1, 2, 3}));
  EXPECT_THAT(warnings, ElementsAre("a.obj: 4 vertices have a weight w other than 1, the first on "
                                    "line 1: read as x/w, y/w, z/w"));
}

TEST(ToleratedMesh, ObjInThePlane) {
  Warnings warnings;
  const Mesh mesh = read_warned("a.obj", "v 0 0\nv 1 0 # x\nv 0 \\\n 1\nf 1 2 3\n", warnings);
  EXPECT_THAT(mesh.vertices,
              ElementsAre(MeshPoint{0, 0, 0}, MeshPoint{1, 0, 0}, MeshPoint{0, 1, 0}));
  EXPECT_THAT(warnings, ElementsAre("a.obj: its 3 vertices have two coordinates: read with z = 0"));
}

TEST(ToleratedMesh, ObjElementsThatAreNoFaces) {
  Warnings warnings;
  const Mesh mesh = read_warned("a.obj",
                                triangle +
                                    "l 1 2 3\np 1\ncstype bezier\ndeg 3\ncurv 0 1 1 2\nend\n"
                                    "f 1 2 2 3 # doubled\nf 1 2 3 \t\n",
                                warnings);
  EXPECT_EQ(mesh.face_count, 2U);
  EXPECT_EQ(mesh.triangles.size(), 3U);
  EXPECT_EQ(warnings.size(), 5U);
}

/// 3 or 4 numbers behind the points of any OFF are a colour. Integers are of 255 unless no number
/// of the file is greater than 1.
TEST(ToleratedMesh, OffColoursOfWhateverKeyword) {
  using Colour = std::array<float, 4>;
  const auto of = [](const std::string& text) {
    Warnings warnings;
    return read_warned("a.off", text, warnings).colours;
  };
  EXPECT_THAT(of("OFF\n2 0 0\n0 0 0 255 0 51\n1 0 0 0 0 0 255\n"),
              ElementsAre(Colour{1, 0, 0.2F, 1}, Colour{0, 0, 0, 1}));
  EXPECT_THAT(of("COFF\n2 0 0\n0 0 0 1 0 0 1\n1 0 0 0.5 0 0 1\n"),
              ElementsAre(Colour{1, 0, 0, 1}, Colour{0.5F, 0, 0, 1}));
  EXPECT_THAT(of("OFF\n2 0 0\n0 0 0 1 0 0\n1 0 0 0 1 1\n"),
              ElementsAre(Colour{1, 0, 0, 1}, Colour{0, 1, 1, 1}));
  EXPECT_THAT(of("OFF\n3 0 0\n0 0 0\n1 0 0 0 255 255\n1 0 0 1 2\n"),
              ElementsAre(Colour{1, 1, 1, 1}, Colour{0, 1, 1, 1}, Colour{1, 1, 1, 1}));
  EXPECT_THAT(of("OFF\n1 0 0\n0 0 0\n"), ElementsAre());
}

/// MeshLab writes NCOFF, and colours before normals.
TEST(ToleratedMesh, OffPrefixesInTheOtherOrder) {
  Warnings warnings;
  const Mesh first = read_warned("a.off", "CNOFF\n1 0 0\n0 0 0 0 0 1 255 0 51 255\n", warnings);
  const Mesh second = read_warned("a.off", "NCOFF\n1 0 0\n0 0 0 255 0 51 255 0 0 1\n", warnings);
  EXPECT_EQ(first.normals, second.normals);
  EXPECT_EQ(first.colours, second.colours);
  EXPECT_THAT(first.normals, ElementsAre(std::array{0.0, 0.0, 1.0}));
  EXPECT_THAT(first.colours, ElementsAre(std::array{1.0F, 0.0F, 0.2F, 1.0F}));
}

/// Two vertices a line could be vertices with colours: then there would be too few lines.
TEST(ToleratedMesh, OffIsReadByLinesWhereThereAreEnough) {
  Warnings warnings;
  const Mesh lines = read_warned(
      "a.off", "OFF\n3 1 0\n0 0 0 1 1 1\n1 0 0 1 1 1\n0 1 0 1 1 1\n3 0 1 2\n", warnings);
  EXPECT_THAT(lines.vertices,
              ElementsAre(MeshPoint{0, 0, 0}, MeshPoint{1, 0, 0}, MeshPoint{0, 1, 0}));
  const Mesh words = read_warned("a.off", "OFF\n3 1 0\n0 0 0 1 0 0\n0 1 0\n3 0 1 2\n", warnings);
  EXPECT_EQ(words.vertices, lines.vertices);
  EXPECT_EQ(words.triangles, lines.triangles);
  EXPECT_THAT(warnings, ElementsAre());
}

TEST(ToleratedMesh, StlNormalsOfWindows) {
  Warnings warnings;
  const Mesh mesh =
      read_warned("a.stl",
                  "solid\nfacet normal -1.#IND 0 1.#INF\nloop\nvertex 0 0 0\nvertex 1 0 0\n"
                  "vertex 0 1 0\nendloop\nendfacet\nendsolid\n",
                  warnings);
  ASSERT_EQ(mesh.normals.size(), 1U);
  EXPECT_NE(mesh.normals[0][0], mesh.normals[0][0]);
  EXPECT_EQ(mesh.normals[0][1], 0);
  EXPECT_THAT(warnings, ElementsAre());
}

}  // namespace
}  // namespace fathom
