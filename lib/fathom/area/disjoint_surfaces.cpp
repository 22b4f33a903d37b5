#include "fathom/area/disjoint_surfaces.h"

#include <algorithm>

namespace fathom::area {
using namespace triangle;

namespace {

bool are_same(const Interval& a, const Interval& b) {
  return a.lower == b.lower && a.upper == b.upper;
}

/// Of neighbours in a mesh; enclosures differ nearly always where the points do.
bool are_same(const SurfaceCorner& a, const SurfaceCorner& b) {
  for (std::size_t k = 0; k < 3; ++k) {
    if (!are_same(a.enclosure[k], b.enclosure[k])) return false;
  }
  return a.point == b.point;
}

/// Whether no corner of s is inside an edge of t. Edge k is opposite to corner k.
bool lies_outside(const SurfaceRegion& s, const SurfaceRegion& t, std::size_t k) {
  const ImageForm& edge = t.region[k];
  return std::all_of(s.corners.begin(), s.corners.end(), [&](const SurfaceCorner& corner) {
    const Interval value = edge.enclose_at(corner.enclosure);
    if (value.upper <= 0) return true;
    if (value.lower > 0) return false;
    if (are_same(corner, t.corners[(k + 1) % 3]) || are_same(corner, t.corners[(k + 2) % 3])) {
      return true;
    }
    return dot(edge.coefficients(), corner.point).sign() != Sign::positive;
  });
}

}  // namespace

bool are_disjoint(const SurfaceRegion& s, const SurfaceRegion& t) {
  for (std::size_t k = 0; k < 3; ++k) {
    if (lies_outside(s, t, k) || lies_outside(t, s, k)) return true;
  }
  return false;
}

}  // namespace fathom::area
