#include "fathom/lens/no_ray.h"

#include <limits>

#include "fathom/lens/preimages.h"
#include "fathom/numeric/standard_arithmetic.h"

namespace fathom::lens {
namespace {

/// Whether the sample lies behind the plane of a tilted sensor.
bool is_behind_sensor(const Preimages& preimages, std::uint32_t column, std::uint32_t row) {
  const ExactVector3 z = preimages.plane_map()[2];
  const Dyadic value = z[0] * Dyadic(column + 0.5) + z[1] * Dyadic(row + 0.5) + z[2];
  return value.sign() != Sign::positive;
}

}  // namespace

std::string why_no_ray(const Projection& projection, std::uint32_t column, std::uint32_t row) {
  const StandardArithmetic standard;
  Lens endless = *projection.lens;
  endless.max_radius = std::numeric_limits<double>::infinity();
  const Preimages preimages(projection, endless);
  if (preimages.of_pixel(column, row)) return "it is beyond max_radius";
  if (endless.directions) return "the table has no direction for this pixel";
  if (!has_stage(endless.model)) return "the model ends nearer to its axis";
  if (is_behind_sensor(preimages, column, row)) return "it is behind the tilted sensor";
  const bool is_last_angle = !is_plane(endless.model) && preimages.disc() == end_of_angles;
  return is_last_angle ? "it is 180 degrees or more from the axis"
                       : "the lens folds nearer to its axis";
}

}  // namespace fathom::lens
