#pragma once

#include "fathom/pipeline/output/temporal_history.h"
#include "fathom/pipeline/render_pipeline.h"
#include "fathom/scene/motion.h"

namespace fathom::pipeline {

/// The time over which a picture is taken, open < close.
struct Shutter {
  double open = 0, close = 1;
};

/// Renders a scene that moves while the shutter is open.
///   temporal:N       the mean of N pictures at the middles of N equal parts of the time, each with
///                    one sample at the centre of a pixel: the integral over time by the midpoint
///                    rule;
///   temporal-area:N  the same of pictures by areas: over the pixel as well;
///   taa:N            N pictures at even steps from open to close, of which the last is seen: each
///                    is sampled at another place in the pixel, and the history of those before is
///                    added (temporal_history.h).
/// The map, and with other kinds of antialiasing the picture, are those of the time of closing.
/// Fails    as render_frame; UsageError for times that are not finite or do not increase, and for
///          taa with a viewport of its own.
PipelineFrame render_moving(MovingScene& scene, const Camera& camera,
                            const PipelineOptions& options, const Shutter& shutter,
                            bool with_picture, const HistorySettings& history = {});

}  // namespace fathom::pipeline
