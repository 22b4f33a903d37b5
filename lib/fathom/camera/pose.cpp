#include "fathom/camera/pose.h"

#include "fathom/numeric/rounding.h"

namespace fathom::camera {

std::array<double, 3> unit_vector(const ExactVector3& v) {
  const Dyadic squared_length = dot(v, v);
  // vᵢ/|v| = ±√(vᵢ²/v·v): one square root of a rational, rounded once.
  const auto entry = [&](int i) {
    const double magnitude = round_sqrt_to_binary64(Ratio(v[i] * v[i], squared_length));
    return v[i].sign() == Sign::negative ? -magnitude : magnitude;
  };
  return {entry(0), entry(1), entry(2)};
}

ExactVector3 rotate(const Matrix3& R, const ExactVector3& X) {
  const auto row = [&](int i) { return dot(ExactVector3{R[i][0], R[i][1], R[i][2]}, X); };
  return {row(0), row(1), row(2)};
}

Matrix34 pose_that_takes(const Matrix3& R, const ExactVector3& X, const ExactVector3& target) {
  const ExactVector3 rotated = rotate(R, X);
  Matrix34 pose;
  for (int i = 0; i < 3; ++i)
    pose[i] = {R[i][0], R[i][1], R[i][2], round_to_binary64(Ratio(target[i] - rotated[i]))};
  return pose;
}

}  // namespace fathom::camera
