#include "fathom/attribution/model/sample_grid.h"

#include <algorithm>
#include <cmath>

#include "fathom/attribution/model/lens_samples.h"

namespace fathom::attribution {

/// Newton's method on r·(1 + k1·r² + k2·r⁴) = the given radius.
std::array<double, 2> undistorted(double x, double y, double k1, double k2) {
  const double given = std::hypot(x, y);
  if (given == 0) return {x, y};
  double r = given;
  for (int round = 0; round < 20; ++round) {
    const double s = r * r;
    const double slope = 1 + s * (3 * k1 + s * 5 * k2);
    if (!(slope > 0)) break;  // folded over: nothing is seen twice by such a lens
    const double next = r - (r * (1 + s * (k1 + s * k2)) - given) / slope;
    if (next == r) break;
    r = next;
  }
  return {x * (r / given), y * (r / given)};
}

SampleGrid::SampleGrid(const Camera& camera, const SamplePosition& sample)
    : projection_(camera.projection), sample_(sample) {
  if (sample.lens) return;
  if (sample.k1 == 0 && sample.k2 == 0) return;
  for (const std::uint32_t row : {0U, camera.height / 2, camera.height - 1}) {
    for (const std::uint32_t column : {0U, camera.width / 2, camera.width - 1}) {
      const auto [x, y] = at(column, row);
      reach_ = std::max({reach_, std::abs(x - column - sample.x), std::abs(y - row - sample.y)});
    }
  }
  reach_ += 1;  // it grows with the distance from the centre, which need not be in the image
}

std::array<double, 2> SampleGrid::at(std::uint32_t column, std::uint32_t row) const {
  if (sample_.lens) return sample_.lens->at(column, row);
  const double u = column + sample_.x, v = row + sample_.y;
  if (sample_.k1 == 0 && sample_.k2 == 0) return {u, v};
  const auto [x, y] = projection_.plane_point_at(u, v);
  const auto [ideal_x, ideal_y] = undistorted(x, y, sample_.k1, sample_.k2);
  return projection_.image_of({ideal_x, ideal_y, 1});
}

}  // namespace fathom::attribution
