#include "tests/oracle/against_oracle.h"

#include <gtest/gtest.h>

#include <bit>
#include <cmath>

#include "tests/oracle/mpfr_rounding.h"
#include "tests/oracle/smooth_normals.h"

namespace fathom::checks {
namespace {

using oracle::Q;

Q rational(const Dyadic& x) {
  Q q;
  mpq_set_z(q.get_mpq_t(), x.significand());
  if (x.exponent() >= 0) {
    mpq_mul_2exp(q.get_mpq_t(), q.get_mpq_t(), static_cast<mp_bitcnt_t>(x.exponent()));
  } else {
    mpq_div_2exp(q.get_mpq_t(), q.get_mpq_t(), static_cast<mp_bitcnt_t>(-x.exponent()));
  }
  return q;
}

oracle::Vector world_point(const Object& object, const MeshPoint& p) {
  const Q local[] = {Q(p.x), Q(p.y), Q(p.z), Q(1)};
  oracle::Vector world;
  for (std::size_t i = 0; i < 3; ++i) {
    for (std::size_t k = 0; k < 4; ++k) {
      world[i] += rational(object.world_from_mesh.rows[i][k]) * local[k];
    }
  }
  return world;
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

oracle::SmoothMesh smooth_mesh(const Mesh& mesh, NormalSource source) {
  oracle::SmoothMesh smooth;
  smooth.by_place = source == NormalSource::place;
  for (const MeshPoint& p : mesh.vertices) smooth.vertices.push_back({Q(p.x), Q(p.y), Q(p.z)});
  for (const CornerIndices& t : mesh.triangles) smooth.triangles.push_back(t);
  if (source != NormalSource::file || mesh.normals.empty()) return smooth;
  const auto& indices = mesh.normal_triangles.empty() ? mesh.triangles : mesh.normal_triangles;
  for (const CornerIndices& t : indices) {
    auto& corners = smooth.normals.emplace_back();
    for (std::size_t k = 0; k < 3; ++k) {
      if (t[k] == no_index) continue;
      const auto& [x, y, z] = mesh.normals[t[k]];
      corners[k] = oracle::Vector{Q(x), Q(y), Q(z)};
    }
  }
  return smooth;
}

oracle::Vector smooth_normal(const Scene& scene, const oracle::Hit& hit, NormalSource source) {
  const TriangleOrigin origin = origin_of(scene, hit.triangle);
  const Object& object = scene.objects[origin.object];
  oracle::Linear placement;
  for (std::size_t i = 0; i < 3; ++i) {
    for (std::size_t k = 0; k < 3; ++k)
      placement[i][k] = rational(object.world_from_mesh.rows[i][k]);
  }
  return oracle::smooth_normal(smooth_mesh(scene.meshes[object.mesh], source), placement,
                               origin.triangle, hit.weight_b, hit.weight_c);
}

/// The square of a component is 0 below this: the error of a bent ray, squared.
const Q& least_square() {
  static const Q least = oracle::power_of_two_below(2 * oracle::zero_bits);
  return least;
}

/// x, or 0 if it is no more than the error of a bent ray.
Q settled(const Q& x) {
  static const Q least = oracle::power_of_two_below(oracle::zero_bits);
  return abs(x) < least ? Q(0) : x;
}

/// A vector scaled to unit length, in the channels of these parts; 0 where it is 0.
void expect_direction(const DepthMap& map, std::size_t pixel, const std::string& name,
                      const oracle::Vector& n) {
  Q length = 0;
  for (const Q& x : n) length += x * x;
  for (std::size_t i = 0; i < 3; ++i) {
    const std::string part = name + "." + "XYZ"[i];
    const Q squared = sgn(length) == 0 ? Q(0) : Q(n[i] * n[i] / length);
    const bool is_zero = squared < least_square();
    const float magnitude = is_zero ? 0 : nearest_root(squared);
    expect_bits((*map.values<float>(part))[pixel],
                sgn(n[i]) < 0 && !is_zero ? -magnitude : magnitude, part.c_str());
  }
}

void expect_hit(const DepthMap& map, std::size_t pixel, const oracle::Hit& hit, const Scene& scene,
                NormalSource normals) {
  const auto value = [&](const char* name) { return (*map.values<float>(name))[pixel]; };
  EXPECT_EQ((*map.values<std::uint32_t>("id"))[pixel], hit.triangle);
  const TriangleOrigin origin = origin_of(scene, hit.triangle);
  EXPECT_EQ((*map.values<std::uint32_t>("face"))[pixel], origin.face);
  EXPECT_EQ((*map.values<std::uint32_t>("object"))[pixel], origin.object);
  const float Z = nearest_float(hit.depth);
  expect_bits(value("Z"), Z, "Z");
  expect_bits(value("Zlow"), std::isinf(Z) ? 0 : nearest_float(settled(hit.depth - Q(Z))), "Zlow");
  expect_bits(value("distance"), nearest_root(hit.squared_distance), "distance");
  expect_bits(value("bary.U"), nearest_float(hit.weight_b), "bary.U");
  expect_bits(value("bary.V"), nearest_float(hit.weight_c), "bary.V");
  const char* axes[] = {"P.X", "P.Y", "P.Z"};
  for (int i = 0; i < 3; ++i) expect_bits(value(axes[i]), nearest_float(hit.position[i]), axes[i]);
  expect_direction(map, pixel, "N", hit.normal);
  expect_direction(map, pixel, "Nc", hit.camera_normal);
  expect_direction(map, pixel, "Ns", smooth_normal(scene, hit, normals));
}

void expect_background(const DepthMap& map, std::size_t pixel) {
  const auto value = [&](const char* name) { return (*map.values<float>(name))[pixel]; };
  for (const char* name : {"Z", "distance"}) {
    EXPECT_EQ(value(name), std::numeric_limits<float>::infinity()) << name;
  }
  for (const char* name :
       {"Zlow", "N.X", "N.Y", "N.Z", "Nc.X", "Nc.Y", "Nc.Z", "Ns.X", "Ns.Y", "Ns.Z"}) {
    EXPECT_EQ(value(name), 0.0F) << name;
  }
  for (const char* name : {"P.X", "P.Y", "P.Z", "bary.U", "bary.V"}) {
    EXPECT_TRUE(std::isnan(value(name))) << name;
  }
  for (const char* name : {"id", "face", "object"}) {
    EXPECT_EQ((*map.values<std::uint32_t>(name))[pixel], no_surface) << name;
  }
}

}  // namespace

float nearest_float(const Q& q) {
  return static_cast<float>(oracle::quotient(oracle::binary32, q.get_mpq_t()));
}

Q rational(const Ratio& x) {
  return rational(x.numerator) / rational(x.denominator);
}

oracle::Areas areas_at(const Scene& scene, const Camera& camera) {
  return {ray_camera(camera), triangles_of(scene)};
}

oracle::RayCamera ray_camera(const Camera& c) {
  oracle::RayCamera r{.perspective = is_perspective(c.projection),
                      .fx = c.projection.fx,
                      .fy = c.projection.fy,
                      .cx = c.projection.cx,
                      .cy = c.projection.cy,
                      .skew = c.projection.skew,
                      .pixel_centre = c.projection.pixel_centre};
  for (int i = 0; i < 3; ++i) {
    for (int k = 0; k < 4; ++k) r.world_to_camera[i][k] = c.world_to_camera[i][k];
  }
  r.near = c.near;
  if (std::isfinite(c.far)) r.far = Q(c.far);
  return r;
}

std::vector<oracle::Triangle> triangles_of(const Scene& scene) {
  std::vector<oracle::Triangle> all;
  for (const Object& object : scene.objects) {
    const Mesh& mesh = scene.meshes[object.mesh];
    for (const CornerIndices& corners : mesh.triangles) {
      oracle::Triangle t;
      for (std::size_t i = 0; i < 3; ++i) t[i] = world_point(object, mesh.vertices[corners[i]]);
      all.push_back(t);
    }
  }
  return all;
}

oracle::RayCaster cast_at(const Scene& scene, const Camera& camera) {
  return {ray_camera(camera), triangles_of(scene)};
}

oracle::RayCaster cast_at(const Scene& scene, const Camera& camera, const oracle::LensNumbers& lens,
                          double greatest_q) {
  oracle::RayCamera bent = ray_camera(camera);
  bent.bent = oracle::lens_rays(bent, lens, greatest_q);
  bent.by_distance = lens.counts_distance();
  return {bent, triangles_of(scene)};
}

oracle::RayCaster cast_along(const Scene& scene, const Camera& camera,
                             const DirectionOfPixel& direction) {
  oracle::RayCamera bent = ray_camera(camera);
  bent.bent = [direction](const oracle::Q& u, const oracle::Q& v) -> std::optional<oracle::Vector> {
    const auto d =
        direction(static_cast<std::uint32_t>(u.get_d()), static_cast<std::uint32_t>(v.get_d()));
    if (!d) return std::nullopt;
    return oracle::Vector{oracle::Q((*d)[0]), oracle::Q((*d)[1]), oracle::Q((*d)[2])};
  };
  bent.by_distance = true;
  return {bent, triangles_of(scene)};
}

std::vector<Channel> all_channels() {
  return {Channel::Z, Channel::Zlow, Channel::distance, Channel::id, Channel::face, Channel::object,
          Channel::N, Channel::P,    Channel::bary,     Channel::Nc, Channel::Ns};
}

void expect_pixel(const DepthMap& map, int x, int y, const std::optional<oracle::Hit>& hit,
                  const Scene& scene, NormalSource normals) {
  SCOPED_TRACE("pixel " + std::to_string(x) + ", " + std::to_string(y));
  const std::size_t pixel = static_cast<std::size_t>(y) * map.width + static_cast<std::size_t>(x);
  if (hit) {
    expect_hit(map, pixel, *hit, scene, normals);
  } else {
    expect_background(map, pixel);
  }
}

int expect_as_rays(const DepthMap& map, const Scene& scene, const Camera& camera,
                   NormalSource normals) {
  const oracle::RayCaster rays = cast_at(scene, camera);
  int seen = 0;
  for (int y = 0; y < static_cast<int>(camera.height); ++y) {
    for (int x = 0; x < static_cast<int>(camera.width); ++x) {
      const auto hit = rays.cast(x, y);
      expect_pixel(map, x, y, hit, scene, normals);
      seen += hit.has_value();
    }
  }
  return seen;
}

}  // namespace fathom::checks
