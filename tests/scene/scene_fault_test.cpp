// What is no scene, though it has the type of one: named, wherever in a long list it stands.
#include "fathom/scene/scene_fault.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <limits>

#include "fathom/failures/errors.h"
#include "tests/scratch_folder.h"
#include "tests/special_values.h"

namespace fathom {
namespace {

using ::testing::HasSubstr;

/// A strip of so many triangles.
Scene strip(std::uint32_t triangles) {
  Scene scene;
  Mesh& mesh = scene.meshes.emplace_back();
  for (std::uint32_t i = 0; i < triangles + 2; ++i) {
    mesh.vertices.push_back({static_cast<double>(i), static_cast<double>(i % 2), 1});
  }
  for (std::uint32_t i = 0; i < triangles; ++i) mesh.triangles.push_back({i, i + 1, i + 2});
  mesh.face_count = triangles;
  scene.objects.emplace_back();
  return scene;
}

struct FaultCase {
  const char* name;
  std::function<void(Scene&)> spoil;
  const char* fault;
};
void PrintTo(const FaultCase& fault, std::ostream* out) {
  *out << fault.name;
}

class SceneFault : public ::testing::TestWithParam<FaultCase> {};

TEST_P(SceneFault, IsNamed) {
  Scene scene = strip(5);
  ASSERT_EQ(find_fault(scene), std::nullopt);
  GetParam().spoil(scene);
  const auto fault = find_fault(scene);
  ASSERT_TRUE(fault.has_value());
  EXPECT_THAT(*fault, HasSubstr(GetParam().fault));
  EXPECT_EQ(message_of<InputError>([&] { require_valid(scene); }), "scene: " + *fault);
}

INSTANTIATE_TEST_SUITE_P(
    All, SceneFault,
    ::testing::Values(
        FaultCase{"ObjectWithoutMesh", [](Scene& s) { s.objects[0].mesh = 1; },
                  "object 0: there is no mesh 1 among 1 mesh"},
        FaultCase{"ObjectsButNoMeshes", [](Scene& s) { s.meshes.clear(); },
                  "object 0: there is no mesh 0 among 0 meshes"},
        FaultCase{"MovedAndNot", [](Scene& s) { s.objects[0].world_from_mesh.rows[1][3] = 1.0; },
                  "object 0: is placed as it is, but its transform is not the identity"},
        FaultCase{"LongTransform",
                  [](Scene& s) {
                    s.objects[0].placed_as_is = false;
                    s.objects[0].world_from_mesh.rows[2][3] = Dyadic(1.0).scaled(-40000);
                  },
                  "object 0: is placed by a transform of 40001 bits, more than 40000"},
        FaultCase{"HugeTransform",
                  [](Scene& s) {
                    s.objects[0].placed_as_is = false;
                    s.objects[0].world_from_mesh.rows[0][1] = -Dyadic(1.0).scaled(2048);
                  },
                  "object 0: is placed by a transform that reaches 2^2048, beyond 2^2048"},
        FaultCase{"CornerBeyond", [](Scene& s) { s.meshes[0].triangles[3][1] = 7; },
                  "mesh 0: triangle 3: a corner is beyond the 7 vertices"},
        FaultCase{"CornerWithoutIndex", [](Scene& s) { s.meshes[0].triangles[4][2] = no_index; },
                  "mesh 0: triangle 4: a corner is beyond"},
        FaultCase{"NoVertices", [](Scene& s) { s.meshes[0].vertices.clear(); },
                  "mesh 0: triangle 0: a corner is beyond the 0 vertices"},
        FaultCase{"VertexNaN", [](Scene& s) { s.meshes[0].vertices[2].z = std::nan(""); },
                  "mesh 0: vertex 2 has a number that is not finite"},
        FaultCase{"VertexInfinite", [](Scene& s) { s.meshes[0].vertices[6].x = -infinity; },
                  "mesh 0: vertex 6 has a number that is not finite"},
        FaultCase{"UnusedVertexNaN",
                  [](Scene& s) {
                    s.meshes[0].vertices.push_back({0, std::nan(""), 0});
                  },
                  "vertex 7 has a number"},
        FaultCase{"SecondMesh",
                  [](Scene& s) {
                    s.meshes.push_back(s.meshes[0]);
                    s.meshes[1].vertices[0].y = infinity;
                  },
                  "mesh 1: vertex 0 has"},
        FaultCase{"FacesOfSomeTriangles",
                  [](Scene& s) {
                    s.meshes[0].face_of_triangle = {0, 1};
                  },
                  "mesh 0: face_of_triangle has 2 elements, expected one for each of 5 triangles"},
        FaultCase{"FaceTooLarge",
                  [](Scene& s) {
                    s.meshes[0].face_of_triangle = {0, 1, 2, 3, no_index};
                  },
                  "object 0: a face's number is above 4294967294"},
        FaultCase{"FirstFaceTooLarge", [](Scene& s) { s.objects[0].first_face = ~0ULL; },
                  "object 0: a face's number is above 4294967294"},
        FaultCase{"FacesTooLargeTogether",
                  [](Scene& s) { s.objects[0].first_face = 0xFFFFFFFE - 3; },
                  "object 0: a face's number is above 4294967294"},
        FaultCase{"TextureOfSomeVertices",
                  [](Scene& s) { s.meshes[0].texture_coordinates.resize(6); },
                  "texture_coordinates has 6 elements, expected one for each of 7 vertices"},
        FaultCase{"TextureOfSomeTriangles",
                  [](Scene& s) { s.meshes[0].texture_triangles.resize(4); },
                  "texture_triangles has 4 elements"},
        FaultCase{"TextureTrianglesOfNothing",
                  [](Scene& s) {
                    s.meshes[0].texture_triangles.resize(5, {no_index, 0, 0});
                  },
                  "texture_triangles 0: a corner is beyond the 0 texture_coordinates"},
        FaultCase{"TextureCornerBeyond",
                  [](Scene& s) {
                    s.meshes[0].texture_coordinates.resize(3);
                    s.meshes[0].texture_triangles.resize(5, {no_index, 2, 1});
                    s.meshes[0].texture_triangles[1] = {0, 1, 3};
                  },
                  "texture_triangles 1: a corner is beyond the 3 texture_coordinates"},
        FaultCase{"TextureNaN",
                  [](Scene& s) {
                    s.meshes[0].texture_coordinates.resize(7);
                    s.meshes[0].texture_coordinates[3][1] = std::nan("");
                  },
                  "texture_coordinates 3 has a number that is not finite"},
        FaultCase{"NormalsOfSomeVertices", [](Scene& s) { s.meshes[0].normals.resize(8); },
                  "normals has 8 elements"},
        FaultCase{"NormalInfinite",
                  [](Scene& s) {
                    s.meshes[0].normals.resize(7, {infinity, 0, 0});
                  },
                  "normals 0 has a number"},
        FaultCase{"NormalCornerBeyond",
                  [](Scene& s) {
                    s.meshes[0].normals.resize(1);
                    s.meshes[0].normal_triangles.resize(5, {0, 0, 1});
                  },
                  "normal_triangles 0: a corner is beyond the 1 normal"},
        FaultCase{"ColoursOfSomeVertices", [](Scene& s) { s.meshes[0].colours.resize(1); },
                  "colours has 1 element"},
        FaultCase{"ColourNaN",
                  [](Scene& s) {
                    s.meshes[0].colours.resize(7);
                    s.meshes[0].colours[5][3] = std::nanf("");
                  },
                  "colours 5 has a number"}),
    [](const auto& test) { return std::string(test.param.name); });

TEST(SceneFaults, ValidScenesHaveNone) {
  EXPECT_EQ(find_fault(Scene()), std::nullopt);
  Scene scene = strip(3);
  scene.meshes.emplace_back();  // empty, and placed by nobody
  scene.objects[0].first_face = 0xFFFFFFFE - 2;
  scene.meshes[0].vertices[0] = {std::numeric_limits<double>::max(),
                                 -std::numeric_limits<double>::max(),
                                 std::numeric_limits<double>::denorm_min()};
  scene.objects[0].placed_as_is = false;
  scene.objects[0].world_from_mesh.rows[2][3] = -Dyadic(1.0).scaled(-39999);
  scene.objects.push_back(scene.objects[0]);
  scene.objects[1].world_from_mesh.rows[2][3] = -Dyadic(1.0).scaled(2047);
  scene.meshes[0].texture_triangles.resize(3, {no_index, no_index, no_index});
  EXPECT_EQ(find_fault(scene), std::nullopt);
  scene.meshes[0].texture_coordinates.resize(1);
  scene.meshes[0].texture_triangles[2] = {0, 0, no_index};
  scene.meshes[0].face_of_triangle = {0, 0, 2};
  EXPECT_EQ(find_fault(scene), std::nullopt);
  // A transform may be singular.
  scene.objects[0].placed_as_is = false;
  for (auto& row : scene.objects[0].world_from_mesh.rows) row.fill(0.0);
  EXPECT_EQ(find_fault(scene), std::nullopt);
}

/// Every place in a list that is looked at in parts and blocks.
TEST(SceneFaults, AreFoundWhereverTheyAre) {
  constexpr std::uint32_t count = (1U << 15) + 77;
  Scene scene = strip(count);
  Mesh& mesh = scene.meshes[0];
  ASSERT_EQ(find_fault(scene), std::nullopt);
  for (std::uint32_t i = 0; i < count; i += i < 200 || i > count - 200 ? 1 : 191) {
    const MeshPoint before = mesh.vertices[i];
    (i % 3 == 0   ? mesh.vertices[i].x
     : i % 3 == 1 ? mesh.vertices[i].y
                  : mesh.vertices[i].z) = i % 2 == 0 ? infinity : std::nan("");
    EXPECT_EQ(find_fault(scene),
              "mesh 0: vertex " + std::to_string(i) + " has a number that is not finite");
    mesh.vertices[i] = before;
    std::uint32_t& corner = mesh.triangles[i][i % 3];
    const std::uint32_t index = corner;
    corner = count + 2;
    EXPECT_THAT(find_fault(scene).value_or(""),
                HasSubstr("triangle " + std::to_string(i) + ": a corner is beyond"));
    corner = index;
  }
  EXPECT_EQ(find_fault(scene), std::nullopt);
}

/// 2³² triangles in all, of one mesh that is placed often.
TEST(SceneFaults, TrianglesAreCountedOverAllObjects) {
  Scene scene = strip(1U << 20);
  scene.objects.resize(4095);
  EXPECT_EQ(find_fault(scene), std::nullopt);
  scene.objects.resize(4096);
  EXPECT_THAT(find_fault(scene).value_or(""),
              HasSubstr("triangles in all are more than 4294967294"));
  EXPECT_THROW(triangle_count(scene), InputError);
  EXPECT_THROW(TriangleSource{scene}, InputError);
}

TEST(SceneFaults, OfStreamedScenes) {
  StreamedScene scene;
  EXPECT_EQ(find_fault(scene), std::nullopt);
  scene.objects.emplace_back();
  EXPECT_THAT(find_fault(scene).value_or(""), HasSubstr("there is no mesh 0 among 0 meshes"));
  scene.streams.emplace_back();
  EXPECT_THAT(find_fault(scene).value_or(""), HasSubstr("mesh 0: there is no stream"));
  EXPECT_THROW(triangle_count(scene), InputError);
  EXPECT_THROW(TriangleSource{scene}, InputError);
  EXPECT_THROW(outline_of(scene), InputError);
}

/// Those that look at a single triangle refuse it where it is at fault.
TEST(SceneFaults, TrianglesAskedForByNumberAreRefused) {
  Scene scene = strip(5);
  scene.meshes[0].triangles[1] = {0, 1, 99};
  scene.meshes[0].vertices[6].x = infinity;
  const TriangleSource source(scene);
  EXPECT_EQ(source.triangle(0).origin.triangle, 0U);
  EXPECT_THROW(static_cast<void>(source.triangle(1)), InputError);
  EXPECT_THROW(static_cast<void>(source.world_corners(4)), InputError);
  EXPECT_THROW(static_cast<void>(source.triangle(5)), std::out_of_range);
  scene.meshes[0].face_of_triangle = {0};
  EXPECT_THROW(static_cast<void>(source.origin(3)), InputError);
  EXPECT_THROW(origin_of(scene, 3), InputError);
}

}  // namespace
}  // namespace fathom
