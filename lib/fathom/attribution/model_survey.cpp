#include "fathom/attribution/model_survey.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "fathom/attribution/attribute_bands.h"
#include "fathom/attribution/diagnosis.h"
#include "fathom/attribution/pixels/foreign_values.h"
#include "fathom/text/counted.h"

namespace fathom::attribution {
namespace {

/// One of so many bands is looked at, but two at least.
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
          .width = found.median_relative_width};
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

}  // namespace fathom::attribution
