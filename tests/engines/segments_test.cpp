// Channels material, group, part and label: both engines, and the pipeline, against what the scene
// says of the triangle that channel id names.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <random>
#include <set>

#include "fathom/camera/camera_making.h"
#include "fathom/render.h"
#include "fathom/render_by_pipeline.h"
#include "fathom/rendering/segment_channels.h"
#include "fathom/scene/read_scene.h"
#include "fathom/scene/scene_segments.h"
#include "tests/effort.h"
#include "tests/engines/expect_same_map.h"
#include "tests/inputs/spheres.h"
#include "tests/scratch_folder.h"

namespace fathom {
namespace {

using checks::expect_same_map;

const std::vector<Channel> channels{Channel::id,    Channel::material, Channel::group,
                                    Channel::label, Channel::part,     Channel::Z};

/// Two spheres of one mesh, three segmentations of its triangles, and one of the first object.
Scene named_spheres() {
  Scene scene = checks::two_spheres(checks::effort > 1 ? 8 : 24);
  Mesh& mesh = scene.meshes[0];
  std::mt19937_64 random(771);
  const auto numbers = [&](std::uint32_t below) {
    std::vector<std::uint32_t> result(mesh.triangles.size());
    for (std::uint32_t& number : result) {
      number = static_cast<std::uint32_t>(random() % (below + 1));
      if (number == below) number = unsegmented;
    }
    return result;
  };
  mesh.segments = {{Segmentation::material, numbers(3), {"oak", "steel", "glass"}},
                   {Segmentation::label, numbers(100), {}},
                   {Segmentation::group, {0}, {"sphere"}}};
  scene.objects[0].segments = std::make_shared<const ObjectSegments>(
      ObjectSegments{{{Segmentation::part, "left"}, {Segmentation::material, "clay"}}, {}});
  return scene;
}

Camera camera_of_spheres() {
  return look_at({3, 1, 2}, {0.4, 0, 0.1}, {0, 1, 0}, {.width = 61, .height = 53});
}

/// The numbering of the specification, written out once more: names by objects in their order, an
/// object's own before its mesh's.
std::string name_at(const Scene& scene, Segmentation by, std::uint32_t triangle) {
  const TriangleOrigin origin = origin_of(scene, triangle);
  const Object& object = scene.objects[origin.object];
  if (object.segments && object.segments->names.contains(by)) return object.segments->names.at(by);
  const TriangleSegments* const segments = scene.meshes[object.mesh].segments_by(by);
  if (!segments) return "";
  const std::uint32_t number =
      segments->numbers[segments->numbers.size() == 1 ? 0 : origin.triangle];
  return number == unsegmented ? "" : segments->names[number];
}

void expect_names(const DepthMap& map, const Scene& scene, const std::string& channel,
                  Segmentation by) {
  const auto& ids = *map.values<std::uint32_t>("id");
  const auto& values = *map.values<std::uint32_t>(channel);
  const auto table = map.tables.find(channel);
  std::set<std::uint32_t> seen;
  for (std::size_t i = 0; i < ids.size(); ++i) {
    seen.insert(values[i]);
    if (ids[i] == no_surface) {
      ASSERT_EQ(values[i], no_surface);
      continue;
    }
    const std::string name = name_at(scene, by, ids[i]);
    if (name.empty()) {
      ASSERT_EQ(values[i], no_segment) << channel << " " << i;
    } else {
      ASSERT_EQ(table->second.at(values[i]), name) << channel << " " << i;
    }
  }
  EXPECT_TRUE(seen.contains(no_surface));
}

void expect_truth(const DepthMap& map, const Scene& scene) {
  expect_names(map, scene, "material", Segmentation::material);
  expect_names(map, scene, "group", Segmentation::group);
  expect_names(map, scene, "part", Segmentation::part);
  EXPECT_THAT(map.tables.at("material"), ::testing::ElementsAre("clay", "oak", "steel", "glass"));
  EXPECT_THAT(map.tables.at("part"), ::testing::ElementsAre("left"));
  EXPECT_FALSE(map.tables.contains("label"));
  const auto& ids = *map.values<std::uint32_t>("id");
  const auto& labels = *map.values<std::uint32_t>("label");
  for (std::size_t i = 0; i < ids.size(); ++i) {
    const std::uint32_t truth =
        ids[i] == no_surface
            ? no_surface
            : scene.meshes[0].segments[1].numbers[origin_of(scene, ids[i]).triangle];
    ASSERT_EQ(labels[i], truth);
  }
}

TEST(SegmentChannels, AreWhatTheSceneSaysInEveryEngine) {
  const Scene scene = named_spheres();
  const Camera camera = camera_of_spheres();
  RenderOptions options{.channels = channels};
  const DepthMap fast = render(scene, camera, options).map;
  expect_truth(fast, scene);
  options.engine = Engine::reference;
  const DepthMap reference = render(scene, camera, options).map;
  expect_truth(reference, scene);
  expect_same_map(fast, reference);
  EXPECT_EQ(fast.tables, reference.tables);
  pipeline::PipelineOptions stages;
  const DepthMap pipeline = render_by_pipeline(scene, camera, stages, channels, false).map;
  expect_truth(pipeline, scene);
}

TEST(SegmentChannels, OfASceneWithoutSegmentsSayThatThereAreNone) {
  const Scene scene = checks::two_spheres(6);
  for (const Engine engine : {Engine::fast, Engine::reference}) {
    const DepthMap map =
        render(scene, camera_of_spheres(), {.engine = engine, .channels = channels}).map;
    EXPECT_TRUE(map.tables.empty());
    const auto& ids = *map.values<std::uint32_t>("id");
    for (const char* channel : {"material", "group", "part", "label"}) {
      const auto& values = *map.values<std::uint32_t>(channel);
      for (std::size_t i = 0; i < ids.size(); ++i)
        ASSERT_EQ(values[i], ids[i] == no_surface ? no_surface : no_segment);
    }
  }
}

/// Tables belong to channels.
TEST(SegmentChannels, HaveTablesOnlyWhereTheyAreInTheMap) {
  const Scene scene = named_spheres();
  const DepthMap map = render(scene, camera_of_spheres(), {.channels = {Channel::part}}).map;
  EXPECT_EQ(map.tables.size(), 1U);
  EXPECT_TRUE(render(scene, camera_of_spheres(), {}).map.tables.empty());
}

/// The labels of a file that is streamed are those of the file in memory.
TEST(SegmentChannels, OfAStreamAreThoseOfTheSceneInMemory) {
  const Scene spheres = checks::two_spheres(10);
  const Mesh& mesh = spheres.meshes[0];
  std::string bytes = "ply\nformat binary_little_endian 1.0\nelement vertex " +
                      std::to_string(mesh.vertices.size()) +
                      "\nproperty double x\nproperty double y\nproperty double z\nelement face " +
                      std::to_string(mesh.triangles.size()) +
                      "\nproperty int label\nproperty list uchar uint vertex_indices\nend_header\n";
  const auto put = [&](const auto& value) {
    bytes.append(reinterpret_cast<const char*>(&value), sizeof value);
  };
  for (const MeshPoint& p : mesh.vertices) put(p.x), put(p.y), put(p.z);
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    put(static_cast<std::int32_t>(t % 13) - 1);
    put(std::uint8_t{3});
    put(mesh.triangles[t]);
  }
  const ScratchFolder folder;
  const auto file = folder.write("a.ply", bytes);
  ReadOptions reading;
  reading.segments = true;
  Warnings warnings;
  const Camera camera = camera_of_spheres();
  const RenderOptions options{.channels = {Channel::label, Channel::face}};
  const DepthMap in_memory = render(read_scene({file}, reading, warnings), camera, options).map;
  const DepthMap streamed = render(stream_scene({file}, reading, warnings), camera, options).map;
  expect_same_map(streamed, in_memory);
  const auto& faces = *streamed.values<std::uint32_t>("face");
  std::uint64_t labelled = 0;
  for (std::size_t i = 0; i < faces.size(); ++i) {
    const std::uint32_t label = streamed.values<std::uint32_t>("label")->at(i);
    if (faces[i] == no_surface) continue;
    ASSERT_EQ(label, faces[i] % 13 == 0 ? no_segment : faces[i] % 13 - 1);
    labelled += label != no_segment;
  }
  EXPECT_GT(labelled, 100U);
}

}  // namespace
}  // namespace fathom
