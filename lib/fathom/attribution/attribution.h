#pragma once

#include <array>
#include <cstdint>
#include <limits>
#include <string>
#include <vector>

#include "fathom/attribution/fragment_source.h"
#include "fathom/attribution/other_map.h"
#include "fathom/scene/scene.h"

/// Every pixel of another renderer's map, attributed to a cause (docs/validation.md).
namespace fathom::attribution {

/// The first that applies.
enum class PixelClass : std::uint8_t {
  equal,         ///< the exact depth rounded once to the storage, or background in both
  quantization,  ///< a neighbour of the exact depth in the storage
  arithmetic,    ///< the surface is the visible one, its depth within the model's bound
  edge,          ///< another surface or none: the sample is nearer to an edge than the model tells
  z_fight,       ///< another surface, which the model does not tell from the visible one by depth
  missed,        ///< a ray slipped between triangles that share an edge or a corner
  convention,    ///< explained by a fault of the whole image that was found and named
  unexplained
};
inline constexpr std::size_t pixel_class_count = 8;
std::string name_of(PixelClass pixel_class);

/// The exact map that the other is held against, and what else is asked again and again.
struct Truth {
  WorldMesh mesh;
  /// With the near and far that both renderers cut at.
  Camera camera;
  std::vector<std::uint32_t> corner_numbers;
  /// Exact depths to 48 bits, infinite in the background; numbers of the visible triangles.
  std::vector<double> depths;
  std::vector<std::uint32_t> triangles;
};
Truth make_truth(const Scene& scene, const Camera& camera);

/// Something that is wrong with the whole image or a whole triangle.
struct Finding {
  std::string
      kind;  ///< shift, mirrored, ray-distance, decoding, affine, missing-triangle, ties, bias
  std::string text;
  std::uint64_t pixels = 0;
};

/// Errors of depth over the pixels where both see the same surface.
struct DepthErrors {
  std::uint64_t pixels = 0;
  double greatest = 0, mean = 0, greatest_relative = 0, median_relative = 0;
};

struct Attribution {
  std::vector<PixelClass> classes;
  /// The values that the model allows for the visible triangle, as depths; NaN where none is seen.
  std::vector<float> least, greatest;
  std::array<std::uint64_t, pixel_class_count> counts{};

  /// How sharp the bounds are: median width of the depth intervals, relative to the depth and in
  /// steps of the storage; share of the pixels that triangles touch where one of them may be seen
  /// or not.
  double median_relative_width = 0, median_steps_width = 0, may_share = 0;
  DepthErrors errors;
  /// Mean over triangles of stored minus expected, in steps of the storage, weighted by the inverse
  /// squares of the widths of their intervals, and the standard deviation of that mean; of pixels
  /// where nothing else is near (raster models).
  double bias_steps = 0, bias_deviation = 0;
  std::uint64_t bias_pixels = 0, bias_triangles = 0;

  /// A constant seems to be added to all window depths: the mean is three quarters of a step or
  /// more, and four times its deviation.
  [[nodiscard]] bool is_biased() const {
    const double mean = bias_steps < 0 ? -bias_steps : bias_steps;
    return bias_triangles >= 64 && mean >= 0.75 && mean >= 4 * bias_deviation;
  }
  /// Unexplained pixels that the absence of the visible triangle explains: its number, else
  /// no_surface. Pixels where the visible triangle is certain, one count a triangle.
  std::vector<std::uint32_t> absent;
  std::vector<std::uint32_t> certain_pixels;
  /// Unexplained pixels that show another than the first of equal triangles.
  std::uint64_t wrong_ties = 0;
  std::vector<Finding> findings;

  [[nodiscard]] std::uint64_t count(PixelClass c) const {
    return counts[static_cast<std::size_t>(c)];
  }
};

/// Holds `other` against the truth, pixel by pixel, as `model` allows. Looks for no findings.
Attribution attribute(const Truth& truth, const OtherMap& other, const RendererModel& model);

/// Steps of the model's storage at a window depth: one code, but not less than binary32 tells.
double storage_step(const RendererModel& model, double window);

}  // namespace fathom::attribution
