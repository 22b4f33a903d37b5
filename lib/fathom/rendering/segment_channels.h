#pragma once

#include <optional>
#include <vector>

#include "fathom/image/channel_table.h"
#include "fathom/mesh/segmentation.h"

/// Which channels show how a scene is divided into segments.
namespace fathom {

constexpr Channel channel_of(Segmentation by) {
  return segment_channels[static_cast<std::size_t>(by)];
}
static_assert(channel_of(Segmentation::material) == Channel::material &&
              channel_of(Segmentation::group) == Channel::group &&
              channel_of(Segmentation::part) == Channel::part &&
              channel_of(Segmentation::label) == Channel::label);

/// The segmentation that a channel shows; nullopt for other channels.
inline std::optional<Segmentation> segmentation_of(Channel channel) {
  for (const Segmentation by : all_segmentations)
    if (channel_of(by) == channel) return by;
  return std::nullopt;
}

/// The segmentations that these channels need; if there are any, the scene must have been read with
/// ReadOptions::segments.
inline std::vector<Segmentation> segmentations_of(const std::vector<Channel>& channels) {
  std::vector<Segmentation> result;
  for (const Channel channel : channels)
    if (const auto by = segmentation_of(channel)) result.push_back(*by);
  return result;
}

}  // namespace fathom
