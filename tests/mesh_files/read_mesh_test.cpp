#include "fathom/mesh_files/read_mesh.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <limits>
#include <random>
#include <set>
#include <tuple>

#include "fathom/failures/errors.h"
#include "tests/inputs/mesh_variants.h"

namespace fathom {
namespace {

using namespace mesh_files;
using test::MeshFile;
using test::read_variant;
using test::soup_of;
using testing::ElementsAre;
using testing::HasSubstr;

Mesh read_bytes_of(const std::string& name, const std::string& bytes, bool attributes = false) {
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
      read_bytes_of("a.ply", "ply\nformat ascii 1.0\nelement vertex 1\nproperty double x" + body);
  EXPECT_EQ(mesh.vertices[0].x, 1.00000005960464477539062500000001);
  EXPECT_EQ(mesh.vertices[0].y, 0x1.000002p0);
  EXPECT_EQ(mesh.vertices[0].z, mesh.vertices[0].x);
}

TEST(ReadMesh, KeepsAttributesOfObj) {
  const Mesh mesh =
      read_bytes_of("a.obj",
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
  const Mesh mesh = read_bytes_of(
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
  const Mesh mesh = read_bytes_of(
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

/// Lines that are plain are counted in another way than those that are not.
TEST(ReadMesh, PlainLinesCountAsAllOthers) {
  std::mt19937 random(6);
  const auto number = [&] { return std::to_string(static_cast<int>(random() % 9) - 4); };
  const std::string index[] = {"1", "2/1", "3//1", "-1/-1/-1", "00000000000000000002", "+1"};
  for (int i = 0; i < 300; ++i) {
    std::string plain = "vt 0 0\nvn 0 0 1\nv 0 0 0\nv 1 0 0\nv\t0 1 0\n", odd = plain;
    for (int line = 0; line < 6; ++line) {
      std::string text = random() % 2 == 0 ? "v" : "f";
      const std::size_t words = text == "v" ? 3 + random() % 5 : random() % 6;
      for (std::size_t k = 0; k < words; ++k)
        text +=
            (random() % 4 == 0 ? "  " : " ") + (text[0] == 'v' ? number() : index[random() % 6]);
      plain += text + (random() % 4 == 0 ? " \r\n" : "\n");
      odd += text + (random() % 2 == 0 ? " # all\n" : " \\\n\n");
    }
    const auto outcome = [](const std::string& text) {
      Warnings warnings;
      std::string failure;
      Mesh mesh;
      try {
        mesh = read_variant({"a.obj", text}, warnings, true);
      } catch (const InputError& error) {
        failure = std::string(error.what()).substr(std::string("a.obj: line 1").size());
      }
      return std::tuple(failure.substr(failure.find(':') + 1), warnings.size(), mesh.vertices,
                        mesh.triangles, mesh.face_of_triangle, mesh.face_count, mesh.colours,
                        mesh.texture_triangles, mesh.normal_triangles);
    };
    ASSERT_EQ(outcome(plain), outcome(odd)) << plain << odd;
  }
}

/// Rows of a binary PLY that are taken at once, and the same ones value by value: behind each lies
/// something that is skipped, in a list.
TEST(ReadMesh, BinaryRowsAtOnceAreThoseOneByOne) {
  const auto ply = [](const std::string& more_of_vertex, const std::string& more_of_face,
                      std::uint32_t last_index, float last_z) {
    std::string text =
        "ply\nformat binary_little_endian 1.0\nelement vertex 3\nproperty float z\nproperty float "
        "x\nproperty float y\n" +
        more_of_vertex + "element face 2\nproperty list uchar uint vertex_indices\n" +
        more_of_face + "end_header\n";
    const auto put = [&](auto value) {
      text.append(reinterpret_cast<const char*>(&value), sizeof value);
    };
    for (const float z : {1.0F, 2.0F, last_z}) {
      for (const float value : {z, z + 4, z + 8}) put(value);
      if (!more_of_vertex.empty()) put(std::uint8_t{0});
    }
    for (const std::uint32_t last : {2U, last_index}) {
      put(std::uint8_t{3});
      for (const std::uint32_t i : {0U, 1U, last}) put(i);
      if (!more_of_face.empty()) put(std::uint8_t{0});
    }
    return text;
  };
  const std::string list = "property list uchar uchar more\n";
  const Mesh at_once = read_bytes_of("a.ply", ply("", "", 1, 3));
  const Mesh one_by_one = read_bytes_of("a.ply", ply(list, list, 1, 3));
  EXPECT_EQ(at_once.vertices, one_by_one.vertices);
  EXPECT_EQ(at_once.vertices[2], (MeshPoint{7, 11, 3}));
  EXPECT_EQ(at_once.triangles, one_by_one.triangles);
  EXPECT_THAT(at_once.triangles, ElementsAre(CornerIndices{0, 1, 2}, CornerIndices{0, 1, 1}));

  const auto failure = [&](const std::string& text) {
    Warnings warnings;
    try {
      read_variant({"a.ply", text}, warnings);
    } catch (const InputError& error) {
      return std::string(error.what());
    }
    return std::string("nothing was thrown");
  };
  const std::size_t header = ply("", "", 1, 3).find("end_header\n") + 11;
  EXPECT_EQ(failure(ply("", "", 1, std::numeric_limits<float>::infinity())),
            "a.ply: byte " + std::to_string(header + 24) +
                ": coordinate z is not finite, expected a finite number");
  EXPECT_EQ(failure(ply("", "", 3, 3)), "a.ply: byte " + std::to_string(header + 36 + 26) +
                                            ": index 3 is out of range, expected 0 to 2");
}

}  // namespace
}  // namespace fathom
