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
  /// The renderer's version and the driver or machine it runs on; empty for a map from a file.
  std::string version;
  /// The file of the map, if it was read from a file.
  std::string file;
  /// Reason for a missing map, in one line; empty if the map exists.
  std::string failure;
  /// Wall-clock time of drawing and judging; nullopt if it was not measured.
  std::optional<double> seconds;
  attribution::RendererModel model;
  std::shared_ptr<const attribution::Truth> truth;
  attribution::OtherMap other;
  attribution::Attribution attribution;
  /// See predicted_fights().
  std::optional<std::uint64_t> predicted_fights;

  /// Whether the triangle of each pixel is known. If not, only depths can reveal z-fighting.
  [[nodiscard]] bool has_triangle_numbers() const { return !other.triangles.empty(); }
  [[nodiscard]] bool is_done() const { return failure.empty(); }
  /// No pixel is unexplained and there is no finding.
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

/// Why a result is not good, in one line: the reason for a missing map, else the first finding,
/// else the number of unexplained pixels and the first pixel to look at. Empty if the result is
/// good.
std::string cause_of(const ValidationCase& validated);

/// The headline of a result: attribution::verdict_text(), or the reason for a missing map.
std::string verdict_of(const ValidationCase& validated);

/// The headline of several results: how many failed, and the first of them.
std::string verdict_of(const std::vector<ValidationCase>& cases);

/// As attribution::pixel_text().
std::string pixel_text(const ValidationCase& validated, std::size_t pixel);

// How reports speak of z-fighting. Where a map has no numbers of triangles, a wrong surface with
// the depth of the right one cannot be seen: the pixels of the class are then the least number
// that fight, and not their number.

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
