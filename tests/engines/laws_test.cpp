// What must not change a map, and what must change only what it should.
#include <gtest/gtest.h>

#include <algorithm>
#include <bit>
#include <random>

#include "fathom/reference/probe.h"
#include "tests/engines/tested_engine.h"
#include "tests/inputs/scene_building.h"
#include "tests/inputs/soup.h"

namespace fathom {
namespace {

using checks::camera_of;
using checks::scene_of;
using checks::soup_around_eye;

constexpr std::uint32_t width = 12, height = 10;

RenderOptions with(std::vector<Channel> channels) {
  RenderOptions options;
  options.channels = std::move(channels);
  return options;
}

std::vector<std::uint32_t> bits(const DepthMap& map, const char* channel) {
  std::vector<std::uint32_t> result;
  for (const float x : *map.values<float>(channel)) {
    result.push_back(std::bit_cast<std::uint32_t>(x));
  }
  return result;
}

TEST(Laws, TheOrderOfCornersChangesOnlyBarycentricWeights) {
  std::mt19937 random(31);
  const auto options = with({Channel::Z, Channel::id, Channel::N, Channel::P, Channel::distance});
  for (int trial = 0; trial < 50; ++trial) {
    Scene scene = soup_around_eye(random, 6);
    const Camera camera = camera_of(width, height, 8);
    const DepthMap before = checks::render_tested(scene, camera, options);
    for (CornerIndices& t : scene.meshes[0].triangles) {
      std::shuffle(t.begin(), t.end(), random);  // both windings
    }
    const DepthMap after = checks::render_tested(scene, camera, options);
    EXPECT_EQ(*before.values<std::uint32_t>("id"), *after.values<std::uint32_t>("id"));
    for (const char* c : {"Z", "N.X", "N.Y", "N.Z", "P.X", "P.Y", "P.Z", "distance"}) {
      EXPECT_EQ(bits(before, c), bits(after, c)) << c;
    }
  }
}

TEST(Laws, TheOrderOfTrianglesChangesOnlyTheirNumbers) {
  std::mt19937 random(32);
  for (int trial = 0; trial < 50; ++trial) {
    Scene scene = soup_around_eye(random, 8);
    const Camera camera = camera_of(width, height, 8);
    const DepthMap before = checks::render_tested(scene, camera, with({Channel::Z, Channel::id}));
    std::shuffle(scene.meshes[0].triangles.begin(), scene.meshes[0].triangles.end(), random);
    const DepthMap after = checks::render_tested(scene, camera, with({Channel::Z, Channel::id}));
    EXPECT_EQ(bits(before, "Z"), bits(after, "Z"));
  }
}

TEST(Laws, AmongEqualDepthsTheLowestNumberIsVisible) {
  Scene scene = scene_of({{-9, -9, 2}, {9, -9, 2}, {0, 9, 2}}, {{0, 1, 2}, {1, 2, 0}, {2, 1, 0}});
  const DepthMap map = checks::render_tested(scene, camera_of(4, 4, 1), with({Channel::id}));
  for (const std::uint32_t id : *map.values<std::uint32_t>("id"))
    EXPECT_TRUE(id == 0 || id == no_surface);
  EXPECT_EQ(map.values<std::uint32_t>("id")->at(5), 0U);
}

// An edge's midpoint is exact here; the two halves cover what the whole did, each sample once.
TEST(Laws, SplittingATriangleChangesNothingThatIsSeen) {
  std::mt19937 random(33);
  for (int trial = 0; trial < 100; ++trial) {
    const Scene whole = soup_around_eye(random, 3);
    Scene split = whole;
    Mesh& mesh = split.meshes[0];
    mesh.triangles.clear();
    for (const CornerIndices& t : whole.meshes[0].triangles) {
      const MeshPoint &a = mesh.vertices[t[0]], &b = mesh.vertices[t[1]];
      const auto middle = static_cast<std::uint32_t>(mesh.vertices.size());
      const MeshPoint m{(a.x + b.x) / 2, (a.y + b.y) / 2, (a.z + b.z) / 2};
      mesh.vertices.push_back(m);
      mesh.triangles.push_back({t[0], middle, t[2]});
      mesh.triangles.push_back({middle, t[1], t[2]});
    }
    const Camera camera = camera_of(width, height, 8);
    const auto channels = with({Channel::Z, Channel::N, Channel::P, Channel::distance});
    const Rendered before = checks::render_and_count(whole, camera, channels);
    const Rendered after = checks::render_and_count(split, camera, channels);
    for (const char* c : {"Z", "N.X", "N.Y", "N.Z", "P.X", "P.Y", "P.Z", "distance"}) {
      ASSERT_EQ(bits(before.map, c), bits(after.map, c)) << c << ", trial " << trial;
    }
    ASSERT_EQ(before.statistics.pixels_with_surface, after.statistics.pixels_with_surface) << trial;
    if (checks::tested_engine() == Engine::fast) continue;  // it counts samples by draw order
    ASSERT_EQ(before.statistics.samples_covered, after.statistics.samples_covered) << trial;
  }
}

TEST(Laws, ShiftingThePrincipalPointByWholePixelsShiftsTheMap) {
  std::mt19937 random(34);
  for (int trial = 0; trial < 30; ++trial) {
    const Scene scene = soup_around_eye(random, 6);
    const Camera camera = camera_of(width, height, 8);
    Camera shifted = camera;
    shifted.projection.cx += 3;
    shifted.projection.cy -= 2;
    const auto before = bits(checks::render_tested(scene, camera), "Z"),
               after = bits(checks::render_tested(scene, shifted), "Z");
    for (std::uint32_t y = 2; y < height; ++y) {
      for (std::uint32_t x = 0; x + 3 < width; ++x) {
        ASSERT_EQ(before[y * width + x], after[(y - 2) * width + x + 3]);
      }
    }
  }
}

// Mirroring world and camera alike changes nothing; mirroring the image moves samples on edges to
// the other side, so it is compared only where no covering triangle has a sample on its edge.
TEST(Laws, MirroringTheWorldAndTheCameraChangesNothing) {
  std::mt19937 random(35);
  for (int trial = 0; trial < 30; ++trial) {
    Scene scene = soup_around_eye(random, 6);
    Camera camera = camera_of(width, height, 8);
    const auto before = bits(checks::render_tested(scene, camera), "Z");
    for (MeshPoint& p : scene.meshes[0].vertices) p.x = -p.x;
    for (auto& row : camera.world_to_camera) row[0] = -row[0];
    EXPECT_EQ(before, bits(checks::render_tested(scene, camera), "Z"));
  }
}

TEST(Laws, MirroringTheImageReversesItsRows) {
  std::mt19937 random(36);
  for (int trial = 0; trial < 30; ++trial) {
    const Scene scene = soup_around_eye(random, 6);
    Camera camera = camera_of(width, height, 8);
    camera.projection.cx += 0.2101;  // no sample lies on an edge of these coordinates
    camera.projection.cy += 0.3203;
    Camera mirrored = camera;
    mirrored.projection.fx = -camera.projection.fx;
    mirrored.projection.cx = width - camera.projection.cx;
    const auto before = bits(checks::render_tested(scene, camera), "Z");
    const auto after = bits(checks::render_tested(scene, mirrored), "Z");
    for (std::uint32_t y = 0; y < height; ++y) {
      for (std::uint32_t x = 0; x < width; ++x) {
        ASSERT_EQ(before[y * width + x], after[y * width + width - 1 - x]);
      }
    }
  }
}

// Scaling the world by a power of two scales depths and changes nothing else.
TEST(Laws, PowersOfTwoOnlyScaleDepth) {
  std::mt19937 random(37);
  for (const double scale : {0x1p100, 0x1p-100}) {
    const Scene scene = soup_around_eye(random, 8);
    Scene scaled = scene;
    for (MeshPoint& p : scaled.meshes[0].vertices) p = {p.x * scale, p.y * scale, p.z * scale};
    const Camera camera = camera_of(width, height, 8);
    const DepthMap a = checks::render_tested(scene, camera),
                   b = checks::render_tested(scaled, camera);
    for (std::size_t i = 0; i < a.values<float>("Z")->size(); ++i) {
      EXPECT_EQ(a.values<float>("Z")->at(i) * static_cast<float>(scale),
                b.values<float>("Z")->at(i));
    }
  }
}

TEST(Laws, AnExactTransformEqualsTransformedVertices) {
  std::mt19937 random(38);
  Scene scene = soup_around_eye(random, 8);
  Scene moved = scene;
  for (MeshPoint& p : moved.meshes[0].vertices) p = {2 * p.y + 1, -p.x, p.z + 0.25};
  Object& object = scene.objects[0];
  object.placed_as_is = false;
  object.world_from_mesh.rows = {
      {{0.0, 2.0, 0.0, 1.0}, {-1.0, 0.0, 0.0, 0.0}, {0.0, 0.0, 1.0, 0.25}}};
  const Camera camera = camera_of(width, height, 8);
  EXPECT_EQ(bits(checks::render_tested(scene, camera), "Z"),
            bits(checks::render_tested(moved, camera), "Z"));
}

TEST(Laws, ThreadsAndObjectsDoNotMatter) {
  std::mt19937 random(39);
  const Scene one = soup_around_eye(random, 40);
  Scene several;  // the same triangles as four objects, two of them one mesh
  for (std::uint32_t k = 0; k < 4; ++k) {
    Mesh part;
    part.vertices = one.meshes[0].vertices;
    for (std::uint32_t i = 0; i < 10; ++i)
      part.triangles.push_back(one.meshes[0].triangles[10 * k + i]);
    several.meshes.push_back(part);
    several.objects.push_back({.mesh = k, .name = "part", .first_face = 0});
  }
  const Camera camera = camera_of(64, 100, 40);
  auto options = with({Channel::Z, Channel::id, Channel::object, Channel::face});
  options.threads = 1;
  const DepthMap a = checks::render_tested(one, camera, options);
  for (const int threads : {1, 2, 5}) {
    options.threads = threads;
    const DepthMap b = checks::render_tested(several, camera, options);
    EXPECT_EQ(bits(a, "Z"), bits(b, "Z"));
    EXPECT_EQ(*a.values<std::uint32_t>("id"), *b.values<std::uint32_t>("id"));
    for (std::size_t i = 0; i < a.values<std::uint32_t>("id")->size(); ++i) {
      const std::uint32_t id = a.values<std::uint32_t>("id")->at(i);
      if (id == no_surface) continue;
      ASSERT_EQ(b.values<std::uint32_t>("object")->at(i), id / 10);
      ASSERT_EQ(b.values<std::uint32_t>("face")->at(i), id % 10);
    }
  }
}

TEST(Laws, ProbeTellsWhatTheMapShows) {
  std::mt19937 random(40);
  for (int trial = 0; trial < 20; ++trial) {
    const Scene scene = soup_around_eye(random, 8);
    Camera camera = camera_of(width, height, 8);
    camera.near = 1;
    camera.far = 6;
    for (const Cull cull : {Cull::none, Cull::back, Cull::front}) {
      auto options = with({Channel::id});
      options.cull = cull;
      const DepthMap map = checks::render_tested(scene, camera, options);
      for (std::uint32_t y = 0; y < height; ++y) {
        for (std::uint32_t x = 0; x < width; ++x) {
          const auto seen = probe(scene, camera, x, y, cull);
          const bool visible = !seen.empty() && seen[0].counts;
          ASSERT_EQ(map.values<std::uint32_t>("id")->at(y * width + x),
                    visible ? seen[0].number : no_surface);
        }
      }
    }
  }
}

}  // namespace
}  // namespace fathom
