// A tile drawn triangle by triangle: at each sample the nearest, whatever the order.
#include "fathom/fast/tiles/tile.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <map>

#include "fathom/fast/bins/bins.h"
#include "fathom/fast/rounds/tile_store.h"
#include "fathom/fast/tiles/visible_triangles.h"
#include "fathom/triangle/projected_triangle.h"
#include "tests/inputs/soup.h"
#include "tests/special_values.h"

namespace fathom {
namespace {

using namespace fast;
using namespace triangle;

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
  VisibleTriangles visible;
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
  [[nodiscard]] DrawContext context() {
    return {referee, statistics, range, true, switches, nullptr, exact_setups, visible};
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
    Scene scene = checks::soup(random, 20, i % 2 == 0);
    Camera camera = checks::camera_of(160, 140, 64);
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
    Camera camera = checks::camera_of(0xFFFFFFFF, 140, 64);
    camera.projection.cx = first_column + 32.0;
    TileScene x(checks::soup(random, 20, true), camera);
    const TileGrid grid(camera.width, camera.height);
    const PixelBox area = grid.area(grid.columns + first_column / Tile::size);
    ASSERT_EQ(area.first_column, first_column);
    seen += expect_nearest(x, area);
  }
  EXPECT_GT(seen, 1000);
}

/// Two small triangles that are near, and after them so many large ones, each nearer than the one
/// before.
TileScene nearer_and_nearer(std::uint32_t large) {
  std::vector<MeshPoint> vertices{{-0.4, -0.4, 1}, {-0.1, -0.4, 1}, {-0.4, -0.1, 1},
                                  {0.4, 0.4, 1},   {0.1, 0.4, 1},   {0.4, 0.1, 1}};
  std::vector<CornerIndices> triangles{{0, 1, 2}, {3, 4, 5}};
  for (std::uint32_t i = 0; i < large; ++i) {
    const double z = 100 - i * 0.001;
    const auto first = static_cast<std::uint32_t>(vertices.size());
    vertices.insert(vertices.end(), {{-9 * z, -9 * z, z}, {9 * z, -9 * z, z}, {0, 9 * z, z}});
    triangles.push_back({first, first + 1, first + 2});
  }
  return {checks::scene_of(vertices, triangles), checks::camera_of(64, 64, 64)};
}

std::uint32_t number_at(const Tile& tile, std::uint32_t column, std::uint32_t row) {
  return tile.surface_at(Tile::index(column, row)).number();
}

/// More surfaces than a tile has places for, twice, and packed in between; then all at once.
TEST(Tile, ForgetsSurfacesThatAreHidden) {
  TileScene x = nearer_and_nearer(40'000);
  const std::size_t half = x.drawn.size() / 2;
  Tile tile;
  tile.start({0, 63, 0, 63});
  for (const std::size_t first : {std::size_t{0}, half}) {
    tile.draw(x.objects[0], std::span(x.drawn).subspan(first, half), x.context());
    EXPECT_EQ(number_at(tile, 10, 10), 0U);
    EXPECT_EQ(number_at(tile, 54, 54), 1U);
    EXPECT_EQ(number_at(tile, 32, 32), first + half - 1);
    EXPECT_EQ(number_at(tile, 0, 63), first + half - 1);
    tile.pack();
    EXPECT_EQ(number_at(tile, 10, 10), 0U);
    EXPECT_EQ(number_at(tile, 32, 32), first + half - 1);
  }
  EXPECT_EQ(x.statistics.visibility.exact, 0U);
  tile.start({0, 63, 0, 63});
  tile.draw(x.objects[0], x.drawn, x.context());
  EXPECT_EQ(number_at(tile, 10, 10), 0U);
  EXPECT_EQ(number_at(tile, 32, 32), x.drawn.size() - 1);
}

/// What was drawn before back faces stays known when hidden surfaces are forgotten: before them,
/// among them, and when the tile is packed.
TEST(Tile, KnowsFrontFacesWhereItForgetsOthers) {
  TileScene x = nearer_and_nearer(40'000);
  for (const std::size_t front : {2, 100, 19'000, 39'999, 40'001}) {
    Tile tile;
    tile.start({0, 63, 0, 63});
    tile.draw(x.objects[0], std::span(x.drawn).first(front), x.context());
    tile.begin_back_faces();
    tile.draw(x.objects[0], std::span(x.drawn).subspan(front), x.context());
    for (int packed = 0; packed < 2; ++packed, tile.pack()) {
      for (std::size_t i = 0; i < Tile::samples; ++i) {
        if (!tile.shows_surface(i)) continue;
        const bool is_known = Tile::place_of(tile.tags()[i]) < tile.end_of_front();
        ASSERT_EQ(is_known, tile.surface_at(i).number() < front) << front << ' ' << i;
      }
    }
    // Front faces after back faces: nothing is known.
    tile.begin_back_faces();
    tile.draw(x.objects[0], x.drawn, x.context());
    EXPECT_EQ(tile.end_of_front(), 0U);
  }
}

/// Each tile has a place of most_packed_bytes in a file: more would be another tile's. Surfaces
/// that fill their list to its end are as many as others.
TEST(Tile, PackedIsWithinItsPlaceWhereTheListIsFull) {
  for (const std::uint32_t in_first_batch : {7U, 8U}) {
    Tile tile;
    tile.start({0, 63, 0, 63});
    (void)tile.next_place();
    tile.keep_surfaces(in_first_batch);
    while (tile.end_of_places() < 8192) {
      (void)tile.next_place();
      tile.keep_surfaces(8);
    }
    EXPECT_GT(tile.bytes(), Tile::most_packed_bytes);
    tile.pack();
    EXPECT_LE(tile.bytes(), Tile::most_packed_bytes);
    files::Bytes saved;
    save(tile, SamplesLie::at_pixels, saved);
    EXPECT_LE(saved.size(), Tile::most_packed_bytes);
  }
}

/// How many surfaces of a tile are shown by one sample alone.
std::size_t shown_once(const Tile& tile) {
  std::map<std::uint32_t, int> samples;
  for (std::size_t i = 0; i < Tile::samples; ++i)
    if (tile.shows_surface(i)) ++samples[tile.surface_at(i).number()];
  return static_cast<std::size_t>(
      std::ranges::count_if(samples, [](const auto& each) { return each.second == 1; }));
}

double q_at(const Tile& tile, std::size_t i) {
  return tile.surface_at(i).q(Tile::column_of(i), Tile::row_of(i));
}

/// Triangles as large as one pixel to nine, all over an image of 64 × 64.
TileScene small_triangles(std::mt19937_64& random, int count) {
  std::uniform_real_distribution<double> place(-0.5, 0.5), depth(1, 9), side(-2.0 / 64, 2.0 / 64);
  std::vector<MeshPoint> vertices;
  std::vector<CornerIndices> triangles;
  for (int i = 0; i < count; ++i) {
    const double x = place(random), y = place(random), z = depth(random);
    const auto first = static_cast<std::uint32_t>(vertices.size());
    for (int k = 0; k < 3; ++k)
      vertices.push_back({(x + side(random)) * z, (y + side(random)) * z, z + place(random)});
    triangles.push_back({first, first + 1, first + 2});
  }
  return {checks::scene_of(vertices, triangles), checks::camera_of(64, 64, 64)};
}

/// At each sample the same surface, with the same q and the same bound, and as much is known of
/// front faces.
TEST(Tile, ComesBackFromAFileAsItWas) {
  std::mt19937_64 random(203);
  TileScene x = small_triangles(random, 3000);
  Tile tile;
  tile.start({0, 63, 0, 63});
  tile.draw(x.objects[0], std::span(x.drawn).first(x.drawn.size() / 2), x.context());
  tile.begin_back_faces();
  tile.draw(x.objects[0], std::span(x.drawn).subspan(x.drawn.size() / 2), x.context());
  tile.pack();
  EXPECT_GT(shown_once(tile), 100U);
  EXPECT_GT(tile.end_of_places(), shown_once(tile) + 100);
  files::Bytes saved;
  save(tile, SamplesLie::at_pixels, saved);
  Tile back;
  back.start(tile.area());
  restore(
      [&](std::uint64_t offset, std::span<std::byte> to) {
        std::ranges::copy(files::ByteView(saved).subspan(offset, to.size()), to.begin());
      },
      SamplesLie::at_pixels, back);
  EXPECT_EQ(back.end_of_places(), tile.end_of_places());
  EXPECT_EQ(back.end_of_front(), tile.end_of_front());
  for (std::size_t i = 0; i < Tile::samples; ++i) {
    ASSERT_EQ(back.shows_surface(i), tile.shows_surface(i));
    ASSERT_EQ(back.surface_at(i).tag, tile.surface_at(i).tag);
    ASSERT_EQ(back.q()[i], tile.q()[i]);
    ASSERT_EQ(q_at(back, i), q_at(tile, i));
  }
}

TEST(Tile, StartEmptiesIt) {
  TileScene x(checks::scene_of({{-9, -9, 1}, {9, -9, 1}, {0, 9, 1}}, {{0, 1, 2}}),
              checks::camera_of(64, 64, 1));
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
