#include "fathom/attribution/faults/hypotheses.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <memory>
#include <utility>
#include <variant>

#include "fathom/attribution/fragment.h"
#include "fathom/attribution/model/lens_samples.h"
#include "fathom/attribution/model/sample_grid.h"

namespace fathom::attribution {
namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();

std::optional<Hypothesis> affine(const OtherMap& other, const RendererModel& model) {
  Hypothesis h{"affine", "depth is interpolated linearly in the image, without perspective", model,
               other};
  auto* const raster = std::get_if<RasterModel>(&h.model.kind);
  if (raster == nullptr) return std::nullopt;
  raster->affine = true;
  return h;
}

/// By whole pixels.
struct WholeShift {
  int x = 0, y = 0;
};

/// Number of pixels whose content at this offset is right.
std::uint64_t agreeing(const Truth& truth, const OtherMap& other, double agreement,
                       const WholeShift& shift) {
  constexpr int every = 3;  // coprime to the periods of rows and columns
  const int width = static_cast<int>(other.width), height = static_cast<int>(other.height);
  std::uint64_t count = 0;
  for (int y = 0; y < height; y += every) {
    for (int x = y % every; x < width; x += every) {
      const int from_x = x + shift.x, from_y = y + shift.y;
      if (from_x < 0 || from_y < 0 || from_x >= width || from_y >= height) continue;
      const double depth = truth.depths[static_cast<std::size_t>(from_y) * other.width +
                                        static_cast<std::size_t>(from_x)];
      const double stored =
          other.depths[static_cast<std::size_t>(y) * other.width + static_cast<std::size_t>(x)];
      if (!(depth < infinity)) continue;
      count += std::abs(stored - depth) <= agreement * depth ? 1 : 0;
    }
  }
  return count;
}

std::optional<Hypothesis> shifted(const Truth& truth, const OtherMap& other,
                                  const RendererModel& model, double agreement) {
  constexpr int most = 16;
  WholeShift best;
  const std::uint64_t none = agreeing(truth, other, agreement, best);
  std::uint64_t greatest = none;
  for (int y = -most; y <= most; ++y) {
    for (int x = -most; x <= most; ++x) {
      const std::uint64_t count = agreeing(truth, other, agreement, {x, y});
      if (count <= greatest) continue;
      greatest = count;
      best = {x, y};
    }
  }
  if (greatest == none) return std::nullopt;
  Hypothesis h{"shift",
               fmt::format("the image is shifted by ({}, {}) pixels: it was sampled that far from "
                           "the pixel centres",
                           best.x, best.y),
               model, other};
  SamplePosition& sample = h.model.sample;
  sample.x += best.x;
  sample.y += best.y;
  if (truth.lens) {
    const Camera& camera = whole_camera(truth);
    if (camera.projection.lens->directions) return std::nullopt;  // of centres only
    sample.lens = std::make_shared<LensSamples>(camera, sample.x, sample.y);
  }
  return h;
}

/// How the axes of an image were exchanged: columns and rows first, then either mirrored.
struct Axes {
  bool exchanged = false, x = false, y = false;
};

template <class T>
std::vector<T> exchanged_values(const std::vector<T>& values, std::uint32_t width, Axes axes) {
  if (values.empty()) return values;
  const std::size_t height = values.size() / width;
  std::vector<T> result(values.size());
  for (std::size_t row = 0; row < height; ++row) {
    for (std::size_t column = 0; column < width; ++column) {
      const std::size_t from_row = axes.y ? height - 1 - row : row;
      const std::size_t from_column = axes.x ? width - 1 - column : column;
      result[row * width + column] = axes.exchanged ? values[from_column * width + from_row]
                                                    : values[from_row * width + from_column];
    }
  }
  return result;
}

std::string text_of(Axes axes) {
  if (axes.exchanged) {
    return axes.x && axes.y ? "rows and columns are exchanged, and both axes are flipped"
           : axes.x         ? "the image is turned by a quarter, clockwise"
           : axes.y         ? "the image is turned by a quarter, counter-clockwise"
                            : "rows and columns are exchanged";
  }
  return std::string("the image is mirrored: ") +
         (axes.x && axes.y ? "both axes are"
          : axes.x         ? "the horizontal axis is"
                           : "the vertical axis is") +
         " flipped";
}

std::optional<Hypothesis> mirrored(const OtherMap& other, const RendererModel& model, Axes axes) {
  if (axes.exchanged && other.width != other.height) return std::nullopt;
  Hypothesis h{axes.exchanged ? "axes" : "mirrored", text_of(axes), model, other};
  for (auto* values : {&h.map.depths, &h.map.windows}) {
    *values = exchanged_values(*values, other.width, axes);
  }
  h.map.triangles = exchanged_values(other.triangles, other.width, axes);
  return h;
}

std::optional<Hypothesis> ray_distance(const Truth& truth, const OtherMap& other,
                                       const RendererModel& model) {
  const Camera& camera = truth.camera;
  if (!is_perspective(camera.projection)) return std::nullopt;
  Hypothesis h{"ray-distance", "distances along the rays are given for planar depths", model,
               other};
  h.map.windows.clear();
  const RoundedProjection projection(camera.projection);
  const SampleGrid samples(camera, {.lens = truth.lens});
  for (std::uint32_t row = 0; row < camera.height; ++row) {
    for (std::uint32_t column = 0; column < camera.width; ++column) {
      const auto [u, v] = samples.at(column, row);
      if (std::isnan(u)) continue;  // no ray
      const auto [x, y] = projection.plane_point_at(u, v);
      h.map.depths[std::size_t{row} * camera.width + column] /= std::hypot(1, x, y);
    }
  }
  return h;
}

}  // namespace

std::vector<MakeHypothesis> hypotheses(const Truth& truth, const OtherMap& other,
                                       const RendererModel& model, const Attribution& found) {
  std::vector<MakeHypothesis> list;
  list.emplace_back([&] { return affine(other, model); });
  for (const bool exchanged : {false, true}) {
    for (const Axes axes : {Axes{exchanged, true, false},
                            {exchanged, false, true},
                            {exchanged, true, true},
                            {exchanged, false, false}}) {
      if (!axes.exchanged && !axes.x && !axes.y) continue;
      list.emplace_back([&other, &model, axes] { return mirrored(other, model, axes); });
    }
  }
  list.emplace_back([&] { return ray_distance(truth, other, model); });
  list.emplace_back(
      [&] { return shifted(truth, other, model, found.sharpness.median_relative_width); });
  if (truth.lens)
    for (MakeHypothesis& make : lens_hypotheses(truth, other, model))
      list.push_back(std::move(make));
  return list;
}

}  // namespace fathom::attribution
