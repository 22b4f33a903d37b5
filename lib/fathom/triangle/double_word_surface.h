#pragma once

#include <array>
#include <cstdint>

#include "fathom/triangle/certified_surface.h"
#include "fathom/triangle/projected_triangle.h"
#include "fathom/triangle/recent_triangles.h"

namespace fathom::triangle {

/// Length of a sample's ray in the camera frame, √(x² + y² + 1): x and y err by 4ε times the sums X
/// and Y of the magnitudes of their terms, their squares by 9ε, the sum by 11ε(X² + Y² + 1); it is
/// at least 1, so the root halves that, and rounds once.
template <class Real>
Certified<Real> ray_length(const SceneRays& rays, const ImagePoint& s) {
  const auto coordinate = [&](const std::array<WordPair, 3>& k) {
    return (entry<Real>(k[2]) + entry<Real>(k[1]) * s.v) + entry<Real>(k[0]) * s.u;
  };
  const Real x = coordinate(rays.lens()[0]), y = coordinate(rays.lens()[1]);
  const Real length = square_root((x * x + y * y) + Real(1.0));
  return {length,
          epsilon<Real> *
              (surface_bounds::ray_length * rays.lens_size() + 1 + std::abs(nearest(length))) *
              slack};
}

/// The point of depth D on the ray of a sample, o + d·D. o and d err by 4ε of their sizes ō and d̄,
/// so the point errs by 5ε·d̄·|D̂| + d̄·E_D + 4ε·ō for its terms and by ε for the sum. A coordinate
/// whose terms are all 0 is exactly 0.
template <class Real>
Vector<Certified<Real>> position(const Rays& rays, const RaySizes& sizes, bool perspective,
                                 const ImagePoint& s, const Certified<Real>& depth) {
  const Ray<Real> ray = ray_at<Real>(rays, perspective, s);
  const double D_size = std::abs(nearest(depth.value));
  Vector<Certified<Real>> point;
  for (std::size_t i = 0; i < 3; ++i) {
    if (sizes.origin[i] == 0 && sizes.direction[i] == 0) {
      point[i] = {Real(0.0), 0};
      continue;
    }
    const double size = sizes.origin[i] + sizes.direction[i] * D_size;
    const double error =
        surface_bounds::position * epsilon<Real> * size + sizes.direction[i] * depth.error;
    point[i] = {ray.origin[i] + ray.direction[i] * depth.value, (error + most_underflow) * slack};
  }
  return point;
}

/// The double-word tier of certified_surface.h, compiled with and without fused multiply-adds.
/// Results may differ in their last bits; the bounds hold for both.
struct WideArithmetic {
  DepthForms<WordPair> (*depth_forms)(const MeshTriangle&, const Rays&, const ImageBounds&);
  Certified<WordPair> (*depth)(const DepthForms<WordPair>&, const ImagePoint&, bool perspective);
  Certified<WordPair> (*distance)(const Certified<WordPair>& depth, const SceneRays&,
                                  const ImagePoint&);
  Vector<Certified<WordPair>> (*position)(const Rays&, const RaySizes&, bool perspective,
                                          const ImagePoint&, const Certified<WordPair>& depth);
  WeightForms<WordPair> (*weight_forms)(const MeshTriangle&, const Rays&, const ImageBounds&);
  std::array<Certified<WordPair>, 2> (*weights)(const MeshTriangle&, const Rays&,
                                                const ImageBounds&, const ImagePoint&);
  Vector<Certified<WordPair>> (*normal)(const MeshTriangle&, const ObjectRays& object,
                                        const ObjectRays& world, const ImageBounds&,
                                        const ImagePoint&);
  Vector<Certified<WordPair>> (*camera_normal)(const MeshTriangle&, const ObjectRays& object,
                                               const ObjectRays& world, const ImageBounds&,
                                               const ImagePoint&, Sign handedness);
};

extern const WideArithmetic wide_without_fma;
/// Runs on every processor; slow on one without the instruction.
extern const WideArithmetic wide_with_fma;
/// The arithmetic for this processor.
const WideArithmetic& wide_arithmetic();

/// Depths of numbered triangles at samples, with bounds. One for each thread, because it caches the
/// triangles that it used last.
class CertifiedSurfaces {
 public:
  explicit CertifiedSurfaces(const SceneRays& rays);

  /// D of the triangle's plane at the sample; the error is +∞ if D is unknown.
  Certified<double> depth(std::uint32_t number, const ImagePoint& s);
  Certified<WordPair> wide_depth(std::uint32_t number, const ImagePoint& s);
  /// True only if the triangle certainly does not cover the sample, or certainly not with D > 0.
  bool certainly_misses(std::uint32_t number, const ImagePoint& s);
  /// True only if the triangle certainly covers the sample where D > 0 there.
  bool certainly_covers(std::uint32_t number, const ImagePoint& s);

 private:
  struct Triangle {
    bool usable = false, has_wide = false, has_weights = false;
    const ObjectRays* object = nullptr;
    MeshTriangle corners;
    DepthForms<double> depth;
    DepthForms<WordPair> wide;
    WeightForms<double> weights;
  };
  Triangle& remember(std::uint32_t number);
  /// The weights of A, B and C; errors are +∞ if they are unknown.
  std::array<Certified<double>, 3> weights(std::uint32_t number, const ImagePoint& s);

  const SceneRays& rays_;
  const WideArithmetic& arithmetic_;
  ImageBounds image_;
  RecentTriangles<Triangle, 256> remembered_;
};

}  // namespace fathom::triangle
