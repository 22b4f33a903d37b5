#include "fathom/camera/pose.h"

#include "fathom/failures/errors.h"
#include "fathom/numeric/certified.h"
#include "fathom/numeric/rounding.h"
#include "fathom/numeric/standard_arithmetic.h"

namespace fathom {

Dyadic determinant_of_rotation(const Pose& pose) {
  const auto row = [&](int i) { return ExactVector3{pose[i][0], pose[i][1], pose[i][2]}; };
  return determinant(row(0), row(1), row(2));
}

CameraPoint to_camera(const Pose& world_to_camera, const WorldPoint& X) {
  const auto row = [&](int i) {
    const auto& [r0, r1, r2, t] = world_to_camera[i];
    return r0 * X.x + r1 * X.y + r2 * X.z + t;
  };
  return {row(0), row(1), row(2)};
}

Pose camera_to_world(const Pose& world_to_camera) {
  const StandardArithmetic standard;
  const auto inverse = camera::inverse(world_to_camera);
  if (!inverse) throw InputError("the camera cannot be inverted: its matrix is singular");
  return *inverse;
}

}  // namespace fathom

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

namespace {

/// The rotation of a quaternion times n, the square of its length.
struct ScaledRotation {
  std::array<ExactVector3, 3> rows;
  Dyadic n;
};

ScaledRotation scaled_rotation_of(const std::array<double, 4>& quaternion) {
  const Dyadic w = quaternion[0], x = quaternion[1], y = quaternion[2], z = quaternion[3];
  const auto twice = [](const Dyadic& a) { return a + a; };
  return {{{{w * w + x * x - y * y - z * z, twice(x * y - w * z), twice(x * z + w * y)},
            {twice(x * y + w * z), w * w - x * x + y * y - z * z, twice(y * z - w * x)},
            {twice(x * z - w * y), twice(y * z + w * x), w * w - x * x - y * y + z * z}}},
          w * w + x * x + y * y + z * z};
}

}  // namespace

Matrix3 rotation_of(const std::array<double, 4>& quaternion) {
  const auto [rows, n] = scaled_rotation_of(quaternion);
  Matrix3 R;
  for (int i = 0; i < 3; ++i)
    for (int k = 0; k < 3; ++k) R[i][k] = round_to_binary64(Ratio(rows[i][k], n));
  return R;
}

ExactPose exact_view_from(const ExactVector3& eye, const std::array<double, 4>& quaternion) {
  const auto [rows, n] = scaled_rotation_of(quaternion);
  ExactPose view;
  for (int i = 0; i < 3; ++i) {
    const ExactVector3 column{rows[0][i], rows[1][i], rows[2][i]};
    view[i] = {Ratio(column[0], n), Ratio(column[1], n), Ratio(column[2], n),
               Ratio(-dot(column, eye), n)};
  }
  return view;
}

Pose view_from(const ExactVector3& eye, const std::array<double, 4>& quaternion) {
  return rounded_pose(exact_view_from(eye, quaternion));
}

namespace {

/// x/over·√of = ±√(of·x²/over²), rounded once.
double times_root(const Dyadic& x, const Dyadic& over, const Dyadic& of) {
  const double magnitude = round_sqrt_to_binary64(Ratio(of * x * x, over * over));
  return x.sign() * over.sign() == Sign::negative ? -magnitude : magnitude;
}

ExactVector3 opposite(const ExactVector3& v) {
  return {-v[0], -v[1], -v[2]};
}

}  // namespace

// The camera's axes (right, down, forward) are the columns c of a matrix C, scaled to length 1. The
// inverse of [c₀/|c₀| … | eye] has the rows |cᵢ|·(C⁻¹)ᵢ and −|cᵢ|·(C⁻¹)ᵢ·eye; the rows of the
// adjugate of C are the cross products of its columns.
std::optional<Pose> view_along(const std::array<ExactVector3, 3>& axes, const ExactVector3& eye) {
  const std::array<ExactVector3, 3> c{axes[0], opposite(axes[1]), opposite(axes[2])};
  const Dyadic det = determinant(c[0], c[1], c[2]);
  if (det.is_zero()) return std::nullopt;
  const std::array<ExactVector3, 3> adjugate = cofactors(c);
  Pose view;
  for (std::size_t i = 0; i < 3; ++i) {
    const Dyadic squared_length = dot(c[i], c[i]);
    for (std::size_t k = 0; k < 3; ++k)
      view[i][k] = times_root(adjugate[i][k], det, squared_length);
    view[i][3] = times_root(-dot(adjugate[i], eye), det, squared_length);
  }
  return view;
}

ExactVector3 rotate(const Matrix3& R, const ExactVector3& X) {
  const auto row = [&](int i) { return dot(ExactVector3{R[i][0], R[i][1], R[i][2]}, X); };
  return {row(0), row(1), row(2)};
}

Pose pose_that_takes(const Matrix3& R, const ExactVector3& X, const ExactVector3& target) {
  const ExactVector3 rotated = rotate(R, X);
  Pose pose;
  for (int i = 0; i < 3; ++i)
    pose[i] = {R[i][0], R[i][1], R[i][2], round_to_binary64(Ratio(target[i] - rotated[i]))};
  return pose;
}

// The rows of the adjugate are the cross products of the columns of A.
Adjugate adjugate(const Pose& pose) {
  const auto column = [&](std::size_t k) {
    return ExactVector3{pose[0][k], pose[1][k], pose[2][k]};
  };
  const ExactVector3 a0 = column(0), a1 = column(1), a2 = column(2);
  return {{cross(a1, a2), cross(a2, a0), cross(a0, a1)}, determinant(a0, a1, a2), column(3)};
}

ExactPose exact_pose(const Pose& pose) {
  ExactPose exact;
  for (std::size_t i = 0; i < 3; ++i)
    for (std::size_t k = 0; k < 4; ++k) exact[i][k] = Ratio(Dyadic(pose[i][k]));
  return exact;
}

Pose rounded_pose(const ExactPose& pose) {
  Pose rounded;
  for (std::size_t i = 0; i < 3; ++i)
    for (std::size_t k = 0; k < 4; ++k) rounded[i][k] = round_to_binary64(pose[i][k]);
  return rounded;
}

ExactPose composed(const ExactPose& second, const ExactPose& first) {
  ExactPose product;
  for (std::size_t i = 0; i < 3; ++i)
    for (std::size_t k = 0; k < 4; ++k) {
      Ratio sum = k == 3 ? second[i][3] : Ratio();
      for (std::size_t j = 0; j < 3; ++j) sum = sum + second[i][j] * first[j][k];
      product[i][k] = sum;
    }
  return product;
}

std::optional<ExactPose> exact_inverse(const Pose& pose) {
  const auto [rows, det, b] = adjugate(pose);
  if (det.is_zero()) return std::nullopt;
  ExactPose inverse;
  for (std::size_t i = 0; i < 3; ++i)
    inverse[i] = {Ratio(rows[i][0], det), Ratio(rows[i][1], det), Ratio(rows[i][2], det),
                  Ratio(-dot(rows[i], b), det)};
  return inverse;
}

std::optional<Pose> inverse(const Pose& pose) {
  const auto exact = exact_inverse(pose);
  return exact ? std::optional(rounded_pose(*exact)) : std::nullopt;
}

}  // namespace fathom::camera
