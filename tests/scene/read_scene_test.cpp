#include "fathom/scene/read_scene.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/stat.h>

#include <filesystem>
#include <thread>

#include "fathom/failures/errors.h"
#include "fathom/scene/scene_fault.h"
#include "tests/scratch_folder.h"

namespace fathom {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;

const std::string triangle = "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n";
const std::string polygon = "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nf 1 2 3 4\nf 1 2\nf 1 2 3\n";

class ReadScene : public testing::Test {
 protected:
  Scene read(const std::vector<std::filesystem::path>& files, const ReadOptions& options = {}) {
    warnings.clear();
    return read_scene(files, options, warnings);
  }
  std::string failure(const std::filesystem::path& file, const ReadOptions& options = {}) {
    return message_of<InputError>([&] { read({file}, options); });
  }
  ScratchFolder folder;
  Warnings warnings;
};

TEST_F(ReadScene, NumbersTrianglesOverAllFiles) {
  const Scene scene = read({folder.write("a.obj", triangle), folder.write("b.obj", polygon)});
  EXPECT_EQ(triangle_count(scene), 4U);
  EXPECT_EQ(scene.objects.at(0).name, "a");
  EXPECT_EQ(scene.objects.at(1).name, "b");
  EXPECT_TRUE(scene.objects.at(1).placed_as_is);
  const TriangleOrigin last = origin_of(scene, 3);
  EXPECT_EQ(last.object, 1U);
  EXPECT_EQ(last.triangle, 2U);
  EXPECT_EQ(last.face, 2U);
  EXPECT_EQ(origin_of(scene, 0).object, 0U);
  EXPECT_EQ(origin_of(scene, 2).face, 0U);
  EXPECT_THAT(warnings, ElementsAre(HasSubstr("b.obj: 1 face of fewer than three corners")));
}

TEST_F(ReadScene, HashesItsSources) {
  const Scene scene = read({folder.write("abc.obj", "# abc"), folder.write("a.obj", triangle)});
  ASSERT_EQ(scene.sources.size(), 2U);
  // sha256sum of the five bytes "# abc".
  EXPECT_EQ(scene.sources[0].sha256,
            "ed88ccf8ca7ecff67c780a0dd5a06c8342cd8de02ba5d99d63a48c8ffc83f0ae");
  EXPECT_EQ(scene.sources[1].path, (folder.path() / "a.obj").string());
  ReadOptions options;
  options.hash = false;
  EXPECT_EQ(read({folder.path() / "a.obj"}, options).sources[0].sha256, "");
}

TEST_F(ReadScene, TellsFormatsByContent) {
  const auto obj_as_stl = folder.write("a.stl", triangle);
  const auto off_as_obj = folder.write("b.obj", "OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n");
  const auto scene_as_txt = folder.write("c.txt", R"({"meshes": [{"file": "a.stl"}]})");
  const auto plain = folder.write("d", triangle);
  EXPECT_EQ(triangle_count(read({obj_as_stl, off_as_obj, scene_as_txt, plain})), 4U);
}

TEST_F(ReadScene, FormatOptionTakesThePlaceOfRecognition) {
  // Without a keyword, an OFF is only known by its suffix.
  const auto file = folder.write("a.txt", "3 1 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n");
  EXPECT_THAT(failure(file), HasSubstr("a.txt: its format is not recognised, expected OBJ, PLY"));
  ReadOptions options;
  options.format = FileFormat::off;
  EXPECT_EQ(triangle_count(read({file}, options)), 1U);
}

TEST_F(ReadScene, PlacesMeshesExactly) {
  folder.write("a.obj", triangle);
  const auto file = folder.write("s.json",
                                 R"({"meshes": [{"file": "a.obj", "name": "one",
                      "transform": [[0.1,0,0,1e-150],[0,2,0,0],[0,0,1,1e150]]},
                     {"file": "a.obj"}]})");
  const Scene scene = read({file});
  ASSERT_EQ(scene.objects.size(), 2U);
  EXPECT_EQ(scene.meshes.size(), 1U);  // read once, shown twice
  EXPECT_EQ(scene.objects[0].name, "one");
  EXPECT_EQ(scene.objects[1].name, "a");
  EXPECT_FALSE(scene.objects[0].placed_as_is);
  EXPECT_TRUE(scene.objects[1].placed_as_is);
  const WorldPoint p = scene.objects[0].world_from_mesh(MeshPoint{1, 3, 1});
  EXPECT_EQ(p.x, Dyadic(0.1) + Dyadic(1e-150));
  EXPECT_EQ(p.y, Dyadic(6.0));
  EXPECT_EQ(p.z, Dyadic(1e150) + Dyadic(1.0));
  EXPECT_EQ(scene.sources.size(), 2U);  // the scene file and the mesh
}

TEST_F(ReadScene, PlacesGltfNodesWithin) {
  folder.write("a.gltf", R"({"asset": {"version": "2.0"}, "scene": 0, "scenes": [{"nodes": [0]}],
    "nodes": [{"mesh": 0, "name": "n", "translation": [1, 2, 3]}],
    "meshes": [{"primitives": [{"attributes": {"POSITION": 0}}]}],
    "accessors": [{"bufferView": 0, "componentType": 5126, "count": 3, "type": "VEC3",
                   "min": [0,0,0], "max": [0,0,0]}],
    "bufferViews": [{"buffer": 0, "byteLength": 36}],
    "buffers": [{"byteLength": 36,
                 "uri": "data:application/octet-stream;base64,)"
                         R"(AAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAA"}]})");
  const auto file = folder.write("s.json",
                                 R"({"meshes": [{"file": "a.gltf", "name": "g",
                      "transform": [[2,0,0,10],[0,2,0,20],[0,0,2,30]]}]})");
  const Scene scene = read({file});
  ASSERT_EQ(scene.objects.size(), 1U);
  EXPECT_EQ(scene.objects[0].name, "g");
  const WorldPoint p = scene.objects[0].world_from_mesh(MeshPoint{0, 0, 0});
  EXPECT_EQ(p.x, Dyadic(12.0));
  EXPECT_EQ(p.y, Dyadic(24.0));
  EXPECT_EQ(p.z, Dyadic(36.0));
}

TEST_F(ReadScene, RefusesBadSceneFiles) {
  folder.write("a.obj", triangle);
  const auto scene_failure = [&](const std::string& text) {
    return failure(folder.write("s.json", text));
  };
  EXPECT_THAT(scene_failure(R"({"meshes": [{"file": "a.obj", "scale": 2}]})"),
              HasSubstr("meshes[0]: unknown key \"scale\""));
  EXPECT_THAT(scene_failure(R"({"meshes": [], "lights": []})"),
              HasSubstr("unknown key \"lights\""));
  EXPECT_THAT(scene_failure(R"({"meshes": [{}]})"),
              HasSubstr("meshes[0]: the key \"file\" is missing"));
  EXPECT_THAT(scene_failure(R"({"meshes": [{"file": 3}]})"), HasSubstr("meshes[0].file"));
  EXPECT_THAT(scene_failure(R"({"meshes": [{"file": "-"}]})"), HasSubstr("meshes[0].file"));
  EXPECT_THAT(scene_failure(R"({"meshes": [{"file": "a.obj", "transform": [[1,0,0,0]]}]})"),
              HasSubstr("meshes[0].transform"));
  EXPECT_THAT(
      scene_failure(
          R"({"meshes": [{"file": "a.obj", "transform": [[1,0,0,0],[1,0,0,0],[1,0,0,"x"]]}]})"),
      HasSubstr("meshes[0].transform[2][3]"));
  EXPECT_THAT(scene_failure(
                  R"({"meshes": [{"file": "a.obj",
                            "transform": [[1,0,0,0],[0,1,0,0],[0,0,1,0],[0,0,1,1]]}]})"),
              HasSubstr("expected 0 0 0 1"));
  EXPECT_THAT(
      scene_failure(
          R"({"meshes": [{"file": "a.obj", "transform": [[1,0,0,1e400],[0,1,0,0],[0,0,1,0]]}]})"),
      HasSubstr("s.json"));
  EXPECT_THAT(scene_failure(R"({"meshes": [{"file": "none.obj"}]})"),
              HasSubstr("none.obj: cannot be opened"));
  EXPECT_THAT(scene_failure(R"({"meshes": [{"file": "s.json"}]})"), HasSubstr("is no mesh"));
  EXPECT_THAT(scene_failure("{\n\"meshes\": [}"), HasSubstr("s.json: line 2"));
  EXPECT_THAT(scene_failure("[]"), HasSubstr("expected a scene file"));
}

TEST_F(ReadScene, RefusesWhatIsNoFile) {
  EXPECT_THAT(failure(folder.path()), HasSubstr("is a directory"));
  EXPECT_THAT(failure(folder.path() / "none.obj"), HasSubstr("cannot be opened: No such file"));
  EXPECT_THAT(failure(folder.write("empty.obj", "")), HasSubstr("empty.obj: is empty"));
  ReadOptions options;
  options.format = FileFormat::obj;
  EXPECT_THAT(failure(folder.path() / "empty.obj", options), HasSubstr("is empty"));
  options.format = FileFormat::gltf;
  EXPECT_THAT(failure(folder.path() / "empty.obj", options), HasSubstr("empty.obj"));
}

TEST_F(ReadScene, WarnsOfAMeshWithoutFaces) {
  EXPECT_EQ(triangle_count(read({folder.write("a.obj", "v 0 0 0\n")})), 0U);
  EXPECT_THAT(warnings, ElementsAre(HasSubstr("a.obj: has no faces")));
}

TEST_F(ReadScene, LeavesOutAttributesThatAreNotFinite) {
  ReadOptions options;
  options.attributes = true;
  const auto head = [](const char* more) {
    return std::string(
               "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\n"
               "property float z\nproperty float nx\nproperty float ny\nproperty float nz\n") +
           more + "element face 1\nproperty list uchar int vertex_indices\nend_header\n";
  };
  // A list by vertex becomes one by corner.
  const Scene ply = read({folder.write("a.ply", head("") + "0 0 0 0 0 1\n1 0 0 nan 0 1\n"
                                                           "0 1 0 0 -inf 0\n3 0 1 2\n")},
                         options);
  EXPECT_THAT(ply.meshes[0].normal_triangles, ElementsAre(CornerIndices{0, no_index, no_index}));
  EXPECT_THAT(warnings, ElementsAre(HasSubstr("a.ply: 2 normals, texture coordinates or colours")));
  EXPECT_EQ(find_fault(ply), std::nullopt);
  // What is named by corners loses those alone; what is finite stays as it is.
  warnings.clear();
  const Scene obj = read({folder.write("a.obj",
                                       "v 0 0 0\nv 1 0 0\nv 0 1 0\nvn 0 0 1\nvn nan 0 0\n"
                                       "vt 0 inf\nvt 1 0\nf 1/1/1 2/2/2 3/2/1\n")},
                         options);
  EXPECT_THAT(obj.meshes[0].normal_triangles, ElementsAre(CornerIndices{0, no_index, 0}));
  EXPECT_THAT(obj.meshes[0].texture_triangles, ElementsAre(CornerIndices{no_index, 1, 1}));
  EXPECT_THAT(warnings, ElementsAre(HasSubstr("a.obj: 2 normals")));
  EXPECT_EQ(find_fault(obj), std::nullopt);
  warnings.clear();
  const Scene whole = read({folder.write("b.ply", head("") + "0 0 0 0 0 1\n1 0 0 0 0 1\n"
                                                             "0 1 0 0 0 1\n3 0 1 2\n")},
                           options);
  EXPECT_TRUE(whole.meshes[0].normal_triangles.empty());
  EXPECT_TRUE(warnings.empty());
}

TEST_F(ReadScene, ReadsPipes) {
  const std::filesystem::path pipe = folder.path() / "pipe";
  ASSERT_EQ(mkfifo(pipe.c_str(), 0600), 0);
  std::thread writer([&] { std::ofstream(pipe) << triangle; });
  const Scene scene = read({pipe});
  writer.join();
  EXPECT_EQ(triangle_count(scene), 1U);
}

/// Above 64 MiB files are mapped.
TEST_F(ReadScene, ReadsLargeFiles) {
  std::string text = triangle;
  text.append(std::size_t{70} << 20, '\n');
  text += "f 3 2 1\nf 1 2 9\n";
  const auto file = folder.write("a.obj", text);
  EXPECT_THAT(failure(file),
              HasSubstr("a.obj: line " + std::to_string((70 << 20) + 6) + ": vertex index 9"));
}

}  // namespace
}  // namespace fathom
