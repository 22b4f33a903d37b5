// Two nearly coplanar surfaces of the study `z-fighting`.

#include "apps/study/z_fighting/coplanar_pair.h"

#include <gtest/gtest.h>

#include <cmath>

namespace fathom::studies {
namespace {

Ratio ratio(double p, double q) {
  return {Dyadic(p), Dyadic(q)};
}

TEST(CoplanarPair, DepthsAreReciprocalsOfAnAffineFunction) {
  const CoplanarPair pair{10, 0.5, 1};
  EXPECT_EQ(front_depth(pair, ratio(0, 1)), ratio(20, 3));
  EXPECT_EQ(front_depth(pair, ratio(1, 2)), ratio(10, 1));
  EXPECT_EQ(front_depth(pair, ratio(1, 1)), ratio(20, 1));
  EXPECT_EQ(back_depth(pair, ratio(1, 2)), ratio(21, 2));
  EXPECT_EQ(back_depth(pair, ratio(1, 1)), ratio(21, 1));
}

/// Facing the camera every sample has the same depth, so the answer is all or nothing, and turns
/// where a code does: linear over [1, 65536] in unorm16 rounds depths to integers.
TEST(CoplanarPair, FacingSurfacesFightInOneBin) {
  const DepthFormat format{Mapping::linear, Storage::unorm16, 1, 65536};
  EXPECT_EQ(fighting_share(format, {100, 0.25, 0}, 8), 1);
  EXPECT_EQ(fighting_share(format, {100, 0.75, 0}, 8), 0);
  EXPECT_EQ(fighting_share(format, {100.25, 0.3, 0}, 8), 0);
  EXPECT_EQ(least_safe_separation(format, {100.25, 1, 0}, 8), 0.25);
  EXPECT_EQ(predicted_safe_separation(format, {100.25, 1, 0}), 1);
}

TEST(CoplanarPair, TheSafeSeparationIsTheLeastOne) {
  for (const Mapping mapping : all_mappings) {
    for (const Storage storage : {Storage::unorm16, Storage::unorm24, Storage::float32}) {
      const DepthFormat format{mapping, storage, 0.1, 100};
      for (const double distance : {0.5, 3.0, 20.0}) {
        const double safe = least_safe_separation(format, {distance, 1, 0.5}, 64);
        // Rounded a few times to binary64: by less than a part in 10⁹.
        EXPECT_EQ(fighting_share(format, {distance, safe * (1 + 1e-9), 0.5}, 64), 0);
        EXPECT_GT(fighting_share(format, {distance, safe * (1 - 1e-9), 0.5}, 64), 0);
      }
    }
  }
}

/// The exercise of the sources: 0.0001 apart along the view, near 0.1, far 100.
TEST(CoplanarPair, ATenthOfAMillimetre) {
  const auto share = [](Storage storage, double distance) {
    return fighting_share({Mapping::standard, storage, 0.1, 100}, {distance, 0.0001, 0.5}, 64);
  };
  // A step of unorm16 is D²·1.5e-4: below 0.0001 up to about 0.8, ten times it from about 2.6.
  EXPECT_EQ(share(Storage::unorm16, 0.4), 0);
  EXPECT_GT(share(Storage::unorm16, 5), 0.9);
  // unorm32: 2.3e-9·D². Never.
  EXPECT_EQ(share(Storage::unorm32, 50), 0);
  // standard float32: 6e-7·D².
  EXPECT_EQ(share(Storage::float32, 5), 0);
  EXPECT_GT(share(Storage::float32, 50), 0.8);
}

TEST(CoplanarPair, ThePipelineWithoutRoundingIsTheIdealModel) {
  const View view = view_from({0, 0, 0}, {0, 0, 1});
  for (const Storage storage : {Storage::unorm16, Storage::float32}) {
    const PipelineModel model{{Mapping::standard, storage, 0.125, 128},
                              view.row,
                              false,
                              {false, false, false, false, true}};
    // Depths of both ends of both surfaces are binary32 numbers: 2, 6 and 2.5, 7.5.
    const CoplanarPair pair{3, 0.75, 1};
    EXPECT_EQ(fighting_share_in_pipeline(model, view, pair, 64),
              fighting_share(model.format, pair, 64));
    const CoplanarPair close{3, std::ldexp(3.0, -17), 1};
    EXPECT_EQ(fighting_share_in_pipeline(model, view, close, 64),
              fighting_share(model.format, close, 64));
  }
}

/// Facing the camera a surface has one depth: all samples are right, or all are wrong. Tilted, the
/// far side decides what is safe: it lies at d/(1 − τ/2), where bins of standard are wider by the
/// square of that, and the pair's separation is 1/(1 − τ/2) times that in the middle; so what is
/// safe grows like 1/(1 − τ/2), by 3.34 from 5 to 55 degrees. The samples, which are always the
/// same, reach at least half of what is needed at worst, so the quotient is off by 2 at most.
TEST(FightsByAngle, FacingIsAllOrNothingAndTiltNeedsMore) {
  const std::vector<FightByAngle> fights = fights_by_angle({0.1, 100, 1e-4, 64, {1.26, 10}});
  ASSERT_EQ(fights.size(), 4U * 2 * 12);
  for (std::size_t i = 0; i < fights.size(); i += 12) {
    EXPECT_EQ(fights[i].degrees, 0);
    EXPECT_TRUE(fights[i].ideal == 0 || fights[i].ideal == 1);
    EXPECT_EQ(fights[i + 1].degrees, 5);
    EXPECT_EQ(fights[i + 11].degrees, 55);
    if (fights[i].format.mapping != Mapping::standard) continue;
    EXPECT_GT(fights[i + 11].safe / fights[i + 1].safe, 1.67);
    EXPECT_LT(fights[i + 11].safe / fights[i + 1].safe, 6.69);
  }
}

/// 45 degrees are the tilt 1. The tangent is rounded, by less than 2^-52, which moves depths up to
/// 20 by less than 10^-14, and what each needs by a few times that.
TEST(FightsByAngle, AnglesAreTilts) {
  const std::vector<FightByAngle> fights = fights_by_angle({0.1, 100, 1e-4, 64, {1.26, 10}});
  for (const FightByAngle& f : fights) {
    if (f.degrees != 45) continue;
    const CoplanarPair pair{f.distance, 1e-4, 1};
    EXPECT_EQ(f.ideal, fighting_share(f.format, pair, 64));
    EXPECT_NEAR(f.safe, least_safe_separation(f.format, pair, 64), 1e-12);
  }
}

}  // namespace
}  // namespace fathom::studies
