#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>

#include "fathom/geometry/eigen_arrays.h"

/// Vectors of three binary64 numbers. Bounds here hold for sums in any order, which is Eigen's
/// business (docs/validation.md, own_roundings).
namespace fathom::attribution {

using Vector3 = Eigen::Vector3d;

using geometry::as_array;
using geometry::as_matrix;
using geometry::as_vector;

/// Component by component.
inline Vector3 abs(const Vector3& a) {
  return a.cwiseAbs();
}

/// det(a, b, c) with every product taken absolutely: what roundings of a determinant are relative
/// to.
inline double permanent(const Vector3& a, const Vector3& b, const Vector3& c) {
  const Vector3 p = abs(a), q = abs(b), r = abs(c);
  return p[0] * (q[1] * r[2] + q[2] * r[1]) + p[1] * (q[2] * r[0] + q[0] * r[2]) +
         p[2] * (q[0] * r[1] + q[1] * r[0]);
}

}  // namespace fathom::attribution
