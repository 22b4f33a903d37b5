#pragma once

#include <cstdint>
#include <optional>

#include "fathom/triangle/double_word_surface.h"
#include "fathom/triangle/projected_triangle.h"
#include "fathom/triangle/rays.h"
#include "fathom/triangle/recent_triangles.h"

namespace fathom::triangle {

/// A triangle under a perspective camera in double-words: the forms of its weights of B and C and
/// of D (certified_surface.h), for the samples of the image and up to `beyond` outside it.
struct WideForms {
  static constexpr double beyond = 8;
  WeightForms<WordPair> weights;
  /// D = constant / weights.divisor.
  Certified<WordPair> constant;
  /// Bounds on the coordinates of these samples.
  double u, v;
};

/// Settles decisions in double-words that binary64 left open: the tier before exact numbers.
/// nullopt means "unknown". One for each thread, because it caches the triangles that it used last.
class WideReferee {
 public:
  explicit WideReferee(const SceneRays& rays);

  /// Whether the triangle covers the sample, if that is certain without the top-left rule.
  std::optional<bool> covers(std::uint32_t number, const ImagePoint& s);
  /// nullopt also under an orthographic camera.
  std::optional<WideForms> forms(std::uint32_t number);
  /// −1 or 1 if D is certainly less or greater than `limit` at a sample that the triangle covers.
  std::optional<int> compare_depth(std::uint32_t number, const ImagePoint& s, double limit);
  /// −1 or 1 if D of `a` is certainly less or greater than D of `b` at a sample that both cover.
  std::optional<int> compare_depths(std::uint32_t a, std::uint32_t b, const ImagePoint& s);
  /// Returns true only if both triangles certainly lie in one plane, so that they have the same D.
  bool lie_in_one_plane(std::uint32_t a, std::uint32_t b);

 private:
  struct Triangle {
    bool usable = false, has_depth = false;
    std::uint32_t object_number = 0;
    const ObjectRays* object = nullptr;
    MeshTriangle corners;
    DepthForms<WordPair> depth;
  };
  Triangle& remember(std::uint32_t number);
  Certified<WordPair> depth_at(std::uint32_t number, const ImagePoint& s);

  const SceneRays& rays_;
  const WideArithmetic& wide_;
  ImageBounds image_;
  RecentTriangles<Triangle, 256> remembered_;
};

/// Returns true only if the six points certainly lie in one plane: all points of one triangle are
/// points of the other, or the coordinates have so few bits that the test is exact. False means
/// "unknown".
bool certainly_coplanar(const MeshTriangle& a, const MeshTriangle& b);

}  // namespace fathom::triangle
