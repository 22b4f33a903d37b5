#include "fathom/camera/lens.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "fathom/numeric/standard_arithmetic.h"

namespace fathom {
namespace {

bool is_tilt(std::string_view parameter) {
  return parameter == "tauX" || parameter == "tauY";
}

bool are_same(const std::shared_ptr<const DirectionTable>& a,
              const std::shared_ptr<const DirectionTable>& b) {
  return a == b || (a && b && *a == *b);
}

}  // namespace

bool operator==(const Lens& a, const Lens& b) {
  const StandardArithmetic standard;
  return a.model == b.model && a.distortion == b.distortion && a.max_radius == b.max_radius &&
         are_same(a.directions, b.directions);
}

// The binary64 number nearest to π/2 is less than π/2, so the greatest angle is that number.
std::optional<std::string> find_fault(const Lens& lens) {
  const StandardArithmetic standard;
  const auto names = entry_of(lens.model).distortion;
  for (std::size_t i = 0; i < lens.distortion.size(); ++i) {
    const double value = lens.distortion[i];
    if (i >= names.size()) {
      if (value != 0) return "more numbers of distortion than the lens model has parameters";
      continue;
    }
    if (!std::isfinite(value)) return std::string(names[i]) + " is not a finite number";
    if (is_tilt(names[i]) && std::abs(value) > std::numbers::pi / 2)
      return std::string(names[i]) + " is not between -pi/2 and pi/2";
  }
  if (!(lens.max_radius > 0)) return "max_radius is not greater than 0";
  if (lens.model == LensModel::table && !lens.directions) return "TABLE has no table of directions";
  if (lens.model != LensModel::table && lens.directions)
    return std::string(name_of(lens.model)) + " has a table of directions, which only TABLE has";
  return std::nullopt;
}

// The numbers that the other model adds stand behind those of the first, and are 0.
Lens with_two_focal_lengths(Lens lens) {
  switch (lens.model) {
    case LensModel::simple_pinhole:
      lens.model = LensModel::pinhole;
      break;
    case LensModel::simple_radial:
    case LensModel::radial:
      lens.model = LensModel::opencv;
      break;
    case LensModel::simple_division:
      lens.model = LensModel::division;
      break;
    case LensModel::simple_fisheye:
      lens.model = LensModel::fisheye;
      break;
    case LensModel::simple_radial_fisheye:
    case LensModel::radial_fisheye:
      lens.model = LensModel::opencv_fisheye;
      break;
    default:
      break;
  }
  return lens;
}

bool is_pinhole(const Lens& lens) {
  const StandardArithmetic standard;
  return is_plane(lens.model) && std::isinf(lens.max_radius) &&
         std::all_of(lens.distortion.begin(), lens.distortion.end(),
                     [](double value) { return value == 0; });
}

}  // namespace fathom
