// Meshes that assimp reads: the geometry is that of the file, placed exactly, and says who read it.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "assimp_files.h"
#include "foreign_scene.h"
#include "tests/apps/run_program.h"
#include "tests/apps/test_folder.h"

namespace fathom::test {
namespace {

using ::testing::AllOf;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::StartsWith;

std::string mesh_file(const std::string& name) {
  return source_dir() / "data/meshes" / name;
}

/// The corners of an OBJ file, rounded to binary32.
std::vector<ExactCorner> corners_of_obj(const std::string& file) {
  Warnings warnings;
  Scene scene = read_scene({file}, {}, warnings);
  for (MeshPoint& p : scene.meshes.at(0).vertices) {
    for (double* x : {&p.x, &p.y, &p.z}) *x = static_cast<float>(*x);
  }
  return corners_in_world(scene);
}

/// y up, as assimp turns a frame with z up.
ExactCorner turned(const ExactCorner& p) {
  return {p[0], p[2], -p[1]};
}

struct Format {
  std::string exporter, suffix;
  bool turns = false;  ///< until y is up
};

void PrintTo(const Format& format, std::ostream* out) {
  *out << format.exporter;
}

class AssimpFormats : public ::testing::TestWithParam<Format> {
 protected:
  static Scene read(const std::string& obj) {
    const Format& format = GetParam();
    return read_bytes("mesh." + format.suffix,
                      exported(read_polygons(mesh_file(obj)), format.exporter));
  }

  /// What is expected of a file that holds binary32 numbers.
  static std::vector<ExactCorner> expected(const std::string& obj) {
    std::vector<ExactCorner> corners = corners_of_obj(mesh_file(obj));
    if (GetParam().turns) std::ranges::transform(corners, corners.begin(), turned);
    return corners;
  }
};

// Its coordinates are short: no decimal is rounded.
TEST_P(AssimpFormats, HaveTheGeometryOfTheirObj) {
  const Scene scene = read("cube.obj");
  EXPECT_EQ(corners_in_world(scene), expected("cube.obj"));
}

/// Those whose exporter does not cut polygons itself.
class AssimpPolygonFormats : public AssimpFormats {};

TEST_P(AssimpPolygonFormats, AreCutAsEveryOtherFormat) {
  const Scene scene = read("l-shape.obj");
  EXPECT_EQ(corners_in_world(scene), expected("l-shape.obj"));
  EXPECT_EQ(origin_of(scene, 5).face, 1U);
}

TEST_P(AssimpFormats, SayWhoReadThem) {
  const Scene scene = read("cube.obj");
  ASSERT_EQ(scene.sources.size(), 1U);
  EXPECT_THAT(scene.sources[0].reader, StartsWith("assimp 5."));
  EXPECT_EQ(scene.sources[0].sha256.size(), 64U);
}

const auto with_polygons =
    ::testing::Values(Format{"collada", "dae"}, Format{"fbx", "fbx"}, Format{"fbxa", "fbx"},
                      Format{"x", "x"}, Format{"x3d", "x3d"});
const auto of_triangles = ::testing::Values(Format{"3ds", "3ds", true}, Format{"3mf", "3mf"});

std::string name_of(const ::testing::TestParamInfo<Format>& tested) {
  return "As_" + tested.param.exporter;
}

INSTANTIATE_TEST_SUITE_P(Polygons, AssimpFormats, with_polygons, name_of);
INSTANTIATE_TEST_SUITE_P(Triangles, AssimpFormats, of_triangles, name_of);
INSTANTIATE_TEST_SUITE_P(Polygons, AssimpPolygonFormats, with_polygons, name_of);

TEST(Assimp, BinaryNumbersArriveBitForBit) {
  std::vector<ExactCorner> expected = corners_of_obj(mesh_file("spot.obj"));
  const Polygons spot = read_polygons(mesh_file("spot.obj"));
  EXPECT_EQ(corners_in_world(read_bytes("spot.fbx", exported(spot, "fbx"))), expected);
  std::ranges::transform(expected, expected.begin(), turned);
  EXPECT_EQ(corners_in_world(read_bytes("spot.3ds", exported(spot, "3ds"))), expected);
}

/// A COLLADA file with this scene and a unit square g, as one face.
std::string collada(const std::string& nodes, const std::string& asset = "",
                    const std::string& positions = "0 0 0 1 0 0 1 1 0 0 1 0",
                    const std::string& primitives =
                        "<polylist count='1'><input semantic='VERTEX' source='#v' offset='0'/>"
                        "<vcount>4</vcount><p>0 1 2 3</p></polylist>") {
  return "<?xml version='1.0'?><COLLADA xmlns='http://www.collada.org/2005/11/COLLADASchema' "
         "version='1.4.1'><asset>" +
         asset +
         "</asset><library_geometries><geometry id='g'><mesh><source id='p'>"
         "<float_array id='a' count='12'>" +
         positions +
         "</float_array><technique_common><accessor source='#a' count='4' stride='3'>"
         "<param name='X' type='float'/><param name='Y' type='float'/><param name='Z' "
         "type='float'/>"
         "</accessor></technique_common></source><vertices id='v'>"
         "<input semantic='POSITION' source='#p'/></vertices>" +
         primitives +
         "</mesh></geometry></library_geometries><library_visual_scenes><visual_scene id='s'>" +
         nodes +
         "</visual_scene></library_visual_scenes><scene><instance_visual_scene url='#s'/></scene>"
         "</COLLADA>";
}

const std::string show_g = "<instance_geometry url='#g'/>";

TEST(Assimp, PlacesNodesExactly) {
  const Scene scene = read_bytes(
      "nodes.dae", collada("<node id='o' name='outer'><matrix>0.1 0 0 0 0 1 0 5 0 0 1 0 0 0 0 1"
                           "</matrix><node id='i' name='inner'><translate>0.3 0 0</translate>" +
                           show_g + "</node></node>"));
  ASSERT_EQ(scene.objects.size(), 1U);
  const Object& object = scene.objects[0];
  EXPECT_EQ(object.name, "inner");
  const Dyadic tenth(double{0.1F}), three_tenths(double{0.3F});
  EXPECT_EQ(object.world_from_mesh.rows[0],
            (std::array<Dyadic, 4>{tenth, 0., 0., tenth * three_tenths}));
  EXPECT_EQ(object.world_from_mesh.rows[1], (std::array<Dyadic, 4>{0., 1., 0., 5.}));
}

TEST(Assimp, TurnsColladaUntilYIsUpAndTakesMetres) {
  const Scene scene =
      read_bytes("z-up.dae", collada("<node id='n'>" + show_g + "</node>",
                                     "<unit name='cm' meter='0.01'/><up_axis>Z_UP</up_axis>"));
  const Dyadic hundredth(double{0.01F});
  EXPECT_EQ(corners_in_world(scene).at(2), (ExactCorner{hundredth, 0., -hundredth}));
}

TEST(Assimp, NodesThatShowTheSameMeshShareIt) {
  const Scene scene =
      read_bytes("twice.dae", collada("<node id='a' name='a'>" + show_g +
                                      "</node><node id='b' name='b'>" + show_g + "</node>"));
  ASSERT_EQ(scene.objects.size(), 2U);
  EXPECT_EQ(scene.meshes.size(), 1U);
  EXPECT_EQ(scene.objects[1].name, "b");
  EXPECT_EQ(scene.objects[1].first_face, 1U);
  EXPECT_EQ(triangle_count(scene), 4U);
}

TEST(Assimp, LinesAreSkippedWithAWarning) {
  Warnings warnings;
  const Scene scene = read_bytes(
      "lines.dae",
      collada(
          "<node id='a'>" + show_g + "</node>", "", "0 0 0 1 0 0 1 1 0 0 1 0",
          "<lines count='2'><input semantic='VERTEX' source='#v' offset='0'/><p>0 1 2 3</p></lines>"
          "<triangles count='1'><input semantic='VERTEX' source='#v' offset='0'/><p>0 1 2</p>"
          "</triangles>"),
      warnings);
  EXPECT_EQ(triangle_count(scene), 1U);
  EXPECT_THAT(warnings,
              ElementsAre(HasSubstr("lines.dae: 2 faces of fewer than three corners are")));
}

TEST(Assimp, FilesWithoutFacesAreAWarning) {
  Warnings warnings;
  const Scene scene = read_bytes("empty.dae", collada("<node id='a'/>"), warnings);
  EXPECT_EQ(triangle_count(scene), 0U);
  EXPECT_THAT(warnings, ElementsAre(HasSubstr("empty.dae: has no faces")));
}

TEST(Assimp, CoordinatesThatAreNotFiniteAreRefused) {
  EXPECT_THAT(refusal_of("nan.dae", collada("<node id='a'>" + show_g + "</node>", "",
                                            "1e39 0 0 1 0 0 1 1 0 0 1 0")),
              HasSubstr("nan.dae: assimp gives a vertex a coordinate that is not finite"));
}

TEST(Assimp, TransformsThatAreNotAffineAreRefusedWhereAMeshIsPlaced) {
  const std::string projection = "<matrix>1 0 0 0 0 1 0 0 0 0 1 0 0 0 1 1</matrix>";
  EXPECT_THAT(refusal_of("p.dae", collada("<node id='a' name='lens'>" + projection +
                                          "<node id='b'>" + show_g + "</node></node>")),
              HasSubstr("p.dae: the node 'lens' has a transform that is not affine"));
  EXPECT_EQ(
      triangle_count(read_bytes("q.dae", collada("<node id='a'>" + projection +
                                                 "</node><node id='b'>" + show_g + "</node>"))),
      2U);
}

TEST(Assimp, DeepTransformsAreRefused) {
  std::string nodes, ends;
  for (int i = 0; i < 201; ++i) {
    nodes += "<node><translate>1 0 0</translate>";
    ends += "</node>";
  }
  EXPECT_THAT(refusal_of("deep.dae", collada(nodes + show_g + ends)),
              HasSubstr("lies below too many transforms"));
}

TEST(Assimp, KeepsNormalsWhereTheyAreAskedFor) {
  Warnings warnings;
  const std::string bytes = exported(read_polygons(mesh_file("l-shape.obj")), "collada");
  EXPECT_THAT(read_bytes("n.dae", bytes, warnings).meshes.at(0).normals, IsEmpty());
  const Scene scene = read_bytes("n.dae", bytes, warnings, {.attributes = true});
  const Mesh& mesh = scene.meshes.at(0);
  ASSERT_EQ(mesh.normals.size(), mesh.vertices.size());
  EXPECT_EQ(mesh.normals.at(0), (std::array<double, 3>{0, 0, 1}));
}

TEST(Assimp, SuffixesAreKnownInAnyCaseAndContentComesFirst) {
  const std::string bytes = exported(read_polygons(mesh_file("cube.obj")), "fbxa");
  EXPECT_EQ(triangle_count(read_bytes("CUBE.FBX", bytes)), 12U);
  EXPECT_EQ(read_bytes("really-obj.fbx", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n").sources[0].reader,
            "");
}

TEST(Assimp, MapsAndInfoNameIt) {
  const TestFolder folder;
  folder.write("cube.dae", exported(read_polygons(mesh_file("cube.obj")), "collada"));
  const std::string mesh = folder / "cube.dae", map = folder / "map.exr";
  ASSERT_EQ(run_fathom({"render", mesh, "--size", "32x32", "-o", map}).status, 0);
  const Outcome header = run({"oiiotool", "--info", "-v", map});
  EXPECT_THAT(header.out, HasSubstr("\"reader\":\"assimp 5."));
  EXPECT_THAT(run_fathom({"info", mesh}).out, HasSubstr("), read by assimp 5."));
  EXPECT_THAT(run_fathom({"info", mesh, "--json"}).out, HasSubstr("\"reader\": \"assimp 5."));
  const Outcome own = run_fathom({"info", mesh_file("cube.obj"), "--json"});
  EXPECT_THAT(own.out, ::testing::Not(HasSubstr("reader")));
}

TEST(Assimp, ScenesPlaceItsMeshes) {
  const TestFolder folder;
  folder.write("cube.dae", exported(read_polygons(mesh_file("cube.obj")), "collada"));
  folder.write("scene.json", R"({"meshes": [{"file": "cube.dae", "name": "box"}]})");
  EXPECT_THAT(run_fathom({"info", folder / "scene.json"}).out,
              AllOf(HasSubstr("object     box: 12 triangles"), HasSubstr("read by assimp")));
}

TEST(Assimp, FormatsAreListed) {
  const Outcome list = run_fathom({"formats"});
  EXPECT_EQ(list.status, 0);
  EXPECT_THAT(list.out, AllOf(StartsWith("assimp 5."), HasSubstr(" fbx ")));
}

}  // namespace
}  // namespace fathom::test
