#include "fathom/attribution/fragment.h"

#include <algorithm>
#include <cmath>
#include <variant>

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

void ImageBox::add(double x, double y, double margin_x, double margin_y) {
  least_x = std::min(least_x, x - margin_x);
  greatest_x = std::max(greatest_x, x + margin_x);
  least_y = std::min(least_y, y - margin_y);
  greatest_y = std::max(greatest_y, y + margin_y);
}

PixelBox whole_image(const Camera& camera) {
  return {0, camera.width - 1, 0, camera.height - 1};
}

PixelBox pixels_of(const ImageBox& box, const Camera& camera, double more) {
  const double last_x = camera.width - 1.0, last_y = camera.height - 1.0;
  const bool meets = box.least_x - more <= last_x && box.least_y - more <= last_y &&
                     !(box.greatest_x < 0) && !(box.greatest_y < 0);
  if (!meets) return {};
  const auto clamped = [](double x, double last) {
    return static_cast<std::uint32_t>(std::clamp(std::floor(x), 0.0, last));
  };
  return {clamped(box.least_x - more, last_x), clamped(box.greatest_x + more, last_x),
          clamped(box.least_y - more, last_y), clamped(box.greatest_y + more, last_y)};
}

namespace {

struct Sources {
  const WorldMesh& mesh;
  const Camera& camera;
  const SamplePosition& sample;

  std::unique_ptr<FragmentSource> operator()(const RasterModel& model) const {
    return raster_fragments(mesh, camera, sample, model);
  }
  std::unique_ptr<FragmentSource> operator()(const RayModel& model) const {
    return ray_fragments(mesh, camera, sample, model);
  }
};

}  // namespace

std::unique_ptr<FragmentSource> fragments(const WorldMesh& mesh, const Camera& camera,
                                          const RendererModel& model) {
  return std::visit(Sources{mesh, camera, model.sample}, model.kind);
}

}  // namespace fathom::attribution
