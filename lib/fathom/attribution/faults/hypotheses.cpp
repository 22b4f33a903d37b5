#include "fathom/attribution/faults/hypotheses.h"

#include <fmt/format.h>

#include <cmath>
#include <cstddef>
#include <variant>

#include "fathom/attribution/faults/shift_estimate.h"
#include "fathom/attribution/pixels/storage_step.h"

namespace fathom::attribution {
namespace {

/// The window depth at which a step of the storage stands for all of them.
constexpr double typical_window = 0.75;

std::optional<Hypothesis> biased(const OtherMap& other, const RendererModel& model,
                                 const Attribution& found) {
  if (!found.is_biased()) return std::nullopt;
  const double steps =
      std::abs(found.bias_steps) < 64 ? std::round(found.bias_steps) : found.bias_steps;
  Hypothesis h{"bias",
               fmt::format("window depths are biased by {:+.4g} steps of the storage", steps),
               model, other};
  auto* const raster = std::get_if<RasterModel>(&h.model.kind);
  if (raster == nullptr) return std::nullopt;
  raster->bias += steps * storage_step(*raster, typical_window);
  return h;
}

std::optional<Hypothesis> affine(const OtherMap& other, const RendererModel& model) {
  Hypothesis h{"affine", "depth is interpolated linearly in the image, without perspective", model,
               other};
  auto* const raster = std::get_if<RasterModel>(&h.model.kind);
  if (raster == nullptr) return std::nullopt;
  raster->affine = true;
  return h;
}

Hypothesis shifted(const OtherMap& other, const RendererModel& model, const ImageShift& shift) {
  Hypothesis h{"shift",
               fmt::format("the image is shifted by ({:.4g}, {:.4g}) pixels: its samples lie there "
                           "from the centres of the pixels",
                           shift.x, shift.y),
               model, other};
  h.model.sample.x += shift.x;
  h.model.sample.y += shift.y;
  return h;
}

/// Which axes of the image are mirrored: the horizontal one, the vertical one or both.
struct Axes {
  bool x = false, y = false;
};

template <class T>
std::vector<T> mirrored_values(const std::vector<T>& values, std::uint32_t width, Axes axes) {
  if (values.empty()) return values;
  const std::size_t height = values.size() / width;
  std::vector<T> result(values.size());
  for (std::size_t row = 0; row < height; ++row) {
    for (std::size_t column = 0; column < width; ++column) {
      result[row * width + column] = values[(axes.y ? height - 1 - row : row) * width +
                                            (axes.x ? width - 1 - column : column)];
    }
  }
  return result;
}

Hypothesis mirrored(const OtherMap& other, const RendererModel& model, Axes axes) {
  Hypothesis h{"mirrored",
               std::string("the image is mirrored: ") +
                   (axes.x && axes.y ? "both axes are"
                    : axes.x         ? "the horizontal axis is"
                                     : "the vertical axis is") +
                   " flipped",
               model, other};
  h.map.depths = mirrored_values(other.depths, other.width, axes);
  h.map.windows = mirrored_values(other.windows, other.width, axes);
  h.map.triangles = mirrored_values(other.triangles, other.width, axes);
  return h;
}

/// Length of the viewing ray per unit of depth, of a perspective camera.
double ray_length(const Camera& camera, std::size_t pixel) {
  const std::size_t column = pixel % camera.width, row = pixel / camera.width;
  const double u = static_cast<double>(column) + 0.5;
  const double v = static_cast<double>(row) + 0.5;
  const double y = (v - camera.cy - (0.5 - camera.pixel_centre)) / camera.fy;
  const double x = (u - camera.cx - (0.5 - camera.pixel_centre) - camera.skew * y) / camera.fx;
  return std::sqrt(1 + x * x + y * y);
}

std::optional<Hypothesis> ray_distance(const Camera& camera, const OtherMap& other,
                                       const RendererModel& model) {
  if (camera.projection != Projection::perspective) return std::nullopt;
  Hypothesis h{"ray-distance", "distances along the rays are given for planar depths", model,
               other};
  h.map.windows.clear();
  for (std::size_t i = 0; i < h.map.depths.size(); ++i) {
    h.map.depths[i] /= ray_length(camera, i);
  }
  return h;
}

}  // namespace

std::vector<MakeHypothesis> hypotheses(const Truth& truth, const OtherMap& other,
                                       const RendererModel& model, const Attribution& found) {
  std::vector<MakeHypothesis> list;
  list.emplace_back([&] { return biased(other, model, found); });
  list.emplace_back([&] { return affine(other, model); });
  list.emplace_back([&]() -> std::optional<Hypothesis> {
    const auto shift = estimated_shift(truth, other);
    if (!shift) return std::nullopt;
    return shifted(other, model, *shift);
  });
  for (const double dx : {-0.5, 0.0, 0.5}) {
    for (const double dy : {-0.5, 0.0, 0.5}) {
      if (dx == 0 && dy == 0) continue;
      list.emplace_back([&other, &model, dx, dy] { return shifted(other, model, {dx, dy}); });
    }
  }
  for (const Axes axes : {Axes{true, false}, {false, true}, {true, true}}) {
    list.emplace_back([&other, &model, axes] { return mirrored(other, model, axes); });
  }
  list.emplace_back([&] { return ray_distance(truth.camera, other, model); });
  return list;
}

}  // namespace fathom::attribution
