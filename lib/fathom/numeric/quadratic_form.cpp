#include "fathom/numeric/quadratic_form.h"

#include <utility>

namespace fathom {
namespace {

/// The pairs of coordinates in the order of the coefficients.
constexpr std::array<std::array<std::size_t, 2>, 6> pairs{
    {{0, 0}, {1, 1}, {2, 2}, {0, 1}, {0, 2}, {1, 2}}};

}  // namespace

QuadraticForm& QuadraticForm::operator+=(const QuadraticForm& other) {
  for (std::size_t k = 0; k < pairs.size(); ++k) coefficients[k] += other.coefficients[k];
  return *this;
}

QuadraticForm& QuadraticForm::operator-=(const QuadraticForm& other) {
  for (std::size_t k = 0; k < pairs.size(); ++k) coefficients[k] -= other.coefficients[k];
  return *this;
}

QuadraticForm operator*(const Dyadic& factor, QuadraticForm form) {
  for (Dyadic& coefficient : form.coefficients) coefficient *= factor;
  return form;
}

Dyadic QuadraticForm::at(const ExactVector3& d) const {
  Dyadic sum;
  for (std::size_t k = 0; k < pairs.size(); ++k) {
    sum += coefficients[k] * d[pairs[k][0]] * d[pairs[k][1]];
  }
  return sum;
}

QuadraticForm square_of(const ExactVector3& l) {
  QuadraticForm form;
  for (std::size_t k = 0; k < pairs.size(); ++k) {
    const auto& [i, j] = pairs[k];
    const Dyadic product = l[i] * l[j];
    form.coefficients[k] = i == j ? product : product.scaled(1);
  }
  return form;
}

QuadraticForm squared_length() {
  QuadraticForm form;
  for (std::size_t k = 0; k < 3; ++k) form.coefficients[k] = 1.0;
  return form;
}

}  // namespace fathom
