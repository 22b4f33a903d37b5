#pragma once

#include <array>
#include <cstdint>

#include "fathom/area/convex_polygon.h"
#include "fathom/area/plane/sheets.h"
#include "fathom/numeric/exact_words.h"

/// Regular triangles in double-words with bounds, in the coordinates of a part. Exact forms of a
/// triangle take ten times as long, and decide only what the bounds leave open.
namespace fathom::area {

using WordVector = std::array<Words, 3>;

WordVector in_words(const ExactVector3& v);
WordVector cross(const WordVector& a, const WordVector& b);
Words dot(const WordVector& a, const WordVector& b);

/// The edge functions of a regular triangle, each positive at the corner of its number.
std::array<WordVector, 3> edges_in_words(const PlaneMesh& mesh, std::uint32_t triangle,
                                         const PlanePart& part);

/// The depth of a regular triangle. It is a quotient n/w: n is constant for a perspective camera, w
/// for an orthographic camera, and the other one is affine in (u, v). Both are positive.
///
/// Does not decide ties: its signs are certain or unknown. in_front() of two surfaces is exact.
class DepthPlane {
 public:
  /// Needs    a regular triangle.
  DepthPlane(const PlaneMesh& mesh, std::uint32_t triangle, const PlanePart& part);

  /// The sign of in_front() of the surfaces of s and t at a place; zero if it is not certain.
  class Comparison {
   public:
    Comparison(const DepthPlane& s, const DepthPlane& t);
    [[nodiscard]] Sign sign_at(const CertifiedPoint& place) const;

   private:
    std::array<Certified<double>, 3> form_;
  };

 private:
  bool is_perspective_;
  std::array<Words, 3> affine_;
  Words constant_;
};

}  // namespace fathom::area
