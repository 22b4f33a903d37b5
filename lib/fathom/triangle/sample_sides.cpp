#include "fathom/triangle/sample_sides.h"

#include "fathom/triangle/image_rows.h"

namespace fathom::triangle {
namespace {

std::array<ApproximateRow, 2> rows_of(const Object& object, const Camera& camera,
                                      const ImagePoint& s) {
  const auto image = image_rows(object, camera);
  const auto difference = [&](const std::array<Dyadic, 4>& row, double place) {
    std::array<Dyadic, 4> result;
    for (std::size_t k = 0; k < 4; ++k) result[k] = row[k] - Dyadic(place) * image[2][k];
    return ApproximateRow(result);
  };
  return {difference(image[0], s.u), difference(image[1], s.v)};
}

}  // namespace

SampleSides::SampleSides(const Object& object, const Camera& camera, const ImagePoint& s)
    : rows_(rows_of(object, camera, s)) {}

SampleSides::Sides SampleSides::of(const MeshPoint& p) const {
  unsigned sides = 0;
  for (std::size_t axis = 0; axis < 2; ++axis) {
    const Interval value = rows_[axis].at(p);
    if (value.upper < 0) sides |= 1U << (2 * axis);
    if (value.lower > 0) sides |= 2U << (2 * axis);
  }
  return static_cast<Sides>(sides);
}

}  // namespace fathom::triangle
