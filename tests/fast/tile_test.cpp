// A tile drawn triangle by triangle: at each sample the nearest, whatever the order.
#include "fathom/fast/tile.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>

#include "fathom/triangle/sampling.h"
#include "tests/inputs/soup.h"

namespace fathom {
namespace {

using namespace fast;
using namespace triangle;

constexpr double infinity = std::numeric_limits<double>::infinity();

TEST(SurfaceTag, HoldsTheNumberAndABoundThatIsNoLess) {
  for (const double error : {0.0, 1e-300, 0x1p-60, 1.0, std::nextafter(1.0, 0), 0.1}) {
    for (const std::uint32_t number : {0U, 7U, 0xFFFFFFFEU}) {
      const std::uint64_t tag = surface_tag(number, error);
      EXPECT_EQ(static_cast<std::uint32_t>(tag), number);
      EXPECT_GE(std::bit_cast<double>(tag), error);
      EXPECT_LE(std::bit_cast<double>(tag), error * (1 + 0x1p-19) + 1e-300);
    }
  }
  EXPECT_TRUE(std::isnan(std::bit_cast<double>(surface_tag(3, infinity))));
  EXPECT_EQ(static_cast<std::uint32_t>(no_surface_tag), no_surface);
  EXPECT_LT(std::bit_cast<double>(no_surface_tag), 1e-300);
}

/// The number of the visible triangle at a sample, by exact numbers; no_surface where none is.
std::uint32_t visible_at(const std::vector<ProjectedTriangle>& triangles, const Camera& camera,
                         const ImagePoint& s) {
  std::uint32_t best = no_surface;
  Ratio depth;
  TierCounts counts;
  for (const ProjectedTriangle& t : triangles) {
    if (t.orientation == Sign::zero || !covers(t, s, counts)) continue;
    const Ratio D = depth_at(t, s);
    if (!is_in_range(D, camera) || (best != no_surface && !(D < depth))) continue;
    best = t.number;
    depth = D;
  }
  return best;
}

/// A scene of one object, and what is needed to draw it into a tile.
struct TileScene {
  Scene scene;
  Camera camera;
  TriangleSource source{scene};
  Referee referee{source, camera};
  RenderStatistics statistics;
  DepthRange range = depth_range(camera);
  FastSwitches switches;
  ExactSetups exact_setups{{0, camera.width - 1, 0, camera.height - 1}};
  ImageObjects objects;
  std::vector<ProjectedTriangle> projected;
  /// The triangles that are not seen edge-on.
  std::vector<std::uint32_t> drawn;

  TileScene(Scene the_scene, const Camera& the_camera)
      : scene(std::move(the_scene)), camera(the_camera) {
    objects.emplace_back(scene.objects[0], scene.meshes[0], camera, 0);
    TierCounts counts;
    for (std::uint32_t number = 0; number < source.count(); ++number) {
      projected.push_back(project(source.world_corners(number), number, camera, counts));
      if (projected.back().orientation != Sign::zero) drawn.push_back(number);
    }
  }
  TileScene(const TileScene&) = delete;
  TileScene& operator=(const TileScene&) = delete;
  [[nodiscard]] Tile::Context context() {
    return {referee, statistics, range, true, switches, nullptr, exact_setups};
  }
};

/// Draws a tile and looks at every sample. Returns how many show a surface.
int expect_nearest(TileScene& x, const PixelBox& area) {
  Tile tile;
  tile.start(area);
  tile.draw(x.objects[0], x.drawn, x.context());
  int seen = 0;
  for (std::uint32_t row = area.first_row; row <= area.last_row; ++row) {
    for (std::uint32_t column = area.first_column; column <= area.last_column; ++column) {
      const std::size_t at = Tile::index(column - area.first_column, row - area.first_row);
      const std::uint32_t number = tile.surface_at(at).number();
      EXPECT_EQ(number, visible_at(x.projected, x.camera, centre_of_pixel(column, row)))
          << column << ' ' << row;
      EXPECT_EQ(tile.q()[at] == -infinity, number == no_surface);
      EXPECT_EQ(tile.shows_surface(at), number != no_surface);
      seen += number != no_surface;
    }
  }
  return seen;
}

TEST(Tile, ShowsTheNearestWhateverTheOrder) {
  std::mt19937_64 random(201);
  int seen = 0;
  for (int i = 0; i < 6; ++i) {
    Scene scene = testing::soup(random, 20, i % 2 == 0);
    Camera camera = testing::camera_of(160, 140, 64);
    if (i % 3 == 1) camera.near = 3;
    TileScene x(std::move(scene), camera);
    std::shuffle(x.drawn.begin(), x.drawn.end(), random);
    const TileGrid grid(camera.width, camera.height);
    seen += expect_nearest(x, grid.area(static_cast<std::uint32_t>(i) % grid.count()));
  }
  EXPECT_GT(seen, 1000);
}

/// Triangles around the column at which a sample looks straight ahead, in a very wide image.
TEST(Tile, ShowsTheNearestInColumnsBeyondTheRangeOfInt) {
  std::mt19937_64 random(202);
  int seen = 0;
  for (const std::uint32_t first_column : {0x7FFFFFC0U, 0x80000000U, 0xFFFFFFC0U}) {
    Camera camera = testing::camera_of(0xFFFFFFFF, 140, 64);
    camera.cx = first_column + 32.0;
    TileScene x(testing::soup(random, 20, true), camera);
    const TileGrid grid(camera.width, camera.height);
    const PixelBox area = grid.area(grid.columns + first_column / Tile::size);
    ASSERT_EQ(area.first_column, first_column);
    seen += expect_nearest(x, area);
  }
  EXPECT_GT(seen, 1000);
}

/// Places of surfaces have 16 bits. Two small triangles that are near stay visible, while more large
/// ones than there are places are drawn behind them, each nearer than the one before; then again
/// after the tile was packed.
TEST(Tile, ForgetsSurfacesThatAreHidden) {
  std::vector<MeshPoint> vertices{{-0.4, -0.4, 1}, {-0.1, -0.4, 1}, {-0.4, -0.1, 1},
                                  {0.4, 0.4, 1},   {0.1, 0.4, 1},   {0.4, 0.1, 1}};
  std::vector<CornerIndices> triangles{{0, 1, 2}, {3, 4, 5}};
  constexpr std::uint32_t large = 70'000;
  for (std::uint32_t i = 0; i < large; ++i) {
    const double z = 100 - i * 0.001;
    const auto first = static_cast<std::uint32_t>(vertices.size());
    vertices.insert(vertices.end(), {{-9 * z, -9 * z, z}, {9 * z, -9 * z, z}, {0, 9 * z, z}});
    triangles.push_back({first, first + 1, first + 2});
  }
  const Scene scene = testing::scene_of(vertices, triangles);
  const Camera camera = testing::camera_of(64, 64, 64);
  const TriangleSource source(scene);
  Referee referee(source, camera);
  RenderStatistics statistics;
  const DepthRange range = depth_range(camera);
  const FastSwitches switches;
  ExactSetups exact_setups({0, camera.width - 1, 0, camera.height - 1});
  const Tile::Context context{referee, statistics, range, true, switches, nullptr, exact_setups};
  ImageObjects objects;
  objects.emplace_back(scene.objects[0], scene.meshes[0], camera, 0);
  std::vector<std::uint32_t> numbers(large + 2);
  for (std::uint32_t i = 0; i < numbers.size(); ++i) numbers[i] = i;
  const auto number_at = [](const Tile& tile, std::uint32_t column, std::uint32_t row) {
    return tile.surface_at(Tile::index(column, row)).number();
  };
  Tile tile;
  tile.start({0, 63, 0, 63});
  const std::size_t half = numbers.size() / 2;
  for (const std::size_t first : {std::size_t{0}, half}) {
    tile.draw(objects[0], std::span(numbers).subspan(first, half), context);
    EXPECT_EQ(number_at(tile, 10, 10), 0U);
    EXPECT_EQ(number_at(tile, 54, 54), 1U);
    EXPECT_EQ(number_at(tile, 32, 32), first + half - 1);
    EXPECT_EQ(number_at(tile, 0, 63), first + half - 1);
    tile.pack();
    EXPECT_EQ(number_at(tile, 10, 10), 0U);
    EXPECT_EQ(number_at(tile, 32, 32), first + half - 1);
  }
  EXPECT_EQ(statistics.visibility.exact, 0U);
  // All of them at once.
  tile.start({0, 63, 0, 63});
  tile.draw(objects[0], numbers, context);
  EXPECT_EQ(number_at(tile, 10, 10), 0U);
  EXPECT_EQ(number_at(tile, 32, 32), large + 1);
}

/// Each tile has a place of most_packed_bytes in a file: more would be another tile's. Surfaces that fill
/// their list to its end are as many as others.
TEST(Tile, PackedIsWithinItsPlaceWhereTheListIsFull) {
  for (const std::uint32_t in_first_batch : {7U, 8U}) {
    Tile tile;
    tile.start({0, 63, 0, 63});
    (void)tile.next_place();
    tile.keep_surfaces(in_first_batch);
    while (tile.end_of_places() < 16384) {
      (void)tile.next_place();
      tile.keep_surfaces(8);
    }
    EXPECT_GT(tile.bytes(), Tile::most_packed_bytes);
    tile.pack();
    EXPECT_LE(tile.bytes(), Tile::most_packed_bytes);
    text::Bytes saved;
    tile.save(saved);
    EXPECT_LE(saved.size(), Tile::most_packed_bytes);
  }
}

/// What waits to be drawn takes no memory of a packed tile, where nothing of it came to be seen either.
TEST(Tile, PackedTwiceHasNoEntries) {
  Tile tile;
  tile.start({0, 63, 0, 63});
  tile.pack();
  tile.entries().resize(100'000);
  tile.pack();
  EXPECT_LE(tile.bytes(), Tile::most_packed_bytes);
}

TEST(Tile, StartEmptiesIt) {
  TileScene x(testing::scene_of({{-9, -9, 1}, {9, -9, 1}, {0, 9, 1}}, {{0, 1, 2}}),
              testing::camera_of(64, 64, 1));
  Tile tile;
  tile.start({0, 63, 0, 63});
  tile.draw(x.objects[0], x.drawn, x.context());
  EXPECT_EQ(tile.surface_at(Tile::index(32, 32)).number(), 0U);
  EXPECT_EQ(tile.q()[Tile::index(32, 32)], 1);
  tile.start({0, 63, 0, 63});
  for (std::uint32_t row = 0; row < 64; ++row) {
    for (std::uint32_t column = 0; column < 64; ++column) {
      ASSERT_EQ(tile.surface_at(Tile::index(column, row)).number(), no_surface);
      ASSERT_EQ(tile.q()[Tile::index(column, row)], -infinity);
    }
  }
}

}  // namespace
}  // namespace fathom
