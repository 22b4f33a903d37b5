// Eigen as our targets compile it: sums have one order and no product is fused with one, whatever
// the compiler is told of the machine. Run this with -DCMAKE_CXX_FLAGS=-march=native too.
#include <gtest/gtest.h>

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <cmath>
#include <random>
#include <type_traits>

#include "fathom/geometry/eigen_arrays.h"

namespace fathom::geometry {
namespace {

// Not the Eigen of a program that links us.
static_assert(std::is_same_v<Eigen::Vector3d, fathom_eigen::Vector3d>);

class Draws {
 public:
  double operator()() { return std::ldexp(static_cast<double>(random_() >> 11), -52) - 1; }
  template <class Matrix>
  Matrix matrix() {
    Matrix m;
    for (Eigen::Index i = 0; i < m.rows(); ++i)
      for (Eigen::Index k = 0; k < m.cols(); ++k)
        m(i, k) = static_cast<typename Matrix::Scalar>((*this)());
    return m;
  }

 private:
  std::mt19937_64 random_{331};
};

template <class Real>
Real sum_of_three(Real a, Real b, Real c) {
  return a + (b + c);
}
template <class Real>
Real sum_of_four(Real a, Real b, Real c, Real d) {
  return (a + b) + (c + d);
}

template <class Real>
void expect_one_order() {
  using Vector3 = Eigen::Matrix<Real, 3, 1>;
  using Matrix3 = Eigen::Matrix<Real, 3, 3>;
  Draws draws;
  for (int n = 0; n < 1000; ++n) {
    const auto a = draws.matrix<Vector3>(), b = draws.matrix<Vector3>();
    ASSERT_EQ(a.dot(b), sum_of_three<Real>(a[0] * b[0], a[1] * b[1], a[2] * b[2]));
    ASSERT_EQ(a.squaredNorm(), sum_of_three<Real>(a[0] * a[0], a[1] * a[1], a[2] * a[2]));
    const Vector3 c = a.cross(b);
    ASSERT_EQ(c[0], a[1] * b[2] - a[2] * b[1]);
    const auto M = draws.matrix<Matrix3>(), N = draws.matrix<Matrix3>();
    const Vector3 p = M * a;
    const Matrix3 P = M * N;
    const auto A = draws.matrix<Eigen::Matrix<Real, 4, 4>>();
    const auto B = draws.matrix<RowMatrix<Real, 3, 4>>();
    const auto q = draws.matrix<Eigen::Matrix<Real, 4, 1>>();
    const Eigen::Matrix<Real, 4, 1> Aq = A * q;
    const Vector3 Bq = B * q;
    for (Eigen::Index i = 0; i < 3; ++i) {
      ASSERT_EQ(p[i], sum_of_three<Real>(M(i, 0) * a[0], M(i, 1) * a[1], M(i, 2) * a[2]));
      ASSERT_EQ(P(i, 1),
                sum_of_three<Real>(M(i, 0) * N(0, 1), M(i, 1) * N(1, 1), M(i, 2) * N(2, 1)));
      ASSERT_EQ(Aq[i],
                sum_of_four<Real>(A(i, 0) * q[0], A(i, 1) * q[1], A(i, 2) * q[2], A(i, 3) * q[3]));
      ASSERT_EQ(Bq[i],
                sum_of_four<Real>(B(i, 0) * q[0], B(i, 1) * q[1], B(i, 2) * q[2], B(i, 3) * q[3]));
    }
  }
}

TEST(LinearAlgebra, SumsHaveOneOrderAndAreNotFused) {
  expect_one_order<double>();
  expect_one_order<float>();
}

TEST(EigenArrays, MatricesAreTheArraysThemselves) {
  std::array<std::array<double, 4>, 3> rows{{{1, 2, 3, 4}, {5, 6, 7, 8}, {9, 10, 11, 12}}};
  const auto& same = rows;
  EXPECT_EQ(as_matrix(same).data(), rows[0].data());
  EXPECT_EQ(as_matrix(same)(1, 3), 8);
  EXPECT_EQ(as_matrix(same).rows(), 3);
  as_matrix(rows).col(3) = Eigen::Vector3d(-1, -2, -3);
  EXPECT_EQ(rows[2][3], -3);
  EXPECT_EQ(rows[2][2], 11);
}

TEST(EigenArrays, VectorsComeBackAsTheyWere) {
  const std::array<double, 3> v{-0.0, 0x1p-1074, 1e300};
  EXPECT_EQ(as_array(as_vector(v)), v);
  EXPECT_TRUE(std::signbit(as_array(as_vector(v))[0]));
}

}  // namespace
}  // namespace fathom::geometry
