// Depths that can be derived on paper.
#include <gtest/gtest.h>

#include <cmath>

#include "fathom/failures/errors.h"
#include "fathom/numeric/rounding.h"
#include "tests/engines/tested_engine.h"
#include "tests/inputs/scene_building.h"

namespace fathom {
namespace {

using checks::camera_of;
using checks::scene_of;

const Samples<float>& depths(const DepthMap& map) {
  return *map.values<float>("Z");
}

/// A rectangle of two triangles with the corners a b c d in turn.
Scene quad(MeshPoint a, MeshPoint b, MeshPoint c, MeshPoint d) {
  return scene_of({a, b, c, d}, {{0, 1, 2}, {0, 2, 3}});
}

TEST(ClosedForm, APlaneAcrossTheViewHasOneDepth) {
  const Scene scene = quad({-100, -100, 5}, {100, -100, 5}, {100, 100, 5}, {-100, 100, 5});
  const DepthMap map = checks::render_tested(scene, camera_of(16, 12, 10));
  for (const float z : depths(map)) EXPECT_EQ(z, 5.0F);
}

// The plane a·x + b·y + c·z = d meets the ray (x, y, 1)·z at z = d / (a·x + b·y + c).
TEST(ClosedForm, AnObliquePlane) {
  const double a = 0.25, b = -0.5, c = 1, d = 4;
  const auto on_plane = [&](double x, double y) {
    return MeshPoint{x, y, (d - a * x - b * y) / c};
  };
  const Scene scene = quad(on_plane(-8, -4), on_plane(8, -4), on_plane(8, 4), on_plane(-8, 4));
  const Camera camera = camera_of(20, 14, 32);
  const DepthMap map = checks::render_tested(scene, camera);
  for (std::uint32_t j = 0; j < 14; ++j) {
    for (std::uint32_t i = 0; i < 20; ++i) {
      const double x = (i + 0.5 - 10) / 32, y = (j + 0.5 - 7) / 32;  // exact: powers of two
      const Ratio z(Dyadic(d), Dyadic(a) * Dyadic(x) + Dyadic(b) * Dyadic(y) + Dyadic(c));
      EXPECT_EQ(depths(map)[j * 20 + i], round_to_binary32(z)) << i << ' ' << j;
    }
  }
}

TEST(ClosedForm, TheGroundUnderAnOrthographicCameraIsALinearRamp) {
  Camera camera = camera_of(8, 4, 2);
  camera.projection.model = ProjectionModel::orthographic;
  const Scene scene = quad({-10, -10, 0}, {10, -10, 20}, {10, 10, 20}, {-10, 10, 0});  // z = x + 10
  const DepthMap map = checks::render_tested(scene, camera);
  for (std::uint32_t i = 0; i < 8; ++i) {
    EXPECT_EQ(depths(map)[i], static_cast<float>((i + 0.5 - 4) / 2 + 10));
  }
}

// A box seen from inside: every ray leaves through the nearest of three walls.
TEST(ClosedForm, ARoomFromInside) {
  const Scene room = checks::box_scene(2, 1, 4);
  const Camera camera = camera_of(40, 40, 8);
  const DepthMap map = checks::render_tested(room, camera);
  for (std::uint32_t j = 0; j < 40; ++j) {
    for (std::uint32_t i = 0; i < 40; ++i) {
      const double x = std::abs((i + 0.5 - 20) / 8), y = std::abs((j + 0.5 - 20) / 8);
      Ratio z = Ratio(Dyadic(4.0));
      if (Ratio(Dyadic(2.0), Dyadic(x)) < z) z = Ratio(Dyadic(2.0), Dyadic(x));
      if (Ratio(Dyadic(1.0), Dyadic(y)) < z) z = Ratio(Dyadic(1.0), Dyadic(y));
      ASSERT_EQ(depths(map)[j * 40 + i], round_to_binary32(z)) << i << ' ' << j;
    }
  }
}

// A mesh whose vertices lie on a sphere lies inside it, and no deeper below it than the sagitta of
// its longest edge. Both bounds are widened by the rounding of the vertices and of the comparison.
TEST(ClosedForm, AFacetedSphereLiesBetweenTwoSpheres) {
  constexpr int rings = 24, segments = 48;
  constexpr double pi = 3.14159265358979323846, radius = 1, distance = 4;
  std::vector<MeshPoint> v;
  std::vector<CornerIndices> t;
  for (int i = 0; i <= rings; ++i) {
    for (int j = 0; j < segments; ++j) {
      const double theta = pi * i / rings, phi = 2 * pi * j / segments;
      v.push_back({radius * std::sin(theta) * std::cos(phi), radius * std::cos(theta),
                   distance + radius * std::sin(theta) * std::sin(phi)});
    }
  }
  for (std::uint32_t i = 0; i < rings; ++i) {
    for (std::uint32_t j = 0; j < segments; ++j) {
      const std::uint32_t a = i * segments + j, b = i * segments + (j + 1) % segments;
      t.push_back({a, b, b + segments});
      t.push_back({a, b + segments, a + segments});
    }
  }
  // Every facet's plane is at least this far from the centre: half its diagonal is at most
  // (π/rings + 2π/segments) / 2 in angle.
  const double inner = radius * std::cos((pi / rings + 2 * pi / segments) / 2);
  const Camera camera = camera_of(64, 64, 100);
  const DepthMap map = checks::render_tested(scene_of(v, t), camera);
  // Nearer root of |z·(x, y, 1) − (0, 0, distance)|² = r².
  const auto sphere = [&](double x, double y, double r) {
    const double a = x * x + y * y + 1;
    const double discriminant = distance * distance - a * (distance * distance - r * r);
    return (distance - std::sqrt(discriminant)) / a;
  };
  int seen = 0;
  for (std::uint32_t j = 0; j < 64; ++j) {
    for (std::uint32_t i = 0; i < 64; ++i) {
      const double x = (i + 0.5 - 32) / 100, y = (j + 0.5 - 32) / 100;
      if (std::hypot(x, y) > 0.2) continue;  // well inside the outline, which is near 0.258
      ++seen;
      const double z = depths(map)[j * 64 + i];
      EXPECT_GE(z, sphere(x, y, radius) * (1 - 1e-7));
      EXPECT_LE(z, sphere(x, y, inner) * (1 + 1e-7));
    }
  }
  EXPECT_GT(seen, 1000);
}

TEST(ClosedForm, NearAndFarAreInclusive) {
  const Scene scene = quad({-9, -9, 2}, {9, -9, 2}, {9, 9, 2}, {-9, 9, 2});
  Camera camera = camera_of(2, 2, 1);
  const auto is_seen = [&](double near, double far) {
    camera.near = near;
    camera.far = far;
    return std::isfinite(depths(checks::render_tested(scene, camera))[0]);
  };
  EXPECT_TRUE(is_seen(2, 3));
  EXPECT_TRUE(is_seen(1, 2));
  EXPECT_FALSE(is_seen(std::nextafter(2, 3), 3));
  EXPECT_FALSE(is_seen(1, std::nextafter(2, 1)));
}

// Three corners in front of and behind the camera: the part in front is seen, to its very edge.
TEST(ClosedForm, TheGroundThroughTheCameraPlane) {
  const Scene scene = scene_of({{-1000, 1, -10}, {1000, 1, -10}, {0, 1, 1000}}, {{0, 1, 2}});
  const DepthMap map = checks::render_tested(scene, camera_of(8, 8, 4));
  for (std::uint32_t j = 0; j < 8; ++j) {
    const double y = (j + 0.5 - 4) / 4;
    const float z = depths(map)[j * 8 + 3];
    if (y < 0) {
      EXPECT_EQ(z, std::numeric_limits<float>::infinity());
    } else {
      EXPECT_EQ(z, round_to_binary32(Ratio(Dyadic(1.0), Dyadic(y))));
    }
  }
}

TEST(ClosedForm, TheNormalFacesTheCameraWhateverTheWindingAndTheCamera) {
  for (const bool reversed : {false, true}) {
    for (const double fx : {1.0, -1.0}) {
      for (const double mirror : {1.0, -1.0}) {
        for (const ProjectionModel projection :
             {ProjectionModel::perspective, ProjectionModel::orthographic}) {
          Scene scene = quad({-9, -9, 2}, {9, -9, 2}, {9, 9, 2}, {-9, 9, 2});
          if (reversed) {
            for (CornerIndices& t : scene.meshes[0].triangles) std::swap(t[0], t[1]);
          }
          Camera camera = camera_of(2, 2, 1);
          camera.projection.model = projection;
          camera.projection.fx = fx;
          camera.world_to_camera[0][0] = mirror;
          RenderOptions options;
          options.channels = {Channel::N};
          const DepthMap map = checks::render_tested(scene, camera, options);
          EXPECT_EQ((*map.values<float>("N.Z"))[0], -1.0F);
          EXPECT_EQ((*map.values<float>("N.X"))[0], 0.0F);
          EXPECT_FALSE(std::signbit((*map.values<float>("N.X"))[0]));
        }
      }
    }
  }
}

TEST(ClosedForm, CullingKeepsOneSide) {
  // Counter-clockwise as displayed (y down): front-facing.
  const Scene front = scene_of({{-9, -9, 2}, {-9, 9, 2}, {9, 0, 2}}, {{0, 1, 2}});
  const Scene back = scene_of({{-9, -9, 2}, {-9, 9, 2}, {9, 0, 2}}, {{0, 2, 1}});
  RenderOptions options;
  const auto is_seen = [&](const Scene& scene, Cull cull) {
    options.cull = cull;
    return std::isfinite(depths(checks::render_tested(scene, camera_of(3, 3, 1), options))[4]);
  };
  EXPECT_TRUE(is_seen(front, Cull::none));
  EXPECT_TRUE(is_seen(back, Cull::none));
  EXPECT_TRUE(is_seen(front, Cull::back));
  EXPECT_FALSE(is_seen(back, Cull::back));
  EXPECT_FALSE(is_seen(front, Cull::front));
  EXPECT_TRUE(is_seen(back, Cull::front));
}

TEST(ClosedForm, AFaultyCameraIsRefused) {
  const Scene scene = scene_of({{0, 0, 1}, {1, 0, 1}, {0, 1, 1}}, {{0, 1, 2}});
  Camera camera = camera_of(2, 2, 0);
  EXPECT_THROW(checks::render_tested(scene, camera), InputError);
}

}  // namespace
}  // namespace fathom
