#include "fathom/rays/hit_values.h"

#include <cmath>
#include <string>

#include "fathom/failures/errors.h"
#include "fathom/numeric/rounding.h"
#include "fathom/numeric/standard_arithmetic.h"
#include "fathom/rays/exact_ray.h"
#include "fathom/threads/threads.h"

namespace fathom {
namespace {

template <class Real>
Real rounded(const Ratio& x) {
  if constexpr (std::is_same_v<Real, float>) {
    return round_to_binary32(x);
  } else {
    return round_to_binary64(x);
  }
}

/// √x with a sign.
template <class Real>
Real rounded_root(const Ratio& x, Sign sign) {
  Real root;
  if constexpr (std::is_same_v<Real, float>) {
    root = round_sqrt_to_binary32(x);
  } else {
    root = round_sqrt_to_binary64(x);
  }
  return sign == Sign::negative ? -root : root;
}

rays::ExactHit exact_hit(const TriangleSource& triangles, const rays::ExactRay& ray,
                         std::uint32_t triangle) {
  auto hit = rays::meet(ray, triangles.world_corners(triangle));
  if (!hit) throw UsageError("the ray does not meet triangle " + std::to_string(triangle));
  return std::move(*hit);
}

}  // namespace

template <class Real>
HitValues<Real> hit_values(const TriangleSource& triangles, const Ray& ray,
                           std::uint32_t triangle) {
  const StandardArithmetic standard;
  const rays::ExactRay exact(ray);
  const rays::ExactHit hit = exact_hit(triangles, exact, triangle);
  HitValues<Real> values;
  values.front_facing = hit.side == Sign::negative;
  values.t = rounded<Real>(hit.t);
  const Ratio squared_length(dot(exact.direction, exact.direction));
  values.distance = rounded_root<Real>(hit.t * hit.t * squared_length, hit.t.sign());
  const Dyadic squared_normal = dot(hit.normal, hit.normal);
  for (std::size_t k = 0; k < 3; ++k) {
    values.position[k] = rounded<Real>(Ratio(exact.origin[k]) + hit.t * Ratio(exact.direction[k]));
    values.normal[k] = rounded_root<Real>(Ratio(hit.normal[k] * hit.normal[k], squared_normal),
                                          -(hit.side * hit.normal[k].sign()));
  }
  for (std::size_t k = 0; k < 2; ++k)
    values.barycentric[k] = rounded<Real>(Ratio(hit.weights[k], hit.divisor));
  return values;
}

template <class Real>
std::vector<HitValues<Real>> hit_values(const TriangleSource& triangles, std::span<const Ray> rays,
                                        std::span<const std::uint32_t> met, int threads) {
  const StandardArithmetic standard;
  std::vector<HitValues<Real>> values(met.size(), values_without_hit<Real>());
  run_with_threads(threads, [&] {
    parallel_for(std::size_t{0}, met.size(), [&](std::size_t i) {
      if (met[i] != no_triangle) values[i] = hit_values<Real>(triangles, rays[i], met[i]);
    });
  });
  return values;
}

template HitValues<float> hit_values(const TriangleSource&, const Ray&, std::uint32_t);
template HitValues<double> hit_values(const TriangleSource&, const Ray&, std::uint32_t);
template std::vector<HitValues<float>> hit_values(const TriangleSource&, std::span<const Ray>,
                                                  std::span<const std::uint32_t>, int);
template std::vector<HitValues<double>> hit_values(const TriangleSource&, std::span<const Ray>,
                                                   std::span<const std::uint32_t>, int);

}  // namespace fathom
