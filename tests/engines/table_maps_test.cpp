// Maps of tables of directions: against rays that are cast in rational numbers, and laws that hold
// bit for bit.
#include <gtest/gtest.h>

#include <bit>
#include <cstring>
#include <functional>
#include <numbers>
#include <random>

#include "fathom/failures/errors.h"
#include "fathom/render.h"
#include "tests/effort.h"
#include "tests/inputs/random_scenes.h"
#include "tests/inputs/tables_of_directions.h"
#include "tests/oracle/against_oracle.h"

namespace fathom {
namespace {

using checks::box_scene;
using checks::Case;
using checks::CaseMaker;
using checks::DirectionMaker;
using checks::Kind;
using checks::scene_of;
using checks::with_table;

RenderOptions options_with(std::vector<Channel> channels) {
  RenderOptions options;
  options.channels = std::move(channels);
  options.threads = 1;
  return options;
}

RenderOptions all_with_valid() {
  std::vector<Channel> channels = checks::all_channels();
  channels.push_back(Channel::valid);
  return options_with(std::move(channels));
}

oracle::RayCaster cast_along(const Scene& scene, const Camera& camera) {
  const std::shared_ptr<const DirectionTable> table = camera.projection.lens->directions;
  return checks::cast_along(scene, camera, [table](std::uint32_t column, std::uint32_t row) {
    return table->at(column, row);
  });
}

class TableMaps : public ::testing::TestWithParam<Kind> {};

TEST_P(TableMaps, EveryChannelOfEveryPixelAgreesWithRationalRays) {
  CaseMaker cases(static_cast<std::uint64_t>(GetParam()) + 1, GetParam());
  DirectionMaker directions(static_cast<std::uint64_t>(GetParam()) + 7);
  int hits = 0, without_ray = 0;
  RenderStatistics all;
  for (int i = 0; i < 300 / checks::effort && !HasFailure(); ++i) {
    SCOPED_TRACE("scene " + std::to_string(i) + " of this seed");
    Case c = cases.make();
    std::vector<double> numbers = directions.numbers(30);
    if (i % 2 == 0) {
      c.camera.world_to_camera = Camera().world_to_camera;
      checks::aim_at_corners(c.scene, numbers);
    }
    const Camera camera = with_table(c.camera, std::move(numbers));
    const auto [map, statistics, doubtful] = render(c.scene, camera, all_with_valid());
    add(all, statistics);
    const oracle::RayCaster rays = cast_along(c.scene, camera);
    const auto& valid = *map.values<std::uint32_t>("valid");
    for (int y = 0; y < 5; ++y) {
      for (int x = 0; x < 6; ++x) {
        const bool has_ray = valid[static_cast<std::size_t>(6 * y + x)] == 1;
        without_ray += !has_ray;
        ASSERT_EQ(rays.sees(x, y), has_ray) << x << ' ' << y;
        const auto hit = has_ray ? rays.cast(x, y) : std::nullopt;
        checks::expect_pixel(map, x, y, hit, c.scene);
        hits += hit.has_value();
      }
    }
  }
  EXPECT_GT(hits, 300 / checks::effort);
  EXPECT_GT(without_ray, 0);
  EXPECT_GT(all.edges.exact, 0U);
}

std::string name_of_kind(const ::testing::TestParamInfo<Kind>& tested) {
  return tested.param == Kind::few_bits ? "few_bits" : "neighbours";
}

INSTANTIATE_TEST_SUITE_P(RandomScenes, TableMaps,
                         ::testing::Values(Kind::few_bits, Kind::neighbours), name_of_kind);

void expect_same_maps(const DepthMap& a, const DepthMap& b) {
  ASSERT_EQ(a.channels.size(), b.channels.size());
  for (const ImageChannel& channel : a.channels) {
    const ImageChannel* const other = b.find(channel.name);
    ASSERT_NE(other, nullptr) << channel.name;
    std::visit(
        [&](const auto& values) {
          using Values = std::decay_t<decltype(values)>;
          const auto& others = std::get<Values>(other->values);
          ASSERT_EQ(values.size(), others.size());
          EXPECT_EQ(std::memcmp(values.data(), others.data(), values.size() * sizeof(values[0])), 0)
              << channel.name;
        },
        channel.values);
  }
}

/// Views without a range of depths: near and far of a pinhole bound planar depths.
Case case_without_range(CaseMaker& cases) {
  Case c;
  do c = cases.make();
  while (is_orthographic(c.camera.projection));
  const Camera plain;
  c.camera.near = plain.near;
  c.camera.far = plain.far;
  // fx of the table is 1: its ties move to the right and down.
  for (double* f : {&c.camera.projection.fx, &c.camera.projection.fy})
    *f = std::ldexp(1, std::ilogb(*f));
  c.camera.projection.skew = 0;
  return c;
}

/// (x_d, y_d) of a pixel; exact, as focal lengths are powers of two.
std::array<double, 2> plane_point(const Camera& camera, std::uint32_t column, std::uint32_t row) {
  const Projection& p = camera.projection;
  return {(column + p.pixel_centre - p.cx) / p.fx, (row + p.pixel_centre - p.cy) / p.fy};
}

/// A table whose direction at each pixel is (x_d, y_d, 1 + k·r²).
Camera table_of_division(const Camera& camera, double k) {
  std::vector<double> numbers;
  for (std::uint32_t row = 0; row < camera.height; ++row) {
    for (std::uint32_t column = 0; column < camera.width; ++column) {
      const auto [x, y] = plane_point(camera, column, row);
      const double bend = k * (x * x + y * y);
      const double z = bend < 1 ? 1 + bend : std::numeric_limits<double>::quiet_NaN();
      numbers.insert(numbers.end(), {x, y, z});
    }
  }
  return with_table(camera, std::move(numbers));
}

TEST(TablesEqual, ThePinholeThatTheyAreFrom) {
  CaseMaker cases(21, Kind::few_bits);
  std::uint64_t seen = 0;
  for (int i = 0; i < 400 / checks::effort; ++i) {
    SCOPED_TRACE(i);
    const Case c = case_without_range(cases);
    const auto pinhole = render(c.scene, c.camera, all_with_valid());
    expect_same_maps(pinhole.map,
                     render(c.scene, table_of_division(c.camera, 0), all_with_valid()).map);
    seen += pinhole.statistics.pixels_with_surface;
  }
  EXPECT_GT(seen, 400U / checks::effort);
}

TEST(TablesEqual, TheRationalLensesThatTheyAreFrom) {
  CaseMaker cases(22, Kind::few_bits);
  std::uint64_t seen = 0;
  for (int i = 0; i < 400 / checks::effort; ++i) {
    SCOPED_TRACE(i);
    Case c = case_without_range(cases);
    const double k = i % 3 == 0 ? -0.25 : i % 3 == 1 ? 0.125 : -2;
    Camera camera = c.camera;
    Lens& lens = camera.projection.lens.emplace(Lens{LensModel::division, {k}});
    if (k == -0.25) lens = Lens{LensModel::fisheye_stereographic};
    camera.near = c.camera.near = i % 4;
    camera.far = c.camera.far = i % 4 + 3;
    const auto of_lens = render(c.scene, camera, all_with_valid());
    expect_same_maps(of_lens.map,
                     render(c.scene, table_of_division(c.camera, k), all_with_valid()).map);
    seen += of_lens.statistics.pixels_with_surface;
  }
  EXPECT_GT(seen, 100U / checks::effort);
}

TEST(Tables, ACropOfATableIsACropOfTheMap) {
  CaseMaker cases(23, Kind::few_bits);
  DirectionMaker directions(24);
  for (int i = 0; i < 100 / checks::effort; ++i) {
    const Case c = cases.make();
    const std::vector<double> numbers = directions.numbers(30);
    std::vector<double> part;
    for (std::size_t row = 1; row < 4; ++row)
      part.insert(part.end(), &numbers[3 * (6 * row + 2)], &numbers[3 * (6 * row + 2)] + 9);
    Camera small = c.camera;
    small.width = small.height = 3;
    const RenderOptions options = options_with({Channel::distance, Channel::id});
    const DepthMap whole = render(c.scene, with_table(c.camera, numbers), options).map;
    const DepthMap crop = render(c.scene, with_table(small, part), options).map;
    for (std::size_t y = 0; y < 3; ++y) {
      for (std::size_t x = 0; x < 3; ++x) {
        const std::size_t place = 6 * (y + 1) + x + 2;
        ASSERT_EQ(std::bit_cast<std::uint32_t>((*crop.values<float>("distance"))[3 * y + x]),
                  std::bit_cast<std::uint32_t>((*whole.values<float>("distance"))[place]));
        ASSERT_EQ((*crop.values<std::uint32_t>("id"))[3 * y + x],
                  (*whole.values<std::uint32_t>("id"))[place]);
      }
    }
  }
}

// Closed surfaces around the eye.

Scene octahedron() {
  std::vector<CornerIndices> faces;
  for (std::uint32_t i = 0; i < 8; ++i)
    faces.push_back({i & 1 ? 1U : 0U, i & 2 ? 3U : 2U, i & 4 ? 5U : 4U});
  return scene_of({{-1, 0, 0}, {1, 0, 0}, {0, -1, 0}, {0, 1, 0}, {0, 0, -1}, {0, 0, 1}}, faces);
}

Scene icosahedron() {
  const double g = std::numbers::phi;
  return scene_of(
      {{-1, g, 0},
       {1, g, 0},
       {-1, -g, 0},
       {1, -g, 0},
       {0, -1, g},
       {0, 1, g},
       {0, -1, -g},
       {0, 1, -g},
       {g, 0, -1},
       {g, 0, 1},
       {-g, 0, -1},
       {-g, 0, 1}},
      {{0, 11, 5},  {0, 5, 1},  {0, 1, 7},  {0, 7, 10}, {0, 10, 11}, {1, 5, 9}, {5, 11, 4},
       {11, 10, 2}, {10, 7, 6}, {7, 1, 8},  {3, 9, 4},  {3, 4, 2},   {3, 2, 6}, {3, 6, 8},
       {3, 8, 9},   {4, 9, 5},  {2, 4, 11}, {6, 2, 10}, {8, 6, 7},   {9, 8, 1}});
}

/// To the corners, to the middle of each pair of corners, and at random.
std::vector<double> directions_at(const Scene& scene, std::size_t pixels) {
  const auto& corners = scene.meshes[0].vertices;
  std::vector<double> numbers;
  for (const MeshPoint& a : corners) {
    for (const MeshPoint& b : corners) {
      if (a.x == -b.x && a.y == -b.y && a.z == -b.z) continue;
      numbers.insert(numbers.end(), {a.x + b.x, a.y + b.y, a.z + b.z});
    }
  }
  const std::vector<double> random = DirectionMaker(31).numbers(pixels);
  numbers.insert(numbers.end(), random.begin(), random.end());
  numbers.resize(3 * pixels);
  return numbers;
}

TEST(Tables, AClosedSurfaceAroundTheEyeCoversEveryRayOnce) {
  for (const Scene& scene : {box_scene(1, 1, 1), octahedron(), icosahedron()}) {
    for (const double sign : {1.0, -1.0}) {
      Camera camera;
      camera.width = camera.height = 40;
      camera.world_to_camera[1][1] = sign;
      camera = with_table(camera, directions_at(scene, 1600));
      const auto [map, statistics, doubtful] =
          render(scene, camera, options_with({Channel::id, Channel::valid}));
      const std::uint64_t rays = 1600 - camera.projection.lens->directions->pixels_without_ray();
      EXPECT_GT(rays, 1000U);
      EXPECT_EQ(statistics.pixels_with_surface, rays);
      EXPECT_EQ(statistics.samples_covered, rays);  // not one is hit twice
    }
  }
}

// A positive factor of a direction means nothing, be it the least or the greatest.
TEST(Tables, LengthsOfDirectionsMeanNothing) {
  const Scene scene = icosahedron();
  Camera camera;
  camera.width = 3;
  camera.height = 1;
  const auto scaled = [&](int power) {
    std::vector<double> numbers{1, 3, -2, 0, 5, 7, -1, 0, 0};
    for (double& number : numbers) number = std::ldexp(number, power);
    return render(scene, with_table(camera, numbers), all_with_valid()).map;
  };
  for (const int power : {-1074, -1000, 1000, 1021}) expect_same_maps(scaled(0), scaled(power));
}

TEST(Tables, HugeAndTinyComponentsOfOneDirectionCount) {
  Camera camera;
  camera.width = 2;
  camera.height = 1;
  // Beside the edge x = y of the first triangle by 10⁻³⁰⁰/10³⁰⁰.
  const Scene halves =
      scene_of({{-9, -9, 4}, {9, 9, 4}, {9, -9, 4}, {-9, 9, 4}}, {{0, 1, 2}, {0, 3, 1}});
  const double tiny = 0x1p-996, huge = 0x1p996;
  const Scene wedge = scene_of({{0, 0, 0x1p500}, {1, 0, 0x1p500}, {0, 1, 0x1p500}}, {{0, 2, 1}});
  const DepthMap map = render(wedge, with_table(camera, {tiny, tiny, huge, -tiny, tiny, huge}),
                              options_with({Channel::id, Channel::Z}))
                           .map;
  EXPECT_EQ((*map.values<std::uint32_t>("id"))[0], 0U);
  EXPECT_EQ((*map.values<std::uint32_t>("id"))[1], no_surface);
  const DepthMap sides =
      render(halves, with_table(camera, {1, 0.5, huge, 0.5, 1, huge}), options_with({Channel::id}))
          .map;
  EXPECT_NE((*sides.values<std::uint32_t>("id"))[0], (*sides.values<std::uint32_t>("id"))[1]);
}

TEST(Tables, AreRefusedWithAnotherSizeOrInfiniteNumbers) {
  Camera camera;
  camera.width = 2;
  camera.height = 1;
  const auto fault_of = [](const std::function<void()>& call) -> std::string {
    try {
      call();
    } catch (const InputError& error) {
      return error.what();
    }
    return "none";
  };
  EXPECT_EQ(fault_of([&] {
              with_table(camera, {1, 2, 3});
            }),
            "directions: found 3 numbers, expected 3 for each of 2x1 pixels");
  EXPECT_EQ(fault_of([&] {
              with_table(camera, {0, 0, 1, 0, HUGE_VAL, 1});
            }),
            "directions: the direction of the pixel in column 1, row 0 has an infinite component, "
            "expected finite numbers, or 0,0,0 for no ray");
  Camera other = with_table(camera, {0, 0, 1, 0, 1, 1});
  other.width = 3;
  EXPECT_EQ(fault_of([&] { (void)render(box_scene(1, 1, 1), other, options_with({Channel::Z})); }),
            "camera: the table of directions has 2x1 pixels, expected the size of the image, 3x1");
}

TEST(Tables, MayEndAtAnAngle) {
  Camera camera;
  camera.width = 3;
  camera.height = 1;
  camera = with_table(camera, {0, 0, 1, 0, 1, 1, 0, 0, -1});
  camera.projection.lens->max_radius = 0.7853981633974484;  // above π/4
  const auto valid = [&] {
    const DepthMap map = render(box_scene(1, 1, 1), camera, options_with({Channel::valid})).map;
    return std::vector<std::uint32_t>(map.values<std::uint32_t>("valid")->begin(),
                                      map.values<std::uint32_t>("valid")->end());
  };
  EXPECT_EQ(valid(), (std::vector<std::uint32_t>{1, 1, 0}));
  camera.projection.lens->max_radius = std::numbers::pi / 4;  // below
  EXPECT_EQ(valid(), (std::vector<std::uint32_t>{1, 0, 0}));
}

}  // namespace
}  // namespace fathom
