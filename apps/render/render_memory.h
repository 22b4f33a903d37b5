#pragma once

#include "fathom/camera/camera.h"
#include "fathom/fast/stream.h"
#include "fathom/triangle/options.h"

namespace fathom::app {

/// Refuses an image that takes more memory than there is or --max-memory allows, before it tries.
/// `more_channels` are added to those of the options. Fails with InputError.
void check_size(const Camera& camera, const RenderOptions& options, std::size_t more_channels);

/// Of the memory that the map leaves over of what is allowed, a quarter for tiles, a sixteenth for
/// triangles.
StreamLimits stream_limits(const Camera& camera, const RenderOptions& options);

}  // namespace fathom::app
