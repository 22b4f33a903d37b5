// Channel A against areas computed in slabs by rational numbers, and against areas known on paper.
#include "fathom/area/coverage.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <random>

#include "fathom/numeric/rounding.h"
#include "fathom/triangle/projected_triangle.h"
#include "tests/effort.h"
#include "tests/engines/tested_engine.h"
#include "tests/inputs/random_scenes.h"
#include "tests/oracle/against_oracle.h"

namespace fathom {
namespace {

using namespace triangle;
using checks::camera_of;
using checks::Case;
using checks::CaseMaker;
using checks::Kind;
using checks::scene_of;
using oracle::Q;

RenderOptions only_coverage() {
  RenderOptions options;
  options.channels = {Channel::A};
  options.threads = 1;
  return options;
}

Samples<float> coverage_of(const Scene& scene, const Camera& camera,
                           const RenderOptions& options = only_coverage()) {
  return *checks::render_tested(scene, camera, options).values<float>("A");
}

std::vector<std::uint32_t> all_triangles(const Scene& scene) {
  std::vector<std::uint32_t> numbers(triangle_count(scene));
  std::iota(numbers.begin(), numbers.end(), 0U);
  return numbers;
}

struct Tally {
  int partly = 0, full = 0, empty = 0;
};

void check(const Case& c, Tally& tally) {
  const Samples<float> A = coverage_of(c.scene, c.camera);
  const oracle::Areas areas = checks::areas_at(c.scene, c.camera);
  const CoverageFrame frame{c.scene, c.camera};
  const std::vector<std::uint32_t> triangles = all_triangles(c.scene);
  for (std::uint32_t y = 0; y < c.camera.height; ++y) {
    for (std::uint32_t x = 0; x < c.camera.width; ++x) {
      SCOPED_TRACE("pixel " + std::to_string(x) + ", " + std::to_string(y));
      const Q expected = areas.coverage(static_cast<int>(x), static_cast<int>(y));
      ASSERT_EQ(checks::rational(pixel_coverage(frame, triangles, x, y)), expected);
      ASSERT_EQ(A[y * c.camera.width + x], checks::nearest_float(expected));
      ++(sgn(expected) == 0 ? tally.empty : expected == 1 ? tally.full : tally.partly);
    }
  }
}

class Coverage : public ::testing::TestWithParam<Kind> {};

TEST_P(Coverage, IsTheAreaOfTheUnion) {
  CaseMaker maker(77 + static_cast<std::uint64_t>(GetParam()), GetParam());
  Tally tally;
  for (int i = 0; i < 150 / checks::effort && !HasFailure(); ++i) {
    SCOPED_TRACE("scene " + std::to_string(i) + " of this seed");
    check(maker.make(), tally);
  }
  if (checks::effort > 1) return;
  EXPECT_GT(tally.partly, 500);
  EXPECT_GT(tally.full, 50);
  EXPECT_GT(tally.empty, 500);
}

INSTANTIATE_TEST_SUITE_P(RandomScenes, Coverage,
                         ::testing::Values(Kind::few_bits, Kind::neighbours, Kind::huge,
                                           Kind::tiny));

/// Triangles of every size from a ten thousandth of a pixel to many pixels, needles one ulp wide,
/// neighbours that share edges, all on top of each other.
Scene debris(std::mt19937_64& random) {
  std::vector<MeshPoint> vertices;
  std::vector<CornerIndices> triangles;
  const auto number = [&] { return static_cast<double>(random() % 65536) / 65536; };
  for (int i = 0; i < 12; ++i) {
    const auto first = static_cast<std::uint32_t>(vertices.size());
    const double size = std::ldexp(4, -static_cast<int>(random() % 16));
    const double x = 4 * number() - 2, y = 4 * number() - 2;
    for (int k = 0; k < 4; ++k) {
      vertices.push_back({x + size * (number() - 0.5), y + size * (number() - 0.5), 1 + number()});
    }
    if (i % 3 == 0) {  // a needle
      vertices[first + 1] = vertices[first];
      vertices[first + 1].x = std::nextafter(vertices[first].x, 9);
    }
    triangles.push_back({first, first + 1, first + 2});
    triangles.push_back({first + 1, first + 3, first + 2});  // shares an edge
  }
  return scene_of(std::move(vertices), std::move(triangles));
}

TEST(CoverageLaws, SliversAndTrianglesSmallerThanAPixel) {
  std::mt19937_64 random(4242);
  Tally tally;
  for (int i = 0; i < 12 / std::min(checks::effort, 4) && !HasFailure(); ++i) {
    Camera camera = camera_of(5, 4, 2);
    if (i % 4 == 1) camera.near = 1.5;
    if (i % 4 == 2) camera.far = 1.25;
    if (i % 4 == 3) camera.world_to_camera[2] = {0.5, 0.25, 1, -1};  // the camera plane cuts
    check({debris(random), camera}, tally);
  }
  EXPECT_GT(tally.partly, 20);
}

/// A ball around the camera, every edge shared: there is no way out.
TEST(CoverageLaws, AClosedMeshHasNoGap) {
  std::mt19937_64 random(7);
  std::vector<MeshPoint> vertices{{0.1, 0.2, -3}, {0.2, 0.1, 3}};
  std::vector<CornerIndices> triangles;
  constexpr std::uint32_t rings = 8, columns = 11;
  for (std::uint32_t i = 0; i < rings; ++i) {
    for (std::uint32_t k = 0; k < columns; ++k) {
      const double a = (i + 1) * 3.14 / (rings + 1), b = k * 6.28 / columns;
      const double r = 2 + static_cast<double>(random() % 1000) / 1000;
      vertices.push_back(
          {r * std::sin(a) * std::cos(b), r * std::sin(a) * std::sin(b), -r * std::cos(a)});
      const std::uint32_t here = 2 + i * columns + k, beside = 2 + i * columns + (k + 1) % columns;
      if (i == 0) triangles.push_back({0, here, beside});
      if (i + 1 == rings) triangles.push_back({1, beside, here});
      if (i + 1 < rings) {
        triangles.push_back({here, beside, here + columns});
        triangles.push_back({beside, beside + columns, here + columns});
      }
    }
  }
  const Scene scene = scene_of(std::move(vertices), std::move(triangles));
  for (const double focal : {5.0, 20.0}) {
    Camera camera = camera_of(33, 21, focal);
    camera.world_to_camera[0] = {0.8, 0.1, -0.6, 0.125};
    camera.world_to_camera[2] = {0.6, 0.3, 0.8, 0.25};
    for (const float a : coverage_of(scene, camera)) ASSERT_EQ(a, 1.0F);
  }
}

/// Twice the area of a polygon's image, on paper: u = f·x/z + c.
Q projected_twice_area(const std::vector<MeshPoint>& outline, const Camera& camera) {
  std::vector<oracle::Point> image;
  for (const MeshPoint& p : outline) {
    image.push_back({Q(camera.projection.fx) * Q(p.x) / Q(p.z) + Q(camera.projection.cx),
                     Q(camera.projection.fy) * Q(p.y) / Q(p.z) + Q(camera.projection.cy)});
  }
  return abs(oracle::twice_area(image));
}

/// A tilted rectangle cut into many triangles with corners of few bits: the pixels' areas add up
/// to that of its outline.
TEST(CoverageLaws, TheSumOverAVisibleMeshIsItsProjectedArea) {
  constexpr std::uint32_t n = 6;
  std::vector<MeshPoint> vertices;
  std::vector<CornerIndices> triangles;
  const auto at = [](double s, double t) {
    return MeshPoint{s - 3 + t / 8, t - 3, 6 + s / 4 + t / 2};
  };
  for (std::uint32_t y = 0; y <= n; ++y) {
    for (std::uint32_t x = 0; x <= n; ++x) {
      vertices.push_back(at(x, y));
      if (x == n || y == n) continue;
      const std::uint32_t v = y * (n + 1) + x;
      triangles.push_back({v, v + 1, v + n + 1});
      triangles.push_back({v + 1, v + n + 2, v + n + 1});
    }
  }
  const Scene scene = scene_of(vertices, triangles);
  const Camera camera = camera_of(24, 20, 13);
  const CoverageFrame frame{scene, camera};
  Q sum = 0;
  for (std::uint32_t y = 0; y < camera.height; ++y) {
    for (std::uint32_t x = 0; x < camera.width; ++x) {
      sum += checks::rational(pixel_coverage(frame, all_triangles(scene), x, y));
    }
  }
  EXPECT_EQ(2 * sum, projected_twice_area({at(0, 0), at(n, 0), at(n, n), at(0, n)}, camera));
}

/// A closed convex mesh covers each point of its image twice, so that its area is half the sum of
/// its triangles'; the numbers that A rounds add up to it exactly.
TEST(CoverageLaws, TheSumOverAClosedMeshIsItsProjectedArea) {
  const double golden = 1.618034;
  std::vector<MeshPoint> vertices;
  for (const double a : {-1.0, 1.0}) {
    for (const double b : {-golden, golden}) {
      vertices.push_back({0, a, 6 + b});
      vertices.push_back({a, b, 6});
      vertices.push_back({b, 0, 6 + a});
    }
  }
  // The faces of the icosahedron: corners at the least distance, 2, from each other.
  const auto are_near = [&](std::uint32_t i, std::uint32_t k) {
    const MeshPoint &p = vertices[i], &q = vertices[k];
    return std::hypot(p.x - q.x, p.y - q.y, p.z - q.z) < 2.1;
  };
  std::vector<CornerIndices> triangles;
  const Camera camera = camera_of(24, 20, 25);
  Q four_times_area = 0;
  for (std::uint32_t i = 0; i < 12; ++i) {
    for (std::uint32_t k = 0; k < i; ++k) {
      for (std::uint32_t m = 0; m < k; ++m) {
        if (!are_near(i, k) || !are_near(k, m) || !are_near(m, i)) continue;
        triangles.push_back({i, k, m});
        four_times_area += projected_twice_area({vertices[i], vertices[k], vertices[m]}, camera);
      }
    }
  }
  ASSERT_EQ(triangles.size(), 20U);
  const Scene scene = scene_of(vertices, triangles);
  const Samples<float> A = coverage_of(scene, camera);
  const CoverageFrame frame{scene, camera};
  Q sum = 0;
  int full = 0;
  for (std::uint32_t y = 0; y < camera.height; ++y) {
    for (std::uint32_t x = 0; x < camera.width; ++x) {
      const Q area = checks::rational(pixel_coverage(frame, all_triangles(scene), x, y));
      ASSERT_EQ(A[y * camera.width + x], checks::nearest_float(area));
      sum += area;
      full += area == 1;
    }
  }
  EXPECT_GT(full, 100);
  EXPECT_EQ(4 * sum, four_times_area);
}

/// An octahedron seen along its axis: a diamond whose pixels' areas are binary fractions of few
/// bits, so that A itself adds up exactly.
TEST(CoverageLaws, TheSumOfABinaryFractionsIsTheAreaItself) {
  Camera camera = camera_of(12, 10, 1);
  camera.projection.model = ProjectionModel::orthographic;
  camera.projection.cx = 5.25, camera.projection.cy = 4.5;
  const Scene scene = scene_of(
      {{4, 0, 5}, {0, 4, 5}, {-4, 0, 5}, {0, -4, 5}, {0.375, 0.125, 2}, {-0.5, 0.25, 8}},
      {{0, 1, 4}, {1, 2, 4}, {2, 3, 4}, {3, 0, 4}, {1, 0, 5}, {2, 1, 5}, {3, 2, 5}, {0, 3, 5}});
  const Samples<float> A = coverage_of(scene, camera);
  EXPECT_EQ(std::accumulate(A.begin(), A.end(), 0.0), 32.0);
}

TEST(CoverageLaws, CullingLeavesTrianglesOut) {
  CaseMaker maker(99, Kind::few_bits);
  int differing = 0;
  for (int i = 0; i < 100 / checks::effort; ++i) {
    Case c = maker.make();
    RenderOptions options = only_coverage();
    const Samples<float> all = coverage_of(c.scene, c.camera);
    for (const Cull cull : {Cull::back, Cull::front}) {
      options.cull = cull;
      const Samples<float> culled = coverage_of(c.scene, c.camera, options);
      Scene kept = c.scene;
      auto& triangles = kept.meshes[0].triangles;
      TierCounts counts;
      triangles.clear();
      for (std::uint32_t t = 0; t < triangle_count(c.scene); ++t) {
        const TriangleSource source(c.scene);
        if (is_kept(project(source.world_corners(t), t, c.camera, counts), cull)) {
          triangles.push_back(c.scene.meshes[0].triangles[t]);
        }
      }
      EXPECT_EQ(culled, coverage_of(kept, c.camera));
      differing += !(culled == all);
    }
  }
  EXPECT_GT(differing, 100 / checks::effort / 4);
}

// A square [1.25, 2.5] × [0.5, 3] in pixels, in front of the image's 4 × 4.
TEST(CoverageLaws, AreasKnownOnPaper) {
  Camera camera = camera_of(4, 4, 1);
  camera.projection.model = ProjectionModel::orthographic;
  camera.projection.cx = camera.projection.cy = 0;
  const Scene scene = scene_of({{1.25, 0.5, 1}, {2.5, 0.5, 1}, {2.5, 3, 1}, {1.25, 3, 1}},
                               {{0, 1, 2}, {0, 2, 3}, {2, 1, 0}});
  const Samples<float> expected{0, 0.375F, 0.25F, 0,  //
                                0, 0.75F,  0.5F,  0,  //
                                0, 0.75F,  0.5F,  0,  //
                                0, 0,      0,     0};
  EXPECT_EQ(coverage_of(scene, camera), expected);
  camera.near = 1;  // near ≤ D counts
  EXPECT_EQ(coverage_of(scene, camera), expected);
  camera.near = 0;
  camera.far = 0.5;
  EXPECT_EQ(coverage_of(scene, camera), Samples<float>(16, 0.0F));
  camera.far = 2;
  camera.world_to_camera[2][3] = -1;  // D = 0 does not
  EXPECT_EQ(coverage_of(scene, camera), Samples<float>(16, 0.0F));
}

}  // namespace
}  // namespace fathom
