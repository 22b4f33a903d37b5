// Functions over a tile: their least and greatest values in pixels err by no more than their
// bounds, and by as much as stated shares of them.
#include "fathom/fast/coverage/tile_functions.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

#include "tests/effort.h"
#include "tests/fast/image_triangles.h"
#include "tests/numeric/error_shares.h"

namespace fathom {
namespace {

using namespace fast;
using namespace triangle;
using namespace checks;

/// A tile of the image.
PixelBox tile_at(Numbers& n, const Camera& camera) {
  const auto first = [&](std::uint32_t size) {
    return static_cast<std::uint32_t>(n.below(static_cast<int>(size / 64))) * 64;
  };
  const std::uint32_t column = first(camera.width), row = first(camera.height);
  return {column, column + 63, row, row + 63};
}

/// Compares the values of a function in a pixel with those at its corners, where an affine function
/// has its greatest and its least. exact(u, v): a Ratio.
template <class Exact>
void add_pixel(const UncertainHalfPlane& f, Numbers& n, const PixelBox& tile, const Exact& exact,
               Share& share) {
  const int column = n.below(64), row = n.below(64);
  std::array<Ratio, 4> values;
  for (int k = 0; k < 4; ++k) {
    values[static_cast<std::size_t>(k)] =
        exact(tile.first_column + 1.0 * (column + k % 2), tile.first_row + 1.0 * (row + (k >> 1)));
  }
  const auto [least, greatest] = std::minmax_element(values.begin(), values.end());
  const ValuesInPixel computed = values_in_pixel(f, column, row);
  share.add(computed.least, *least, f.error);
  share.add(computed.greatest, *greatest, f.error);
}

void add_edges(const ImageTriangle& t, const Camera& camera, Numbers& n, Share& share) {
  for (const ImageVertex& vertex : t.vertices) {
    if (!vertex.is_usable()) return;
  }
  if (t.exact.orientation == Sign::zero) return;
  const bool turned = t.exact.orientation == Sign::negative;
  const std::array<std::size_t, 3> order{0, turned ? 2U : 1U, turned ? 1U : 2U};
  const PixelBox tile = tile_at(n, camera);
  const auto edges =
      edges_over_tile({t.vertices[order[0]], t.vertices[order[1]], t.vertices[order[2]]}, tile);
  std::array<Dyadic, 3> W;
  for (std::size_t i = 0; i < 3; ++i) W[i] = to_image(camera.projection, t.exact.camera[i]).W;
  for (std::size_t i = 0; i < 3; ++i) {
    const std::size_t corner = order[i];
    const Dyadic scale = W[(corner + 1) % 3] * W[(corner + 2) % 3];
    const auto exact = [&](double u, double v) {
      return Ratio(t.exact.edges[corner].at(u, v), scale);
    };
    add_pixel(edges[i], n, tile, exact, share);
  }
}

class FunctionShares : public ::testing::TestWithParam<bool> {};

TEST_P(FunctionShares, OfEdgesOverATile) {
  const Camera camera = plain_camera(GetParam()), bare = bare_camera(GetParam());
  Numbers n(36);
  Share ordinary, worst;
  for (int i = 0; i < 2000 / effort; ++i) {
    add_edges(project_both(triangle_from(n), camera), camera, n, ordinary);
    add_edges(worst_triangle(n, bare), bare, n, worst);
  }
  EXPECT_GT(ordinary.count(), 8000 / effort);
  expect_share(ordinary.publish("shape_rounding"), 0.03);
  expect_share(worst.publish("worst"), 0.3);
}

/// The power of two by which exact_setup() scales a function: that between a coefficient and its
/// exact value.
long scale_of(double a, double b, const ExactVector3& exact) {
  const bool use_a = !exact[0].is_zero();
  return std::ilogb(use_a ? a : b) -
         std::ilogb(round_to_binary64(Ratio(use_a ? exact[0] : exact[1])));
}

TEST_P(FunctionShares, OfExactSetupsOverATile) {
  const bool perspective = GetParam();
  Camera camera = plain_camera(perspective);
  camera.near = 2.9;
  camera.far = 3.7;
  const DepthRange range = depth_range(camera);
  Numbers n(37);
  Share edges, ends;
  for (int i = 0; i < 2000 / effort; ++i) {
    auto corners = triangle_from(n);
    if (n.below(2)) corners[0].z -= 5;  // reaches behind the camera
    const ProjectedTriangle t = project_both(corners, camera).exact;
    if (t.orientation == Sign::zero) continue;
    const PixelBox tile = tile_at(n, camera);
    const TriangleSetup setup = exact_setup(t, perspective, tile);
    const auto [functions, count] = functions_over_tile(setup, range);
    ASSERT_EQ(count, 5U);
    for (std::size_t k = 0; k < 3; ++k) {
      const long scale = scale_of(setup.edge_a[k], setup.edge_b[k], t.edges[k].coefficients());
      const auto exact = [&](double u, double v) {
        return Ratio(t.edges[k].at(u, v).scaled(scale));
      };
      add_pixel(functions[k], n, tile, exact, edges);
    }
    // q is 1/D or −D, an affine function of the place.
    const auto q = [&](double u, double v) {
      return perspective ? Ratio(t.weight.at(u, v), t.depth_numerator.at(u, v))
                         : Ratio(-t.depth_numerator.at(u, v), t.weight.at(u, v));
    };
    const auto end = [&](double D) { return perspective ? Ratio(1.0, D) : Ratio(-D); };
    add_pixel(
        functions[3], n, tile, [&](double u, double v) { return end(camera.near) - q(u, v); },
        ends);
    add_pixel(
        functions[4], n, tile, [&](double u, double v) { return q(u, v) - end(camera.far); }, ends);
  }
  EXPECT_GT(ends.count(), 6000 / effort);
  expect_share(edges.publish("shape_share"), 0.1);
  expect_share(ends.publish("ends_of_range"), 0.12);
}

INSTANTIATE_TEST_SUITE_P(Fast, FunctionShares, ::testing::Bool());

/// Ends of the range of any exponent: functions are finite, and where they are certain of a sign at
/// a point, it is that of q less the end.
TEST(TileFunctions, AreFiniteForEveryRangeOfDepths) {
  Numbers n(39);
  const auto any_limit = [&] {
    return std::ldexp(1 + n.below(1024) / 1024.0, n.below(2098) - 1074);
  };
  int certain = 0;
  for (int i = 0; i < 20000 / effort; ++i) {
    const bool perspective = i % 4 != 0;
    Camera camera = plain_camera(perspective);
    camera.near = any_limit();
    camera.far =
        i % 2 == 0 ? any_limit() : std::ldexp(1 + n.below(1024) / 1024.0, -1024 - n.below(50));
    if (camera.near > camera.far) std::swap(camera.near, camera.far);
    SCOPED_TRACE(::testing::Message() << std::hexfloat << camera.near << " to " << camera.far);
    auto corners = triangle_from(n);
    if (n.below(2)) corners[0].z -= 5;  // reaches behind the camera
    const ProjectedTriangle t = project_both(corners, camera).exact;
    if (t.orientation == Sign::zero) continue;
    const PixelBox tile = tile_at(n, camera);
    const auto [functions, count] =
        functions_over_tile(exact_setup(t, perspective, tile), depth_range(camera));
    ASSERT_EQ(count, 5U);
    const double x = n.below(64), y = n.below(64);
    const double u = tile.first_column + x, v = tile.first_row + y;
    const Ratio q = perspective ? Ratio(t.weight.at(u, v), t.depth_numerator.at(u, v))
                                : Ratio(-t.depth_numerator.at(u, v), t.weight.at(u, v));
    const auto end = [&](double D) { return perspective ? Ratio(1.0, D) : Ratio(-D); };
    const std::array<Ratio, 2> exact{end(camera.near) - q, q - end(camera.far)};
    for (std::size_t k = 0; k < 2; ++k) {
      const auto& [a, b, c, error] = functions[3 + k];
      ASSERT_TRUE(std::isfinite(a) && std::isfinite(b) && std::isfinite(c) && std::isfinite(error));
      const double f = c + a * x + b * y;
      if (!(std::abs(f) > error)) continue;
      ++certain;
      ASSERT_EQ(f > 0 ? Sign::positive : Sign::negative, exact[k].sign());
    }
  }
  EXPECT_GT(certain, 30000 / effort);
}

/// A pixel beside the corner of a triangle, which none of its sides separates from it, and pixels
/// of random triangles against their clipped area.
TEST(CertainlyMissesPixel, IsSaidOfPixelsWithoutAnArea) {
  std::mt19937_64 random(38);
  std::uniform_real_distribution<double> place(-3, 4);
  int missed = 0, empty = 0;
  for (int i = 0; i < 20000 / effort; ++i) {
    SCOPED_TRACE(i);
    std::array<SquarePoint, 3> p{};
    for (SquarePoint& corner : p) corner = {place(random), place(random)};
    if ((p[1].x - p[0].x) * (p[2].y - p[0].y) < (p[1].y - p[0].y) * (p[2].x - p[0].x)) {
      std::swap(p[1], p[2]);
    }
    std::array<UncertainHalfPlane, 3> sides{};
    ClippedSquare square;
    for (std::size_t k = 0; k < 3; ++k) {
      const SquarePoint &P = p[k], &Q = p[(k + 1) % 3];
      sides[k] = {P.y - Q.y, Q.x - P.x, P.x * Q.y - P.y * Q.x, 0x1p-40};
      square.clip(sides[k]);
    }
    const bool is_missed = certainly_misses_pixel(sides, 0, 0);
    if (is_missed) {
      ASSERT_TRUE(square.corners().empty());
    }
    missed += is_missed ? 1 : 0;
    empty += square.corners().empty() ? 1 : 0;
  }
  EXPECT_GT(empty, 5000 / effort);
  EXPECT_GT(missed, empty / 3);
  // Below the pixel, wide and low; between the corner (½, 1¼) and the pixel there is no side.
  const std::array<UncertainHalfPlane, 3> beside{
      {{-1, 1, -0.75, 1e-9}, {1, 1, -1.75, 1e-9}, {0, -1, 3, 1e-9}}};
  EXPECT_TRUE(certainly_misses_pixel(beside, 0, 0));
  EXPECT_FALSE(certainly_misses_pixel(beside, 0, 1));
  for (const UncertainHalfPlane& side : beside) EXPECT_GT(values_in_pixel(side, 0, 0).greatest, 0);
}

TEST(CertainSign, OnPaper) {
  // x + y − 7 over [1, 3] × [2, 4]: 0 at the corner where it is greatest.
  EXPECT_FALSE(is_certainly_negative(1, 1, -7, 0, {1, 3, 2, 4}));
  EXPECT_TRUE(is_certainly_negative(1, 1, -7.25, 0, {1, 3, 2, 4}));
  EXPECT_TRUE(is_certainly_negative(1, 1, -7.25, 0.125, {1, 3, 2, 4}));
  EXPECT_FALSE(is_certainly_negative(1, 1, -7.25, 0.25, {1, 3, 2, 4}));
  // Greatest at the left, at the top, anywhere.
  EXPECT_TRUE(is_certainly_negative(-1, 1, -3.5, 0, {1, 3, 2, 4}));
  EXPECT_TRUE(is_certainly_negative(1, -1, -1.5, 0, {1, 3, 2, 4}));
  EXPECT_TRUE(is_certainly_negative(0, 0, -1, 0, {1, 3, 2, 4}));
  EXPECT_FALSE(is_certainly_negative(0, 0, 0, 0, {1, 3, 2, 4}));
  EXPECT_FALSE(is_certainly_negative(0, 0, -1, INFINITY, {1, 3, 2, 4}));
}

/// Of small integers, which nothing rounds: as at the four corners.
TEST(CertainSign, IsThatOfAllCorners) {
  Numbers n(67);
  int negative = 0;
  for (int i = 0; i < 2000; ++i) {
    const double a = n.below(9) - 4, b = n.below(9) - 4, c = n.below(80) - 60, error = n.below(3);
    const double left = n.below(9) - 4, top = n.below(9) - 4;
    const double right = left + n.below(6), bottom = top + n.below(6);
    double greatest = -INFINITY;
    for (const double x : {left, right}) {
      for (const double y : {top, bottom}) greatest = std::max(greatest, c + a * x + b * y);
    }
    EXPECT_EQ(is_certainly_negative(a, b, c, error, {left, right, top, bottom}), greatest < -error);
    negative += greatest < -error;
  }
  EXPECT_GT(negative, 500);
  EXPECT_LT(negative, 1500);
}

}  // namespace
}  // namespace fathom
