#pragma once

#include <cstdint>

#include "fathom/depth_format/encode.h"
#include "fathom/image/depth_map.h"

namespace fathom::depth_buffer {

/// The channels of depth_buffer.h in a map, which begin with their background. A view: no channel
/// may be added to the map or removed from it meanwhile.
class BufferChannels {
 public:
  BufferChannels(DepthMap& map, const DepthFormat& format, bool against_exact);

  void store(std::size_t pixel, StoredDepth stored);
  [[nodiscard]] StoredDepth stored(std::size_t pixel) const;

  float* decoded = nullptr;
  /// Null unless against_exact.
  float* error = nullptr;
  std::uint32_t *winner = nullptr, *fight = nullptr;
  const std::uint32_t* id = nullptr;

 private:
  Storage storage_;
  std::uint32_t *codes_ = nullptr, *low_ = nullptr;
  float* values_ = nullptr;
};

}  // namespace fathom::depth_buffer
