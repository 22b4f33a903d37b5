// Channel A of scenes that are rendered in rounds: the values of the same scene in memory, bit for
// bit, whatever is kept in memory and whatever has to wait on a disk.
#include "fathom/fast/rounds/coverage_in_rounds.h"

#include <gtest/gtest.h>
#include <sys/resource.h>

#include <algorithm>
#include <csignal>
#include <cstdlib>
#include <filesystem>
#include <memory>

#include "fathom/camera/camera_files.h"
#include "fathom/failures/errors.h"
#include "fathom/fast/stream.h"
#include "fathom/scene/framing.h"
#include "tests/adversaries.h"
#include "tests/effort.h"
#include "tests/engines/expect_same_map.h"
#include "tests/inputs/adversarial_scenes.h"
#include "tests/inputs/both_readings.h"
#include "tests/inputs/soup.h"
#include "tests/places.h"
#include "tests/scratch_folder.h"

namespace fathom {
namespace {

namespace fs = std::filesystem;
using checks::Both;
using checks::effort;

const fs::path data = test::source_dir() / "data";

/// From a single round that stays in memory to many of which every one goes to the disk.
std::vector<StreamLimits> limits_for(std::uint64_t triangles) {
  const auto part = static_cast<std::uint32_t>(triangles / 5 + 1);
  const std::uint32_t few = triangles < 500 ? 1 : triangles < 5000 ? 37 : 997;
  constexpr std::uint64_t all = std::uint64_t{1} << 30, tiles = 400000;
  return {{.triangles_at_once = part},
          {.triangles_at_once = part, .kept_bytes = 0},
          {.triangles_at_once = part, .tile_bytes = tiles, .kept_bytes = triangles * 100},
          {.triangles_at_once = few, .tile_bytes = all, .kept_bytes = 0},
          {.triangles_at_once = few, .tile_bytes = 0, .kept_bytes = triangles * 20},
          {.triangles_at_once = 7 * few, .tile_bytes = tiles, .kept_bytes = triangles * 50}};
}

void expect_same_coverage(const Both& both, const Camera& camera, Cull cull = Cull::none) {
  RenderOptions options;
  options.channels = {Channel::A, Channel::Z};
  options.cull = cull;
  const DepthMap truth = render_fast(both.scene, camera, options).map;
  for (const StreamLimits& limits : limits_for(triangle_count(both.streamed))) {
    SCOPED_TRACE(std::to_string(limits.triangles_at_once) + " triangles at once, " +
                 std::to_string(limits.tile_bytes) + " bytes of tiles, " +
                 std::to_string(limits.kept_bytes) + " of triangles");
    checks::expect_same_map(render_streamed(both.streamed, camera, options, limits).map, truth);
  }
}

/// Files of one scene each, removed with the object.
class Files {
 public:
  fs::path stl(const Mesh& mesh) { return folder_.write(next("stl"), checks::stl_of(mesh)); }
  fs::path ply(const Mesh& mesh) { return folder_.write(next("ply"), checks::ply_of(mesh)); }

 private:
  std::string next(const std::string& ending) { return std::to_string(count_++) + "." + ending; }
  ScratchFolder folder_;
  int count_ = 0;
};

TEST(CoverageInRounds, Meshes) {
  Files files;
  for (const char* name : {"spot.obj", "cube.obj", "l-shape.obj", "house.gltf", "teapot.obj"}) {
    const fs::path path = data / "meshes" / name;
    SCOPED_TRACE(name);
    Warnings warnings;
    const Scene scene = read_scene({path}, {}, warnings);
    const LensChoice lens{.width = 400U / effort, .height = 300U / effort};
    for (const bool as_stl : {true, false}) {
      const Both both({as_stl ? files.stl(scene.meshes[0]) : files.ply(scene.meshes[0])});
      Camera camera = frame_scene(both.scene, {.azimuth = 20, .elevation = 10}, lens);
      expect_same_coverage(both, camera, as_stl ? Cull::none : Cull::back);
      // From within, where triangles are cut by near and reach behind the camera.
      camera.world_to_camera[2][3] *= 0.25;
      camera.near = 0.05 * std::abs(camera.world_to_camera[2][3]);
      expect_same_coverage(both, camera);
    }
  }
}

/// Several files are several objects, which meet in every tile; the last one is there twice.
TEST(CoverageInRounds, SeveralObjects) {
  Files files;
  Warnings warnings;
  const Scene spot = read_scene({data / "meshes" / "spot.obj"}, {}, warnings);
  const Scene house = read_scene({data / "meshes" / "house.gltf"}, {}, warnings);
  const fs::path cube = data / "meshes" / "cube.stl", ply = files.ply(spot.meshes[0]);
  const Both both({files.stl(spot.meshes[0]), cube, files.ply(house.meshes[0]), ply, ply});
  const LensChoice lens{.width = 330U / effort, .height = 250U / effort};
  expect_same_coverage(both, frame_scene(both.scene, {.azimuth = 40, .elevation = 20}, lens));
}

/// Large triangles meet most tiles, and so most buckets.
TEST(CoverageInRounds, SoupsAndSlivers) {
  Files files;
  std::mt19937_64 random(1711);
  for (int i = 0; i < 12 / effort + 1; ++i) {
    SCOPED_TRACE("soup " + std::to_string(i) + " of seed 1711");
    Scene scene = i % 3 == 2 ? checks::slivers(random, 60) : checks::soup(random, 80, i % 2 == 0);
    // Some triangles again, and some with their corners in another order.
    Mesh& mesh = scene.meshes[0];
    for (std::size_t t = 0; t < 20; ++t) {
      const auto [a, b, c] = mesh.triangles[3 * t];
      mesh.triangles.push_back(t % 2 == 0 ? CornerIndices{b, c, a} : CornerIndices{b, a, c});
    }
    const Both both({files.ply(mesh)});
    Camera camera = checks::camera_of(160, 140, 64);
    if (i % 2 == 1) camera.near = 4;
    expect_same_coverage(both, camera, i % 5 == 0 ? Cull::back : Cull::none);
    if (::testing::Test::HasFailure()) return;
  }
}

TEST(CoverageInRounds, TrianglesAroundTheEye) {
  Files files;
  std::mt19937_64 random(1712);
  for (int i = 0; i < 6 / effort + 1; ++i) {
    SCOPED_TRACE("case " + std::to_string(i) + " of seed 1712");
    std::vector<MeshPoint> vertices;
    std::vector<CornerIndices> indices;
    const auto number = [&] { return static_cast<double>(random() % 4097) / 1024 - 2; };
    for (std::uint32_t t = 0; t < 60; ++t) {
      for (int k = 0; k < 3; ++k) vertices.push_back({number(), number(), number() + 1});
      indices.push_back({3 * t, 3 * t + 1, 3 * t + 2});
    }
    const Both both({files.ply(checks::scene_of(vertices, indices).meshes[0])});
    Camera camera = checks::camera_of(200, 150, 90);
    if (i % 2 == 1) camera.near = 0.25;
    expect_same_coverage(both, camera);
  }
}

TEST(CoverageInRounds, Adversaries) {
  Files files;
  for (const checks::Family family : checks::all_families) {
    // Files that are streamed are not placed.
    if (family == checks::Family::placements) continue;
    checks::for_each_adversary(6, [&](std::uint64_t seed) {
      SCOPED_TRACE(name_of(family));
      const checks::Case c = checks::adversarial_case(family, seed);
      const Both both({files.ply(c.scene.meshes.at(0))});
      expect_same_coverage(both, c.camera);
    });
  }
}

TEST(CoverageInRounds, HardScenes) {
  Files files;
  int scenes = 0;
  for (const auto& entry : fs::directory_iterator(data / "scenes/hard")) {
    if (entry.path().extension() != ".obj") continue;
    SCOPED_TRACE(entry.path().filename());
    Warnings warnings;
    const Scene scene = read_scene({entry.path()}, {}, warnings);
    fs::path cameras = entry.path();
    cameras.replace_extension(".camera.json");
    const Both both({files.ply(scene.meshes[0])});
    for (const Camera& camera : read_cameras(cameras)) expect_same_coverage(both, camera);
    ++scenes;
  }
  EXPECT_GE(scenes, 10);
}

/// Every so many-th triangle of a scene as a mesh that knows what the scene calls them.
struct ScatteredTriangles {
  ScatteredTriangles(const Scene& scene, std::uint32_t first, std::uint32_t step) {
    mesh.vertices = scene.meshes[0].vertices;
    for (std::uint32_t i = first; i < scene.meshes[0].triangles.size(); i += step) {
      mesh.triangles.push_back(scene.meshes[0].triangles[i]);
      numbers.push_back(i);
    }
  }
  Mesh mesh;
  std::vector<std::uint32_t> numbers;
};

/// What a rank of several does: it has some of the tiles, and gets triangles from anywhere.
class SomeTiles {
 public:
  SomeTiles(const Scene& scene, const Camera& camera)
      : scene_(scene), triangles_(scene), rays_(triangles_, camera), frame_(camera, options_) {
    frame_.by_area = true;
  }

  std::vector<float> coverage(const std::vector<std::uint32_t>& tiles, std::uint64_t most_bytes,
                              std::uint32_t rounds) {
    fast::CoverageInRounds kept({frame_, triangles_, rays_}, tiles, most_bytes);
    for (std::uint32_t round = 0; round < rounds; ++round) {
      const ScatteredTriangles some(scene_, round, rounds);
      fast::ImageObjects objects;
      objects.emplace_back(scene_.objects[0], some.mesh, frame_.camera, 0U, nullptr, some.numbers);
      kept.add(objects, sort(objects));
    }
    return write(kept);
  }

  [[nodiscard]] const fast::TileGrid& grid() const { return frame_.grid; }

 private:
  std::vector<fast::Bins> sort(const fast::ImageObjects& objects) {
    return sort_into_tiles(objects, 0, objects.back().end_number(), 3, frame_, workers_);
  }

  std::vector<float> write(fast::CoverageInRounds& kept) {
    fast::ImageObjects objects;
    objects.emplace_back(scene_.objects[0], scene_.meshes[0], frame_.camera, 0U);
    const std::vector<fast::Bins> bins = sort(objects);
    std::vector<float> values(std::size_t{frame_.camera.width} * frame_.camera.height);
    const auto write_tile = [&](std::uint32_t number, fast::TileCoverage& coverage) {
      const auto tile = std::make_unique<fast::Tile>();
      tile->start(grid().area(number));
      const fast::DrawContext context = frame_.context(workers_.local());
      draw_tile(*tile, number, bins, objects, context);
      coverage.write(*tile, number, context, values.data(), {frame_.camera.width});
    };
    // In two parts, whose border lies anywhere.
    const std::uint32_t middle = grid().count() / 2;
    kept.write(0, middle, write_tile);
    kept.write(middle, grid().count(), write_tile);
    return values;
  }

  const Scene& scene_;
  RenderOptions options_;
  TriangleSource triangles_;
  triangle::SceneRays rays_;
  fast::FastFrame frame_;
  fast::FastWorkers workers_{[this] { return fast::FastWorker(triangles_, frame_.camera, rays_); }};
};

TEST(CoverageInRounds, SomeTilesOfTrianglesFromAnywhere) {
  std::mt19937_64 random(1714);
  const Scene scene = checks::soup(random, 700, false);
  Camera camera = checks::camera_of(320, 280, 128);
  camera.near = 3;
  RenderOptions options;
  options.channels = {Channel::A};
  const DepthMap map = render_fast(scene, camera, options).map;
  const auto& truth = std::get<Samples<float>>(map.channels[0].values);
  SomeTiles rank(scene, camera);
  const std::vector<std::uint32_t> tiles{0, 3, 4, 7, 8, 13, 19, 20, 22};
  for (const std::uint64_t most_bytes : {0U, 20000U, 100000000U}) {
    for (const std::uint32_t rounds : {1U, 2U, 9U}) {
      SCOPED_TRACE(std::to_string(most_bytes) + " bytes, " + std::to_string(rounds) + " rounds");
      const std::vector<float> values = rank.coverage(tiles, most_bytes, rounds);
      for (std::uint32_t row = 0; row < camera.height; ++row) {
        for (std::uint32_t column = 0; column < camera.width; ++column) {
          const std::size_t pixel = std::size_t{row} * camera.width + column;
          const bool is_ours = std::ranges::count(tiles, rank.grid().tile_at(column, row)) != 0;
          ASSERT_EQ(values[pixel], is_ours ? truth[pixel] : 0.0F) << column << ", " << row;
        }
      }
    }
  }
}

TEST(CoverageInRounds, SaysWhereThereIsNoRoomOnTheDisk) {
  const ScratchFolder folder;
  Warnings warnings;
  const Both both({data / "meshes" / "cube.stl"});
  RenderOptions options;
  options.channels = {Channel::A};
  const char* const before = std::getenv("TMPDIR");
  const std::string folder_before = before ? before : "";
  ::setenv("TMPDIR", folder.path().c_str(), 1);
  rlimit limit{};
  ::getrlimit(RLIMIT_FSIZE, &limit);
  const rlimit small{100, limit.rlim_max};
  ::setrlimit(RLIMIT_FSIZE, &small);
  const auto old = std::signal(SIGXFSZ, SIG_IGN);
  const std::string message = message_of<OutputError>([&] {
    render_streamed(both.streamed, frame_scene(both.scene, {}, {}), options, {.kept_bytes = 0});
  });
  (void)std::signal(SIGXFSZ, old);
  ::setrlimit(RLIMIT_FSIZE, &limit);
  before ? ::setenv("TMPDIR", folder_before.c_str(), 1) : ::unsetenv("TMPDIR");
  EXPECT_EQ(message, folder.path().string() + " (what does not fit into memory): File too large");
  EXPECT_TRUE(fs::is_empty(folder.path()));
}

}  // namespace
}  // namespace fathom
