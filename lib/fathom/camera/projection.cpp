#include "fathom/camera/projection.h"

#include <cmath>
#include <utility>

#include "fathom/numeric/certified.h"
#include "fathom/numeric/double_word.h"
#include "fathom/numeric/rounding.h"
#include "fathom/numeric/standard_arithmetic.h"

namespace fathom {
namespace {

/// A coordinate of the principal point in the image of the specification, where the centre of the
/// top left pixel is at ½: c + (½ − pixel_centre).
Dyadic centred(double c, double pixel_centre) {
  return Dyadic(c) + (Dyadic(0.5) - pixel_centre);
}

}  // namespace

std::string_view name_of(ProjectionModel model) {
  return model == ProjectionModel::perspective ? "perspective" : "orthographic";
}

std::optional<std::string> find_fault(const Projection& projection) {
  const StandardArithmetic standard;
  const std::pair<const char*, double> numbers[] = {
      {"fx", projection.fx}, {"fy", projection.fy},     {"cx", projection.cx},
      {"cy", projection.cy}, {"skew", projection.skew}, {"pixel_centre", projection.pixel_centre}};
  for (const auto& [name, value] : numbers)
    if (!std::isfinite(value)) return std::string(name) + " is not a finite number";
  if (projection.fx == 0) return "fx is 0, expected any other number";
  if (projection.fy == 0) return "fy is 0, expected any other number";
  return std::nullopt;
}

HomogeneousImagePoint to_image(const Projection& projection, const CameraPoint& p) {
  const Projection& m = projection;
  const Dyadic W = is_perspective(m) ? p.z : Dyadic(1.0);
  return {m.fx * p.x + m.skew * p.y + centred(m.cx, m.pixel_centre) * W,
          m.fy * p.y + centred(m.cy, m.pixel_centre) * W, W};
}

PrincipalPoint principal_point(const Projection& projection) {
  const StandardArithmetic standard;
  const WordPair half_less_centre = two_sum(0.5, -projection.pixel_centre);
  // For 0 and ½ the difference is exact, and the sum is the only rounding.
  if (half_less_centre.lo == 0)
    return {projection.cx + half_less_centre.hi, projection.cy + half_less_centre.hi};
  const auto rounded = [&](double c) {
    return round_to_binary64(Ratio(centred(c, projection.pixel_centre)));
  };
  return {rounded(projection.cx), rounded(projection.cy)};
}

}  // namespace fathom
