#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "fathom/attribution/attribution.h"
#include "fathom/attribution/cause.h"
#include "fathom/attribution/judgement.h"

namespace fathom::validation {

/// One renderer in one of its variants, on one scene.
struct ValidationCase {
  std::string scene;
  /// vtk, opengl, blender, embree or map; and its variant or model: "unorm24", "robust", …
  std::string renderer, variant;
  /// Its version and what it runs on; empty of a map that someone brings.
  std::string version;
  /// Where a map that someone brings was read from.
  std::string file;
  /// Why there is no map, in one line; empty where there is one.
  std::string failure;
  /// What drawing and judging took, by the clock; none where it was not measured.
  std::optional<double> seconds;
  attribution::RendererModel model;
  std::shared_ptr<const attribution::Truth> truth;
  attribution::OtherMap other;
  attribution::Attribution attribution;
  /// See predicted_fights() in z_fighting.h.
  std::optional<std::uint64_t> predicted_fights;

  /// Whether it is known which triangle each pixel shows: where it is not, z-fighting shows only
  /// where depths reveal it.
  [[nodiscard]] bool has_triangle_numbers() const { return !other.triangles.empty(); }
  [[nodiscard]] bool is_done() const { return failure.empty(); }
  /// Nothing is unexplained and nothing was found to be wrong.
  [[nodiscard]] bool is_good() const {
    return is_done() && attribution.count(attribution::PixelClass::unexplained) == 0 &&
           attribution.findings.empty();
  }
};

inline void set_judgement(ValidationCase& made, attribution::Judgement judgement) {
  made.model = std::move(judgement.model);
  made.truth = std::move(judgement.truth);
  made.other = std::move(judgement.other);
  made.attribution = std::move(judgement.attribution);
}

/// Why a result is not good, in one line: why there is no map, else the first finding, else how
/// many pixels are unexplained and the one to look at first. Empty where the result is good.
std::string cause_of(const ValidationCase& validated);

/// What is to be said first of a result: as attribution::verdict_text(), or why there is no map.
std::string verdict_of(const ValidationCase& validated);

/// The same of several: how many failed, and the first of them.
std::string verdict_of(const std::vector<ValidationCase>& cases);

/// As attribution::pixel_text().
std::string pixel_text(const ValidationCase& validated, std::size_t pixel);

}  // namespace fathom::validation
