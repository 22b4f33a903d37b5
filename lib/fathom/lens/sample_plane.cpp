#include "fathom/lens/sample_plane.h"

#include <utility>

#include "fathom/numeric/standard_arithmetic.h"
#include "fathom/numeric/transcendental.h"

namespace fathom::lens {

SamplePlane::SamplePlane(const Projection& projection)
    : centre_(exact_principal_point(projection)),
      fx_(projection.fx),
      fy_(projection.fy),
      skew_(projection.skew),
      c_(fx_ * fy_) {}

// With U = u − cx', V = v − cy': y_d = V/fy and x_d = (U − skew·y_d)/fx = (U·fy − skew·V)/(fx·fy).
DistortedPoint SamplePlane::at(const Dyadic& u, const Dyadic& v) const {
  const Dyadic U = u - centre_.x, V = v - centre_.y;
  DistortedPoint point{U * fy_ - skew_ * V, V * fx_, c_};
  if (c_.sign() == Sign::negative) point = {-point.a, -point.b, -point.c};
  return point;
}

namespace {

constexpr long grid_bits = 128;

using Matrix = std::array<ExactVector3, 3>;

Matrix transposed(const Matrix& m) {
  return {ExactVector3{m[0][0], m[1][0], m[2][0]}, ExactVector3{m[0][1], m[1][1], m[2][1]},
          ExactVector3{m[0][2], m[1][2], m[2][2]}};
}

Matrix operator*(const Matrix& a, const Matrix& b) {
  const Matrix columns = transposed(b);
  Matrix product;
  for (std::size_t i = 0; i < 3; ++i)
    for (std::size_t j = 0; j < 3; ++j) product[i][j] = dot(a[i], columns[j]);
  return product;
}

ExactVector3 operator*(const Matrix& m, const ExactVector3& v) {
  return {dot(m[0], v), dot(m[1], v), dot(m[2], v)};
}

Matrix tilt_matrix(double tau_x, double tau_y) {
  const Dyadic sin_x = sine_on_grid(tau_x, grid_bits), cos_x = cosine_on_grid(tau_x, grid_bits);
  const Dyadic sin_y = sine_on_grid(tau_y, grid_bits), cos_y = cosine_on_grid(tau_y, grid_bits);
  const Dyadic zero, one = 1.0;
  const Matrix about_y{ExactVector3{cos_y, zero, -sin_y}, ExactVector3{zero, one, zero},
                       ExactVector3{sin_y, zero, cos_y}};
  const Matrix about_x{ExactVector3{one, zero, zero}, ExactVector3{zero, cos_x, sin_x},
                       ExactVector3{zero, -sin_x, cos_x}};
  const Matrix R = about_y * about_x;
  const Matrix projection{ExactVector3{R[2][2], zero, -R[0][2]},
                          ExactVector3{zero, R[2][2], -R[1][2]}, ExactVector3{zero, zero, one}};
  return projection * R;
}

}  // namespace

// The determinant of M is positive, so the adjugate is a positive multiple of the inverse: it is
// R₃₃² times that of R, (sin²τx + cos²τx)·(sin²τy + cos²τy) with the rounded numbers. R₃₃, the
// product of the cosines, is not 0: no binary64 number is so near π/2 that its cosine is below
// 2⁻¹²⁸.
Tilt::Tilt(double tau_x, double tau_y) {
  const StandardArithmetic standard;
  matrix_ = tilt_matrix(tau_x, tau_y);
  adjugate_ = transposed(cofactors(matrix_));
}

std::optional<Tilt> Tilt::of(const Lens& lens) {
  const StandardArithmetic standard;
  const double tau_x = lens.distortion[12], tau_y = lens.distortion[13];
  if (lens.model != LensModel::opencv_14 || (tau_x == 0 && tau_y == 0)) return std::nullopt;
  return Tilt(tau_x, tau_y);
}

std::optional<DistortedPoint> Tilt::undone(const DistortedPoint& point) const {
  auto [a, b, c] = inverse_times(ExactVector3{point.a, point.b, point.c});
  if (c.sign() != Sign::positive) return std::nullopt;
  return DistortedPoint{std::move(a), std::move(b), std::move(c)};
}

ExactVector3 Tilt::inverse_times(const ExactVector3& point) const {
  return adjugate_ * point;
}

}  // namespace fathom::lens
