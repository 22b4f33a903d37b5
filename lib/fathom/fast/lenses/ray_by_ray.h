#pragma once

#include "fathom/fast/channels/fast_output.h"
#include "fathom/lens/preimages.h"
#include "fathom/rendering/rendered.h"
#include "fathom/scene/triangle_source.h"
#include "fathom/triangle/channels.h"

namespace fathom::fast {

/// An image that no window holds, because its rays are too far from the axis for binary64 numbers.
struct RayByRay {
  const TriangleSource& triangles;
  const Camera& camera;
  Cull cull;
  const lens::Preimages& preimages;

  /// Writes each pixel from exact numbers, looking at every triangle for each.
  void write(triangle::ChannelWriter& writer, RenderStatistics& statistics,
             FirstFault& fault) const;
};

}  // namespace fathom::fast
