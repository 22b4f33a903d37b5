#pragma once

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <random>
#include <sstream>
#include <string>

#include "fathom/camera/camera.h"
#include "fathom/numeric/rounding.h"

/// The imports are held to the projection formula of each program's own convention, written out
/// in long double without a matrix of ours.
namespace fathom::test {

using Real = long double;
using Vector = std::array<Real, 3>;

/// Where a point lands: image position with (0, 0) in the top left corner, and depth.
struct Seen {
  Real u = 0, v = 0, depth = 0;
};

inline Seen seen(const Camera& camera, const Vector& X) {
  const auto exact = [](Real x) { return Dyadic(static_cast<double>(x)); };
  const CameraPoint p = to_camera(camera.world_to_camera, {exact(X[0]), exact(X[1]), exact(X[2])});
  const auto [U, V, W] = to_image(camera.projection, p);
  return {round_to_binary64(Ratio(U, W)), round_to_binary64(Ratio(V, W)),
          round_to_binary64(Ratio(p.z))};
}

/// Entries of ours are rounded once, by 2⁻⁵³ of themselves; coordinates and translations are below
/// 100, focal lengths and pixels below 2000, depths above 1. A point in the camera frame then errs
/// by less than 4·100·2⁻⁵³ < 1e-13 and a pixel by less than 2000·1e-13·(1 + 100) < 1e-7·½.
inline void expect_same(const Seen& ours, const Seen& theirs) {
  ASSERT_GT(theirs.depth, 1);
  ASSERT_NEAR(static_cast<double>(ours.u), static_cast<double>(theirs.u), 1e-7);
  ASSERT_NEAR(static_cast<double>(ours.v), static_cast<double>(theirs.v), 1e-7);
  ASSERT_NEAR(static_cast<double>(ours.depth), static_cast<double>(theirs.depth), 1e-12);
}

class Draws {
 public:
  explicit Draws(unsigned seed) : random_(seed) {}
  /// With few digits, so that it stands in a text as it is.
  double operator()(double from, double to) {
    return std::round(std::uniform_real_distribution<double>(from, to)(random_) * 1024) / 1024;
  }
  Vector point(double size) {
    return {(*this)(-size, size), (*this)(-size, size), (*this)(-size, size)};
  }

 private:
  std::mt19937 random_;
};

/// v turned by the quaternion q: q·v·q⁻¹ with Hamilton's product, no matrix.
inline Vector turned(const std::array<Real, 4>& q, const Vector& v) {
  using Q = std::array<Real, 4>;
  const auto times = [](const Q& a, const Q& b) {
    return Q{a[0] * b[0] - a[1] * b[1] - a[2] * b[2] - a[3] * b[3],
             a[0] * b[1] + a[1] * b[0] + a[2] * b[3] - a[3] * b[2],
             a[0] * b[2] - a[1] * b[3] + a[2] * b[0] + a[3] * b[1],
             a[0] * b[3] + a[1] * b[2] - a[2] * b[1] + a[3] * b[0]};
  };
  const Real n = q[0] * q[0] + q[1] * q[1] + q[2] * q[2] + q[3] * q[3];
  const Q r = times(times(q, {0, v[0], v[1], v[2]}), {q[0] / n, -q[1] / n, -q[2] / n, -q[3] / n});
  return {r[1], r[2], r[3]};
}

inline std::string text_of(double x) {
  std::ostringstream out;
  out.precision(17);
  out << x;
  return out.str();
}

template <class List>
std::string joined(const List& list, const char* separator) {
  std::ostringstream out;
  out.precision(17);
  const char* before = "";
  for (const auto x : list) {
    out << before << static_cast<double>(x);
    before = separator;
  }
  return out.str();
}

}  // namespace fathom::test
