#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include "apps/validate/report/validation_case.h"
#include "fathom/attribution/model/renderer_model.h"
#include "fathom/attribution/truth.h"
#include "fathom/scene/scene.h"

/// How reports speak of z-fighting. Where a map has no numbers of triangles, a wrong surface with
/// the depth of the right one cannot be seen: the pixels of the class are then the least number
/// that fight, and not their number.
namespace fathom::validation {

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
