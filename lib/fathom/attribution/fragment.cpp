#include "fathom/attribution/fragment.h"

#include <algorithm>
#include <cmath>
#include <variant>

namespace fathom::attribution {

void ImageBox::add(double x, double y, double margin_x, double margin_y) {
  least_x = std::min(least_x, x - margin_x);
  greatest_x = std::max(greatest_x, x + margin_x);
  least_y = std::min(least_y, y - margin_y);
  greatest_y = std::max(greatest_y, y + margin_y);
}

PixelBox whole_image(const Camera& camera) {
  return {0, camera.width - 1, 0, camera.height - 1};
}

PixelBox PixelSquares::pixels(std::size_t square) const {
  const auto column = static_cast<std::uint32_t>(square % squares(width_)) * side,
             row = static_cast<std::uint32_t>(square / squares(width_)) * side;
  return {column, std::min(column + side, width_) - 1, row, std::min(row + side, height_) - 1};
}

void PixelSquares::extend(PixelBox& box, const PixelBox& more) {
  if (box.is_empty()) {
    box = more;
    return;
  }
  box = {std::min(box.first_column, more.first_column), std::max(box.last_column, more.last_column),
         std::min(box.first_row, more.first_row), std::max(box.last_row, more.last_row)};
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
