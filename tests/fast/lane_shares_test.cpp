// Bounds of what several lanes compute at once, from both sides, for the vector instructions that
// every processor has: the doubled area, boxes of samples, intervals of D.
#include <gtest/gtest.h>

#include "fathom/fast/channels/depth_interval-inl.h"
#include "fathom/fast/setup/setup-inl.h"
#include "tests/effort.h"
#include "tests/fast/image_triangles.h"
#include "tests/numeric/error_shares.h"

namespace fathom {
namespace {

using namespace fast;
using namespace checks;
namespace lanes = fast::HWY_NAMESPACE;

double first(lanes::V v) {
  return hwy::HWY_NAMESPACE::GetLane(v);
}

/// The same triangle in every lane.
lanes::Corners in_lanes(const ImageTriangle& t) {
  std::array<CornerIndices, SetupBatch::most> same;
  same.fill({0, 1, 2});
  return lanes::load_corners(t.vertices.data(), same.data());
}

Ratio exact_doubled_area(const ImageTriangle& t, const Camera& camera) {
  std::array<Ratio, 3> u, v;
  for (std::size_t i = 0; i < 3; ++i) {
    const HomogeneousImagePoint image = to_image(camera.projection, t.exact.camera[i]);
    u[i] = {image.U, image.W};
    v[i] = {image.V, image.W};
  }
  return (u[1] - u[0]) * (v[2] - v[0]) - (v[1] - v[0]) * (u[2] - u[0]);
}

void add_area(const ImageTriangle& t, const Camera& camera, Share& share) {
  const lanes::Corners corners = in_lanes(t);
  if (!(first(corners.position_error) < 1)) return;  // not usable
  const lanes::Sides sides = lanes::sides_of(corners);
  share.add(first(sides.doubled_area()), exact_doubled_area(t, camera),
            first(lanes::area_error(sides, corners.position_error)));
}

class CornerShares : public ::testing::TestWithParam<bool> {};

TEST_P(CornerShares, OfDoubledAreas) {
  const Camera camera = plain_camera(GetParam()), bare = bare_camera(GetParam());
  Numbers n(25);
  Share ordinary, worst;
  for (int i = 0; i < 4000 / effort; ++i) {
    add_area(project_both(triangle_from(n), camera), camera, ordinary);
    add_area(worst_triangle(n, bare), bare, worst);
  }
  EXPECT_GT(ordinary.count(), 3000 / effort);
  expect_share(ordinary.publish("area"), 0.04);
  expect_share(worst.publish("area_worst"), 0.7);
}

INSTANTIATE_TEST_SUITE_P(Fast, CornerShares, ::testing::Bool());

/// Corners without errors, far from each other: what is left of the bound are roundings.
TEST(LaneShares, OfTheRoundingsOfDoubledAreas) {
  Numbers n(26);
  Share share;
  for (int i = 0; i < 20000 / effort; ++i) {
    ImageTriangle t;
    std::array<Dyadic, 3> u, v;
    for (std::size_t k = 0; k < 3; ++k) {
      t.vertices[k] = {n.unit(), n.unit(), 1, upper_half(0x1p-100) << 32};
      u[k] = t.vertices[k].u;
      v[k] = t.vertices[k].v;
    }
    const lanes::Corners corners = in_lanes(t);
    const lanes::Sides sides = lanes::sides_of(corners);
    share.add(first(sides.doubled_area()),
              (u[1] - u[0]) * (v[2] - v[0]) - (v[1] - v[0]) * (u[2] - u[0]),
              first(lanes::area_error(sides, corners.position_error)));
  }
  expect_share(share.publish("area_rounding"), 0.15);
}

/// How much is needed of the margin beyond the corners' error: a share above 1 would say that a
/// place lies on the wrong side of the exact one, or twice as far out as it should.
TEST(LaneShares, OfTheMarginsOfBoxes) {
  Numbers n(27);
  Share samples, pixels;
  for (int i = 0; i < 20000 / effort; ++i) {
    const double x = std::ldexp(n.unit(), n.below(36) - 5);
    const double e = n.below(2) * std::ldexp(n.unit() + 1, -13 - n.below(30));
    const Dyadic room = (abs(Dyadic(x)) + Dyadic(1)) * Dyadic(setup_bounds::box_margin);
    const lanes::V place = lanes::constant(x), error = lanes::constant(e);
    const Dyadic down = Dyadic(x) - Dyadic(e) - room, up = Dyadic(x) + Dyadic(e) + room;
    samples.add(first(lanes::least_place(place, error)), down - Dyadic(0.5), room);
    samples.add(first(lanes::greatest_place(place, error)), up - Dyadic(0.5), room);
    pixels.add(first(lanes::moved_down(place, error)), down, room);
    pixels.add(first(lanes::moved_up(place, error)), up, room);
  }
  expect_share(samples.publish("box_margin"), 0.1);
  expect_share(pixels.publish("box_margin_areas"), 0.07);
}

/// From none to the greatest that an interval is made for.
double error_of_q(Numbers& n, double greatest) {
  if (n.below(4) == 0) return 0;
  if (n.below(4) == 0) return greatest;
  return std::ldexp(greatest * (1 + n.unit()) / 2, -n.below(54));
}

struct DepthShares {
  /// Of half the interval, with the exact q at an end of what its error allows; and of the room at
  /// an end beyond what that error does, which is for roundings.
  Share interval, room;

  /// `outside`: where an end would lie without roundings.
  void add(const lanes::DepthInterval& x, const std::array<Ratio, 2>& exact,
           const std::array<Ratio, 2>& outside) {
    const Interval D{first(x.least), first(x.greatest)};
    for (std::size_t k = 0; k < 2; ++k) {
      interval.add(D, exact[k]);
      room.add(k == 0 ? D.lower : D.upper, outside[k],
               abs(Dyadic(round_to_binary64(outside[k] - exact[k]))));
    }
  }
};

TEST(LaneShares, OfIntervalsOfDepth) {
  const Ratio above(Dyadic(1 + resolve_bounds::end_room)), spread(resolve_bounds::spread_room);
  const Ratio below(Dyadic(1 - resolve_bounds::end_room));
  Numbers n(28);
  DepthShares shares;
  for (int i = 0; i < 10000 / effort; ++i) {
    const double q = std::ldexp(1.5 + n.unit() / 2, n.below(40) - 20);
    const double e = error_of_q(n, q * resolve_bounds::greatest_relative_error);
    const Ratio z(1.0, q), moved = z * z * Ratio(e) * spread;
    shares.add(lanes::perspective_depth(lanes::constant(q), lanes::constant(e)),
               {Ratio(1.0, Dyadic(q) + Dyadic(e)), Ratio(1.0, Dyadic(q) - Dyadic(e))},
               {z * below - moved, z * above + moved});
  }
  expect_share(shares.interval.publish("interval"), 0.99999);
  expect_share(shares.room.publish("end_room"), 0.18);
}

TEST(LaneShares, OfOrthographicIntervalsOfDepth) {
  const Dyadic above(1 + resolve_bounds::end_room), below(1 - resolve_bounds::end_room);
  Numbers n(29);
  DepthShares shares;
  for (int i = 0; i < 10000 / effort; ++i) {
    const double D = std::ldexp(1.5 + n.unit() / 2, n.below(40) - 20);
    const double e = error_of_q(n, D * (1 - 0x1p-20));
    const Dyadic least = Dyadic(D) - Dyadic(e), greatest = Dyadic(D) + Dyadic(e);
    shares.add(lanes::orthographic_depth(lanes::constant(-D), lanes::constant(e)),
               {least, greatest}, {least * below, greatest * above});
  }
  expect_share(shares.interval.publish("interval"), 0.99);
  expect_share(shares.room.publish("end_room"), 0.14);
}

}  // namespace
}  // namespace fathom
