#include "fathom/mesh/vertex_normals.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "fathom/failures/errors.h"

namespace fathom::mesh {
namespace {

using ::testing::ElementsAre;
using ::testing::IsEmpty;

/// Vertices 1 and 3 are at one place, and so are 2 and 4, one of them with a −0; 5 is on its own.
Mesh two_triangles() {
  Mesh mesh;
  mesh.vertices =
      std::vector<MeshPoint>{{0, 0, 1}, {1, 0, 1}, {0, 1, 1}, {1, 0, 1}, {-0.0, 1, 1}, {1, 1, 1}};
  mesh.triangles = std::vector<CornerIndices>{{0, 1, 2}, {3, 5, 4}};
  return mesh;
}

TEST(VertexNormals, AreSharedWithTheFirstVertexAtAPlace) {
  const Mesh mesh = two_triangles();
  EXPECT_THAT(sharing_vertices(mesh, NormalSource::vertex), ElementsAre(0, 1, 2, 3, 4, 5));
  EXPECT_THAT(sharing_vertices(mesh, NormalSource::file), ElementsAre(0, 1, 2, 3, 4, 5));
  EXPECT_THAT(sharing_vertices(mesh, NormalSource::place), ElementsAre(0, 1, 2, 1, 2, 5));
}

TEST(VertexNormals, AreSummedOverTheTrianglesThere) {
  const SharedTriangles by_vertex(two_triangles(), NormalSource::vertex);
  EXPECT_THAT(by_vertex.at(1), ElementsAre(0));
  EXPECT_THAT(by_vertex.at(by_vertex.shared(3)), ElementsAre(1));
  const SharedTriangles by_place(two_triangles(), NormalSource::place);
  EXPECT_EQ(by_place.shared(3), 1U);
  EXPECT_EQ(by_place.shared(4), 2U);
  EXPECT_THAT(by_place.at(0), ElementsAre(0));
  EXPECT_THAT(by_place.at(1), ElementsAre(0, 1));
  EXPECT_THAT(by_place.at(2), ElementsAre(0, 1));
  EXPECT_THAT(by_place.at(3), IsEmpty());
  EXPECT_THAT(by_place.at(5), ElementsAre(1));
}

TEST(VertexNormals, OfTheFileAreThoseThatItsCornersName) {
  Mesh mesh = two_triangles();
  EXPECT_TRUE(needs_sums(mesh, NormalSource::file));
  EXPECT_EQ(normal_index(mesh, 0, 0), no_index);
  mesh.normals.assign(6, {0, 0, 1});
  EXPECT_FALSE(needs_sums(mesh, NormalSource::file));
  EXPECT_TRUE(needs_sums(mesh, NormalSource::place));
  EXPECT_EQ(normal_index(mesh, 1, 2), 4U);
  mesh.normals.resize(1);
  mesh.normal_triangles = std::vector<CornerIndices>{{0, 0, 0}, {0, 0, no_index}};
  EXPECT_TRUE(needs_sums(mesh, NormalSource::file));
  EXPECT_EQ(normal_index(mesh, 1, 1), 0U);
  EXPECT_EQ(normal_index(mesh, 1, 2), no_index);
}

TEST(VertexNormals, ACornerWithoutAVertexIsRefused) {
  Mesh mesh = two_triangles();
  mesh.triangles = std::vector<CornerIndices>{{0, 1, 6}};
  EXPECT_THROW(SharedTriangles(mesh, NormalSource::vertex), InputError);
}

}  // namespace
}  // namespace fathom::mesh
