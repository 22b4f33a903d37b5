#pragma once

#include <array>
#include <cmath>

/// Vectors of three binary64 numbers.
namespace fathom::attribution {

using Vector3 = std::array<double, 3>;

inline Vector3 operator-(const Vector3& a, const Vector3& b) {
  return {a[0] - b[0], a[1] - b[1], a[2] - b[2]};
}

inline Vector3 operator+(const Vector3& a, const Vector3& b) {
  return {a[0] + b[0], a[1] + b[1], a[2] + b[2]};
}

inline Vector3 operator*(double s, const Vector3& a) {
  return {s * a[0], s * a[1], s * a[2]};
}

inline Vector3 cross(const Vector3& a, const Vector3& b) {
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}

inline double dot(const Vector3& a, const Vector3& b) {
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

/// Component by component.
inline Vector3 abs(const Vector3& a) {
  return {std::abs(a[0]), std::abs(a[1]), std::abs(a[2])};
}

/// det(a, b, c) with every product taken absolutely: what roundings of a determinant are relative
/// to.
inline double permanent(const Vector3& a, const Vector3& b, const Vector3& c) {
  const Vector3 p = abs(a), q = abs(b), r = abs(c);
  return p[0] * (q[1] * r[2] + q[2] * r[1]) + p[1] * (q[2] * r[0] + q[0] * r[2]) +
         p[2] * (q[0] * r[1] + q[1] * r[0]);
}

}  // namespace fathom::attribution
