#include "fathom/attribution/model/lens_samples.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <string>

#include "fathom/failures/errors.h"
#include "fathom/lens/preimages.h"
#include "fathom/threads/threads.h"

namespace fathom::attribution {
namespace {

/// Pixels of a square, in a row.
constexpr std::uint32_t side = 16;

std::uint32_t squares_of(std::uint32_t pixels) {
  return (pixels + side - 1) / side;
}

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

LensSamples::LensSamples(const Camera& camera, double x, double y, Places places)
    : camera_(camera),
      points_(std::size_t{camera.width} * camera.height),
      boxes_(std::size_t{squares_of(camera.width)} * squares_of(camera.height)) {
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
    return is_in_image ? point : std::array<double, 2>{none, none};
  };
  const std::uint32_t columns = squares_of(camera.width);
  parallel_for(std::uint32_t{0}, squares_of(camera.height), [&](std::uint32_t square) {
    const std::uint32_t end = std::min((square + 1) * side, camera.height);
    for (std::uint32_t row = square * side; row < end; ++row) {
      for (std::uint32_t column = 0; column < camera.width; ++column) {
        const auto point = point_of(column, row);
        points_[std::size_t{row} * camera.width + column] = point;
        if (!std::isnan(point[0]))
          boxes_[square * columns + column / side].add(point[0], point[1], 0, 0);
      }
    }
  });
}

PixelBox LensSamples::pixels_of(const ImageBox& box) const {
  const std::uint32_t columns = squares_of(camera_.width);
  PixelBox pixels;
  for (std::uint32_t square = 0; square < boxes_.size(); ++square) {
    if (!overlap(boxes_[square], box)) continue;
    const std::uint32_t column = square % columns * side, row = square / columns * side;
    const std::uint32_t last_column = std::min(column + side, camera_.width) - 1,
                        last_row = std::min(row + side, camera_.height) - 1;
    if (pixels.is_empty()) {
      pixels = {column, last_column, row, last_row};
      continue;
    }
    pixels = {std::min(pixels.first_column, column), std::max(pixels.last_column, last_column),
              std::min(pixels.first_row, row), std::max(pixels.last_row, last_row)};
  }
  return pixels;
}

}  // namespace fathom::attribution
