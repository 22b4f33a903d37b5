// The reference engine against rays cast in rational numbers, every channel, over random scenes
// with coordinates of few bits, so that samples on edges and vertices, equal depths and edge-on
// triangles abound.
#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "fathom/exact/probe.h"
#include "fathom/render.h"
#include "tests/exact/scene_building.h"
#include "tests/oracle/mpfr_rounding.h"
#include "tests/oracle/ray_caster.h"

namespace fathom {
namespace {

using oracle::Q;

enum class Kind { few_bits, neighbours, huge, tiny };

struct Case {
  Scene scene;
  Camera camera;
};

class CaseMaker {
 public:
  CaseMaker(std::uint64_t seed, Kind kind) : random_(seed), kind_(kind) {}

  Case make() {
    Case c;
    plain_ = below(3) != 0;
    do c.camera = plain_ ? plain_camera() : camera();
    while (find_fault(c.camera));
    c.scene = scene(c.camera);
    return c;
  }

 private:
  int below(int n) { return static_cast<int>(random_() % static_cast<unsigned>(n)); }
  double scale() const {
    return kind_ == Kind::huge ? 0x1p498 : kind_ == Kind::tiny ? 0x1p-498 : 1;  // about 1e±150
  }
  double coordinate() {
    double x = std::ldexp(below(17) - 8, -below(3)) * scale();
    if (kind_ == Kind::neighbours && below(3) == 0) x = std::nextafter(x, below(2) ? 1e9 : -1e9);
    return x;
  }

  /// A corner that the plain camera sees exactly at a pixel centre (or near it, or anywhere).
  MeshPoint corner(const Camera& c) {
    if (!plain_ || below(4) == 0) return {coordinate(), coordinate(), coordinate()};
    const double z = (1 + below(4)) * scale(), half = below(8) == 0 ? 0.25 : 0.5;
    const double u = below(10) - 2 + half, v = below(9) - 2 + half;
    MeshPoint p{(u - c.cx) / c.fx * z, (v - c.cy) / c.fy * z, z};
    if (kind_ == Kind::neighbours && below(3) == 0)
      p.x = std::nextafter(p.x, below(2) ? 1e9 : -1e9);
    return p;
  }

  Scene scene(const Camera& c) {
    const int corners = 3 + below(5);
    std::vector<MeshPoint> vertices;
    for (int i = 0; i < corners; ++i) vertices.push_back(corner(c));
    std::vector<CornerIndices> triangles(static_cast<std::size_t>(2 + below(6)));
    for (CornerIndices& t : triangles) {
      for (std::uint32_t& index : t) index = static_cast<std::uint32_t>(below(corners));
    }
    return testing::scene_of(std::move(vertices), std::move(triangles));
  }

  /// No rotation, a focal length that is a power of two: sample rays have few bits.
  Camera plain_camera() {
    Camera c = testing::camera_of(6, 5, std::ldexp(1, below(4)));
    if (below(3) == 0) c.fy = -c.fy;
    if (below(4) == 0) c.near = below(3) * scale();
    if (below(4) == 0) c.far = c.near + (1 + below(3)) * scale();
    return c;
  }

  Camera camera() {
    Camera c = testing::camera_of(6, 5, std::ldexp(1 + below(4), below(3)));
    c.projection = below(4) == 0 ? Projection::orthographic : Projection::perspective;
    if (below(3) == 0) c.fy = -c.fy;
    if (below(3) == 0) c.skew = below(5) - 2;
    if (below(3) == 0) c.cx += 0.25 * below(9) - 1;
    if (below(2) == 0) c.pixel_centre = 0;
    if (c.projection == Projection::orthographic) {
      c.fx /= scale();
      c.fy /= scale();
      c.skew /= scale();
    }
    if (below(2) == 0) {
      for (auto& row : c.world_to_camera) {
        for (int k = 0; k < 3; ++k) row[k] = below(5) - 2;
      }
    }
    for (auto& row : c.world_to_camera) row[3] = (below(9) - 4) * scale();
    if (below(2) == 0) c.world_to_camera[2][3] = 8 * scale();
    if (below(4) == 0) c.near = below(4) * scale();
    if (below(4) == 0) c.far = c.near + (1 + below(8)) * scale();
    return c;
  }

  std::mt19937_64 random_;
  Kind kind_;
  bool plain_ = false;
};

oracle::RayCamera ray_camera(const Camera& c) {
  oracle::RayCamera r{.perspective = c.projection == Projection::perspective,
                      .fx = c.fx,
                      .fy = c.fy,
                      .cx = c.cx,
                      .cy = c.cy,
                      .skew = c.skew,
                      .pixel_centre = c.pixel_centre};
  for (int i = 0; i < 3; ++i) {
    for (int k = 0; k < 4; ++k) r.world_to_camera[i][k] = c.world_to_camera[i][k];
  }
  r.near = c.near;
  if (std::isfinite(c.far)) r.far = Q(c.far);
  return r;
}

std::vector<oracle::Triangle> triangles_of(const Scene& scene) {
  std::vector<oracle::Triangle> all;
  const Mesh& mesh = scene.meshes[0];
  for (const CornerIndices& corners : mesh.triangles) {
    oracle::Triangle t;
    for (int i = 0; i < 3; ++i) {
      const MeshPoint& p = mesh.vertices[corners[i]];
      t[i] = {Q(p.x), Q(p.y), Q(p.z)};
    }
    all.push_back(t);
  }
  return all;
}

float nearest_float(const Q& q) {
  return static_cast<float>(oracle::quotient(oracle::binary32, q.get_mpq_t()));
}
float nearest_root(const Q& q) {
  return static_cast<float>(oracle::root(oracle::binary32, q.get_mpq_t()));
}

/// Ours and the oracle's value, bit for bit; any NaN is a NaN.
void expect_bits(float ours, float expected, const char* channel) {
  if (std::isnan(ours) && std::isnan(expected)) return;
  EXPECT_EQ(std::bit_cast<std::uint32_t>(ours), std::bit_cast<std::uint32_t>(expected))
      << channel << ": " << std::hexfloat << ours << ", expected " << expected;
}

void expect_hit(const DepthMap& map, std::size_t pixel, const oracle::Hit& hit) {
  const auto value = [&](const char* name) { return (*map.values<float>(name))[pixel]; };
  EXPECT_EQ((*map.values<std::uint32_t>("id"))[pixel], hit.triangle);
  EXPECT_EQ((*map.values<std::uint32_t>("face"))[pixel], hit.triangle);
  EXPECT_EQ((*map.values<std::uint32_t>("object"))[pixel], 0U);
  const float Z = nearest_float(hit.depth);
  expect_bits(value("Z"), Z, "Z");
  expect_bits(value("Zlow"), std::isinf(Z) ? 0 : nearest_float(hit.depth - Q(Z)), "Zlow");
  expect_bits(value("distance"), nearest_root(hit.squared_distance), "distance");
  expect_bits(value("bary.U"), nearest_float(hit.weight_b), "bary.U");
  expect_bits(value("bary.V"), nearest_float(hit.weight_c), "bary.V");
  const char* axes[] = {"P.X", "P.Y", "P.Z", "N.X", "N.Y", "N.Z"};
  Q length = 0;
  for (const Q& n : hit.normal) length += n * n;
  for (int i = 0; i < 3; ++i) {
    expect_bits(value(axes[i]), nearest_float(hit.position[i]), axes[i]);
    const float magnitude = nearest_root(hit.normal[i] * hit.normal[i] / length);
    expect_bits(value(axes[3 + i]), sgn(hit.normal[i]) < 0 ? -magnitude : magnitude, axes[3 + i]);
  }
}

void expect_background(const DepthMap& map, std::size_t pixel) {
  const auto value = [&](const char* name) { return (*map.values<float>(name))[pixel]; };
  for (const char* name : {"Z", "distance"}) {
    EXPECT_EQ(value(name), std::numeric_limits<float>::infinity()) << name;
  }
  for (const char* name : {"Zlow", "N.X", "N.Y", "N.Z"}) EXPECT_EQ(value(name), 0.0F) << name;
  for (const char* name : {"P.X", "P.Y", "P.Z", "bary.U", "bary.V"}) {
    EXPECT_TRUE(std::isnan(value(name))) << name;
  }
  for (const char* name : {"id", "face", "object"}) {
    EXPECT_EQ((*map.values<std::uint32_t>(name))[pixel], no_surface) << name;
  }
}

struct Tally {
  int hits = 0, ties = 0, on_edges = 0;
  RenderStatistics statistics;
};

void add_ties(const Case& c, int x, int y, Tally& tally) {
  const auto seen =
      probe(c.scene, c.camera, static_cast<std::uint32_t>(x), static_cast<std::uint32_t>(y));
  if (seen.empty()) return;
  for (const Sign side : seen[0].edge_signs) tally.on_edges += side == Sign::zero;
  tally.ties += seen.size() > 1 && seen[1].counts && seen[0].depth == seen[1].depth;
}

void check(const Case& c, Tally& tally) {
  RenderOptions options;
  options.channels = {Channel::Z,  Channel::Zlow, Channel::distance,
                      Channel::id, Channel::face, Channel::object,
                      Channel::N,  Channel::P,    Channel::bary};
  options.threads = 1;
  RenderStatistics statistics;
  options.statistics = &statistics;
  const DepthMap map = render(c.scene, c.camera, options);
  tally.statistics.edges += statistics.edges;
  tally.statistics.visibility += statistics.visibility;
  tally.statistics.range += statistics.range;
  tally.statistics.facing += statistics.facing;
  const oracle::RayCaster rays(ray_camera(c.camera), triangles_of(c.scene));
  for (int y = 0; y < 5; ++y) {
    for (int x = 0; x < 6; ++x) {
      const auto hit = rays.cast(x, y);
      const std::size_t pixel = static_cast<std::size_t>(y) * 6 + static_cast<std::size_t>(x);
      if (hit) {
        ++tally.hits;
        expect_hit(map, pixel, *hit);
        add_ties(c, x, y, tally);
      } else {
        expect_background(map, pixel);
      }
    }
  }
}

class Oracle : public ::testing::TestWithParam<std::tuple<Kind, int>> {};

TEST_P(Oracle, EveryChannelOfEveryPixelAgrees) {
  const auto [kind, part] = GetParam();
  CaseMaker maker(static_cast<std::uint64_t>(1000 * static_cast<int>(kind) + part), kind);
  Tally tally;
  for (int i = 0; i < 1200 && !HasFailure(); ++i) {
    SCOPED_TRACE("scene " + std::to_string(i) + " of this seed");
    check(maker.make(), tally);
  }
  // The scenes are worth their time: things were seen, and the hard cases were among them.
  // The scenes are worth their time: the hard cases are among them, and every tier was reached
  // (samples on edges of few bits are settled by the filter: its interval is the point 0).
  EXPECT_GT(tally.hits, 5000);
  EXPECT_GT(tally.on_edges, 400);
  EXPECT_GT(tally.ties, 500);
  EXPECT_GT(tally.statistics.visibility.exact, 500U);
  EXPECT_GT(tally.statistics.edges.interval, kind == Kind::huge ? 0U : 10000U);
  if (kind == Kind::neighbours || kind == Kind::huge) {
    EXPECT_GT(tally.statistics.edges.exact, 1000U);
    EXPECT_GT(tally.statistics.facing.exact, 1000U);
  }
}

INSTANTIATE_TEST_SUITE_P(RandomScenes, Oracle,
                         ::testing::Combine(::testing::Values(Kind::few_bits, Kind::neighbours,
                                                              Kind::huge, Kind::tiny),
                                            ::testing::Range(0, 3)));

}  // namespace
}  // namespace fathom
