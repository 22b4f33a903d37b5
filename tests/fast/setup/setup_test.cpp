// The bounds of set-ups from both sides: never violated against exact values, and not looser than a
// stated factor.
#include "fathom/fast/setup/setup.h"

#include <gtest/gtest.h>

#include <cmath>

#include "fathom/triangle/projected_triangle.h"
#include "tests/effort.h"
#include "tests/fast/image_triangles.h"
#include "tests/numeric/error_shares.h"

namespace fathom {
namespace {

using namespace fast;
using namespace triangle;
using namespace checks;

double edge_at(const TriangleSetup& s, std::size_t i, double x, double y) {
  return (s.edge_c[i] + s.edge_b[i] * y) + s.edge_a[i] * x;
}
double q_at(const TriangleSetup& s, double x, double y) {
  return (s.q_c + s.q_b * y) + s.q_a * x;
}

Ratio exact_q(const ProjectedTriangle& t, const ImagePoint& s, bool perspective) {
  const Ratio D = depth_at(t, s);
  return perspective ? Ratio(D.denominator, D.numerator) : Ratio(-D.numerator, D.denominator);
}

/// A sample of the box: a corner of it, or any.
ImagePoint sample_of(Numbers& n, const PixelBox& box) {
  const auto pick = [&](std::uint32_t first, std::uint32_t last) {
    const int choice = n.below(4);
    if (choice == 0) return first;
    if (choice == 1) return last;
    return first + static_cast<std::uint32_t>(n.below(static_cast<int>(last - first + 1)));
  };
  return {pick(box.first_column, box.last_column) + 0.5, pick(box.first_row, box.last_row) + 0.5};
}

struct SetupShares {
  Share edges, q;
  int setups = 0, refused = 0;
};

void check_certified(const ImageTriangle& t, const Camera& camera, Numbers& n,
                     SetupShares& shares) {
  const bool perspective = is_perspective(camera.projection);
  constexpr CornerIndices corners{0, 1, 2};
  const auto orientation = certified_orientation(t.vertices.data(), corners);
  if (orientation) {
    EXPECT_EQ(*orientation, t.exact.orientation);
  }
  const PixelBox image{0, camera.width - 1, 0, camera.height - 1};
  SetupBatch batch;
  certified_setups(t.vertices.data(), &corners, 1, image, depth_range(camera), batch);
  if ((batch.empty & 1) || !orientation || *orientation == Sign::zero) return;
  if (batch.refused & 1) {
    ++shares.refused;
    return;
  }
  const PixelBox box = batch.box(0);
  const TriangleSetup setup = batch.get(0);
  ++shares.setups;
  // The setup turns the triangle so that its inside is positive, by exchanging B and C.
  const bool turned = t.exact.orientation == Sign::negative;
  const std::size_t order[] = {0, turned ? 2U : 1U, turned ? 1U : 2U};
  std::array<Dyadic, 3> W;
  for (std::size_t i = 0; i < 3; ++i) W[i] = to_image(camera.projection, t.exact.camera[i]).W;
  for (int k = 0; k < 6; ++k) {
    const ImagePoint s = sample_of(n, box);
    const double x = s.u - 0.5 - setup.column, y = s.v - 0.5 - setup.row;
    for (std::size_t i = 0; i < 3; ++i) {
      const std::size_t corner = order[i];
      const Ratio exact(t.exact.edges[corner].at(s.u, s.v),
                        W[(corner + 1) % 3] * W[(corner + 2) % 3]);
      shares.edges.add(edge_at(setup, i, x, y), exact, setup.edge_error);
    }
    TierCounts counts;
    if (covers(t.exact, s, counts)) {
      shares.q.add(q_at(setup, x, y), exact_q(t.exact, s, perspective),
                   setup.q_error * (1 - 0x1p-20));
    }
  }
}

class Setups : public ::testing::TestWithParam<bool> {};

TEST_P(Setups, FromVerticesBoundsHoldAndAreTight) {
  const Camera camera = plain_camera(GetParam());
  Numbers n(21);
  SetupShares shares;
  for (int i = 0; i < 20000; ++i) {
    check_certified(project_both(triangle_from(n), camera), camera, n, shares);
  }
  EXPECT_GT(shares.setups, 3000);
  EXPECT_GT(shares.refused, 20);
  EXPECT_GT(shares.edges.count(), 20000);
  EXPECT_GT(shares.q.count(), 2500);
  EXPECT_GT(shares.edges.publish("edges"), 0.02);
  EXPECT_GT(shares.q.publish("q"), 0.02);
}

TEST_P(Setups, FromVerticesBoundsHoldForTheWorstErrorsOfCorners) {
  const Camera camera = bare_camera(GetParam());
  Numbers n(22);
  SetupShares shares;
  for (int i = 0; i < 20000; ++i) check_certified(worst_triangle(n, camera), camera, n, shares);
  EXPECT_GT(shares.setups, 3000);
  EXPECT_GT(shares.q.count(), 3000);
  EXPECT_GT(shares.edges.publish("edges"), 0.2);
  EXPECT_GT(shares.q.publish("q"), 0.03);
}

TEST_P(Setups, FromExactFormsBoundsHoldAndAreTight) {
  const bool perspective = GetParam();
  const Camera camera = plain_camera(perspective);
  Numbers n(23);
  Share edges, q;
  for (int i = 0; i < 6000; ++i) {
    auto corners = triangle_from(n);
    if (n.below(2)) corners[0].z -= 5;  // reaches behind the camera
    const ImageTriangle t = project_both(corners, camera);
    if (t.exact.orientation == Sign::zero) continue;
    const auto column = static_cast<std::uint32_t>(n.below(576));
    const auto row = static_cast<std::uint32_t>(n.below(416));
    const PixelBox box{column, column + 63, row, row + 63};
    const TriangleSetup setup = exact_setup(t.exact, perspective, box);
    for (int k = 0; k < 4; ++k) {
      const ImagePoint s = sample_of(n, box);
      const double x = s.u - 0.5 - column, y = s.v - 0.5 - row;
      for (std::size_t j = 0; j < 3; ++j) {
        // The scale is a power of two: that between a coefficient and its exact value.
        const ExactVector3& l = t.exact.edges[j].coefficients();
        const bool use_a = !l[0].is_zero();
        const double exact_size = round_to_binary64(Ratio(use_a ? l[0] : l[1]));
        const double size = use_a ? setup.edge_a[j] : setup.edge_b[j];
        const long scale = std::ilogb(size) - std::ilogb(exact_size);
        edges.add(edge_at(setup, j, x, y), Ratio(t.exact.edges[j].at(s.u, s.v).scaled(scale)),
                  setup.edge_error);
      }
      const Ratio w(t.exact.weight.at(s.u, s.v));
      if (perspective && w.sign() != Sign::positive) continue;
      const Ratio exact = perspective ? Ratio(w.numerator, t.exact.depth_numerator.at(s.u, s.v))
                                      : exact_q(t.exact, s, perspective);
      q.add(q_at(setup, x, y), exact, setup.q_error * (1 - 0x1p-20));
    }
  }
  EXPECT_GT(q.count(), 5000);
  EXPECT_GT(edges.publish("edges"), 0.1);
  EXPECT_GT(q.publish("q"), 0.1);
}

/// Edge functions in double-words are the exact ones over |det K·R|.
Dyadic factor_of_forms(const Camera& camera) {
  const auto& m = camera.world_to_camera;
  const auto minor = [&](std::size_t i, std::size_t j) {
    return Dyadic(m[1][i]) * Dyadic(m[2][j]) - Dyadic(m[1][j]) * Dyadic(m[2][i]);
  };
  const Dyadic det =
      Dyadic(m[0][0]) * minor(1, 2) - Dyadic(m[0][1]) * minor(0, 2) + Dyadic(m[0][2]) * minor(0, 1);
  return abs(Dyadic(camera.projection.fx) * Dyadic(camera.projection.fy) * det);
}

TEST(WideSetups, BoundsHoldAndAreTight) {
  const Camera camera = plain_camera(true);
  const Dyadic factor = factor_of_forms(camera);
  const PixelBox image{0, camera.width - 1, 0, camera.height - 1};
  Numbers n(25);
  Share edges, q;
  int refused = 0;
  for (int i = 0; i < 4000 / effort; ++i) {
    auto corners = triangle_from(n);
    if (n.below(2)) corners[0].z -= 5;  // reaches behind the camera
    const ImageTriangle t = project_both(corners, camera);
    const Scene scene =
        scene_of({corners.begin(), corners.end()}, std::vector<CornerIndices>{{0, 1, 2}});
    const TriangleSource source(scene);
    const SceneRays rays(source, camera);
    const auto forms = WideReferee(rays).forms(0);
    ASSERT_TRUE(forms);
    const auto setup = wide_setup(*forms, 0, image);
    refused += !setup;
    if (t.exact.orientation == Sign::zero) {
      ASSERT_FALSE(setup);
    }
    if (!setup) continue;
    for (int k = 0; k < 4; ++k) {
      const ImagePoint s = sample_of(n, image);
      const double x = s.u - 0.5, y = s.v - 0.5;
      for (std::size_t j = 0; j < 3; ++j) {
        const ExactVector3& l = t.exact.edges[j].coefficients();
        const bool use_a = !l[0].is_zero();
        const double exact_size = round_to_binary64(Ratio(use_a ? l[0] : l[1], factor));
        const double size = use_a ? setup->edge_a[j] : setup->edge_b[j];
        const long scale = std::lround(std::log2(size / exact_size));
        edges.add(edge_at(*setup, j, x, y),
                  Ratio(t.exact.edges[j].at(s.u, s.v).scaled(scale), factor), setup->edge_error);
      }
      const Dyadic w = t.exact.weight.at(s.u, s.v);
      if (w.sign() != Sign::positive) continue;
      q.add(q_at(*setup, x, y), Ratio(w, t.exact.depth_numerator.at(s.u, s.v)),
            setup->q_error * (1 - 0x1p-20));
    }
  }
  EXPECT_LT(refused, 200 / effort);
  EXPECT_GT(q.count(), 4000 / effort);
  EXPECT_GT(edges.publish("edges"), 0.05);
  EXPECT_GT(q.publish("q"), 0.1);
}

/// Triangles of almost one depth: what is left of the bound on q is the share of |q_A|.
TEST(LevelSetups, BoundsHoldForTheRoundingsOfQ) {
  const Camera camera = bare_camera(false);
  Numbers n(24);
  SetupShares shares;
  for (int i = 0; i < 6000 / effort; ++i) {
    ImageTriangle t;
    std::array<WorldPoint, 3> world;
    const double level = 1 + n.below(2) * n.unit() / 8;
    for (std::size_t k = 0; k < 3; ++k) {
      const double u = 32 + n.unit() * 40, v = 32 + n.unit() * 40, D = level + n.unit() * 0x1p-20;
      t.vertices[k] = {u, v, -D, upper_half(0x1p-100) << 32 | upper_half(0x1p-100)};
      world[k] = {u, v, D};
    }
    TierCounts counts;
    t.exact = project(world, 0, camera, counts);
    check_certified(t, camera, n, shares);
  }
  EXPECT_GT(shares.q.count(), 4000 / effort);
  expect_share(shares.q.publish("q_of_corner"), 0.5);
}

INSTANTIATE_TEST_SUITE_P(Fast, Setups, ::testing::Bool());

/// Of triangles with corners on the grid, boxes have the samples from their least to before their
/// greatest coordinates, and all that the triangles cover are among them.
TEST(GridSetups, BoxesEndBeforeWhatTheTopLeftRuleMovesOut) {
  Numbers n(72);
  const Camera camera = bare_camera(false);
  int at_samples = 0, covered = 0;
  for (int i = 0; i < 4000 / effort; ++i) {
    const int bits = 1 + n.below(8);
    const auto place = [&] { return n.below(14 << bits) * std::ldexp(1, -bits) + 1; };
    std::array<MeshPoint, 3> points;
    for (MeshPoint& point : points) point = {place(), place(), 1};
    const ImageTriangle t = project_both(points, camera);
    if (t.exact.orientation == Sign::zero) continue;
    SetupBatch batch;
    constexpr CornerIndices corners{0, 1, 2};
    certified_setups(t.vertices.data(), &corners, 1, {0, 15, 0, 15}, depth_range(camera), batch);
    ASSERT_EQ(batch.snapped & 1, 1U);
    const bool is_empty = (batch.empty & 1) != 0;
    const auto [left, right] = std::minmax({points[0].x, points[1].x, points[2].x});
    const auto [top, bottom] = std::minmax({points[0].y, points[1].y, points[2].y});
    const double first_column = std::ceil(left - 0.5), last_column = std::ceil(right - 0.5) - 1;
    const double first_row = std::ceil(top - 0.5), last_row = std::ceil(bottom - 0.5) - 1;
    EXPECT_EQ(is_empty, first_column > last_column || first_row > last_row);
    if (!is_empty) {
      EXPECT_EQ(batch.first_column[0], first_column);
      EXPECT_EQ(batch.last_column[0], last_column);
      EXPECT_EQ(batch.first_row[0], first_row);
      EXPECT_EQ(batch.last_row[0], last_row);
    }
    at_samples += std::ceil(right) != right && std::floor(right - 0.5) == right - 0.5;
    TierCounts counts;
    for (std::uint32_t pixel = 0; pixel < 256; ++pixel) {
      const std::uint32_t column = pixel % 16, row = pixel / 16;
      if (!covers(t.exact, centre_of_pixel(column, row), counts)) continue;
      ++covered;
      EXPECT_FALSE(is_empty);
      EXPECT_GE(column, batch.first_column[0]);
      EXPECT_LE(column, batch.last_column[0]);
      EXPECT_GE(row, batch.first_row[0]);
      EXPECT_LE(row, batch.last_row[0]);
    }
  }
  EXPECT_GT(at_samples, 300 / effort);
  EXPECT_GT(covered, 10000 / effort);
}

}  // namespace
}  // namespace fathom
