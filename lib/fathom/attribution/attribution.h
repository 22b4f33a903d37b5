#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "fathom/attribution/finding.h"
#include "fathom/attribution/model/renderer_model.h"
#include "fathom/attribution/other_map.h"
#include "fathom/attribution/pixel_class.h"
#include "fathom/attribution/truth.h"

/// Every pixel of another renderer's map, attributed to a cause (docs/validation.md).
namespace fathom::attribution {

/// Errors of depth over the pixels where both see the same surface: in scene units, and relative to
/// the exact depth.
struct DepthErrors {
  std::uint64_t pixels = 0;
  double greatest = 0, mean = 0, greatest_relative = 0, median_relative = 0;
};

/// Images are rows from the top, as the maps.
struct Attribution {
  std::vector<PixelClass> classes;
  /// The values that the model allows for the visible triangle, as depths in scene units; NaN where
  /// none is seen.
  std::vector<float> least, greatest;
  /// Pixels of each class.
  std::array<std::uint64_t, pixel_class_count> counts{};

  /// How sharp the bounds are: median width of the depth intervals, relative to the depth and in
  /// steps of the storage; share of the pixels that triangles touch where one of them may be seen
  /// or not.
  double median_relative_width = 0, median_steps_width = 0, may_share = 0;
  DepthErrors errors;
  /// Mean over triangles of stored minus expected, in steps of the storage, weighted by the inverse
  /// squares of the widths of their intervals, the standard deviation of that mean, and how much of
  /// it roundings of a matrix that is not known may be, which all triangles share; of pixels where
  /// nothing else is near. Raster models only.
  double bias_steps = 0, bias_deviation = 0, bias_shared = 0;
  std::uint64_t bias_pixels = 0, bias_triangles = 0;

  /// 1 where the visible triangle is certain to be drawn and no other is near it in depth.
  std::vector<std::uint8_t> alone;
  /// For each pixel, if it is unexplained and the absence of the visible triangle explains it: that
  /// triangle, else no_surface.
  std::vector<std::uint32_t> absent;
  /// For each triangle, the pixels where it is certain to be visible.
  std::vector<std::uint32_t> certain_pixels;
  /// Unexplained pixels that show another of equal triangles than the model's rule lets win.
  std::uint64_t wrong_ties = 0;
  /// What is wrong.
  std::vector<Finding> findings;
  /// Conventions that were recognised (`background`, `model`), and a possible cause: `clip-planes`.
  std::vector<Finding> notes;

  [[nodiscard]] std::uint64_t count(PixelClass c) const {
    return counts[static_cast<std::size_t>(c)];
  }
  /// A constant seems to be added to all window depths: the mean is three quarters of a step or
  /// more, and what of it the matrix cannot be is four times its deviation.
  [[nodiscard]] bool is_biased() const {
    const double mean = bias_steps < 0 ? -bias_steps : bias_steps;
    return bias_triangles >= 64 && mean >= 0.75 && mean - bias_shared >= 4 * bias_deviation;
  }
};

/// Compares `other` with the truth, pixel by pixel, as `model` allows. Looks for no findings.
/// Exact    the truth and the bounds of what the model allows; a class is given only where they
///          prove it. Means and errors are sums in binary64.
/// Needs    maps of the same size; near and far of the truth's camera as the model's mapping does.
Attribution attribute(const Truth& truth, const OtherMap& other, const RendererModel& model);

}  // namespace fathom::attribution
