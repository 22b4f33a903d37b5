#include "fathom/mesh_files/read_mesh.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <random>
#include <set>

#include "tests/inputs/mesh_variants.h"

namespace fathom {
namespace {

using namespace mesh_files;
using test::MeshFile;
using test::read_variant;
using test::soup_of;
using testing::ElementsAre;
using testing::HasSubstr;

Mesh read(const std::string& name, const std::string& bytes, bool attributes = false) {
  Warnings warnings;
  Mesh mesh = read_variant({name, bytes}, warnings, attributes);
  EXPECT_THAT(warnings, ElementsAre()) << name;
  return mesh;
}

TEST(ReadMesh, EveryVariantOfEveryFormatIsTheSameMesh) {
  const Mesh truth = test::sample_mesh();
  const std::vector<MeshFile> files = test::variants_of(truth);
  EXPECT_GT(files.size(), 80U);
  std::set<std::string> names;
  for (const MeshFile& file : files) {
    EXPECT_TRUE(names.insert(file.name).second) << file.name;
    for (const bool attributes : {false, true}) {
      Warnings warnings;
      Mesh mesh;
      ASSERT_NO_THROW(mesh = read_variant(file, warnings, attributes)) << file.name;
      EXPECT_THAT(warnings, ElementsAre()) << file.name;
      EXPECT_EQ(soup_of(mesh), soup_of(truth)) << file.name;
      EXPECT_EQ(mesh.face_count, 5U) << file.name;
      EXPECT_TRUE(mesh.face_of_triangle.empty()) << file.name;
    }
  }
}

TEST(ReadMesh, TextIsRoundedToTheDeclaredType) {
  const std::string x = "1.00000005960464477539062500000001";  // see decimal_test
  const std::string body =
      "\nproperty float y\nproperty double z\nelement face 0\nproperty list uchar int "
      "vertex_indices\nend_header\n" +
      x + " " + x + " " + x + "\n";
  const Mesh mesh =
      read("a.ply", "ply\nformat ascii 1.0\nelement vertex 1\nproperty double x" + body);
  EXPECT_EQ(mesh.vertices[0].x, 1.00000005960464477539062500000001);
  EXPECT_EQ(mesh.vertices[0].y, 0x1.000002p0);
  EXPECT_EQ(mesh.vertices[0].z, mesh.vertices[0].x);
}

TEST(ReadMesh, KeepsAttributesOfObj) {
  const Mesh mesh =
      read("a.obj",
           "v 0 0 0 1 0.5 0\nv 1 0 0\nv 0 1 0 2 0 0 0.25\nvt 0.5\nvt 1 2 3\nvn 0 0 1\n"
           "f 1/2 2//1 3/1/-1\nf 1 2 3\n",
           true);
  EXPECT_THAT(mesh.texture_coordinates, ElementsAre(std::array{0.5, 0.0}, std::array{1.0, 2.0}));
  EXPECT_THAT(mesh.normals, ElementsAre(std::array{0.0, 0.0, 1.0}));
  EXPECT_THAT(mesh.colours,
              ElementsAre(std::array{1.0F, 0.5F, 0.0F, 1.0F}, std::array{1.0F, 1.0F, 1.0F, 1.0F},
                          std::array{1.0F, 0.0F, 0.0F, 0.25F}));
  EXPECT_THAT(mesh.texture_triangles, ElementsAre(CornerIndices{1, no_index, 0},
                                                  CornerIndices{no_index, no_index, no_index}));
  EXPECT_THAT(mesh.normal_triangles, ElementsAre(CornerIndices{no_index, 0, 0},
                                                 CornerIndices{no_index, no_index, no_index}));
}

TEST(ReadMesh, KeepsAttributesOfPly) {
  const Mesh mesh = read(
      "a.ply",
      "ply\nformat ascii 1.0\nelement vertex 1\nproperty float x\nproperty float y\nproperty "
      "float z\nproperty float nx\nproperty float ny\nproperty float nz\nproperty uchar "
      "red\nproperty uchar green\nproperty uchar blue\nproperty float texture_u\nproperty float "
      "texture_v\nelement face 0\nproperty list uchar int vertex_indices\nend_header\n"
      "1 2 3 0 nan 1 255 0 51 0.5 0.75\n",
      true);
  EXPECT_EQ(mesh.normals.at(0)[2], 1);
  EXPECT_THAT(mesh.colours, ElementsAre(std::array{1.0F, 0.0F, 0.2F, 1.0F}));
  EXPECT_THAT(mesh.texture_coordinates, ElementsAre(std::array{0.5, 0.75}));
}

TEST(ReadMesh, PolygonsAreCutWithTheirAttributes) {
  // An L whose reflex corner is the third: a fan from the first corner leaves it.
  const Mesh mesh = read(
      "l.obj",
      "v 2 0 0\nv 2 1 0\nv 1 1 0\nv 1 2 0\nv 0 2 0\nv 0 0 0\nvt 1\nvt 2\nvt 3\nvt 4\nvt 5\nvt 6\n"
      "f 1 2 3\nf 1/6 2/5 3/4 4/3 5/2 6/1\nf 6 1 2 3\n",
      true);
  EXPECT_EQ(mesh.face_count, 3U);
  EXPECT_THAT(mesh.face_of_triangle, ElementsAre(0, 1, 1, 1, 1, 2, 2));
  // Ears by hand: 0, then 1, then 2; each is the first corner of what remains.
  EXPECT_THAT(mesh.triangles,
              ElementsAre(CornerIndices{0, 1, 2}, CornerIndices{5, 0, 1}, CornerIndices{5, 1, 2},
                          CornerIndices{5, 2, 3}, CornerIndices{3, 4, 5}, CornerIndices{5, 0, 1},
                          CornerIndices{5, 1, 2}));
  EXPECT_EQ(mesh.texture_triangles[1], (CornerIndices{0, 5, 4}));
  EXPECT_EQ(mesh.texture_triangles[2], (CornerIndices{0, 4, 3}));
}

TEST(ReadMesh, WarnsOnceWithACount) {
  Warnings warnings;
  const Mesh mesh =
      read_variant({"w.obj",
                    "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 1 1 0\nf 1 2\nf 1\nf 1 2 3\nf 1 4 2 3\nl 1 2\np "
                    "1\ncurv 0 1 1 2\ncurv 0 1 1 2\n"},
                   warnings);
  EXPECT_THAT(warnings, ElementsAre(HasSubstr("2 lines and points (l, p)"),
                                    HasSubstr("unknown keyword 'curv' on 2"),
                                    HasSubstr("2 faces of fewer than three corners"),
                                    HasSubstr("1 face that is not a simple polygon")));
  EXPECT_EQ(mesh.face_count, 4U);
  EXPECT_THAT(mesh.face_of_triangle, ElementsAre(2, 3, 3));
}

/// An OBJ of several pieces: places and lines must not depend on how it is cut.
TEST(ReadMesh, LargeObjIsReadInPieces) {
  std::mt19937 random(5);
  std::string text;
  const int n = 200'000;
  for (int i = 0; i < n; ++i) {
    text += "v " + std::to_string(i) + (i % 7 == 0 ? " \\\n" : " ") +
            std::to_string(random() % 1000) + " 0.5\n";
    if (i >= 2)
      text +=
          i % 2 == 0 ? "f -1 -2 -3\n" : "f " + std::to_string(n) + " 1 " + std::to_string(i) + "\n";
  }
  ASSERT_GT(text.size(), 3U << 20);
  Warnings warnings;
  const Mesh one = read_obj(text, "a", {.format = {}, .threads = 1}, warnings);
  const Mesh two = read_obj(text, "a", {.format = {}, .threads = 4}, warnings);
  EXPECT_EQ(one.vertices, two.vertices);
  EXPECT_EQ(one.triangles, two.triangles);
  ASSERT_EQ(one.vertices.size(), static_cast<std::size_t>(n));
  for (int i = 0; i < n; ++i) ASSERT_EQ(one.vertices[i].x, i);
  for (std::uint32_t t = 0; t < n - 2; ++t) {
    const std::uint32_t i = t + 2;
    ASSERT_EQ(one.triangles[t],
              i % 2 == 0 ? (CornerIndices{i, i - 1, i - 2}) : (CornerIndices{n - 1, 0, i - 1}));
  }
}

}  // namespace
}  // namespace fathom
