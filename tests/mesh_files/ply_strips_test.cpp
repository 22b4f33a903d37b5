// Triangle strips of PLY files: element tristrips, as Stanford's and Georgia Tech's scans have it.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <random>

#include "fathom/failures/errors.h"
#include "fathom/mesh_files/read_mesh.h"
#include "fathom/mesh_files/triangle_stream.h"
#include "fathom/scene/read_scene.h"
#include "tests/effort.h"
#include "tests/inputs/mesh_text.h"
#include "tests/inputs/mesh_variants.h"
#include "tests/scratch_folder.h"

namespace fathom {
namespace {

using test::raw;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using Strips = std::vector<std::vector<std::int32_t>>;

const std::string properties = "property float x\nproperty float y\nproperty float z\n";
const std::string six_points = "0 0 0\n0 1 0\n1 0 0\n1 1 0\n2 0 0\n2 1 0\n";

std::string ascii_ply(const std::string& rows, int count = 1) {
  return "ply\nformat ascii 1.0\nelement vertex 6\n" + properties + "element tristrips " +
         std::to_string(count) + "\nproperty list int int vertex_indices\nend_header\n" +
         six_points + rows;
}

Mesh read_warned(const std::string& bytes, Warnings& warnings) {
  return test::read_variant({"a.ply", bytes}, warnings);
}

TEST(PlyStrips, EveryOtherTriangleTurnsRound) {
  Warnings warnings;
  const Mesh mesh = read_warned(ascii_ply("6 0 1 2 3 4 5\n"), warnings);
  // By hand: all six clockwise seen from +z, as the first.
  EXPECT_THAT(mesh.triangles, ElementsAre(CornerIndices{0, 1, 2}, CornerIndices{1, 3, 2},
                                          CornerIndices{2, 3, 4}, CornerIndices{3, 5, 4}));
  for (const auto& [a, b, c] : test::soup_of(mesh))
    EXPECT_EQ((b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x), -1);
  EXPECT_EQ(mesh.face_count, 4U);
  EXPECT_TRUE(mesh.face_of_triangle.empty());
  EXPECT_THAT(warnings, ElementsAre());
}

TEST(PlyStrips, MinusOneBeginsAnother) {
  Warnings warnings;
  const Mesh mesh =
      read_warned(ascii_ply("11 0 1 2 3 -1 2 3 4 -1 -1 -1\n6 -1 -1 5 4 3 -1\n0\n", 3), warnings);
  EXPECT_THAT(mesh.triangles, ElementsAre(CornerIndices{0, 1, 2}, CornerIndices{1, 3, 2},
                                          CornerIndices{2, 3, 4}, CornerIndices{5, 4, 3}));
  EXPECT_THAT(warnings, ElementsAre());
}

/// Repeated corners, which join strips, give triangles without area; they count and keep the turn.
TEST(PlyStrips, StitchesAreTriangles) {
  Warnings warnings;
  const Mesh mesh = read_warned(ascii_ply("8 0 1 2 2 3 3 4 5\n"), warnings);
  EXPECT_THAT(mesh.triangles,
              ElementsAre(CornerIndices{0, 1, 2}, CornerIndices{1, 2, 2}, CornerIndices{2, 2, 3},
                          CornerIndices{2, 3, 3}, CornerIndices{3, 3, 4}, CornerIndices{3, 5, 4}));
  EXPECT_EQ(mesh.face_count, 6U);
}

TEST(PlyStrips, OfFewerThanThreeCornersAreSkipped) {
  Warnings warnings;
  const Mesh mesh = read_warned(ascii_ply("9 0 -1 1 2 -1 3 4 5 -1\n1 5\n", 2), warnings);
  EXPECT_THAT(mesh.triangles, ElementsAre(CornerIndices{3, 4, 5}));
  EXPECT_EQ(mesh.face_count, 1U);
  EXPECT_THAT(warnings,
              ElementsAre("a.ply: 3 triangle strips of fewer than three corners are skipped"));
}

TEST(PlyStrips, BesideFaces) {
  for (const bool strips_first : {false, true}) {
    const std::string faces = "element face 2\nproperty list uchar int vertex_indices\n",
                      strips = "element tristrips 1\nproperty list int int vertex_index\n",
                      face_rows = "4 0 1 3 2\n3 3 5 4\n", strip_rows = "4 2 3 4 5\n";
    const std::string bytes = "ply\nformat ascii 1.0\nelement vertex 6\n" + properties +
                              (strips_first ? strips + faces : faces + strips) + "end_header\n" +
                              six_points +
                              (strips_first ? strip_rows + face_rows : face_rows + strip_rows);
    Warnings warnings;
    const Mesh mesh = read_warned(bytes, warnings);
    EXPECT_EQ(mesh.face_count, 4U);
    std::vector<CornerIndices> expected{{0, 1, 3}, {0, 3, 2}, {3, 5, 4}};
    std::vector<std::uint32_t> numbers{0, 0, 1};
    if (strips_first) {
      expected.insert(expected.begin(), {{2, 3, 4}, {3, 5, 4}});
      numbers = {0, 1, 2, 2, 3};
    } else {
      expected.insert(expected.end(), {{2, 3, 4}, {3, 5, 4}});
      numbers = {0, 0, 1, 2, 3};
    }
    EXPECT_EQ(mesh.triangles, expected);
    EXPECT_EQ(mesh.face_of_triangle, numbers);
  }
}

std::string failure(const std::string& bytes) {
  Warnings warnings;
  return message_of<InputError>([&] { read_warned(bytes, warnings); });
}

TEST(PlyStrips, WrongOnesAreRefused) {
  EXPECT_THAT(failure(ascii_ply("4 0 1 2 6\n")),
              HasSubstr("a.ply: line 16: index 6 is out of range, expected 0 to 5 or -1"));
  EXPECT_THAT(failure(ascii_ply("4 0 1 -2 3\n")), HasSubstr("line 16: index -2 is out of range"));
  EXPECT_THAT(failure(ascii_ply("4 0 1 2\n")), HasSubstr("line 16: expected"));
  EXPECT_THAT(failure(ascii_ply("3 0 1 2\n", 2)), HasSubstr("1 of 2 rows of element tristrips"));
  std::string no_list = ascii_ply("1\n");
  no_list.replace(no_list.find("list int int"), 12, "int");
  EXPECT_THAT(failure(no_list), HasSubstr("element tristrips lacks the list vertex_indices"));
  std::string floats = ascii_ply("3 0 1 2\n");
  floats.replace(floats.find("list int int"), 12, "list int float");
  EXPECT_THAT(failure(floats), HasSubstr("element tristrips lacks the list vertex_indices"));
}

std::string binary_ply(const Strips& rows, std::uint32_t vertices, bool big,
                       const std::string& before = "", const std::string& before_rows = "",
                       bool extras = false) {
  std::string bytes = std::string("ply\nformat binary_") + (big ? "big" : "little") +
                      "_endian 1.0\nelement vertex " + std::to_string(vertices) + "\n" +
                      properties + before + "element tristrips " + std::to_string(rows.size()) +
                      (extras ? "\nproperty list uchar short weights" : "") +
                      "\nproperty list uint int vertex_indices" +
                      (extras ? "\nproperty double quality" : "") + "\nend_header\n";
  for (std::uint32_t v = 0; v < vertices; ++v)
    bytes += raw(static_cast<float>(v), big) + raw(static_cast<float>(v % 7), big) +
             raw(static_cast<float>(v % 3), big);
  bytes += before_rows;
  for (const auto& row : rows) {
    if (extras) bytes += std::string(1, '\1') + raw(std::int16_t{3}, big);
    bytes += raw(static_cast<std::uint32_t>(row.size()), big);
    for (const std::int32_t i : row) bytes += raw(i, big);
    if (extras) bytes += raw(0.5, big);
  }
  return bytes;
}

/// The stream's triangles, faces and warnings are the ordinary reader's, in chunks of any size and
/// one by one.
void expect_streamed_alike(const std::string& bytes, std::size_t triangles) {
  const ScratchFolder folder;
  const auto path = folder.write("a.ply", bytes);
  Warnings warnings, streamed_warnings;
  const Mesh mesh = read_scene({path}, {}, warnings).meshes.at(0);
  const auto soup = test::soup_of(mesh);
  ASSERT_EQ(soup.size(), triangles);
  const auto stream = open_triangle_stream(path, {}, streamed_warnings);
  EXPECT_EQ(warnings, streamed_warnings);
  ASSERT_EQ(stream->triangle_count(), triangles);
  EXPECT_EQ(stream->face_count(), mesh.face_count);
  // One by one takes minutes under sanitizers.
  for (const std::uint32_t size :
       {checks::effort > 1 ? 37U : 1U, 7U * checks::effort, 1000U, 1U << 20}) {
    test::Soup streamed;
    for (std::uint32_t first = 0; first < stream->triangle_count(); first += size) {
      const TriangleChunk chunk = stream->read(first, size);
      for (const auto& corners : test::soup_of(chunk.mesh)) streamed.push_back(corners);
      for (std::uint32_t t = 0; t < chunk.mesh.triangles.size(); ++t)
        ASSERT_EQ(chunk.mesh.face_of_triangle.empty() ? first + t : chunk.mesh.face_of_triangle[t],
                  mesh.face_of(first + t));
    }
    ASSERT_TRUE(streamed == soup) << size;
  }
  for (std::uint32_t t = 0; t < triangles; t += 1 + static_cast<std::uint32_t>(triangles / 500)) {
    const TriangleStream::Triangle one = stream->triangle(t);
    ASSERT_TRUE(one.corners == soup[t]) << t;
    ASSERT_EQ(one.face, mesh.face_of(t));
    ASSERT_EQ(stream->face_of(t), mesh.face_of(t));
  }
}

/// Long strips, short ones, deserts of −1 and of empty rows; beside faces of all sizes.
TEST(PlyStrips, StreamsReadThemAlike) {
  std::mt19937 random(34);
  const auto below = [&](int n) { return static_cast<std::int32_t>(random() % unsigned(n)); };
  for (const bool big : {false, true}) {
    for (const bool faces : {false, true}) {
      Strips rows;
      std::size_t triangles = 0;
      for (int i = 0; i < 40; ++i) {
        std::vector<std::int32_t> row;
        for (int run = below(4); run > 0; --run) {
          const int corners = below(10) == 0 ? below(5000) : below(9);
          for (int k = 0; k < corners; ++k) row.push_back(below(100));
          triangles += corners < 3 ? 0 : static_cast<std::size_t>(corners) - 2;
          row.insert(row.end(), static_cast<std::size_t>(i == 20 ? 5000 : 1), -1);
        }
        rows.push_back(row);
        if (i == 30) rows.insert(rows.end(), 3000, {});
      }
      std::string face_rows;
      if (faces) {
        triangles += 3;
        for (const std::vector<std::int32_t>& ring : Strips{{0, 1, 2}, {3, 4, 5, 6}, {1, 2}}) {
          face_rows += static_cast<char>(ring.size());
          for (const std::int32_t i : ring) face_rows += raw(i, big);
        }
      }
      SCOPED_TRACE((big ? "big endian" : "little endian") + std::string(faces ? ", faces" : ""));
      expect_streamed_alike(
          binary_ply(rows, 100, big,
                     faces ? "element face 3\nproperty list uchar int vertex_indices\n" : "",
                     face_rows, true),
          triangles);
    }
  }
}

TEST(PlyStrips, StreamsRefuseTheSame) {
  const ScratchFolder folder;
  const std::string good = binary_ply({{0, 1, 2, 3}, {1, 2, 3}}, 4, false);
  for (const std::string& bytes :
       {binary_ply({{0, 1, 2, 4}}, 4, false), binary_ply({{0, 1, 2, -2}}, 4, true),
        good.substr(0, good.size() - 1), good.substr(0, good.size() - 16)}) {
    const auto path = folder.write("a.ply", bytes);
    Warnings warnings;
    const std::string truth = message_of<InputError>([&] { read_scene({path}, {}, warnings); });
    EXPECT_EQ(message_of<InputError>([&] { open_triangle_stream(path, {}, warnings); }), truth);
  }
}

}  // namespace
}  // namespace fathom
