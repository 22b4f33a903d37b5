#pragma once

#include <gmpxx.h>

#include <array>
#include <cstdint>
#include <functional>
#include <optional>
#include <vector>

/// The slow answer to what a camera sees: a ray through every pixel centre, in rational numbers,
/// by Cramer's rule, brute force over all triangles. It shares no code with the engines: no edge
/// functions, no homogeneous points, no interpolation of depths, GMP's own rationals.
namespace fathom::oracle {

using Q = mpq_class;
using Vector = std::array<Q, 3>;

struct RayCamera {
  bool perspective = true;
  Q fx, fy, cx, cy, skew, pixel_centre;
  std::array<std::array<Q, 4>, 3> world_to_camera;
  Q near = 0;
  std::optional<Q> far;
  /// Of a lens: the direction that the sample (u, v) sees, in the camera frame, with an error below
  /// 2^−lens_bits of it; none where the sample sees nothing. It takes the place of fx … skew.
  std::function<std::optional<Vector>(const Q& u, const Q& v)> bent;
  /// Whether near and far bound the ray distance.
  bool by_distance = false;
};

/// Values of a bent ray that are smaller than 2^−zero_bits, in scenes of numbers of few bits and
/// their neighbours, are 0: products of two subnormal numbers are greater.
inline constexpr int lens_bits = 3500, zero_bits = 2600;

/// 2^−bits
Q power_of_two_below(int bits);

struct Hit {
  std::uint32_t triangle = 0;
  Q depth;               // z in the camera frame
  Q squared_distance;    // of the ray distance
  Vector position;       // in the world
  Vector normal;         // in the world, any length, towards the camera
  Vector camera_normal;  // in the camera frame, likewise
  Q weight_b, weight_c;
};

/// A triangle's corners in the world.
using Triangle = std::array<Vector, 3>;

class RayCaster {
 public:
  RayCaster(const RayCamera& camera, const std::vector<Triangle>& triangles);
  /// What the ray through the centre of pixel (x, y) meets first.
  [[nodiscard]] std::optional<Hit> cast(int x, int y) const;
  /// Whether the sample of the pixel has a ray.
  [[nodiscard]] bool sees(int x, int y) const;
  /// Number of triangles that the ray meets within the range of depths.
  [[nodiscard]] int count_hits(int x, int y) const;

 private:
  struct Meeting {
    Q depth, weight_b, weight_c;
  };
  [[nodiscard]] std::optional<Meeting> meet(const Triangle& in_camera, int x, int y) const;
  [[nodiscard]] std::optional<Meeting> meet_bent(const Triangle& in_camera, const Vector& d) const;
  [[nodiscard]] std::optional<Hit> cast_bent(const Vector& d) const;
  [[nodiscard]] Vector to_camera(const Vector& world) const;
  [[nodiscard]] Vector to_world(const Vector& in_camera) const;
  void ray(const Q& u, const Q& v, Vector& origin, Vector& direction) const;

  RayCamera camera_;
  std::vector<Triangle> world_;
  std::vector<Triangle> in_camera_;
};

}  // namespace fathom::oracle
