#pragma once

#include "fathom/fast/stream.h"

namespace fathom::fast {

/// render_streamed() for a camera whose lens bends rays: the map of render_fast(), bit for bit. The
/// files are read for each view of the lens, and for each band of rows whose tiles fit into the
/// memory.
Rendered render_lens_streamed(const StreamedScene& scene, const Camera& camera,
                              const RenderOptions& options, const StreamLimits& limits,
                              const RenderContext& context);

}  // namespace fathom::fast
