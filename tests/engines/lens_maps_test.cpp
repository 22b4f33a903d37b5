// Maps of lenses against rays that are cast in rational numbers, every channel, over random scenes.
#include <gtest/gtest.h>

#include <algorithm>
#include <string>

#include "fathom/lens/preimages.h"
#include "fathom/render.h"
#include "tests/adversaries.h"
#include "tests/inputs/lens_scenes.h"
#include "tests/oracle/against_oracle.h"

namespace fathom {
namespace {

using checks::Kind;
using checks::LensCase;
using checks::LensCaseMaker;

struct Tally {
  int hits = 0, without_ray = 0;
  RenderStatistics statistics;
};

void check(const LensCase& c, Tally& tally) {
  const Camera& camera = c.view.camera;
  RenderOptions options;
  options.engine = Engine::reference;
  options.channels = checks::all_channels();
  options.channels.push_back(Channel::valid);
  options.threads = 1;
  const auto [map, statistics, doubtful] = render(c.view.scene, camera, options);
  add(tally.statistics, statistics);
  const double disc = lens::Preimages(camera.projection, *camera.projection.lens).disc();
  const oracle::RayCaster rays = checks::cast_at(c.view.scene, camera, c.numbers, disc);
  const auto& valid = *map.values<std::uint32_t>("valid");
  for (int y = 0; y < 5; ++y) {
    for (int x = 0; x < 6; ++x) {
      const bool has_ray = valid[static_cast<std::size_t>(6 * y + x)] == 1;
      tally.without_ray += !has_ray;
      ASSERT_EQ(rays.sees(x, y), has_ray) << x << ' ' << y << ' ' << disc;
      const auto hit = has_ray ? rays.cast(x, y) : std::nullopt;
      checks::expect_pixel(map, x, y, hit, c.view.scene);
      tally.hits += hit.has_value();
    }
  }
}

class LensMaps : public ::testing::TestWithParam<std::tuple<LensModel, Kind>> {};

TEST_P(LensMaps, EveryChannelOfEveryPixelAgreesWithRationalRays) {
  const auto [model, kind] = GetParam();
  LensCaseMaker maker(
      static_cast<std::uint64_t>(100 * static_cast<int>(model)) + static_cast<std::uint64_t>(kind),
      kind);
  Tally tally;
  const auto scenes =
      static_cast<int>(std::min<std::uint64_t>(checks::number_of_adversaries(30), 300));
  for (int i = 0; i < scenes && !HasFailure(); ++i) {
    SCOPED_TRACE("scene " + std::to_string(i) + " of this seed");
    check(maker.make(model), tally);
  }
  // Few samples of these cameras are in the circle of an orthographic fisheye.
  EXPECT_GT(tally.hits, model == LensModel::fisheye_orthographic ? scenes / 3 : scenes);
  if (model == LensModel::simple_radial || model == LensModel::opencv) {
    EXPECT_GT(tally.without_ray, 0);
  }
  if (checks::effort == 1) {
    EXPECT_GT(tally.statistics.edges.exact, 0U);
  }
}

std::string name_of_lens_case(const ::testing::TestParamInfo<std::tuple<LensModel, Kind>>& info) {
  const auto [model, kind] = info.param;
  return std::string(name_of(model)) + (kind == Kind::few_bits ? "_few_bits" : "_neighbours");
}

INSTANTIATE_TEST_SUITE_P(Adversaries, LensMaps,
                         ::testing::Combine(::testing::ValuesIn(checks::bending_models()),
                                            ::testing::Values(Kind::few_bits, Kind::neighbours)),
                         name_of_lens_case);

}  // namespace
}  // namespace fathom
