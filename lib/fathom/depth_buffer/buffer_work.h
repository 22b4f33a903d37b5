#pragma once

#include <vector>

#include "fathom/depth_buffer/buffer_channels.h"
#include "fathom/depth_buffer/depth_buffer.h"

/// The two ways to fill the channels; both in the arena of their caller.
namespace fathom {

struct BufferWork {
  BufferChannels& channels;
  const TriangleSource& triangles;
  const Camera& camera;
  const DepthBufferOptions& options;
};

DepthBufferStatistics sum_of(const std::vector<DepthBufferStatistics>& parts);

DepthBufferStatistics fill_exactly(const BufferWork& work);
DepthBufferStatistics fill_certified(const BufferWork& work);

}  // namespace fathom
