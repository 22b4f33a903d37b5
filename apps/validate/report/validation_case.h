#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "fathom/attribution/attribution.h"
#include "fathom/attribution/judgement.h"
#include "fathom/attribution/model/renderer_model.h"
#include "fathom/attribution/truth.h"
#include "fathom/scene/scene.h"

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
  /// See predicted_fights() in validation_case.h.
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

/// How reports speak of z-fighting. Where a map has no numbers of triangles, a wrong surface with
/// the depth of the right one cannot be seen: the pixels of the class are then the least number
/// that fight, and not their number.

/// "2874", "at least 3: no triangle numbers were read", "unknown: no triangle numbers were read".
std::string z_fight_count_text(const ValidationCase& c);

/// In a list of counts: "2874 z-fight (0 by the format alone)", "z-fight unknown (no triangle
/// numbers)"; empty where numbers were read and nothing fights, nor would by the format alone.
std::string z_fight_clause(const ValidationCase& c);

/// The pixels that z-fight by the depth format of a rasterizer alone: the exact depths, rounded
/// once to its storage, let another triangle win than the visible one, by the renderer's rule for
/// equal depths (depth_buffer.h). Pixels that fight beyond this do so because depths are computed
/// in binary32.
///
/// Exact    the count; no depth is computed in floating point without a bound.
/// Nothing  where the format alone says nothing: rays; a rule that is not known; samples that are
///          not the pixels' centres; biased depths; reversed depths of an orthographic camera, for
///          which there is no format.
/// Needs    the scene that the truth is of.
std::optional<std::uint64_t> predicted_fights(const Scene& scene, const attribution::Truth& truth,
                                              const attribution::RendererModel& model);

}  // namespace fathom::validation
