#include "fathom/attribution/model_survey.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <variant>
#include <vector>

#include "fathom/attribution/attribution.h"
#include "fathom/attribution/diagnosis.h"
#include "fathom/attribution/model/window_depth.h"
#include "fathom/numeric/standard_arithmetic.h"
#include "fathom/text/counted.h"

namespace fathom::attribution {
namespace {

/// One of so many bands is judged, but at least two bands.
constexpr std::size_t most_between = 16, least_bands = 2;

/// Bands in which either map shows a surface.
std::vector<std::uint32_t> bands_with_surfaces(const Truth& truth, const OtherMap& other) {
  std::vector<std::uint32_t> bands;
  const std::size_t of_band = std::size_t{other.width} * rows_per_band;
  for (std::size_t first = 0; first < other.depths.size(); first += of_band) {
    const std::size_t end = std::min(first + of_band, other.depths.size());
    for (std::size_t i = first; i < end; ++i) {
      if (truth.triangles[i] == no_surface && !std::isfinite(other.depths[i])) continue;
      bands.push_back(static_cast<std::uint32_t>(first / of_band));
      break;
    }
  }
  return bands;
}

struct Sample {
  std::vector<std::uint32_t> bands;
  double share = 1;  ///< of the bands with surfaces
};

Sample sample_of(const Truth& truth, const OtherMap& other) {
  const std::vector<std::uint32_t> all = bands_with_surfaces(truth, other);
  const std::size_t count = std::min(all.size(), std::max(all.size() / most_between, least_bands));
  Sample sample;
  for (std::size_t k = 0; k < count; ++k) {
    sample.bands.push_back(all[(2 * k + 1) * all.size() / (2 * count)]);
  }
  if (count > 0) sample.share = static_cast<double>(count) / static_cast<double>(all.size());
  return sample;
}

}  // namespace

ModelSurvey surveyed(const Truth& truth, const OtherMap& other, const RendererModel& model) {
  const RendererModel known = as_recorded(model, other);
  const Sample sample = sample_of(truth, other);
  const Attribution found = attribute_bands(truth, other, known, sample.bands);
  return {.model = model,
          .unexplained = found.count(PixelClass::unexplained),
          .foreign = foreign_values(truth.camera, other, known),
          .share = sample.share,
          .width = found.sharpness.median_relative_width,
          .decides = found.sharpness.decides()};
}

std::string text_of(const ModelSurvey& survey) {
  if (survey.foreign > 0) {
    return fmt::format("{}: {} hold{} what its storage cannot", survey.model.name,
                       text::counted(survey.foreign, "pixel"), survey.foreign == 1 ? "s" : "");
  }
  if (survey.unexplained > 0) {
    return fmt::format("{}: {} of a sample unexplained", survey.model.name,
                       text::counted(survey.unexplained, "pixel"));
  }
  return fmt::format("{}: a sample is explained, bounds {:.2g} of the depth", survey.model.name,
                     survey.width);
}

namespace {

constexpr double u = unit_roundoff<float>;

/// Where depths lie among a storage's codes.
class CodeScale {
 public:
  CodeScale(const Camera& camera, const RasterModel& model)
      : window_(window_depth(camera.projection.model, model.mapping, camera.near, camera.far)),
        codes_(is_unorm(model.storage) ? greatest_code(model.storage) : 0x1p24),
        least_(is_unorm(model.storage) ? 0 : 0.5) {}

  struct Place {
    double code = 0;   ///< not a whole number
    double error = 0;  ///< how far from there the code may be that was decoded
  };
  /// nullopt if codes cannot be distinguished.
  [[nodiscard]] std::optional<Place> of(double depth) const {
    const double window = window_.of_depth(depth);
    if (!(window >= least_ && window <= 1)) return std::nullopt;
    const double moved = std::abs(window_.of_depth(depth * (1 + 4 * u)) - window);
    // As storage_error() of raster_polygon.cpp has the decoding: four roundings of a window depth.
    return Place{window * codes_, codes_ * (4 * u + moved)};
  }

 private:
  WindowDepth window_;
  double codes_;  ///< to a window depth of 1
  double least_;
};

std::vector<double> sorted_depths(const OtherMap& other) {
  std::vector<double> depths;
  for (const double depth : other.depths) {
    if (std::isfinite(depth) && depth > 0) depths.push_back(depth);
  }
  std::sort(depths.begin(), depths.end());
  return depths;
}

/// Distinct depths in a range of codes, and how many may be there.
struct Range {
  double begin = 0, end = -1, error = 0;
  std::uint64_t depths = 0;

  [[nodiscard]] std::uint64_t too_many() const {
    const double most = std::ceil(end - begin + 2 * error) + 1;
    return static_cast<double>(depths) > most ? depths - static_cast<std::uint64_t>(most) : 0;
  }
};

}  // namespace

std::uint64_t foreign_values(const Camera& camera, const OtherMap& other,
                             const RendererModel& model) {
  const auto* const raster = std::get_if<RasterModel>(&model.kind);
  const bool has_codes = raster != nullptr && raster->mapping == Mapping::opengl &&
                         !raster->written && !model.recorded;
  if (!has_codes) return 0;
  const CodeScale scale(camera, *raster);
  std::uint64_t foreign = 0;
  Range range;
  double last = 0;
  for (const double depth : sorted_depths(other)) {
    const std::optional<CodeScale::Place> place = scale.of(depth);
    if (!place) continue;
    const auto [code, error] = *place;
    if (error < 0.25) {
      foreign += std::abs(code - std::nearbyint(code)) > error ? 1 : 0;
      continue;
    }
    if (depth == last) continue;
    last = depth;
    if (!(code < range.end)) {
      foreign += range.too_many();
      range = {.begin = code, .end = code + std::max(64.0, 16 * error)};
    }
    range.error = std::max(range.error, error);
    ++range.depths;
  }
  return foreign + range.too_many();
}

}  // namespace fathom::attribution
