#pragma once

#include <optional>
#include <vector>

#include "fathom/area/coverage_image.h"
#include "fathom/depth_buffer/buffer_channels.h"
#include "fathom/depth_buffer/depth_buffer.h"

/// The two ways to fill the channels; both work in the arena of their caller.
namespace fathom::depth_buffer {

struct BufferWork {
  BufferChannels& channels;
  const TriangleSource& triangles;
  const Camera& camera;
  const DepthBufferOptions& options;
};

/// Bands of rows, with their triangles if these are needed.
class BufferBands {
 public:
  explicit BufferBands(const BufferWork& work);
  [[nodiscard]] std::uint32_t count() const;
  [[nodiscard]] area::TriangleBands::Band operator[](std::uint32_t band) const;

 private:
  std::uint32_t height_;
  std::optional<area::TriangleBands> bands_;
};

DepthBufferStatistics sum_of(const std::vector<DepthBufferStatistics>& parts);

DepthBufferStatistics fill_exactly(const BufferWork& work);
DepthBufferStatistics fill_certified(const BufferWork& work);

}  // namespace fathom::depth_buffer
