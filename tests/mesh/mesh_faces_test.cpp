#include "fathom/mesh/mesh_faces.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "fathom/failures/errors.h"
#include "tests/scratch_folder.h"

namespace fathom {
namespace {

using namespace mesh;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using Corners = std::vector<std::uint32_t>;

const std::string file = "FILE";

Mesh collected(const std::vector<Corners>& faces, std::uint64_t skipped = 0) {
  Mesh mesh;
  FaceCollector collector(mesh, file);
  for (const Corners& face : faces) collector.add(face);
  EXPECT_EQ(collector.skipped(), skipped);
  return mesh;
}

TEST(FaceCollector, TrianglesNeedNoTableOfFaces) {
  const Mesh mesh = collected({{0, 1, 2}, {2, 1, 3}});
  EXPECT_THAT(mesh.triangles, ElementsAre(CornerIndices{0, 1, 2}, CornerIndices{2, 1, 3}));
  EXPECT_TRUE(mesh.face_of_triangle.empty());
  EXPECT_EQ(mesh.face_count, 2U);
  EXPECT_EQ(mesh.face_of(1), 1U);
}

TEST(FaceCollector, PolygonsAreFansOfTheirFace) {
  const Mesh mesh = collected({{0, 1, 2}, {4, 5, 6, 7, 8}, {1, 2, 3}});
  EXPECT_THAT(mesh.triangles,
              ElementsAre(CornerIndices{0, 1, 2}, CornerIndices{4, 5, 6}, CornerIndices{4, 6, 7},
                          CornerIndices{4, 7, 8}, CornerIndices{1, 2, 3}));
  EXPECT_THAT(mesh.face_of_triangle, ElementsAre(0, 1, 1, 1, 2));
  EXPECT_EQ(mesh.face_count, 3U);
}

TEST(FaceCollector, FacesOfFewCornersCountAndAreSkipped) {
  const Mesh mesh = collected({{}, {3}, {0, 1, 2}, {4, 5}}, 3);
  EXPECT_THAT(mesh.triangles, ElementsAre(CornerIndices{0, 1, 2}));
  EXPECT_THAT(mesh.face_of_triangle, ElementsAre(2));
  EXPECT_EQ(mesh.face_count, 4U);
}

/// An arrow head, whose fan from its first corner would cover the notch: cut from the reflex corner
/// on. Texture triangles go with it.
TEST(CutPolygons, FacesThatAreNotConvexAreCutWithinThem) {
  Mesh mesh = collected({{0, 1, 2}, {0, 1, 2, 3}});
  mesh.vertices = {{0, 0, 0}, {4, 0, 0}, {1, 1, 0}, {0, 4, 0}};
  mesh.texture_triangles = {{10, 11, 12}, {10, 11, 12}, {10, 12, 13}};
  Warnings warnings;
  cut_polygons(mesh, 0, file, warnings);
  EXPECT_THAT(warnings, ElementsAre());
  EXPECT_EQ(mesh.triangles[0], (CornerIndices{0, 1, 2}));
  double area = 0;
  for (std::size_t t = 1; t < 3; ++t) {
    const auto& [a, b, c] = mesh.triangles[t];
    const MeshPoint &A = mesh.vertices[a], &B = mesh.vertices[b], &C = mesh.vertices[c];
    const double twice = (B.x - A.x) * (C.y - A.y) - (B.y - A.y) * (C.x - A.x);
    EXPECT_GT(twice, 0);
    area += twice / 2;
    for (std::size_t k = 0; k < 3; ++k) {
      EXPECT_EQ(mesh.texture_triangles[t][k], mesh.triangles[t][k] + 10);
    }
  }
  EXPECT_EQ(area, 4);  // ½·4·4 without the triangle (4, 0), (0, 4), (1, 1) of area 4
}

TEST(CutPolygons, WarnsOfWhatIsOddWithACount) {
  Mesh mesh = collected({{0, 1, 2, 3}, {0, 0, 1, 1}});
  mesh.vertices = {{0, 0, 0}, {1, 1, 0}, {1, 0, 0}, {0, 1, 0}};  // the first crosses itself
  Warnings warnings;
  cut_polygons(mesh, 1, file, warnings);
  EXPECT_THAT(warnings,
              ElementsAre(HasSubstr("FILE: 1 face of fewer than three corners is skipped"),
                          HasSubstr("FILE: 2 faces that are not simple polygons")));
}

TEST(MeshFaces, MoreThanCanBeNumberedIsRefused) {
  EXPECT_NO_THROW(expect_countable(most_elements, "vertices", file));
  EXPECT_THAT(message_of<InputError>([] { expect_countable(most_elements + 1, "vertices", file); }),
              HasSubstr("FILE: 4294967295 vertices are more than the 4294967294"));
}

}  // namespace
}  // namespace fathom
