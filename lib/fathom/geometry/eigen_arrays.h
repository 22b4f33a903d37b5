#pragma once

#include <Eigen/Core>
#include <array>
#include <cstddef>

#include "fathom/geometry/frames.h"
#include "fathom/numeric/rounding.h"

/// Arrays, which public types are made of, as Eigen's vectors and matrices. Only for .cpp files and
/// headers that are not installed, of targets that link fathom_linear_algebra: users have
/// eigen_conversions.h.
namespace fathom::geometry {

inline Eigen::Vector3d as_vector(const std::array<double, 3>& a) {
  return Eigen::Vector3d(a.data());
}

inline std::array<double, 3> as_array(const Eigen::Vector3d& a) {
  return {a.x(), a.y(), a.z()};
}

/// a · b, summed from the left; a.dot(b) adds x to the sum of y and z. For signs of sums that are 0
/// except for rounding: pictures and counts that depend on them do not change.
inline double dot_from_left(const Eigen::Vector3d& a, const Eigen::Vector3d& b) {
  const Eigen::Vector3d terms = a.cwiseProduct(b);
  return terms.x() + terms.y() + terms.z();
}

/// A matrix given by its rows.
template <class Real, std::size_t rows, std::size_t columns>
using RowMatrix =
    Eigen::Matrix<Real, static_cast<int>(rows), static_cast<int>(columns), Eigen::RowMajor>;

/// The matrix where it is: it lasts as long as the array.
template <class Real, std::size_t rows, std::size_t columns>
Eigen::Map<const RowMatrix<Real, rows, columns>> as_matrix(
    const std::array<std::array<Real, columns>, rows>& a) {
  static_assert(sizeof(a) == sizeof(Real) * rows * columns);
  return Eigen::Map<const RowMatrix<Real, rows, columns>>(a.front().data());
}
template <class Real, std::size_t rows, std::size_t columns>
Eigen::Map<RowMatrix<Real, rows, columns>> as_matrix(
    std::array<std::array<Real, columns>, rows>& a) {
  static_assert(sizeof(a) == sizeof(Real) * rows * columns);
  return Eigen::Map<RowMatrix<Real, rows, columns>>(a.front().data());
}

/// An exact map, each entry rounded once.
template <class Target, class Source>
RowMatrix<double, 3, 4> rounded(const ExactAffine<Target, Source>& map) {
  RowMatrix<double, 3, 4> m;
  for (std::size_t i = 0; i < 3; ++i)
    for (std::size_t k = 0; k < 4; ++k)
      m(static_cast<Eigen::Index>(i), static_cast<Eigen::Index>(k)) =
          round_to_binary64(map.rows[i][k]);
  return m;
}

}  // namespace fathom::geometry
