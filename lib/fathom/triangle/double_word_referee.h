#pragma once

#include <cstdint>
#include <optional>

#include "fathom/triangle/double_word_surface.h"
#include "fathom/triangle/projected_triangle.h"
#include "fathom/triangle/rays.h"
#include "fathom/triangle/recent_triangles.h"

namespace fathom::triangle {

/// A triangle under a perspective camera in double-words: what its weights of B and C and D are
/// made of (certified_surface.h), at the samples of the image and up to `beyond` beyond them.
struct WideForms {
  static constexpr double beyond = 8;
  WeightForms<WordPair> weights;
  /// D is this over weights.divisor.
  Certified<WordPair> constant;
  /// What bounds the coordinates of those samples.
  double u, v;
};

/// Settles with double-words what binary64 did not: the tier before exact numbers. nullopt: not
/// known. One for each thread: it remembers the triangles that it was asked about last.
class WideReferee {
 public:
  explicit WideReferee(const SceneRays& rays);

  /// Whether the triangle covers the sample, if that is certain without the top-left rule.
  std::optional<bool> covers(std::uint32_t number, const ImagePoint& s);
  /// nullopt also under an orthographic camera.
  std::optional<WideForms> forms(std::uint32_t number);
  /// −1 or 1 if D, at a sample that the triangle covers, is certainly less or greater than `limit`.
  std::optional<int> compare_depth(std::uint32_t number, const ImagePoint& s, double limit);
  /// −1 or 1 if D of `a`, at a sample that both cover, is certainly less or greater than D of `b`.
  std::optional<int> compare_depths(std::uint32_t a, std::uint32_t b, const ImagePoint& s);
  /// True only if both triangles certainly lie in one plane, so that they have the same D.
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

/// True only if the six points certainly lie in one plane: all points of one triangle are points of
/// the other, or the coordinates have so few bits that it can be computed. False: nothing is known.
bool certainly_coplanar(const MeshTriangle& a, const MeshTriangle& b);

}  // namespace fathom::triangle
