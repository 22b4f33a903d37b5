// Scenes from families that are each hard for a reason of their own: the fast engine against the
// reference engine, and both against rays cast in rational numbers. Each scene is rendered with one
// combination, drawn at random, of outputs, vector instructions, threads and floating-point mode.
// Every 32nd scene also has its deep map, mattes and visible areas compared with rational areas.
// tests/adversaries.h says how many there are.
#include "tests/adversaries.h"

#include <gtest/gtest.h>

#include <array>
#include <map>
#include <span>

#include "fathom/area/deep_pixels.h"
#include "fathom/area/visible_areas.h"
#include "fathom/failures/errors.h"
#include "tests/engines/expect_same_map.h"
#include "tests/engines/only_target.h"
#include "tests/inputs/adversarial_scenes.h"
#include "tests/inputs/floating_point_modes.h"
#include "tests/inputs/odd_normals.h"
#include "tests/oracle/against_oracle.h"
#include "tests/oracle/mpfr_rounding.h"

namespace fathom {
namespace {

using checks::Case;
using checks::Family;

/// What a scene is rendered with.
struct Combination {
  RenderOptions options;
  std::int64_t target;
  const checks::FloatingPointMode* mode;  // null: the standard one
};

Combination combination(std::mt19937_64& random) {
  const auto below = [&](std::size_t n) { return random() % n; };
  static const std::vector<std::int64_t> targets = checks::vector_targets();
  Combination c{{}, targets[below(targets.size())], nullptr};
  RenderOptions& options = c.options;
  switch (below(3)) {
    case 0:
      options.channels = checks::every_channel;
      break;
    case 1:
      options.channels = {Channel::Z};
      break;
    default:
      options.channels = {Channel::Z};
      for (const Channel channel : checks::every_channel) {
        if (channel != Channel::Z && below(2) == 0) options.channels.push_back(channel);
      }
  }
  options.cull = below(5) == 0 ? Cull::back : below(5) == 0 ? Cull::front : Cull::none;
  if (below(4) == 0) options.depth_encoding.type = DepthEncoding::Type::binary64;
  if (below(12) == 0) options.depth_encoding = {DepthEncoding::Type::scaled_unorm16, 1000};
  if (options.depth_encoding.type != DepthEncoding::Type::binary32) {
    std::erase(options.channels, Channel::Zlow);
  }
  constexpr std::array sources{NormalSource::file, NormalSource::vertex, NormalSource::place};
  options.normals = sources[below(3)];
  options.threads = static_cast<int>(1 + below(3));
  if (below(4) == 0) options.fast.hierarchy = false;
  c.mode = checks::any_mode(random);
  return c;
}

/// The map, or what is wrong with a depth that does not fit.
template <class Render>
std::variant<DepthMap, std::string> outcome(const Render& render) {
  try {
    return render();
  } catch (const OutputError& error) {
    return std::string(error.what());
  }
}

std::variant<DepthMap, std::string> fast_map(const Case& c, const Combination& how) {
  const checks::OnlyTarget only(how.target);
  const checks::InMode mode(how.mode);
  return outcome([&] { return render_fast(c.scene, c.camera, how.options).map; });
}

void expect_same(const Case& c, const Combination& how) {
  RenderOptions slow = how.options;
  slow.threads = 1;
  const auto truth = outcome([&] { return render_reference(c.scene, c.camera, slow).map; });
  const auto ours = fast_map(c, how);
  ASSERT_EQ(ours.index(), truth.index());
  if (truth.index() == 1) {
    EXPECT_EQ(std::get<1>(ours), std::get<1>(truth));
  } else {
    checks::expect_same_map(std::get<0>(ours), std::get<0>(truth));
  }
}

/// Returns how many pixels show a surface.
int expect_as_rays(const Case& c) {
  RenderOptions options;
  options.channels = checks::all_channels();
  options.threads = 1;
  return checks::expect_as_rays(render_reference(c.scene, c.camera, options).map, c.scene,
                                c.camera);
}

std::uint32_t matte_of(std::uint32_t triangle) {
  return triangle % 3;
}

/// The areas of visible surfaces in a pixel against the oracle's.
void expect_pixel_areas(std::map<std::uint32_t, oracle::Q> expected,
                        std::span<const DeepSample> samples, std::span<const MatteShare> shares) {
  std::map<std::uint32_t, oracle::Q> mattes;
  for (const auto& [number, area] : expected) mattes[matte_of(number)] += area;
  for (const DeepSample& sample : samples) {
    EXPECT_EQ(sample.area, checks::nearest_float(expected[sample.id])) << "triangle " << sample.id;
    expected.erase(sample.id);
  }
  for (const auto& [number, area] : expected) EXPECT_EQ(area, 0) << "triangle " << number;
  for (const MatteShare& share : shares) {
    EXPECT_EQ(share.coverage, checks::nearest_float(mattes[share.id])) << "matte " << share.id;
    mattes.erase(share.id);
  }
  for (const auto& [id, area] : mattes) EXPECT_EQ(area, 0) << "matte " << id;
}

/// Deep maps, mattes and visible areas.
void expect_areas(const Case& c, const Combination& how) {
  RenderOptions options;
  options.threads = how.options.threads;
  const TriangleSource triangles(c.scene);
  std::optional<checks::InMode> mode(std::in_place, how.mode);
  const DeepMap deep = area::visible_in_pixels(triangles, c.camera, options);
  const Mattes mattes = area::mattes_in_pixels(triangles, c.camera, options, matte_of);
  const VisibleAreas visible = visible_areas(triangles, c.camera, options);
  mode.reset();
  const oracle::Areas areas = checks::areas_at(c.scene, c.camera);
  std::vector<oracle::Q> sums(triangles.count());
  std::size_t sample = 0, share = 0;
  for (std::size_t pixel = 0; pixel < deep.counts.size(); ++pixel) {
    SCOPED_TRACE("pixel " + std::to_string(pixel));
    const std::size_t width = c.camera.width;
    const auto expected =
        areas.visible(static_cast<int>(pixel % width), static_cast<int>(pixel / width));
    for (const auto& [number, area] : expected) sums[number] += area;
    expect_pixel_areas(expected, std::span(deep.samples).subspan(sample, deep.counts[pixel]),
                       std::span(mattes.shares).subspan(share, mattes.counts[pixel]));
    sample += deep.counts[pixel];
    share += mattes.counts[pixel];
  }
  for (std::size_t t = 0; t < sums.size(); ++t) {
    EXPECT_EQ(visible.triangles[t].visible, oracle::quotient(oracle::binary64, sums[t].get_mpq_t()))
        << "triangle " << t;
  }
}

class Adversaries : public ::testing::TestWithParam<Family> {};

TEST_P(Adversaries, AreRenderedExactly) {
  int seen = 0;
  checks::for_each_adversary(900, [&](std::uint64_t seed) {
    Case c = checks::adversarial_case(GetParam(), seed);
    std::mt19937_64 random(seed ^ 0x9E3779B97F4A7C15);
    if (seed % 2 == 1) checks::add_odd_normals(c.scene.meshes[0], random);
    const Combination how = combination(random);
    expect_same(c, how);
    if (seed % 8 < 2) seen += expect_as_rays(c);
    if (seed % 32 == 0) expect_areas(c, how);
  });
  const std::uint64_t count = checks::number_of_adversaries();
  if (count >= 100) {
    EXPECT_GT(seen, static_cast<int>(count / 20));
  }
}

INSTANTIATE_TEST_SUITE_P(EachFamily, Adversaries, ::testing::ValuesIn(checks::all_families),
                         [](const auto& test) { return checks::name_of(test.param); });

}  // namespace
}  // namespace fathom
