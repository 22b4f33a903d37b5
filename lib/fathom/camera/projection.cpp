#include "fathom/camera/projection.h"

#include <cmath>
#include <tuple>
#include <utility>

#include "fathom/numeric/certified.h"
#include "fathom/numeric/double_word.h"
#include "fathom/numeric/rounding.h"
#include "fathom/numeric/standard_arithmetic.h"

namespace fathom {

std::string_view name_of(ProjectionModel model) {
  return model == ProjectionModel::perspective ? "perspective" : "orthographic";
}

namespace {

/// Whether fx … skew are as in a new projection.
bool has_no_intrinsics(const Projection& p) {
  const Projection untouched;
  return std::tie(p.fx, p.fy, p.cx, p.cy, p.skew, p.pixel_centre) ==
         std::tie(untouched.fx, untouched.fy, untouched.cx, untouched.cy, untouched.skew,
                  untouched.pixel_centre);
}

std::optional<std::string> fault_of_panorama(const Projection& p) {
  const LensModelEntry& model = entry_of(p.lens->model);
  const std::pair<std::string_view, double> numbers[] = {{model.intrinsics[0], p.fx},
                                                         {model.intrinsics[1], p.fy}};
  for (const auto& [name, value] : numbers)
    if ((name == "w" || name == "h") && !(value > 0))
      return std::string(name) + " is not greater than 0";
  if (p.skew != 0) return std::string(model.name) + " has no skew";
  return std::nullopt;
}

}  // namespace

std::optional<std::string> find_fault(const Projection& projection) {
  const StandardArithmetic standard;
  const std::pair<const char*, double> numbers[] = {
      {"fx", projection.fx}, {"fy", projection.fy},     {"cx", projection.cx},
      {"cy", projection.cy}, {"skew", projection.skew}, {"pixel_centre", projection.pixel_centre}};
  for (const auto& [name, value] : numbers)
    if (!std::isfinite(value)) return std::string(name) + " is not a finite number";
  if (projection.lens && is_panorama(projection.lens->model))
    if (auto fault = fault_of_panorama(projection)) return fault;
  if (projection.fx == 0) return "fx is 0, expected any other number";
  if (projection.fy == 0) return "fy is 0, expected any other number";
  if (!projection.lens) return std::nullopt;
  if (is_orthographic(projection)) return "an orthographic camera has no lens";
  const LensModelEntry& model = entry_of(projection.lens->model);
  if (has_one_focal_length(model) && (projection.fx != projection.fy || projection.skew != 0))
    return std::string(model.name) + " has one focal length and no skew";
  if (model.intrinsics.empty() && !has_no_intrinsics(projection))
    return std::string(model.name) + " has no fx, fy, cx, cy, skew and pixel_centre";
  return find_fault(*projection.lens);
}

bool bends_rays(const Projection& projection) {
  return projection.lens && !is_pinhole(*projection.lens);
}

bool counts_distance(const Projection& projection) {
  return bends_rays(projection) && !is_plane(projection.lens->model);
}

HomogeneousImagePoint to_image(const Projection& projection, const CameraPoint& p) {
  const ExactPrincipalPoint centre = exact_principal_point(projection);
  const Dyadic W = is_perspective(projection) ? p.z : Dyadic(1.0);
  return {projection.fx * p.x + projection.skew * p.y + centre.x * W,
          projection.fy * p.y + centre.y * W, W};
}

PrincipalPoint principal_point(const Projection& projection) {
  const StandardArithmetic standard;
  const WordPair half_less_centre = two_sum(0.5, -projection.pixel_centre);
  // For 0 and ½ the difference is exact, and the sum is the only rounding.
  if (half_less_centre.lo == 0)
    return {projection.cx + half_less_centre.hi, projection.cy + half_less_centre.hi};
  const ExactPrincipalPoint centre = exact_principal_point(projection);
  return {round_to_binary64(Ratio(centre.x)), round_to_binary64(Ratio(centre.y))};
}

// In the image of the specification the centre of the top left pixel is at ½.
ExactPrincipalPoint exact_principal_point(const Projection& projection) {
  const Dyadic half_less_centre = Dyadic(0.5) - projection.pixel_centre;
  return {projection.cx + half_less_centre, projection.cy + half_less_centre};
}

}  // namespace fathom
