#include "fathom/attribution/model/lens_samples.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <string>
#include <utility>

#include "fathom/failures/errors.h"
#include "fathom/lens/preimages.h"
#include "fathom/threads/threads.h"

namespace fathom::attribution {
namespace {

bool overlap(const ImageBox& a, const ImageBox& b) {
  return a.least_x <= b.greatest_x && b.least_x <= a.greatest_x && a.least_y <= b.greatest_y &&
         b.least_y <= a.greatest_y;
}

double middle(const Interval& x) {
  return x.lower / 2 + x.upper / 2;
}

[[noreturn]] void refuse(const Camera& camera, const std::string& why) {
  throw UsageError("the lens " + std::string(name_of(camera.projection.lens->model)) + ": " + why);
}

void require_planar_depths(const Camera& camera) {
  const bool is_limited = camera.near > 0 || camera.far < std::numeric_limits<double>::infinity();
  if (counts_distance(camera.projection) && is_limited)
    refuse(camera, "near and far limit ray distances, not depths; leave them out");
}

}  // namespace

Camera without_lens(Camera camera) {
  camera.projection.lens.reset();
  return camera;
}

LensSamples::LensSamples(const Camera& camera, std::vector<std::array<double, 2>> points)
    : camera_(camera), points_(std::move(points)), squares_(camera), boxes_(squares_.count()) {
  require_planar_depths(camera);
  find_boxes();
}

LensSamples::LensSamples(const Camera& camera, double x, double y, Places places)
    : camera_(camera),
      points_(std::size_t{camera.width} * camera.height),
      squares_(camera),
      boxes_(squares_.count()) {
  require_planar_depths(camera);
  const lens::Preimages preimages(camera.projection, *camera.projection.lens);
  const RoundedProjection projection(without_lens(camera).projection);
  const bool at_centres = x == 0.5 && y == 0.5;
  const auto direction_of = [&](std::uint32_t column, std::uint32_t row) {
    return at_centres ? preimages.of_pixel(column, row) : preimages.of(column + x, row + y);
  };
  const auto point_of = [&](std::uint32_t column, std::uint32_t row) -> std::array<double, 2> {
    constexpr double none = std::numeric_limits<double>::quiet_NaN();
    const auto d = direction_of(column, row);
    if (!d) return {none, none};
    const auto& box = d->box();
    if (!(box[2].lower > 0))
      refuse(camera, "some rays do not go forwards, and depth is compared along z");
    auto point = projection.image_of({middle(box[0]), middle(box[1]), middle(box[2])});
    if (places == Places::as_they_are) return point;
    for (double& u : point) u = std::floor(u) + 0.5;
    const bool is_in_image =
        point[0] > 0 && point[1] > 0 && point[0] < camera.width && point[1] < camera.height;
    return is_in_image || places == Places::at_centres_of_endless
               ? point
               : std::array<double, 2>{none, none};
  };
  parallel_for(std::uint32_t{0}, camera.height, [&](std::uint32_t row) {
    for (std::uint32_t column = 0; column < camera.width; ++column)
      points_[std::size_t{row} * camera.width + column] = point_of(column, row);
  });
  find_boxes();
}

void LensSamples::find_boxes() {
  for (std::size_t square = 0; square < squares_.count(); ++square) {
    const PixelBox pixels = squares_.pixels(square);
    for (std::uint32_t row = pixels.first_row; row <= pixels.last_row; ++row) {
      for (std::uint32_t column = pixels.first_column; column <= pixels.last_column; ++column) {
        const auto& [u, v] = at(column, row);
        if (!std::isnan(u)) boxes_[square].add(u, v, 0, 0);
      }
    }
  }
}

PixelBox LensSamples::pixels_of(const ImageBox& box) const {
  return squares_.around([&](std::size_t square) { return overlap(boxes_[square], box); });
}

}  // namespace fathom::attribution
