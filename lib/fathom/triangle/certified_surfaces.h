#pragma once

#include <array>
#include <cstdint>

#include "fathom/triangle/double_word_surface.h"
#include "fathom/triangle/projected_triangle.h"
#include "fathom/triangle/recent_triangles.h"

namespace fathom {

/// Depths of numbered triangles at samples, with bounds. One for each thread: it remembers the
/// triangles that it was asked about last.
class CertifiedSurfaces {
 public:
  explicit CertifiedSurfaces(const SceneRays& rays);

  /// D of the triangle's plane at the sample; the error is +∞ where nothing is known.
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
  /// Of A, B, C; errors are +∞ where nothing is known.
  std::array<Certified<double>, 3> weights(std::uint32_t number, const ImagePoint& s);

  const SceneRays& rays_;
  const WideArithmetic& arithmetic_;
  ImageBounds image_;
  RecentTriangles<Triangle, 256> remembered_;
};

}  // namespace fathom
