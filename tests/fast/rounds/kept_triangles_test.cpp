// Triangles that are taken out of rounds, and put together again.
#include "fathom/fast/rounds/kept_triangles.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <numeric>
#include <set>

#include "tests/inputs/soup.h"

namespace fathom {
namespace {

using namespace fast;

/// A scene of two objects, sorted into tiles by area.
class KeptTrianglesOf : public ::testing::Test {
 protected:
  KeptTrianglesOf()
      : camera_(checks::camera_of(160, 140, 64)),
        scene_(two_soups()),
        triangles_(scene_),
        rays_(triangles_, camera_),
        frame_(camera_, options_) {
    frame_.by_area = true;
    std::uint32_t first = 0;
    for (const Object& object : scene_.objects) {
      objects_.emplace_back(object, scene_.meshes[object.mesh], camera_, first);
      first = objects_.back().end_number();
    }
    bins_ = sort_into_tiles(objects_, 0, first, 2, frame_, workers_);
  }

  static Scene two_soups() {
    std::mt19937_64 random(1715);
    Scene scene = checks::soup(random, 900, false);
    scene.meshes.push_back(checks::soup(random, 700, true).meshes[0]);
    scene.objects.push_back({.mesh = 1, .name = "other"});
    return scene;
  }

  /// By their numbers in the scene.
  [[nodiscard]] std::set<std::uint32_t> in_tile(std::uint32_t tile) const {
    std::set<std::uint32_t> numbers;
    for (const Bins& bins : bins_) {
      for (const Side side : {Side::front, Side::back}) {
        for (const TileEntry& entry : bins.in_tile(tile, side)) numbers.insert(entry.number);
      }
    }
    return numbers;
  }

  void expect_corners_of_the_scene(const KeptTriangles& kept) const {
    ASSERT_EQ(kept.numbers.size(), kept.mesh.triangles.size());
    for (std::size_t i = 0; i < kept.numbers.size(); ++i) {
      const TriangleSource::Triangle truth = triangles_.triangle(kept.numbers[i]);
      EXPECT_EQ(truth.origin.object, kept.object);
      for (std::size_t k = 0; k < 3; ++k) {
        EXPECT_EQ(kept.mesh.vertices[kept.mesh.triangles[i][k]], truth.corners[k]);
      }
    }
  }

  Camera camera_;
  Scene scene_;
  RenderOptions options_;
  TriangleSource triangles_;
  triangle::SceneRays rays_;
  FastFrame frame_;
  FastWorkers workers_{[this] { return FastWorker(triangles_, camera_, rays_); }};
  ImageObjects objects_;
  std::vector<Bins> bins_;
};

TEST_F(KeptTrianglesOf, SomeTilesAreThereOnceEach) {
  const std::vector<std::uint32_t> tiles{1, 2, 7};
  std::set<std::uint32_t> truth;
  for (const std::uint32_t tile : tiles) truth.merge(in_tile(tile));
  const auto kept = triangles_in_tiles(objects_, bins_, tiles, triangles_);
  std::vector<std::uint32_t> numbers;
  ASSERT_EQ(kept.size(), 2U);
  for (const KeptTriangles& some : kept) {
    expect_corners_of_the_scene(some);
    numbers.insert(numbers.end(), some.numbers.begin(), some.numbers.end());
  }
  EXPECT_TRUE(std::ranges::equal(numbers, truth));
  EXPECT_LT(numbers.size(), triangles_.count());
  EXPECT_TRUE(triangles_in_tiles(objects_, bins_, {}, triangles_).empty());
}

TEST_F(KeptTrianglesOf, BinsApartBecomeOneObjectForEach) {
  std::vector<std::uint32_t> tiles(frame_.grid.count());
  std::iota(tiles.begin(), tiles.end(), 0U);
  std::vector<KeptTriangles> kept;
  for (const Bins& bins : bins_) {
    for (KeptTriangles& some : triangles_in_tiles(objects_, {&bins, 1}, tiles, triangles_))
      kept.push_back(std::move(some));
  }
  ASSERT_EQ(kept.size(), 3U);  // the bins meet within an object
  GatheredTriangles gathered;
  gathered.take(kept);
  gathered.sort(4, triangles_, frame_, workers_);
  ASSERT_EQ(gathered.objects().size(), 2U);
  for (const std::uint32_t tile : tiles) {
    std::set<std::uint32_t> numbers;
    for (const Bins& bins : gathered.bins()) {
      for (const Side side : {Side::front, Side::back}) {
        for (const TileEntry& entry : bins.in_tile(tile, side)) {
          numbers.insert(object_of(gathered.objects(), entry.number).number_in_scene(entry.number));
        }
      }
    }
    EXPECT_EQ(numbers, in_tile(tile)) << tile;
  }
}

}  // namespace
}  // namespace fathom
