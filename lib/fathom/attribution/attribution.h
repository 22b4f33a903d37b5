#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "fathom/attribution/model/renderer_model.h"
#include "fathom/attribution/other_map.h"
#include "fathom/attribution/truth.h"

/// Every pixel of another renderer's map, attributed to a cause (docs/validation.md).
namespace fathom::attribution {

/// A quantity that was estimated from a map.
struct Estimate {
  std::string name;
  double value = 0;
  /// Standard deviation, from residuals summed for each corner of the mesh: triangles that share a
  /// corner share its roundings.
  double deviation = 0;
  /// "pixels", "scene units", "rad" or empty.
  std::string unit;
};

/// A result about the whole image, a triangle or some pixels; mostly a fault.
struct Finding {
  /// See docs/validation.md, "Findings".
  std::string kind;
  /// The finding as a clause.
  std::string text;
  /// The number of pixels that it explains.
  std::uint64_t pixels = 0;
  std::vector<Estimate> estimates = {};
  /// Kinds of alternatives that explain the map equally well with as many parameters.
  std::vector<std::string> alternatives = {};
  /// The evidence, one clause per line of the report.
  std::vector<std::string> evidence = {};
};

/// Why a pixel differs from the truth (docs/validation.md, "Classes"): the first that applies.
enum class PixelClass : std::uint8_t {
  equal,         ///< the exact depth rounded once to the storage, or background in both
  quantization,  ///< next to the exact depth in the storage
  arithmetic,    ///< the surface is the visible one, its depth within the model's bound
  edge,          ///< another surface or no surface: closer to an edge than the model can resolve
  z_fight,       ///< another surface, at a depth that the model cannot distinguish
  missed,        ///< a ray slipped through between triangles that share an edge or a corner
  convention,    ///< explained by a fault of the whole image that was found and named
  unexplained
};
inline constexpr std::size_t pixel_class_count = 8;

/// "within quantization", "missed surface", …, as reports show it.
std::string name_of(PixelClass pixel_class);

/// Errors of depth over the pixels where both maps show the same surface: in scene units, and
/// relative to the exact depth.
struct DepthErrors {
  std::uint64_t pixels = 0;
  double greatest = 0, mean = 0, greatest_relative = 0, median_relative = 0;
};

/// How sharp the bounds are.
struct Sharpness {
  /// Median width of the depth intervals, relative to the depth and in steps of the storage.
  double median_relative_width = 0, median_steps_width = 0;
  /// Share of undecided pixels, where a triangle may be visible, among pixels that triangles touch.
  double may_share = 0;
  /// Share of the pixels with a surface at which the model allows nearly any depth, for example
  /// because a triangle passes the eye and may be anywhere.
  double loose_share = 0;

  /// Whether the model excludes something at most pixels. Otherwise it explains nearly any map.
  [[nodiscard]] bool decides() const { return loose_share <= 0.5; }
};

/// The mean difference of stored and expected window depths, over pixels with no other surface near
/// the visible one. Raster models only.
struct Bias {
  /// The mean over triangles, weighted by the inverse squares of the widths of their intervals, and
  /// its standard deviation, in steps of the storage.
  double steps = 0, deviation = 0;
  /// The part of the mean that roundings of an unknown matrix, shared by all triangles, may cause.
  double shared = 0;
  std::uint64_t pixels = 0, triangles = 0;

  /// Whether a constant seems to be added to all window depths: the mean is at least three quarters
  /// of a step, and the part of it that the matrix cannot cause is at least four times its
  /// deviation.
  [[nodiscard]] bool is_significant() const {
    const double mean = steps < 0 ? -steps : steps;
    return triangles >= 64 && mean >= 0.75 && mean - shared >= 4 * deviation;
  }
};

/// Input of the search for findings.
struct Clues {
  /// For each pixel, 1 if the visible triangle is certainly drawn and no other triangle is near it
  /// in depth.
  std::vector<std::uint8_t> alone;
  /// For each pixel, the visible triangle if the pixel is unexplained and the absence of that
  /// triangle explains it; otherwise no_surface.
  std::vector<std::uint32_t> absent;
  /// The number of unexplained pixels that show, of several equal triangles, a different one than
  /// the model's rule selects.
  std::uint64_t wrong_ties = 0;
};

/// Images are rows from the top, as the maps.
struct Attribution {
  std::vector<PixelClass> classes;
  /// The values that the model allows for the visible triangle, as depths in scene units; NaN in
  /// the background.
  std::vector<float> least, greatest;
  /// Pixels of each class.
  std::array<std::uint64_t, pixel_class_count> counts{};

  Sharpness sharpness;
  DepthErrors errors;
  Bias bias;
  Clues clues;
  /// The faults.
  std::vector<Finding> findings;
  /// Recognised conventions (`background`, `model`), a possible cause (`clip-planes`), `undecided`.
  std::vector<Finding> notes;

  [[nodiscard]] std::uint64_t count(PixelClass c) const {
    return counts[static_cast<std::size_t>(c)];
  }
};

/// Compares `other` with the truth, pixel by pixel, as `model` allows. Does not search for
/// findings.
/// Exact    the truth and the model's bounds; a pixel gets a class only if they
///          prove it. Means and errors are sums in binary64.
/// Needs    maps of the same size; near and far of the truth's camera as the model's mapping does.
Attribution attribute(const Truth& truth, const OtherMap& other, const RendererModel& model);

/// The number of rows that are judged together.
inline constexpr std::uint32_t rows_per_band = 8;

/// attribute() for some bands, numbered from the top. All other pixels are classified as equal and
/// contribute to no other figure.
Attribution attribute_bands(const Truth& truth, const OtherMap& other, const RendererModel& model,
                            const std::vector<std::uint32_t>& bands);

/// attribute() and, if pixels remain unexplained or depths are wrong on average, a search for
/// faults that explain them (docs/validation.md, "Findings"). Each hypothesis is a model or a map
/// with one fault corrected; it holds if at most a tenth of the unexplained pixels remains.
/// Findings are named; pixels that a fault of the whole image explains become `convention`.
Attribution attribute_and_name(const Truth& truth, const OtherMap& other,
                               const RendererModel& model);

/// The finding and the number of its pixels: "the image is mirrored (1 pixel)".
std::string finding_text(const Finding& finding);

/// The same with its kind: "mirrored: the image is mirrored (1 pixel)".
std::string finding_line(const Finding& finding);

/// Why a map is wrong, in one line: the first finding, otherwise the number of unexplained pixels
/// and the pixel to look at first. Empty if every pixel is explained and there is no finding.
std::string cause_of(const Truth& truth, const OtherMap& other, const Attribution& found);

/// First line of a report: "failed: the image is mirrored (1 pixel)", "every pixel is explained",
/// or "cannot tell: …" if the model allows nearly any depth.
std::string verdict_text(const Truth& truth, const OtherMap& other, const Attribution& found);

/// A pixel with its depths: "(12, 7): 3.25 instead of 3.21, allowed 3.2099 to 3.2101". Depths are
/// in scene units, to 9 digits.
std::string pixel_text(const Truth& truth, const OtherMap& other, const Attribution& found,
                       std::size_t pixel);

/// The pixels to look at first, at most `count`: unexplained pixels, then pixels of a convention,
/// then missed surfaces, then the greatest relative errors of depth. Equal pixels are left out.
std::vector<std::size_t> worst_pixels(const Truth& truth, const OtherMap& other,
                                      const Attribution& found, std::size_t count);

}  // namespace fathom::attribution
