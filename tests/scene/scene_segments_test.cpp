#include "fathom/scene/scene_segments.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "fathom/failures/errors.h"
#include "fathom/scene/read_scene.h"
#include "fathom/scene/scene_fault.h"
#include "tests/scratch_folder.h"

namespace fathom {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

const std::vector<Segmentation> all{all_segmentations.begin(), all_segmentations.end()};
const std::string corners = "v 0 0 0\nv 1 0 0\nv 0 1 0\n";

class Segments : public testing::Test {
 protected:
  Scene read(const std::vector<std::filesystem::path>& files) {
    ReadOptions options;
    options.segments = true;
    Warnings warnings;
    return read_scene(files, options, warnings);
  }
  static std::vector<std::uint32_t> numbers_of(const TriangleSource& triangles, Segmentation by) {
    const SceneSegments segments(triangles, all);
    std::vector<std::uint32_t> numbers;
    for (std::uint32_t t = 0; t < triangles.count(); ++t)
      numbers.push_back(segments.number(by, triangles.origin(t)));
    return numbers;
  }
  static std::vector<std::string> names_of(const Scene& scene, Segmentation by) {
    return SceneSegments(scene, all).names(by);
  }
  std::filesystem::path write(const std::string& name, const std::string& text) {
    return folder.write(name, text);
  }
  ScratchFolder folder;
};

TEST_F(Segments, HaveOneNumberForAName_ThroughAllFiles) {
  const Scene scene =
      read({write("a.obj", corners + "usemtl oak\nf 1 2 3\nusemtl steel\nf 1 2 3\n"),
            write("b.obj", corners + "f 1 2 3\n"),
            write("c.obj", corners + "usemtl glass\nf 1 2 3\nusemtl oak\nf 1 2 3\n")});
  EXPECT_THAT(names_of(scene, Segmentation::material), ElementsAre("oak", "steel", "glass"));
  EXPECT_THAT(numbers_of(scene, Segmentation::material), ElementsAre(0, 1, unsegmented, 2, 0));
  EXPECT_THAT(numbers_of(scene, Segmentation::group), testing::Each(unsegmented));
  EXPECT_THAT(names_of(scene, Segmentation::group), IsEmpty());
}

TEST_F(Segments, OfASegmentationThatWasNotWantedAreNone) {
  const Scene scene = read({write("a.obj", corners + "usemtl oak\nf 1 2 3\n")});
  const SceneSegments segments(scene, {Segmentation::part});
  EXPECT_EQ(segments.number(Segmentation::material, {0, 0, 0}), unsegmented);
  EXPECT_THAT(segments.names(Segmentation::material), IsEmpty());
}

TEST_F(Segments, OfASceneFileComeBeforeThoseOfItsMeshes) {
  write("a.obj", corners + "o lid\nusemtl oak\nf 1 2 3\nusemtl steel\nf 1 2 3\n");
  const Scene scene = read({write("scene.json", R"({"meshes": [
    {"file": "a.obj"},
    {"file": "a.obj", "material": "glass", "label": 7},
    {"file": "a.obj", "label": 0},
    {"file": "a.obj", "material": "steel"}]})")});
  EXPECT_EQ(scene.meshes.size(), 1U);
  EXPECT_THAT(names_of(scene, Segmentation::material), ElementsAre("oak", "steel", "glass"));
  EXPECT_THAT(numbers_of(scene, Segmentation::material), ElementsAre(0, 1, 2, 2, 0, 1, 1, 1));
  EXPECT_THAT(numbers_of(scene, Segmentation::label),
              ElementsAre(unsegmented, unsegmented, 7, 7, 0, 0, unsegmented, unsegmented));
  EXPECT_THAT(numbers_of(scene, Segmentation::part), testing::Each(0U));
}

TEST_F(Segments, OfASceneFileAreChecked) {
  write("a.obj", corners + "f 1 2 3\n");
  const auto fault = [&](const std::string& member) {
    const auto file = write("scene.json", R"({"meshes": [{"file": "a.obj", )" + member + "}]}");
    return message_of<InputError>([&] { read({file}); });
  };
  EXPECT_THAT(fault(R"("label": -1)"), HasSubstr("meshes[0].label: expected"));
  EXPECT_THAT(fault(R"("label": 4294967294)"), HasSubstr("meshes[0].label: expected"));
  EXPECT_THAT(fault(R"("label": "7")"), HasSubstr("meshes[0].label: expected"));
  EXPECT_THAT(fault(R"("material": 7)"),
              HasSubstr("meshes[0].material: is a number, expected a string"));
}

TEST_F(Segments, OfFilesThatAreStreamed) {
  std::string bytes =
      "ply\nformat binary_little_endian 1.0\nelement vertex 0\nproperty uchar x\nproperty uchar y\n"
      "property uchar z\nelement face 0\nproperty list uchar uchar vertex_indices\n"
      "property uchar label\nend_header\n";
  bytes.replace(bytes.find("vertex 0"), 8, "vertex 3").replace(bytes.find("face 0"), 6, "face 2");
  bytes += std::string("\0\0\1\1\0\1\0\1\1", 9) + std::string("\3\0\1\2\5\3\0\1\2\6", 10);
  ReadOptions options;
  options.segments = true;
  Warnings warnings;
  const StreamedScene scene =
      stream_scene({write("a.ply", bytes), write("b.ply", bytes)}, options, warnings);
  EXPECT_THAT(numbers_of(scene, Segmentation::label), ElementsAre(5, 6, 5, 6));
  EXPECT_THAT(numbers_of(scene, Segmentation::material), testing::Each(unsegmented));
}

Scene two_triangles() {
  Scene scene;
  Mesh mesh;
  mesh.vertices = std::vector<MeshPoint>{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
  mesh.triangles = std::vector<CornerIndices>{{0, 1, 2}, {0, 2, 1}};
  mesh.face_count = 2;
  scene.meshes.push_back(mesh);
  scene.objects.push_back({.name = "object"});
  return scene;
}

std::string fault_of(std::vector<TriangleSegments> segments) {
  Scene scene = two_triangles();
  scene.meshes[0].segments = std::move(segments);
  return find_fault(scene).value_or("");
}

TEST(SegmentFaults, AreNamed) {
  const auto material = Segmentation::material, label = Segmentation::label;
  EXPECT_EQ(fault_of({{material, {0, 1}, {"a", "b"}}, {label, {7, unsegmented}, {}}}), "");
  EXPECT_EQ(fault_of({{material, {0}, {"a"}}}), "");
  EXPECT_EQ(fault_of({{material, {}, {}}}), "");
  EXPECT_EQ(fault_of({{material, {0, 0, 0}, {"a"}}}),
            "mesh 0: materials has 3 elements, expected one for each of 2 triangles");
  EXPECT_EQ(fault_of({{material, {0, 2}, {"a", "b"}}}),
            "mesh 0: triangle 1: its number is beyond the 2 materials");
  EXPECT_EQ(fault_of({{material, {0, no_index}, {"a", "b"}}}),
            "mesh 0: triangle 1: its number is beyond the 2 materials");
  EXPECT_EQ(fault_of({{material, {0}, {"a"}}, {material, {0}, {"a"}}}),
            "mesh 0: materials are there twice");
  EXPECT_EQ(fault_of({{label, {1, no_index}, {}}}),
            "mesh 0: triangle 1: the label is above 4294967294");
  EXPECT_EQ(fault_of({{label, {0}, {"a"}}}), "mesh 0: labels are numbers, they have no names");
  Scene scene = two_triangles();
  scene.objects[0].segments = std::make_shared<const ObjectSegments>(ObjectSegments{{}, no_index});
  EXPECT_EQ(find_fault(scene).value_or(""), "object 0: the label is above 4294967294");
}

/// Who asks in spite of them gets an error, not what is beyond a list.
TEST(SegmentFaults, AreNeverReadBeyond) {
  Scene scene = two_triangles();
  const auto ask = [&](TriangleSegments segments) {
    scene.meshes[0].segments = {std::move(segments)};
    return message_of<InputError>([&] {
      (void)SceneSegments(scene, all).number(Segmentation::material, {0, 2, 0});
    });
  };
  EXPECT_THAT(ask({Segmentation::material, {0, 0}, {"a"}}), HasSubstr("scene: a mesh has not"));
  EXPECT_THAT(ask({Segmentation::material, {5}, {"a"}}), HasSubstr("scene: a mesh has not"));
}

}  // namespace
}  // namespace fathom
