#include "fathom/lens/stage.h"

#include <stdexcept>

#include "fathom/numeric/standard_arithmetic.h"

namespace fathom::lens {
namespace {

/// 1 and the numbers, without leading zeroes.
std::vector<double> polynomial(std::initializer_list<double> numbers) {
  std::vector<double> coefficients{1};
  coefficients.insert(coefficients.end(), numbers);
  while (coefficients.back() == 0) coefficients.pop_back();
  return coefficients;
}

}  // namespace

StageNumbers<double> stage_of(const Lens& lens) {
  const StandardArithmetic standard;
  const auto& d = lens.distortion;
  switch (lens.model) {
    case LensModel::simple_pinhole:
    case LensModel::pinhole:
    case LensModel::simple_fisheye:
    case LensModel::fisheye:
      return {{1}, {1}, 0, 0, 0, 0, 0, 0};
    case LensModel::simple_radial:
    case LensModel::radial:
    case LensModel::simple_radial_fisheye:
    case LensModel::radial_fisheye:
      return {polynomial({d[0], d[1]}), {1}, 0, 0, 0, 0, 0, 0};
    case LensModel::opencv:
    case LensModel::full_opencv:
    case LensModel::opencv_14:
      return {polynomial({d[0], d[1], d[4]}),
              polynomial({d[5], d[6], d[7]}),
              d[2],
              d[3],
              d[8],
              d[9],
              d[10],
              d[11]};
    case LensModel::brown:
      return {polynomial({d[0], d[1], d[2], d[3]}), {1}, d[4], d[5], 0, 0, 0, 0};
    case LensModel::opencv_fisheye:
      return {polynomial({d[0], d[1], d[2], d[3]}), {1}, 0, 0, 0, 0, 0, 0};
    case LensModel::thin_prism_fisheye:
      return {polynomial({d[0], d[1], d[4], d[5]}), {1}, d[2], d[3], d[6], 0, d[7], 0};
    case LensModel::simple_division:
    case LensModel::division:
    case LensModel::fisheye_stereographic:
    case LensModel::table:
      break;
  }
  throw std::logic_error("the lens model has no stage");
}

bool is_radial(const StageNumbers<double>& n) {
  const StandardArithmetic standard;
  return n.p1 == 0 && n.p2 == 0 && n.s1 == 0 && n.s2 == 0 && n.s3 == 0 && n.s4 == 0;
}

bool is_identity(const StageNumbers<double>& n) {
  return n.numerator.size() == 1 && n.denominator.size() == 1 && is_radial(n);
}

}  // namespace fathom::lens
