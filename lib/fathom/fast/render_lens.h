#pragma once

#include "fathom/fast/render_fast.h"
#include "fathom/fast/render_memory.h"

namespace fathom::fast {

/// render_fast() for a camera with a lens whose rays all go forwards. In a window where edges are
/// straight, triangles are sorted and set up as without a lens; samples lie where their rays meet
/// it.
Rendered render_lens(const Scene& scene, const Camera& camera, const RenderOptions& options,
                     const RenderContext& context, RenderMemory::Parts& memory, DepthMap before);

}  // namespace fathom::fast
