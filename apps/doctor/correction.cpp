#include <cmath>
#include <limits>
#include <optional>
#include <utility>

#include "apps/doctor/diagnosis.h"
#include "fathom/camera_directions.h"
#include "fathom/image/surface.h"

namespace fathom::doctor {
namespace {

constexpr double no_depth = std::numeric_limits<double>::infinity();

/// Planar depth by ray distance at a pixel.
double forwardness(const std::optional<DirectionTable>& directions, std::uint32_t x,
                   std::uint32_t y) {
  if (!directions) return 1;
  const auto d = directions->at(x, y);
  return d ? (*d)[2] / std::hypot((*d)[0], (*d)[1], (*d)[2]) : 1;
}

}  // namespace

Camera corrected_camera(const View& view, const Diagnosis& found) {
  return corrected(view.camera, found.hypothesis, view.image.size);
}

DepthMap corrected_map(const View& view, const Diagnosis& found) {
  const Hypothesis& h = found.hypothesis;
  const Camera camera = corrected_camera(view, found);
  std::optional<DirectionTable> directions;
  if (h.is_distance && is_perspective(camera.projection)) directions = directions_of(camera);
  const double added = h.is_truncated ? view.image.step() / 2 : 0;
  Samples<float> depths(std::size_t(camera.width) * camera.height);
  for (std::uint32_t y = 0; y < camera.height; ++y) {
    for (std::uint32_t x = 0; x < camera.width; ++x) {
      double depth = view.image.at(stored_place(h, camera, x, y)).value_or(no_depth);
      if (depth == found.no_value) depth = no_depth;
      depths[std::size_t(y) * camera.width + x] =
          float((depth + added) / h.depth_scale * forwardness(directions, x, y));
    }
  }
  DepthMap map{.width = camera.width, .height = camera.height};
  map.channels.push_back({"Z", std::move(depths)});
  declare_background(map, no_depth);
  map.camera = camera;
  return map;
}

}  // namespace fathom::doctor
