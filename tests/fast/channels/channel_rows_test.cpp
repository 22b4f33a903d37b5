// Rows of rounded values: where a value is settled, every number that the bound of q allows rounds
// to it; and hardly ever is one left open without need.
#include "fathom/fast/channels/channel_rows.h"

#include <gtest/gtest.h>

#include <bit>
#include <cmath>
#include <random>

#include "fathom/numeric/rounding.h"
#include "tests/inputs/scene_building.h"

namespace fathom {
namespace {

using namespace fast;
using namespace triangle;

/// A row of q with errors, and the exact ends of the intervals of D.
struct Row {
  std::array<double, TileShape::size> q;
  std::array<std::uint64_t, TileShape::size> tags;

  /// D near middles of two numbers that are 2^−23·size apart, errors from 2⁻⁴⁵ to 2⁻²⁵.
  Row(std::mt19937_64& random, bool perspective) {
    const auto unit = [&] { return std::ldexp(static_cast<double>(random() >> 11), -53); };
    for (std::size_t k = 0; k < TileShape::size; ++k) {
      const double base = static_cast<float>(1.05 + 0.9 * unit());
      const double spread = std::ldexp(1, -25 - static_cast<int>(random() % 20));
      const double D = base + 0x1p-24 + spread * 3 * (2 * unit() - 1);
      q[k] = perspective ? 1 / D : -D;
      tags[k] = std::bit_cast<std::uint64_t>(perspective ? spread / (D * D) : spread);
    }
  }
  [[nodiscard]] SurfaceRow lanes(double v) const {
    return {q.data(), tags.data(), nullptr, 0.5, v};
  }
  /// The end of D's interval for an error `factor` times the bound, in units of the bound.
  [[nodiscard]] Ratio depth(std::size_t k, double factor, bool perspective) const {
    const Dyadic moved = Dyadic(q[k]) - Dyadic(factor) * Dyadic(std::bit_cast<double>(tags[k]));
    return perspective ? Ratio(1.0, moved) : Ratio(-moved);
  }
};

struct Counts {
  int settled = 0, open = 0;
};

/// `round(D)`: what the exact depth D is rounded to. A value is left open only if an interval
/// `loose` times as wide is not settled either.
template <class T, class Round>
void expect_right(const RoundedValues<T>& ours, const Row& row, bool perspective,
                  const Round& round, Counts& counts, double loose = 2) {
  for (std::size_t k = 0; k < TileShape::size; ++k) {
    const auto at = [&](double factor) { return round(row.depth(k, factor, perspective), k); };
    if ((ours.settled >> k & 1) != 0) {
      ++counts.settled;
      EXPECT_EQ(at(-1), ours.values[k]) << std::hexfloat << row.q[k];
      EXPECT_EQ(at(1), ours.values[k]) << std::hexfloat << row.q[k];
    } else {
      ++counts.open;
      EXPECT_NE(at(-loose), at(loose)) << std::hexfloat << row.q[k];
    }
  }
}

void expect_both(const Counts& counts) {
  EXPECT_GT(counts.settled, 1000);
  EXPECT_GT(counts.open, 1000);
}

/// The camera's numbers are powers of two: rays are exact, and all errors those of q.
Camera plain_camera(bool perspective) {
  Camera camera = checks::camera_of(64, 64, 64);
  camera.projection.cx = camera.projection.cy = 96;  // no ray has a coordinate of 0
  camera.world_to_camera[0][3] = -2;
  if (!perspective) camera.projection.model = ProjectionModel::orthographic;
  return camera;
}

class ChannelRows : public ::testing::TestWithParam<bool> {};

TEST_P(ChannelRows, DepthsAndCodes) {
  const bool perspective = GetParam();
  std::mt19937_64 random(51);
  const Scene scene = checks::scene_of({}, {});
  const SceneRays rays(scene, plain_camera(perspective));
  Counts depths, codes;
  for (int i = 0; i < 100; ++i) {
    const Row row(random, perspective);
    RoundedValues<float> binary32;
    round_depths(row.lanes(7.5), rays, false, binary32);
    expect_right(
        binary32, row, perspective,
        [](const Ratio& D, std::size_t) { return round_to_binary32(D); }, depths);
    // Scaled so that the same D lie near the middle of two codes: 2²³·D, less what all share.
    RoundedValues<std::uint16_t> rounded;
    const double scale = 0x1p15;
    Row coarse = row;
    for (std::size_t k = 0; k < TileShape::size; ++k) {
      const double code = 32770 + static_cast<double>(random() % 20000) + 0.5;
      const double D = code / scale * (1 + 0x1p-30 * static_cast<double>(random() % 64));
      coarse.q[k] = perspective ? 1 / D : -D;
      const double error = std::ldexp(1, -18 - static_cast<int>(random() % 14));
      coarse.tags[k] = std::bit_cast<std::uint64_t>(perspective ? error / (D * D) : error);
    }
    round_to_codes(coarse.lanes(7.5), rays, false, {scale}, rounded);
    expect_right(
        rounded, coarse, perspective,
        [&](const Ratio& D, std::size_t) {
          return round_to_integer(D * Ratio(Dyadic(scale)), 65535).value_or(0);
        },
        codes);
  }
  expect_both(depths);
  expect_both(codes);
}

TEST_P(ChannelRows, Positions) {
  const bool perspective = GetParam();
  std::mt19937_64 random(52);
  const Scene scene = checks::scene_of({}, {});
  const SceneRays rays(scene, plain_camera(perspective));
  const Rays& world = rays.world().rays;
  const RaySizes sizes(world, {perspective, 64, 64});
  Counts counts;
  for (int i = 0; i < 60; ++i) {
    const Row row(random, perspective);
    std::array<RoundedValues<float>, 3> rounded;
    round_positions(row.lanes(7.5), world, sizes, perspective, rounded);
    for (std::size_t c = 0; c < 3; ++c) {
      const auto point = [&](const Ratio& D, std::size_t k) {
        const auto& [m0, m1, m2, O] = world.columns;
        const Dyadic along = Dyadic(m0[c].hi) * Dyadic(static_cast<double>(k) + 0.5) +
                             Dyadic(m1[c].hi) * Dyadic(7.5);
        const Dyadic origin = Dyadic(O[c].hi) + (perspective ? Dyadic() : along);
        const Dyadic d = Dyadic(m2[c].hi) + (perspective ? along : Dyadic());
        return round_to_binary32(Ratio(origin) + D * Ratio(d));
      };
      // The bound takes the greatest ray of the image for each: here up to 5 times this one.
      expect_right(rounded[c], row, perspective, point, counts, 16);
    }
  }
  expect_both(counts);
}

INSTANTIATE_TEST_SUITE_P(Fast, ChannelRows, ::testing::Bool());

/// D·√(x² + y² + 1), by the square.
TEST(Fast, RowsOfRayDistances) {
  std::mt19937_64 random(53);
  const Scene scene = checks::scene_of({}, {});
  const SceneRays rays(scene, plain_camera(true));
  Counts counts;
  for (int i = 0; i < 100; ++i) {
    Row row(random, true);
    const auto squared_length = [](std::size_t k) {
      const double x = (static_cast<double>(k) + 0.5 - 96) / 64, y = (7.5 - 96) / 64;
      return Dyadic(x) * Dyadic(x) + Dyadic(y) * Dyadic(y) + Dyadic(1.0);
    };
    // Move D so that the distance is where D was.
    for (std::size_t k = 0; k < TileShape::size; ++k) {
      const double length = std::sqrt(round_to_binary64(Ratio(squared_length(k))));
      row.q[k] *= length;
      row.tags[k] = std::bit_cast<std::uint64_t>(std::bit_cast<double>(row.tags[k]) * length);
    }
    RoundedValues<float> rounded;
    round_depths(row.lanes(7.5), rays, true, rounded);
    expect_right(
        rounded, row, true,
        [&](const Ratio& D, std::size_t k) {
          return round_sqrt_to_binary32(D * D * Ratio(squared_length(k)));
        },
        counts);
  }
  expect_both(counts);
}

/// An error that is infinite or NaN settles nothing.
TEST(Fast, RowsOfUnknownDepths) {
  for (const bool perspective : {false, true}) {
    const Scene scene = checks::scene_of({}, {});
    const SceneRays rays(scene, plain_camera(perspective));
    std::mt19937_64 random(54);
    Row row(random, perspective);
    for (std::size_t k = 0; k < TileShape::size; ++k) {
      row.tags[k] = std::bit_cast<std::uint64_t>(k % 2 ? std::nan("")
                                                       : std::numeric_limits<double>::infinity());
    }
    RoundedValues<float> depths;
    round_depths(row.lanes(7.5), rays, true, depths);
    EXPECT_EQ(depths.settled, 0U);
    RoundedValues<std::uint16_t> codes;
    round_to_codes(row.lanes(7.5), rays, false, {1000}, codes);
    EXPECT_EQ(codes.settled, 0U);
    std::array<RoundedValues<float>, 3> positions;
    const Rays& world = rays.world().rays;
    round_positions(row.lanes(7.5), world, RaySizes(world, {perspective, 64, 64}), perspective,
                    positions);
    // Where the ray has no component along an axis the depth does not count.
    EXPECT_EQ(positions[2].settled, 0U);
  }
}

}  // namespace
}  // namespace fathom
