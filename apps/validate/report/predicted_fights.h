#pragma once

#include <cstdint>
#include <optional>

#include "fathom/attribution/model/renderer_model.h"
#include "fathom/attribution/truth.h"
#include "fathom/scene/scene.h"

namespace fathom::validation {

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
