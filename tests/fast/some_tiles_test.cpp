// Tiles that are drawn in several places, of triangles that come in rounds: the map of the whole
// scene, bit for bit.
#include "fathom/fast/some_tiles.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <numeric>

#include "fathom/failures/errors.h"
#include "fathom/fast/render_fast.h"
#include "tests/adversaries.h"
#include "tests/effort.h"
#include "tests/engines/expect_same_map.h"
#include "tests/inputs/adversarial_scenes.h"
#include "tests/inputs/soup.h"
#include "tests/inputs/tables_of_directions.h"

namespace fathom {
namespace {

using checks::expect_same_map;

/// Triangles of a scene by their numbers, in ascending order: a list for each object that has any.
std::vector<SomeTriangles> some_of(const Scene& scene, const std::vector<std::uint32_t>& numbers) {
  std::vector<SomeTriangles> lists;
  std::uint32_t first = 0, object = 0;
  auto next = numbers.begin();
  for (const Object& each : scene.objects) {
    const Mesh& whole = scene.meshes[each.mesh];
    const auto end = first + static_cast<std::uint32_t>(whole.triangles.size());
    SomeTriangles some{object++, {}, 0, {}};
    some.mesh.vertices = whole.vertices;
    for (; next != numbers.end() && *next < end; ++next) {
      some.mesh.triangles.push_back(whole.triangles[*next - first]);
      some.numbers.push_back(*next);
    }
    if (!some.numbers.empty()) lists.push_back(std::move(some));
    first = end;
  }
  return lists;
}

/// Cuts a list into rounds of this length, in any order.
std::vector<std::vector<std::uint32_t>> rounds_of(std::vector<std::uint32_t> numbers,
                                                  std::size_t length, std::mt19937_64& random) {
  std::ranges::shuffle(numbers, random);
  std::vector<std::vector<std::uint32_t>> rounds;
  for (std::size_t first = 0; first < numbers.size(); first += length) {
    const auto begin = numbers.begin() + static_cast<std::ptrdiff_t>(first);
    rounds.emplace_back(
        begin, begin + static_cast<std::ptrdiff_t>(std::min(length, numbers.size() - first)));
    std::ranges::sort(rounds.back());
  }
  return rounds;
}

/// Copies the pixels of some tiles of a map of rows from this one on.
void copy_tiles(const DepthMap& rows, std::uint32_t first_row, const ImageTiles& tiles,
                const WantedTile& wanted, DepthMap& map) {
  for (std::size_t i = 0; i < map.channels.size(); ++i) {
    std::visit(
        [&]<class T>(Samples<T>& values) {
          const auto& from = std::get<Samples<T>>(rows.channels[i].values);
          for (std::uint32_t pixel = 0; pixel < from.size(); ++pixel) {
            const std::uint32_t row = first_row + pixel / map.width, column = pixel % map.width;
            if (!wanted(row / tiles.side * tiles.columns + column / tiles.side)) continue;
            values[std::size_t{row} * map.width + column] = from[pixel];
          }
        },
        map.channels[i].values);
  }
}

struct Plan {
  std::uint32_t places;
  std::size_t triangles_of_round;
  TilesInRounds::Limits limits;
  std::uint32_t rows_at_once;
};

/// Renders as several processes do: each place is given, in rounds, the triangles that touch its
/// tiles. Compares with a render of the whole scene.
void expect_same_in_places(const Scene& scene, const Camera& camera, const RenderOptions& options,
                           const Plan& plan, const Rendered& truth, std::mt19937_64& random) {
  const ImageTiles tiles = tiles_of(camera);
  std::vector<std::uint32_t> all(TriangleSource(scene).count());
  std::iota(all.begin(), all.end(), 0);
  std::vector<std::uint32_t> place_of(tiles.count());
  for (std::uint32_t& place : place_of) place = static_cast<std::uint32_t>(random() % plan.places);

  DepthMap map =
      render_fast(Scene{std::vector<Mesh>(scene.meshes.size()), scene.objects, {}}, camera, options)
          .map;
  std::uint64_t pixels_with_surface = 0;
  for (std::uint32_t place = 0; place < plan.places; ++place) {
    const WantedTile wanted = [&](std::uint32_t tile) { return place_of[tile] == place; };
    TilesInRounds drawing(scene, camera, options, plan.limits);
    const SortedTriangles sorted = drawing.sort_again(some_of(scene, all));
    std::vector<std::uint64_t> counts(tiles.count(), 0), counted(tiles.count(), 0);
    sorted.count(counts);
    std::vector<bool> touches(all.size(), false);
    for (const TileTouch& touch : sorted.touches([](std::uint32_t) { return true; })) {
      ++counted[touch.tile];
      if (wanted(touch.tile)) touches[touch.triangle] = true;
    }
    EXPECT_EQ(counts, counted);
    std::vector<std::uint32_t> own;
    std::ranges::copy_if(all, std::back_inserter(own), [&](std::uint32_t t) { return touches[t]; });
    EXPECT_EQ(sorted.count_triangles(wanted), own.size());

    std::vector<std::uint32_t> own_tiles;
    for (std::uint32_t tile = 0; tile < tiles.count(); ++tile)
      if (wanted(tile)) own_tiles.push_back(tile);
    drawing.choose(own_tiles);
    for (const auto& round : rounds_of(own, plan.triangles_of_round, random))
      drawing.draw(drawing.sort(some_of(scene, round)));
    for (std::uint32_t row = 0; row < tiles.rows; row += plan.rows_at_once) {
      const DepthMap rows = drawing.rows(row, std::min(tiles.rows, row + plan.rows_at_once));
      copy_tiles(rows, row * tiles.side, tiles, wanted, map);
    }
    pixels_with_surface += drawing.statistics().pixels_with_surface;
  }
  EXPECT_EQ(pixels_with_surface, truth.statistics.pixels_with_surface);
  expect_same_map(map, truth.map);
}

RenderOptions all_channels() {
  RenderOptions options;
  options.channels = checks::every_channel;
  return options;
}

constexpr std::uint64_t plenty = std::uint64_t{1} << 40;

const std::vector<Plan> plans{{1, 1000000, {plenty, plenty}, 100},
                              {1, 100, {plenty, plenty}, 1},
                              {2, 37, {0, plenty}, 2},
                              {3, 100, {0, 0}, 1},
                              {2, 500, {plenty, 0}, 3},
                              {5, 1000, {1 << 20, 1 << 16}, 1}};

TEST(TilesInRounds, AreThoseOfTheWholeScene) {
  std::mt19937_64 random(501);
  const Camera camera = checks::camera_of(160, 140, 64);
  for (const bool on_samples : {false, true}) {
    for (const Plan& plan : plans) {
      const Scene scene = checks::soup(random, 900 / checks::effort, on_samples);
      const RenderOptions options = all_channels();
      expect_same_in_places(scene, camera, options, plan, render_fast(scene, camera, options),
                            random);
    }
  }
}

TEST(TilesInRounds, SliversWithAllWaysToCull) {
  std::mt19937_64 random(502);
  const Camera camera = checks::camera_of(160, 140, 64);
  for (const Cull cull : {Cull::none, Cull::back, Cull::front}) {
    for (const Plan& plan : plans) {
      const Scene scene = checks::slivers(random, 600 / checks::effort);
      RenderOptions options = all_channels();
      options.cull = cull;
      expect_same_in_places(scene, camera, options, plan, render_fast(scene, camera, options),
                            random);
    }
  }
}

/// Corners behind the eye and beside it: bins, setups and coverage ask exact numbers for triangles
/// whose numbers in a round are not those in the scene, in every tile.
TEST(TilesInRounds, TrianglesAroundTheEye) {
  std::mt19937_64 random(504);
  for (int i = 0; i < 6 / checks::effort + 1; ++i) {
    SCOPED_TRACE("case " + std::to_string(i) + " of seed 504");
    const auto number = [&] { return static_cast<double>(random() % 4097) / 1024 - 2; };
    Scene scene;
    for (std::uint32_t object = 0; object < 3; ++object) {
      std::vector<MeshPoint> vertices;
      std::vector<CornerIndices> triangles;
      for (std::uint32_t t = 0; t < 40; ++t) {
        for (int k = 0; k < 3; ++k) vertices.push_back({number(), number(), number() + 1});
        triangles.push_back({3 * t, 3 * t + 1, 3 * t + 2});
      }
      Scene one = checks::scene_of(std::move(vertices), std::move(triangles));
      scene.meshes.push_back(std::move(one.meshes[0]));
      scene.objects.push_back(std::move(one.objects[0]));
      scene.objects.back().mesh = object;
    }
    Camera camera = checks::camera_of(200, 150, 90);
    if (i % 2 == 1) camera.near = 0.25;
    RenderOptions options = all_channels();
    options.cull = i % 3 == 0 ? Cull::none : i % 3 == 1 ? Cull::back : Cull::front;
    const Rendered truth = render_fast(scene, camera, options);
    for (const Plan& plan :
         {Plan{1, 17, {plenty, plenty}, 1}, Plan{3, 17, {0, 0}, 1}, Plan{2, 50, {0, 1 << 14}, 2}})
      expect_same_in_places(scene, camera, options, plan, truth, random);
    if (::testing::Test::HasFailure()) return;
  }
}

/// Where coordinates cancel, coverage is settled by exact corners, which each object places its own
/// way: the triangle that says which object it is has another number in a round.
TEST(TilesInRounds, PlacedObjects) {
  std::mt19937_64 random(506);
  const Camera camera = checks::camera_of(160, 140, 64);
  const auto number = [&] { return static_cast<double>(random() % 4096) / 4096; };
  Scene scene;
  for (std::uint32_t object = 0; object < 3; ++object) {
    const double moved_by = object * 0x1p26;
    std::vector<MeshPoint> vertices;
    std::vector<CornerIndices> triangles;
    for (std::uint32_t t = 0; t < 100; ++t) {
      const double x = 2 * number() - 1, y = 2 * number() - 1, z = 1 + number();
      for (int k = 0; k < 3; ++k)
        vertices.push_back({x + number() / 4 - moved_by, y + number() / 4, z});
      triangles.push_back({3 * t, 3 * t + 1, 3 * t + 2});
    }
    Scene one = checks::scene_of(std::move(vertices), std::move(triangles));
    scene.meshes.push_back(std::move(one.meshes[0]));
    Object placed = one.objects[0];
    placed.mesh = object;
    placed.placed_as_is = false;
    placed.world_from_mesh.rows[0] = {1, 0, 0, moved_by};
    scene.objects.push_back(placed);
  }
  const RenderOptions options = all_channels();
  const Rendered truth = render_fast(scene, camera, options);
  EXPECT_GT(truth.statistics.areas_with_exact_ends, 100U);
  for (const Plan& plan : plans) expect_same_in_places(scene, camera, options, plan, truth, random);
}

RenderOptions lens_channels() {
  RenderOptions options;
  options.channels = checks::every_channel;
  std::erase(options.channels, Channel::A);
  options.channels.push_back(Channel::valid);
  return options;
}

/// A lens of one view, lenses of several, one that folds within the image, and rays so far from the
/// axis that no window holds them. With a third of the pairs of a lens and a plan, each occurs.
TEST(TilesInRounds, OfLenses) {
  std::mt19937_64 random(507);
  std::size_t number = 0;
  for (const Lens& lens :
       {Lens{LensModel::opencv, {-0.2, 0.05, 0.001}}, Lens{LensModel::division, {-2}},
        Lens{LensModel::fisheye_stereographic}, Lens{LensModel::simple_radial, {-0.9}},
        Lens{LensModel::simple_radial, {0x1p-1000}}}) {
    SCOPED_TRACE(name_of(lens.model));
    Camera camera = checks::camera_of(130, 70, 64);
    camera.projection.lens = lens;
    const bool is_too_far = lens.distortion[0] == 0x1p-1000;
    if (is_too_far) {
      camera.width = 70;
      camera.height = 3;
      camera.projection.fx = camera.projection.fy = 0x1p-660;
    }
    std::size_t of_plan = number++;
    for (const Plan& plan : plans) {
      if (of_plan++ % 3 != 0 && !checks::draws_all_cases()) continue;
      const Scene scene = checks::soup(random, is_too_far ? 20 : 120 / checks::effort, false);
      RenderOptions options = lens_channels();
      // Shading normals take most of the time at a lens; one plan of many rounds has them.
      if (&plan != &plans[2]) std::erase(options.channels, Channel::Ns);
      if (plan.places == 2) options.cull = Cull::back;
      expect_same_in_places(scene, camera, options, plan, render_fast(scene, camera, options),
                            random);
    }
  }
}

TEST(TilesInRounds, OfATableOfDirections) {
  std::mt19937_64 random(508);
  const Camera camera =
      checks::with_table(checks::camera_of(100, 70, 64), checks::DirectionMaker(508).numbers(7000));
  for (const Plan& plan : plans) {
    const Scene scene = checks::soup(random, 200 / checks::effort, false);
    expect_same_in_places(scene, camera, lens_channels(), plan,
                          render_fast(scene, camera, lens_channels()), random);
  }
}

TEST(TilesInRounds, Adversaries) {
  for (const checks::Family family : checks::all_families) {
    checks::for_each_adversary(30, [&](std::uint64_t seed) {
      SCOPED_TRACE(name_of(family));
      std::mt19937_64 random(seed);
      const checks::Case c = checks::adversarial_case(family, seed);
      RenderOptions options = all_channels();
      if (seed % 4 == 3) options.cull = Cull::back;
      const Rendered truth = render_fast(c.scene, c.camera, options);
      for (const Plan& plan :
           {Plan{1, 1, {0, 0}, 1}, Plan{1, 3, {plenty, plenty}, 1}, Plan{2, 2, {plenty, 0}, 1}})
        expect_same_in_places(c.scene, c.camera, options, plan, truth, random);
    });
  }
}

/// Most triangles are hidden, and surfaces of a tile are forgotten many times; those of a round are
/// more than there is room for where the tile waits, next to another one.
TEST(TilesInRounds, ManySurfacesOfATile) {
  std::mt19937_64 random(503);
  const Camera camera = checks::camera_of(128, 30, 64);
  std::vector<MeshPoint> vertices;
  std::vector<CornerIndices> triangles;
  const auto number = [&] { return static_cast<double>(random() % 4096) / 4096; };
  for (std::uint32_t t = 0; t < 60000 / checks::effort; ++t) {
    const double u = 128 * number(), v = 30 * number(), z = 1 + 8 * number();
    for (int k = 0; k < 3; ++k) {
      vertices.push_back(
          {(u + 4 * number() - 64) / 64 * z, (v + 4 * number() - 15) / 64 * z, z + number() / 8});
    }
    triangles.push_back({3 * t, 3 * t + 1, 3 * t + 2});
  }
  const Scene scene = checks::scene_of(std::move(vertices), std::move(triangles));
  RenderOptions options;
  options.channels = {Channel::Z, Channel::id};
  for (const std::size_t length : {300U, 14000U}) {
    const Plan plan{1, length, {0, 0}, 1};
    expect_same_in_places(scene, camera, options, plan, render_fast(scene, camera, options),
                          random);
  }
}

/// A depth that the encoding cannot hold is told with its place in the image, not in the rows.
TEST(TilesInRounds, ADepthBeyondTheEncodingHasItsPlace) {
  const Camera camera = checks::camera_of(160, 140, 64);
  const Scene scene = checks::scene_of({{0.5, 0.9, 2}, {0.6, 0.9, 2}, {0.5, 1, 2}}, {{0, 1, 2}});
  RenderOptions options;
  options.channels = {Channel::Z};
  options.depth_encoding = {.type = DepthEncoding::Type::scaled_unorm16, .scale = 1e6};
  const auto message_of = [](const auto& work) {
    try {
      work();
    } catch (const OutputError& error) {
      return std::string(error.what());
    }
    return std::string("no error");
  };
  const std::string expected = message_of([&] { (void)render_fast(scene, camera, options); });
  TilesInRounds drawing(scene, camera, options, {});
  std::vector<std::uint32_t> tiles(tiles_of(camera).count());
  std::iota(tiles.begin(), tiles.end(), 0);
  drawing.choose(tiles);
  drawing.draw(drawing.sort(some_of(scene, {0})));
  (void)drawing.rows(0, 1);
  EXPECT_EQ(message_of([&] { (void)drawing.rows(1, 3); }), expected);
  EXPECT_NE(expected, "no error");
}

}  // namespace
}  // namespace fathom
