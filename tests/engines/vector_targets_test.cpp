// The fast engine's map with every kind of vector instructions that this machine has, with any
// number of threads, and with each of its short cuts left out: always the reference engine's.
#include <gtest/gtest.h>

#include <set>
#include <string>

#include "tests/effort.h"
#include "tests/engines/expect_same_map.h"
#include "tests/engines/only_target.h"
#include "tests/inputs/random_scenes.h"
#include "tests/inputs/soup.h"

namespace fathom {
namespace {

using checks::expect_same;
using checks::OnlyTarget;
using checks::quick_channels;
using checks::vector_targets;

/// Scenes of several tiles with the reference engine's maps of them.
class Soups {
 public:
  Soups(std::uint64_t seed, int count, std::vector<Channel> channels)
      : channels_(std::move(channels)) {
    std::mt19937_64 random(seed);
    RenderOptions options;
    options.channels = channels_;
    for (int i = 0; i < count; ++i) {
      Camera camera = checks::camera_of(160, 140, 64);
      if (i % 4 == 3) camera.world_to_camera[2][3] = -3.25;  // the camera among the triangles
      if (i % 4 == 2) camera.near = 4;
      Scene scene = checks::soup(random, 60, i % 2 == 0);
      DepthMap truth = render_reference(scene, camera, options).map;
      cases_.push_back({std::move(scene), camera, std::move(truth)});
    }
  }

  /// Renders them by the fast engine, with the same channels.
  void expect_same(RenderOptions options) const {
    options.channels = channels_;
    for (std::size_t i = 0; i < cases_.size() && !::testing::Test::HasFailure(); ++i) {
      SCOPED_TRACE("soup " + std::to_string(i));
      checks::expect_same_map(render_fast(cases_[i].scene, cases_[i].camera, options).map,
                              cases_[i].truth);
    }
  }

 private:
  struct Case {
    Scene scene;
    Camera camera;
    DepthMap truth;
  };
  std::vector<Channel> channels_;
  std::vector<Case> cases_;
};

TEST(FastTargets, EveryKindOfVectorInstructions) {
  const Soups soups(99, checks::effort > 1 ? 4 : 12, quick_channels);
  const Soups rows(98, 4, {Channel::Z});  // Z alone is written by whole rows
  std::set<std::string> names;
  for (const std::int64_t target : vector_targets()) {
    const OnlyTarget only(target);
    names.insert(vector_instructions());
    SCOPED_TRACE(vector_instructions());
    RenderOptions options;
    options.channels = quick_channels;
    options.threads = 2;
    soups.expect_same(options);
    rows.expect_same(options);
    for (const auto kind : {checks::Kind::few_bits, checks::Kind::neighbours}) {
      checks::CaseMaker maker(31, kind);
      for (int i = 0; i < 400 / checks::effort && !HasFailure(); ++i) {
        const checks::Case c = maker.make();
        expect_same(c.scene, c.camera, options);
      }
    }
  }
  // The kinds were really chosen between, where the machine has several.
  if (vector_targets().size() > 2) {
    EXPECT_GT(names.size(), 1U);
  }
}

TEST(FastTargets, EveryKindOfVectorInstructionsUnderLenses) {
  const Lens lenses[] = {{LensModel::simple_radial, {-0.25}},
                         {LensModel::opencv, {-0.15, 0.02, 0.01, -0.02}},
                         {LensModel::full_opencv, {-0.1, 0.02, 0, 0, 0.003, 0.05, 0.01, 0.001}}};
  std::mt19937_64 random(102);
  RenderOptions options;
  options.channels = {Channel::Z, Channel::id, Channel::distance, Channel::valid};
  for (const Lens& lens : lenses) {
    SCOPED_TRACE(name_of(lens.model));
    Camera camera = checks::camera_of(160, 140, 64);
    camera.projection.lens = lens;
    const Scene scene = checks::soup(random, 60, false);
    const DepthMap truth = render_reference(scene, camera, options).map;
    for (const std::int64_t target : vector_targets()) {
      const OnlyTarget only(target);
      SCOPED_TRACE(vector_instructions());
      checks::expect_same_map(render_fast(scene, camera, options).map, truth);
    }
  }
}

TEST(FastTargets, OneToEightThreads) {
  const Soups soups(100, 4, quick_channels);
  for (int threads = 1; threads <= 8; ++threads) {
    SCOPED_TRACE(threads);
    RenderOptions options;
    options.threads = threads;
    soups.expect_same(options);
  }
}

TEST(FastTargets, WithoutShortCuts) {
  const Soups soups(101, 8, quick_channels);
  for (int switched_off = 0; switched_off < 4; ++switched_off) {
    SCOPED_TRACE(switched_off);
    RenderOptions options;
    options.fast.hierarchy = !(switched_off & 1);
    options.fast.early_rejection = !(switched_off & 2);
    soups.expect_same(options);
  }
}

}  // namespace
}  // namespace fathom
