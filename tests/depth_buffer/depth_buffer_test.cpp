#include "fathom/depth_buffer/depth_buffer.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <bit>
#include <string>

#include "fathom/depth_format/encode.h"
#include "fathom/failures/errors.h"
#include "fathom/reference/probe.h"
#include "fathom/render.h"
#include "tests/effort.h"
#include "tests/engines/expect_same_map.h"
#include "tests/inputs/random_scenes.h"
#include "tests/inputs/soup.h"
#include "tests/special_values.h"

namespace fathom {
namespace {

using checks::Kind;

struct Buffered {
  DepthMap map;
  DepthBufferStatistics statistics;
};

Buffered buffered(const Scene& scene, const Camera& camera, const DepthFormat& format,
                  Engine engine, Cull cull = Cull::none,
                  EqualDepths equal_depths = EqualDepths::first_wins) {
  RenderOptions options{.engine = engine, .channels = {Channel::Z, Channel::id}, .cull = cull};
  Buffered result{render(scene, camera, options).map, {}};
  result.statistics =
      add_depth_buffer(result.map, scene, camera, {format, true, options, equal_depths});
  return result;
}

StoredDepth stored_at(const DepthMap& map, Storage storage, std::size_t pixel) {
  if (storage == Storage::float64) {
    const std::uint64_t high = (*map.values<std::uint32_t>("Zwindow.high"))[pixel];
    return {high << 32 | (*map.values<std::uint32_t>("Zwindow.low"))[pixel]};
  }
  if (is_unorm(storage)) return {(*map.values<std::uint32_t>("Zwindow"))[pixel]};
  const float value = (*map.values<float>("Zwindow"))[pixel];
  return round_to_storage(storage, Ratio(Dyadic(static_cast<double>(value))));
}

/// The depth test of the specification, over every triangle that counts at the sample.
std::uint32_t winner(const DepthFormat& format, std::vector<CoveringTriangle> covering,
                     EqualDepths equal_depths) {
  std::sort(covering.begin(), covering.end(),
            [](const auto& a, const auto& b) { return a.number < b.number; });
  std::uint32_t winner = no_surface;
  StoredDepth nearest;
  for (const CoveringTriangle& t : covering) {
    if (!t.counts) continue;
    const StoredDepth stored = encode(format, t.depth);
    const bool wins_as_equal = equal_depths == EqualDepths::last_wins && stored == nearest;
    if (winner == no_surface || is_nearer(format, stored, nearest) || wins_as_equal) {
      winner = t.number;
      nearest = stored;
    }
  }
  return winner;
}

/// Holds a map against every triangle that covers a sample, each exact, one pixel after the other.
void expect_true(const Buffered& b, const Scene& scene, const Camera& camera,
                 const DepthFormat& format, Cull cull, EqualDepths equal_depths) {
  std::uint64_t fighting = 0;
  for (std::uint32_t y = 0; y < camera.height; ++y) {
    for (std::uint32_t x = 0; x < camera.width; ++x) {
      const std::size_t pixel = y * camera.width + x;
      const std::vector<CoveringTriangle> covering = probe(scene, camera, x, y, cull);
      const StoredDepth stored = stored_at(b.map, format.storage, pixel);
      const float decoded = (*b.map.values<float>("Zdecoded"))[pixel];
      const float error = (*b.map.values<float>("Zerror"))[pixel];
      if (covering.empty() || !covering[0].counts) {
        ASSERT_EQ(stored,
                  is_reversed(format.mapping) ? StoredDepth{} : greatest_stored(format.storage));
        ASSERT_EQ(decoded, infinity);
        ASSERT_EQ(error, 0);
        ASSERT_EQ((*b.map.values<std::uint32_t>("Zwinner"))[pixel], no_surface);
        ASSERT_EQ((*b.map.values<std::uint32_t>("Zfight"))[pixel], 0U);
        continue;
      }
      const Ratio& depth = covering[0].depth;
      ASSERT_EQ(stored, encode(format, depth));
      const std::optional<Real> back = decode(format, stored);
      ASSERT_EQ(decoded, back ? round_to_binary32(*back) : infinity);
      ASSERT_EQ(error, back ? round_to_binary32(difference(*back, depth)) : infinity);
      const std::uint32_t wins = winner(format, covering, equal_depths);
      ASSERT_EQ((*b.map.values<std::uint32_t>("Zwinner"))[pixel], wins);
      ASSERT_EQ((*b.map.values<std::uint32_t>("Zfight"))[pixel], wins != covering[0].number);
      fighting += wins != covering[0].number ? 1 : 0;
    }
  }
  ASSERT_EQ(b.statistics.fighting, fighting);
}

DepthFormat random_format(std::mt19937_64& random, const Camera& camera) {
  const auto mapping = all_mappings[random() % std::size(all_mappings)];
  DepthFormat format{mapping, all_storages[random() % std::size(all_storages)], camera.near,
                     camera.far};
  if (mapping == Mapping::log && random() % 2 == 0) format.c = 0.25;
  return format;
}

/// Scenes in which ties abound; half of the formats have so few steps that all surfaces fight.
TEST(DepthBuffer, BothEnginesHoldWhatTheSpecificationSays) {
  std::mt19937_64 random(31);
  std::uint64_t fighting = 0;
  for (int i = 0; i < 1500 / checks::effort; ++i) {
    const Kind kind = i % 3 == 0 ? Kind::neighbours : Kind::few_bits;
    checks::Case c = checks::CaseMaker(1000 + static_cast<std::uint64_t>(i), kind).make();
    c.camera.near = std::ldexp(1, -static_cast<int>(random() % 26));
    c.camera.far = std::ldexp(1, static_cast<int>(random() % 30) + 1);
    const DepthFormat format = random_format(random, c.camera);
    const Cull cull = i % 5 == 0 ? Cull::back : i % 7 == 0 ? Cull::front : Cull::none;
    const EqualDepths equal_depths = i % 2 == 0 ? EqualDepths::first_wins : EqualDepths::last_wins;
    SCOPED_TRACE("case " + std::to_string(i) + " " + std::string(name_of(format.mapping)) + " " +
                 std::string(name_of(format.storage)));
    const Buffered exact =
        buffered(c.scene, c.camera, format, Engine::reference, cull, equal_depths);
    ASSERT_NO_FATAL_FAILURE(expect_true(exact, c.scene, c.camera, format, cull, equal_depths));
    const Buffered fast = buffered(c.scene, c.camera, format, Engine::fast, cull, equal_depths);
    ASSERT_NO_FATAL_FAILURE(checks::expect_same_map(fast.map, exact.map));
    ASSERT_FALSE(::testing::Test::HasFailure());
    EXPECT_EQ(fast.statistics.fighting, exact.statistics.fighting);
    fighting += exact.statistics.fighting;
  }
  // Among the few cases that are run under sanitizers there need not be one.
  if (checks::effort == 1) {
    EXPECT_GT(fighting, 50U);
  }
}

/// Numbers for which no bound was derived.
TEST(DepthBuffer, HugeAndTinyScenesAreLeftToExactNumbers) {
  for (const Kind kind : {Kind::huge, Kind::tiny}) {
    std::uint64_t exact_numbers = 0;
    for (int i = 0; i < 40 / checks::effort + 1; ++i) {
      checks::Case c = checks::CaseMaker(2000 + static_cast<std::uint64_t>(i), kind).make();
      c.camera.near = kind == Kind::huge ? 1e140 : 1e-160;
      c.camera.far = kind == Kind::huge ? 1e160 : 1e-140;
      const DepthFormat format{Mapping::log_ulrich, Storage::unorm16, c.camera.near, c.camera.far};
      const Buffered exact = buffered(c.scene, c.camera, format, Engine::reference);
      const Buffered fast = buffered(c.scene, c.camera, format, Engine::fast);
      checks::expect_same_map(fast.map, exact.map);
      exact_numbers += fast.statistics.by_exact_numbers;
    }
    EXPECT_GT(exact_numbers, 0U);
  }
}

/// Larger images, all sizes of triangles; which tier answers.
TEST(DepthBuffer, EnginesAgreeOnManyTriangles) {
  std::mt19937_64 random(32);
  const Scene scene = checks::soup(random, 60, false);
  Camera camera = checks::camera_of(100 / (checks::effort > 1 ? 4 : 1), 90, 70);
  camera.near = 0.5;
  camera.far = 50;
  for (const Mapping mapping : {Mapping::standard, Mapping::reversed, Mapping::log}) {
    for (const Storage storage : {Storage::unorm16, Storage::float16, Storage::float32}) {
      const DepthFormat format{mapping, storage, camera.near, camera.far};
      const Buffered exact = buffered(scene, camera, format, Engine::reference);
      const Buffered fast = buffered(scene, camera, format, Engine::fast);
      checks::expect_same_map(fast.map, exact.map);
      const DepthBufferStatistics& s = fast.statistics;
      const std::uint64_t all = s.by_binary64 + s.by_double_words + s.by_exact_numbers;
      EXPECT_EQ(all, exact.statistics.by_exact_numbers);
      // Depths here are as likely at a boundary as anywhere where z has few bits: fronto-parallel
      // triangles are among them.
      EXPECT_LT(s.by_exact_numbers, all / 20);
      if (mapping == Mapping::log) continue;
      EXPECT_GT(s.by_binary64, all * 9 / 10);
    }
  }
}

Scene two_planes(double depth, double separation, bool far_one_first) {
  const double a = far_one_first ? depth + separation : depth;
  const double b = far_one_first ? depth : depth + separation;
  const double w = 10 * depth;
  return checks::scene_of({{-w, -w, a}, {w, -w, a}, {0, w, a}, {-w, -w, b}, {w, -w, b}, {0, w, b}},
                          {{0, 1, 2}, {3, 4, 5}});
}

/// standard, near 0.1, far 1000, unorm16: at depth 10 a step is 10²·999.9/(100·65535) = 0.01526; at
/// depth 1 it is 0.0001526.
TEST(DepthBuffer, SurfacesCloserThanAStepFight) {
  Camera camera = checks::camera_of(4, 3, 2);
  camera.near = 0.1;
  camera.far = 1000;
  const DepthFormat format{Mapping::standard, Storage::unorm16, 0.1, 1000};
  const auto fighting = [&](double depth, double separation, bool far_one_first) {
    return buffered(two_planes(depth, separation, far_one_first), camera, format, Engine::fast)
        .statistics.fighting;
  };
  EXPECT_EQ(fighting(10, 0.0001, true), 12U);  // the first drawn wins among equal codes
  EXPECT_EQ(fighting(10, 0.0001, false), 0U);  // which here is the right one
  EXPECT_EQ(fighting(10, 0.02, true), 0U);
  EXPECT_EQ(fighting(1, 0.0002, true), 0U);
  EXPECT_EQ(fighting(100, 0.01, true), 12U);
}

TEST(DepthBuffer, ChannelsHaveTheTypesThatTheyAreSaidToHave) {
  Camera camera = checks::camera_of(4, 3, 2);
  camera.near = 0.5;
  camera.far = 8;
  const Scene scene = two_planes(2, 1, false);
  const auto map_of = [&](Storage storage) {
    return buffered(scene, camera, {Mapping::linear, storage, 0.5, 8}, Engine::fast).map;
  };
  // (2 − 0.5)/7.5 = 0.2
  EXPECT_EQ((*map_of(Storage::unorm16).values<std::uint32_t>("Zwindow"))[5], 13107U);
  EXPECT_EQ((*map_of(Storage::float16).values<float>("Zwindow"))[5], 0x1.998p-3F);
  EXPECT_EQ((*map_of(Storage::float32).values<float>("Zwindow"))[5], 0.2F);
  const DepthMap wide = map_of(Storage::float64);
  EXPECT_EQ(wide.find("Zwindow"), nullptr);
  EXPECT_EQ(stored_at(wide, Storage::float64, 5).bits, std::bit_cast<std::uint64_t>(0.2));
  EXPECT_EQ((*map_of(Storage::unorm16).values<float>("Zdecoded"))[5], 2.0F);
}

TEST(DepthBuffer, WhatMeansNothingIsRefused) {
  Camera camera = checks::camera_of(4, 3, 2);
  EXPECT_THROW(depth_format_of(camera, Mapping::standard, Storage::unorm16), UsageError);
  camera.near = 1;
  EXPECT_THROW(depth_format_of(camera, Mapping::linear, Storage::unorm16), UsageError);
  EXPECT_NO_THROW(depth_format_of(camera, Mapping::reversed_infinite, Storage::float32));
  const Scene scene = two_planes(2, 1, false);
  DepthMap map = render(scene, camera, {.channels = {Channel::Z}}).map;
  EXPECT_THROW(add_depth_buffer(map, scene, camera,
                                {{Mapping::infinite, Storage::unorm16, 1, infinity}, false, {}}),
               UsageError);
}

/// Three bands of rows and a part of one, alone and with what the exact map says beside it.
TEST(DepthBuffer, StoresTheSameInEveryRowWhetherOrNotItIsCompared) {
  std::mt19937_64 random(33);
  const Scene scene = checks::soup(random, 40, false);
  Camera camera = checks::camera_of(20, 27, 20);
  camera.near = 0.5;
  camera.far = 50;
  const DepthFormat format{Mapping::reversed, Storage::unorm16, camera.near, camera.far};
  for (const Engine engine : {Engine::fast, Engine::reference}) {
    const Buffered compared = buffered(scene, camera, format, engine);
    const RenderOptions options{.engine = engine, .channels = {Channel::Z, Channel::id}};
    DepthMap alone = render(scene, camera, options).map;
    const DepthBufferStatistics s =
        add_depth_buffer(alone, scene, camera, {format, false, options});
    for (const char* name : {"id", "Zwindow"}) {
      EXPECT_EQ(*alone.values<std::uint32_t>(name), *compared.map.values<std::uint32_t>(name));
    }
    EXPECT_EQ(*alone.values<float>("Zdecoded"), *compared.map.values<float>("Zdecoded"));
    const auto& id = *alone.values<std::uint32_t>("id");
    const auto surfaces = static_cast<std::uint64_t>(id.size()) -
                          static_cast<std::uint64_t>(std::count(id.begin(), id.end(), no_surface));
    EXPECT_GT(surfaces, 200U);
    EXPECT_EQ(s.by_binary64 + s.by_double_words + s.by_exact_numbers, surfaces);
    EXPECT_EQ(s.fighting, 0U);
    if (engine == Engine::reference) {
      EXPECT_EQ(s.by_exact_numbers, surfaces);
    }
  }
}

/// Triangles are numbered from 0: two of them are 0 and 1.
TEST(DepthBuffer, MapsOfOtherScenesAreRefused) {
  Camera camera = checks::camera_of(4, 3, 2);
  camera.near = 0.5;
  camera.far = 8;
  const Scene scene = two_planes(2, 1, false);
  const DepthFormat format{Mapping::standard, Storage::unorm16, 0.5, 8};
  for (const std::uint32_t id : {1U, 2U, 3U}) {
    DepthMap map = render(scene, camera, {.channels = {Channel::Z, Channel::id}}).map;
    (*map.values<std::uint32_t>("id"))[7] = id;
    if (id < 2) {
      EXPECT_NO_THROW(add_depth_buffer(map, scene, camera, {format, false, {}}));
    } else {
      EXPECT_THROW(add_depth_buffer(map, scene, camera, {format, false, {}}), InputError);
    }
  }
}

}  // namespace
}  // namespace fathom
